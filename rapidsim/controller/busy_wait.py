"""Detecting that a loop only polls, so that it can skip to the next thing that happens.

A program whose state is the same at the same place a few ticks later, and which has asked nothing
of the controller meanwhile but to look, will be there again after as many ticks, and again, until
something happens that it may notice.

What it looks at may change by itself, as a clock does: whoever tells the program such a value says
how long it stays as it is.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import zip_longest

FIRST_LOOK = 200
"""Ticks that a program may use without a wait before polling is looked for."""
LONGEST_ROUND = 100
"""The longest round that is detected, in ticks."""
SELDOM = 100_000
"""A program that computes is checked ever less often, but at least once in so many ticks."""


@dataclass(slots=True, eq=False)
class BusyWaitDetector:
    """Looks for rounds of one task's program."""

    state: Callable[[], Iterable[object]]
    """All that decides what the program does next, in parts to be compared; it ends with None where
    it is too much."""
    _observed_ticks: int = 0
    """Ticks at which watching began."""
    _since: int = 0
    """Ticks at the state that later ones are compared with."""
    _seen: tuple[object, tuple[object, ...]] | None = None
    """What the program had done by then, and its state; None while nothing is watched."""
    _pause: int = FIRST_LOOK
    _next: int = FIRST_LOOK
    _done: object = None
    """What it had done at the last look."""
    stable_until_s: float = math.inf
    """Until this time [s], everything that the watched round has read stays the same."""

    def note_stable_until(self, until_s: float) -> None:
        """Note that the program has read something that stays unchanged until a time [s]."""
        self.stable_until_s = min(self.stable_until_s, until_s)

    def ticks_left(self, used: int) -> int:
        """How many ticks may go by before `observe` is asked, given those that were used so far."""
        return 0 if self._seen is not None else max(0, self._next - used)

    def observe(self, used: int, done: object) -> int | None:
        """The ticks of a round that the program repeats; None while none is known.

        Args:
            used: Ticks so far.
            done: Equal to what it was earlier if the program has only looked since.
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
                # Rounds may begin later: compare with a state ever further on.
                # Source: Brent (1980), An improved Monte Carlo factorization algorithm.
                if used - self._since >= self._since - self._observed_ticks:
                    self._keep(used, done)
                return None
        self.note_failed_check(used)
        return None

    def again(self, used: int, ticks: int) -> None:
        """Rounds of so many ticks were skipped; look after the next one whether there are more."""
        # What ends the wait falls into the next, and what is seen of it stands after that.
        self._seen, self._next, self._pause = None, used + 2 * ticks, FIRST_LOOK

    def note_failed_check(self, used: int) -> None:
        """Nothing was found, or it was of no use; look later, and ever less often."""
        self._seen = None
        self._pause = min(2 * self._pause, SELDOM)
        self._next = used + self._pause

    def _begin(self, used: int, done: object) -> None:
        if done != self._done:
            self._pause = FIRST_LOOK
        self._done, self._observed_ticks = done, used
        self._keep(used, done)

    def _keep(self, used: int, done: object) -> None:
        """Compare with the present state."""
        self.stable_until_s = math.inf
        state = tuple(self.state())
        if state[-1:] == (None,):
            self._seen, self._next = None, used + SELDOM
        else:
            self._since, self._seen = used, (done, state)
