"""The time of the program pointer: an offset from an instant that may not be known yet.

Loops use up ticks, a small fixed time a turn; they are counted in the controller's `left` and
turned into time when somebody looks.
"""

from __future__ import annotations

import math

from rapidsim.controller.journal.journal import Instant, Moment

TICK_S = 1e-5
"""Virtual time of one turn of a loop that neither moves nor waits."""
BACKGROUND_TICK_S = 1e-3
"""The same in a background task, which gets what normal tasks leave of the processor."""
LONGEST_SLICE = 100_000
"""Ticks after which the controller checks what is due even if it expects nothing."""


_ROUNDING = 1e-6
"""The fraction of a tick by which a time computed in another way may differ."""
NO_TICKS = -(1 << 62)
"""What is left of a slice whose ticks the watchdog has taken away: how many were used is not
known, at most those of one slice."""


class PointerTime:
    """When the current statement happens."""

    __slots__ = ("_granted", "instant", "offset_s", "tick_s", "used")

    def __init__(self, tick_s: float = TICK_S) -> None:
        """Start at time zero, with no ticks granted; a tick takes `tick_s` [s]."""
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
        """The time as events keep it, to be dated later."""
        return Moment(self.instant, self.offset_s)

    def settle(self, left: int) -> None:
        """Turn the ticks that were used into time, given those that are left."""
        if left > NO_TICKS // 2:
            used = max(0, self._granted - left)
            self.offset_s += used * self.tick_s
            self.used += used
            self._granted = left

    def hold(self, ticks_now: int, left: int) -> int:
        """Set the ticks left, whatever was granted: a loop may continue counting from there."""
        self.settle(ticks_now)
        self._granted = left
        return left

    def grant(self, until_s: float, slack_s: float, most: int) -> int:
        """Ticks that the program may use until a time [s], or for a slack [s] if none is known.

        They are no more than `most`.
        """
        wait_s = until_s - self.known_s if self.is_known else slack_s
        slice_s = min(max(wait_s, 0.0), LONGEST_SLICE * self.tick_s)
        ticks = min(math.ceil(slice_s / self.tick_s - _ROUNDING), most)
        # With the last of them none is left, and the one that finds none looks around.
        self._granted = max(0, ticks - 1)
        return self._granted

    def set(self, time_s: float) -> None:
        """Go to a known time."""
        self.instant, self.offset_s = Instant(time_s), 0.0

    def follow(self, instant: Instant) -> None:
        """Go to an instant, known or not."""
        self.instant, self.offset_s = instant, 0.0
