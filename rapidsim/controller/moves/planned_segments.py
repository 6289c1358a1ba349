"""Segments of a long plan: those of lines in rows are created again when they are needed later."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import overload

from rapidsim.controller.moves.line_rows import LineRows
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.motion.derived_values import derived_value
from rapidsim.motion.geometry.segments import Segment

_MANY = 1024
"""Number of segments from which on they are worth it."""


class PlannedSegments(Sequence[Segment]):
    """Segments of moves, as they are now."""

    def __init__(self, moves: Sequence[QueuedMove]) -> None:
        """Take the segments of moves."""
        self._now: tuple[Segment, ...] | None = tuple(queued.segment for queued in moves)
        self._count = len(moves)
        self._parts: list[Segment | tuple[LineRows, range]] = []
        lines = [one.row for one in moves]
        starts = [
            at
            for at, (before, line) in enumerate(pairwise([None, *lines]))
            if not (line and before and line.rows is before.rows and line.at == before.at + 1)
        ]
        for begin, end in pairwise([*starts, len(moves)]):
            line = lines[begin]
            whole = (line.rows, range(line.at, line.at + end - begin)) if line else None
            self._parts.append(whole or moves[begin].segment)

    @derived_value
    def _all(self) -> tuple[Segment, ...]:
        now, self._now = self._now, None
        return now or tuple(self._created())

    def _created(self) -> Iterator[Segment]:
        for part in self._parts:
            if isinstance(part, Segment):
                yield part
            else:
                yield from map(part[0].segment, part[1])

    def __len__(self) -> int:
        """Number of segments."""
        return self._count

    def __iter__(self) -> Iterator[Segment]:
        """Iterate over the segments."""
        return iter(self._all)

    @overload
    def __getitem__(self, at: int) -> Segment: ...
    @overload
    def __getitem__(self, at: slice) -> Sequence[Segment]: ...

    def __getitem__(self, at: int | slice) -> Segment | Sequence[Segment]:
        """Return a segment, or those of a slice."""
        return self._all[at]


def segments_of(moves: Sequence[QueuedMove]) -> Sequence[Segment]:
    """Return the segments of moves."""
    if len(moves) < _MANY:
        return [queued.segment for queued in moves]
    return PlannedSegments(moves)
