"""What happens in a run, an instant each: events, executed lines, what is not simulated."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from rapidsim.language.moves import Place


class EventKind(StrEnum):
    """What an event is about."""

    TEXT = "text"
    SIGNAL = "signal"
    ERROR = "error"
    INTERRUPT = "interrupt"
    FILE = "file"
    SOCKET = "socket"
    CORNER = "corner"
    LIMIT = "limit"


@dataclass(frozen=True, slots=True)
class Event:
    """Something that happened at an instant."""

    time_s: float
    task: str
    kind: EventKind
    place: Place | None
    message: str
    details: Mapping[str, object] = field(default_factory=dict)
    """What a program wants to read: signal name and value, file name, interrupt number."""


@dataclass(frozen=True, slots=True)
class ExecutedLine:
    """The program pointer reached a statement that waits or moves."""

    time_s: float
    task: str
    place: Place


@dataclass(frozen=True, slots=True)
class Unsimulated:
    """A routine that was met and not simulated."""

    name: str
    count: int
    treated_as: str
