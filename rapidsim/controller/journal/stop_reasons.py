"""What ends a run from outside the program."""

from __future__ import annotations

from rapidsim.diagnostics import Violation
from rapidsim.language.errors import RunLimitReached, Stopped


class TimeLimitReached(RunLimitReached):
    """Virtual time reached `--max-time`."""


class EventLimitReached(TimeLimitReached):
    """The run has noted more events than it may keep."""


class WallLimitReached(TimeLimitReached):
    """The run has taken as much wall-clock time as `--max-wall` allows."""


class WaitsForever(Stopped):
    """The program waits for something that cannot happen."""

    def __init__(self, reason: str, suggestion: str | None = None) -> None:
        """Say why, and what would end the wait if that is not an input."""
        super().__init__(reason)
        self.cure = suggestion


class PollsForever(WaitsForever):
    """The program polls something that never changes."""


class TrapStorm(Stopped):
    """Interrupts come faster than their traps can finish."""


class ZoneReached(Stopped):
    """The robot came to a world zone that stops it."""


class MoveImpossible(Stopped):
    """A move at which the controller stops without calling an ERROR clause."""

    def __init__(self, violation: Violation, *, assumed: bool = False) -> None:
        """Carry the finding along.

        Args:
            violation: The finding.
            assumed: Whether it rests on a frame that the run does not know.
        """
        super().__init__(violation.message)
        self.violation = violation
        self.assumed = assumed
