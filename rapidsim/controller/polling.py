"""Finding out that a loop only looks, so that it can be taken to where something happens at once.

A program whose state is the same at the same place a few ticks later, and which has asked nothing
of the controller meanwhile but to look, will be there again after as many ticks, and again, until
something happens that it may notice.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import zip_longest

FIRST_LOOK = 200
"""Ticks that a program may take without a wait before anybody looks whether it polls."""
LONGEST_ROUND = 100
"""Ticks of the longest round that is found."""
SELDOM = 100_000
"""A program that computes is looked at ever more seldom, but once in so many ticks."""


@dataclass(slots=True, eq=False)
class Polling:
    """Looks for rounds of one task's program."""

    state: Callable[[], Iterable[object]]
    """All that decides what the program does next, in parts to be compared; it ends with None where
    it is too much."""
    _since: int = 0
    """Ticks at which the round that is watched began."""
    _seen: tuple[object, tuple[object, ...]] | None = None
    """What the program had done by then, and its state; None while nothing is watched."""
    _pause: int = FIRST_LOOK
    _next: int = FIRST_LOOK
    _done: object = None
    """What it had done when it was last looked at."""

    def ticks_left(self, used: int) -> int:
        """How many ticks may go by before `look` is asked, given those that were used so far."""
        return 0 if self._seen is not None else max(0, self._next - used)

    def look(self, used: int, done: object) -> int | None:
        """The ticks of a round that the program makes again and again; None while none is known.

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
            if used - self._since < LONGEST_ROUND:
                return None
        self._seen = None
        self._pause = min(2 * self._pause, SELDOM)
        self._next = used + self._pause
        return None

    def again(self) -> None:
        """The rounds have been made; look from here on whether there are more."""
        self._seen, self._next, self._pause = None, 0, FIRST_LOOK

    def _begin(self, used: int, done: object) -> None:
        if done != self._done:
            self._pause = FIRST_LOOK
        self._done = done
        state = tuple(self.state())
        if state[-1:] == (None,):
            self._next = used + SELDOM
        else:
            self._since, self._seen = used, (done, state)
