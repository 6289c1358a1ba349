"""Detection of busy waits: loops that only poll, so that time can skip to the next event.

A program whose state repeats at the same place a few ticks later, without side effects in between,
will be there again after as many ticks, and again, until an event that it may notice.

A value that it reads may change by itself, as a clock does: the function that returns such a value
also notes until when it stays unchanged.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import zip_longest

FIRST_LOOK = 200
"""Number of ticks without a wait after which the search for polling begins."""
LONGEST_ROUND = 100
"""Longest iteration [ticks] that is detected."""
SELDOM = 100_000
"""Maximum number of ticks between two checks of a program that computes."""


@dataclass(slots=True, eq=False)
class BusyWaitDetector:
    """Detects repeated iterations of one task's program."""

    state: Callable[[], Iterable[object]]
    """Everything that decides the program's next statement, in parts to be compared; it ends with
    None if it is too large."""
    _observed_ticks: int = 0
    """Number of ticks at which the observation began."""
    _since: int = 0
    """Number of ticks at the state with which later ones are compared."""
    _seen: tuple[object, tuple[object, ...]] | None = None
    """Count of effects at that state, and the state; None while nothing is observed."""
    _pause: int = FIRST_LOOK
    _next: int = FIRST_LOOK
    _done: object = None
    """Count of effects at the last check."""
    stable_until_s: float = math.inf
    """Time [s] until which all values that the observed iteration has read stay the same."""

    def note_stable_until(self, until_s: float) -> None:
        """Note that the program has read something that stays unchanged until a time [s]."""
        self.stable_until_s = min(self.stable_until_s, until_s)

    def ticks_left(self, used: int) -> int:
        """Number of ticks that may pass before `observe` is called, after `used` ticks so far."""
        return 0 if self._seen is not None else max(0, self._next - used)

    def observe(self, used: int, done: object) -> int | None:
        """Number of ticks of the iteration that the program repeats; None if none is detected.

        Args:
            used: Ticks so far.
            done: Count of effects; unchanged if the program has only read since.
        """
        if self._seen is None:
            if used >= self._next:
                self._begin(used, done)
            return None
        begun, state = self._seen
        if done == begun:
            if all(a == b for a, b in zip_longest(state, self.state())):
                return used - self._since
            if used - self._observed_ticks < LONGEST_ROUND:
                # Iterations may begin later: compare with ever later states.
                # Source: Brent (1980), An improved Monte Carlo factorization algorithm.
                if used - self._since >= self._since - self._observed_ticks:
                    self._keep(used, done)
                return None
        self.note_failed_check(used)
        return None

    def again(self, used: int, ticks: int) -> None:
        """Note that iterations of so many ticks were skipped; check for more after the next one."""
        # The end of the wait falls into the next iteration, and the reaction follows it.
        self._seen, self._next, self._pause = None, used + 2 * ticks, FIRST_LOOK

    def note_failed_check(self, used: int) -> None:
        """Note that nothing was detected or skipped; check later, at growing intervals."""
        self._seen = None
        self._pause = min(2 * self._pause, SELDOM)
        self._next = used + self._pause

    def _begin(self, used: int, done: object) -> None:
        if done != self._done:
            self._pause = FIRST_LOOK
        self._done, self._observed_ticks = done, used
        self._keep(used, done)

    def _keep(self, used: int, done: object) -> None:
        """Save the current state for comparison."""
        self.stable_until_s = math.inf
        state = tuple(self.state())
        if state[-1:] == (None,):
            self._seen, self._next = None, used + SELDOM
        else:
            self._since, self._seen = used, (done, state)
