"""Type of a task, which determines its treatment by a controller."""

from __future__ import annotations

from enum import StrEnum


class TaskEvent(StrEnum):
    """Events of a task that call routines of its program, in the words of a configuration."""

    START = "START"
    """The program is started from main."""
    STOP = "STOP"
    """The program is stopped."""
    QUICK_STOP = "QSTOP"
    """The program is stopped quickly, as by an emergency stop."""
    RESTART = "RESTART"
    """The program is started where it stopped."""


class TaskKind(StrEnum):
    """The type of a task in the configuration of a controller."""

    NORMAL = "normal"
    """Started and stopped by the user; the run lasts until all of these have ended."""
    STATIC = "static"
    """Runs in the background and restarts from main when it has ended."""
    SEMISTATIC = "semistatic"
    """Like `STATIC`; a controller restarts it from main when it is switched on."""
