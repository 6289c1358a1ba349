"""Log of all moves that a robot ever got, by number; the oldest may have been dropped."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.controller.moves.queued_move import QueuedMove


class MoveLog:
    """Moves by number; numbers and count do not change when moves are dropped."""

    def __init__(self) -> None:
        """Begin without moves."""
        self.forgotten = 0
        """Number of dropped moves, which are the first ones."""
        self._kept: list[QueuedMove] = []

    def __len__(self) -> int:
        """Number of all moves, dropped ones included."""
        return self.forgotten + len(self._kept)

    def __iter__(self) -> Iterator[QueuedMove]:
        """Iterate over the moves that are not dropped."""
        return iter(self._kept)

    def __getitem__(self, number: int) -> QueuedMove:
        """A move by its number; a negative one counts from the end."""
        at = number if number < 0 else number - self.forgotten
        if 0 <= number < self.forgotten:
            raise IndexError(f"move {number} is forgotten")
        return self._kept[at]

    def append(self, queued: QueuedMove) -> None:
        """Add a move."""
        self._kept.append(queued)

    def numbered(self, first: int = 0, last: int | None = None) -> Iterator[tuple[int, QueuedMove]]:
        """Kept moves from number `first` on and before `last`, with their numbers."""
        begin = max(first - self.forgotten, 0)
        end = None if last is None else last - self.forgotten
        return enumerate(self._kept[begin:end], self.forgotten + begin)

    def forget(self, before_s: float, until: int) -> None:
        """Drop moves that ended before a time [s], up to a number; never the last move."""
        count, most = 0, min(until, len(self) - 1) - self.forgotten
        while count < most and self._kept[count].is_over(before_s):
            count += 1
        del self._kept[:count]
        self.forgotten += count
