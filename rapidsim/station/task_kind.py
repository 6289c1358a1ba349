"""Type of a task, which determines its treatment by a controller."""

from __future__ import annotations

from enum import StrEnum


class TaskKind(StrEnum):
    """The type of a task in the configuration of a controller."""

    NORMAL = "normal"
    """Started and stopped by the user; the run lasts until all of these have ended."""
    STATIC = "static"
    """Runs in the background and restarts from main when it has ended."""
    SEMISTATIC = "semistatic"
    """Like `STATIC`; a controller restarts it from main when it is switched on."""
