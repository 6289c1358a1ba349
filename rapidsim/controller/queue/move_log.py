"""All moves that a robot was ever given, by number; the oldest may have been dropped."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.controller.moves.queued_move import QueuedMove


class MoveLog:
    """Numbers and count stay the same, whatever is dropped."""

    def __init__(self) -> None:
        """Begin with none."""
        self.forgotten = 0
        """How many of the first moves have been dropped."""
        self._kept: list[QueuedMove] = []

    def __len__(self) -> int:
        """How many were ever given."""
        return self.forgotten + len(self._kept)

    def __iter__(self) -> Iterator[QueuedMove]:
        """Those that are still kept."""
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
        """Those that are there from a number on, before another, with their numbers."""
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
