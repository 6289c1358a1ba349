"""Reasons for the end of a run outside the program."""

from __future__ import annotations

from rapidsim.diagnostics import Violation
from rapidsim.language.errors import Stopped


class TimeLimitReached(Stopped):
    """Virtual time reached `--max-time`."""


class EventLimitReached(TimeLimitReached):
    """The run has recorded more events than allowed."""


class WallLimitReached(TimeLimitReached):
    """The run has taken as much wall-clock time as `--max-wall` allows."""


class WaitsForever(Stopped):
    """The program waits for something that cannot happen."""

    def __init__(self, reason: str, suggestion: str | None = None) -> None:
        """Store the reason, and a suggestion to end the wait unless an input would."""
        super().__init__(reason)
        self.cure = suggestion


class PollsForever(WaitsForever):
    """The program polls something that never changes."""


class TrapStorm(Stopped):
    """Interrupts are raised faster than their traps can finish."""


class ZoneReached(Stopped):
    """The robot has reached a world zone that stops it."""


class MoveImpossible(Stopped):
    """A move at which the controller stops without calling an ERROR clause."""

    def __init__(self, violation: Violation, *, assumed: bool = False) -> None:
        """Store the finding.

        Args:
            violation: The finding.
            assumed: Whether it depends on a frame that is unknown to the run.
        """
        super().__init__(violation.message)
        self.violation = violation
        self.assumed = assumed
