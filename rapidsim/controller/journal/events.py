"""Records of a run, each at an instant: events, executed lines, unsimulated routines."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from enum import StrEnum

from rapidsim.language.error_answers import AnsweredError
from rapidsim.language.moves import Place
from rapidsim.values import value_class


class EventKind(StrEnum):
    """Subject of an event."""

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
    FAULT = "fault"


@value_class(frozen=True, slots=True, repr=False)
class Event:
    """An event at an instant."""

    time_s: float
    task: str
    kind: EventKind
    place: Place | None
    message: str
    details: Mapping[str, object] = field(default_factory=dict)
    """Data for programs: signal name and value, file name, interrupt number."""
    moves_given: int = 0
    """Number of moves that the task's robot had got before."""

    def __repr__(self) -> str:
        """One line."""
        said = self.message if len(self.message) < 60 else f"{self.message[:57]}..."
        return f"<{self.kind} at {self.time_s:.3f} s of {self.task[:20]}: {said!r}>"


@value_class(frozen=True, slots=True)
class ErrorTally:
    """Errors of one number from one place that one ERROR clause handled with the same result."""

    time_s: float
    """Time of the first."""
    last_s: float
    task: str
    error: AnsweredError
    count: int


@value_class(frozen=True, slots=True)
class ExecutedLine:
    """Arrival of the program pointer at a statement that waits or moves."""

    time_s: float
    task: str
    place: Place


@value_class(frozen=True, slots=True)
class Wait:
    """A statement that let virtual time pass; waits of length 0 are not recorded."""

    task: str
    place: Place
    awaited: str
    """The awaited condition, in the words of the program: `diReady = 1`, `0.5 s`."""
    start_s: float
    end_s: float
    ended_by: str
    """The event that ended it, and its cause; `CUT_OFF` if the run ended first."""


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
