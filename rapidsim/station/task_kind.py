"""How a controller treats a task."""

from __future__ import annotations

from enum import StrEnum


class TaskKind(StrEnum):
    """The type of a task in the configuration of a controller."""

    NORMAL = "normal"
    """It is started and stopped; the run lasts as long as any of these."""
    STATIC = "static"
    """It runs in the background and starts again from main when it has ended."""
    SEMISTATIC = "semistatic"
    """As `STATIC`; a controller starts it anew when it is switched on."""
