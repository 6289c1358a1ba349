"""Time of the program pointer: an offset from an instant that may be unknown yet.

Loops use up ticks, a small fixed time per iteration; they are counted in the controller's
`ticks_left` and converted to time when the time is read.
"""

from __future__ import annotations

import math

from rapidsim.controller.journal.journal import Instant, Moment

TICK_S = 1e-5
"""Virtual time of one iteration of a loop that neither moves nor waits."""
BACKGROUND_TICK_S = 1e-3
"""Virtual time [s] of an iteration in a background task, which gets the remaining CPU time."""
LONGEST_SLICE = 100_000
"""Number of ticks after which the controller checks for due events even if it expects none."""


_ROUNDING = 1e-6
"""Fraction of a tick by which a time computed differently may deviate."""
NO_TICKS = -(1 << 62)
"""Remaining ticks of a slice that the watchdog has taken: the number of used ticks is then unknown,
at most those of one slice."""


class PointerTime:
    """Time of the current statement."""

    __slots__ = ("_granted", "instant", "offset_s", "tick_s", "used")

    def __init__(self, tick_s: float = TICK_S) -> None:
        """Start at time zero, without granted ticks; a tick takes `tick_s` [s]."""
        self.tick_s = tick_s
        self.instant = Instant(0.0)
        self.offset_s = 0.0
        self.used = 0
        """Ticks used so far."""
        self._granted = 0

    @property
    def is_known(self) -> bool:
        """Whether the path that decides the time has been planned."""
        return self.instant.time is not None

    @property
    def known_s(self) -> float:
        """The time [s]; it must be known."""
        assert self.instant.time is not None
        return self.instant.time + self.offset_s

    def moment(self) -> Moment:
        """The moment for events, to be dated later."""
        return Moment(self.instant, self.offset_s)

    def settle(self, left: int) -> None:
        """Convert the used ticks to time; `left` are the remaining ones."""
        if left > NO_TICKS // 2:
            used = max(0, self._granted - left)
            self.offset_s += used * self.tick_s
            self.used += used
            self._granted = left

    def hold(self, ticks_now: int, left: int) -> int:
        """Set the remaining ticks, whatever was granted: a loop may go on counting from there."""
        self.settle(ticks_now)
        self._granted = left
        return left

    def grant(self, until_s: float, slack_s: float, most: int) -> int:
        """Number of ticks until a time [s], or for a slack [s] if the current time is unknown.

        At most `most` ticks are granted.
        """
        wait_s = until_s - self.known_s if self.is_known else slack_s
        slice_s = min(max(wait_s, 0.0), LONGEST_SLICE * self.tick_s)
        ticks = min(math.ceil(slice_s / self.tick_s - _ROUNDING), most)
        # One less: the tick that finds none remaining is the last, and it checks for events.
        self._granted = max(0, ticks - 1)
        return self._granted

    def set(self, time_s: float) -> None:
        """Set the time to a known time."""
        self.instant, self.offset_s = Instant(time_s), 0.0

    def follow(self, instant: Instant) -> None:
        """Set the time to an instant, known or not."""
        self.instant, self.offset_s = instant, 0.0
