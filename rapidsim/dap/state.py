"""State that a debuggee hands over to the process that continues in its place."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any

from rapidsim.dap.wire import Message


@dataclass
class Change:
    """A value that the user has set, applied again whenever the run gets there."""

    number: int
    """Number of the statement before which it was set."""
    task: str
    depth: int
    """Routines between the innermost one and that of the name."""
    name: str
    """Data with indices and components, or a signal."""
    text: str
    """The value in source notation."""


@dataclass
class SessionState:
    """The state of a session apart from the run itself; it is sent as JSON."""

    breakpoints: dict[str, list[Message]] = field(default_factory=dict)
    """Arguments of the client, by path of the source."""
    filters: dict[str, str] = field(default_factory=dict)
    """Enabled exception filters, each with its condition."""
    watchpoints: list[str] = field(default_factory=list)
    """Names of data and signals with a data breakpoint."""
    changes: list[Change] = field(default_factory=list)
    printed: int = 0
    """Number of texts of the run that the client's console shows already."""
    target: int = 0
    """Number of the statement to run to; 0 for none."""
    reason: str = "goto"
    """Reason of the stop there."""
    text: str = ""
    """Description of the stop there."""
    survey_until: int = 0
    """Number of the statement up to which stops are only noted, to go to the last one; 0 for
    none."""
    steps: list[list[int]] = field(default_factory=list)
    """Pairs of numbers: a step led to the first statement from the second."""
    client: Message = field(default_factory=dict)
    """State of a client that is in the same process."""
    unhandled_error: int = 0
    """Number of the statement whose error, which ends the program, has been shown."""

    def message(self) -> Message:
        """The state as JSON values."""
        return asdict(self)

    @classmethod
    def read(cls, message: Any) -> SessionState:
        """The state of a message."""
        changes = [Change(**one) for one in message["changes"]]
        return cls(**{**message, "changes": changes})
