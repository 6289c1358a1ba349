"""What happens in a run, each at an instant: events, executed lines, what is not simulated."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from enum import StrEnum

from rapidsim.language.error_answers import AnsweredError
from rapidsim.language.moves import Place
from rapidsim.values import value_class


class EventKind(StrEnum):
    """What an event is about."""

    TEXT = "text"
    SIGNAL = "signal"
    ERROR = "error"
    INTERRUPT = "interrupt"
    FILE = "file"
    SOCKET = "socket"
    MESSAGE = "message"
    GUIDANCE = "guidance"
    CORNER = "corner"
    LIMIT = "limit"


@value_class(frozen=True, slots=True, repr=False)
class Event:
    """Something that happened at an instant."""

    time_s: float
    task: str
    kind: EventKind
    place: Place | None
    message: str
    details: Mapping[str, object] = field(default_factory=dict)
    """What a program wants to read: signal name and value, file name, interrupt number."""
    moves_given: int = 0
    """How many moves the task's robot had been given before."""

    def __repr__(self) -> str:
        """One line."""
        said = self.message if len(self.message) < 60 else f"{self.message[:57]}..."
        return f"<{self.kind} at {self.time_s:.3f} s of {self.task[:20]}: {said!r}>"


@value_class(frozen=True, slots=True)
class ErrorTally:
    """Errors of one number that one place raised and one ERROR clause answered in one way."""

    time_s: float
    """When the first was raised."""
    last_s: float
    task: str
    error: AnsweredError
    count: int


@value_class(frozen=True, slots=True)
class ExecutedLine:
    """The program pointer reached a statement that waits or moves."""

    time_s: float
    task: str
    place: Place


@value_class(frozen=True, slots=True)
class Wait:
    """A statement let virtual time pass; waits of no length are not recorded."""

    task: str
    place: Place
    awaited: str
    """What it waited for, in the words of the program: `diReady = 1`, `0.5 s`."""
    start_s: float
    end_s: float
    ended_by: str
    """What ended it, and its cause; `CUT_OFF` if the run ended first."""


CUT_OFF = "the end of the run"
THE_TIME = "the time"
MAX_TIME = "its time limit"
SATISFIED = "its condition"


@value_class(frozen=True, slots=True)
class Unsimulated:
    """A routine that was called and not simulated."""

    name: str
    count: int
    treated_as: str
    is_unknown: bool = False
    """Whether no module declares it: its calls were skipped."""
