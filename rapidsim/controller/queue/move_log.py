"""Log of all moves that a robot ever got, by number; the oldest may have been dropped."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from itertools import chain

from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.controller.moves.settled_lines import settled

_FEWEST = 500
"""Number of moves that settle together at least."""


class MoveLog:
    """Moves by number; numbers and count do not change when moves are dropped."""

    def __init__(self) -> None:
        """Begin without moves."""
        self.forgotten = 0
        """Number of dropped moves, which are the first ones."""
        self._settled: list[Sequence[QueuedMove]] = []
        """Moves that are over, in parts."""
        self._begins: list[int] = []
        """Number of the first move of each part."""
        self._first = 0
        """Number of the first of the other moves."""
        self._kept: list[QueuedMove] = []

    def __len__(self) -> int:
        """Number of all moves, dropped ones included."""
        return self._first + len(self._kept)

    def __iter__(self) -> Iterator[QueuedMove]:
        """Iterate over the moves that are not dropped."""
        return chain.from_iterable(self.parts)

    def __getitem__(self, number: int) -> QueuedMove:
        """A move by its number; a negative one counts from the end."""
        number += len(self) if number < 0 else 0
        if number >= self._first:
            return self._kept[number - self._first]
        if number < self.forgotten:
            raise IndexError(f"move {number} is forgotten")
        part = bisect_right(self._begins, number) - 1
        return self._settled[part][number - self._begins[part]]

    @property
    def parts(self) -> Sequence[Sequence[QueuedMove]]:
        """Moves that are not dropped, in parts, of which some are columns."""
        return (*self._settled, self._kept)

    def extend(self, moves: Sequence[QueuedMove]) -> None:
        """Add moves."""
        self._kept.extend(moves)

    def numbered(self, first: int = 0, last: int | None = None) -> Iterator[tuple[int, QueuedMove]]:
        """Kept moves from number `first` on and before `last`, with their numbers."""
        end = len(self) if last is None else min(last, len(self))
        return ((number, self[number]) for number in range(max(first, self.forgotten), end))

    def settle(self, until: int) -> None:
        """Store moves up to a number, which are over and no longer planned, as columns."""
        count = until - self._first
        if count < _FEWEST:
            return
        for part in settled(self._kept[:count]):
            self._settled.append(part)
            self._begins.append(self._first)
            self._first += len(part)
        del self._kept[:count]

    def forget(self, before_s: float, until: int) -> None:
        """Drop moves that ended before a time [s], up to a number; never the last move."""
        most = min(until, len(self) - 1)
        while self._settled:
            end = self.forgotten + len(self._settled[0])
            if end > most or not all(one.is_over(before_s) for one in self._settled[0]):
                return
            del self._settled[0], self._begins[0]
            self.forgotten = end
        count = 0
        while count < most - self._first and self._kept[count].is_over(before_s):
            count += 1
        del self._kept[:count]
        self._first += count
        self.forgotten = self._first
