"""Statements that the program pointer reached; those of announced moves are columns."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from itertools import accumulate
from typing import TypeAlias

import numpy as np

from rapidsim.controller.journal.events import ExecutedLine
from rapidsim.frames.transform import Array
from rapidsim.language.moves import AnnouncedTargets, Place
from rapidsim.row_sequence import RowSequence
from rapidsim.values import value_class

DatedPlace: TypeAlias = tuple[float, Place]
"""A time [s], and the place that was reached then."""


@value_class(frozen=True, slots=True, eq=False)
class DatedRows(RowSequence[DatedPlace]):
    """Successive statements (k,) with announced targets."""

    times: Array
    """Shape (k,) [s]."""
    targets: AnnouncedTargets
    first: int

    def __len__(self) -> int:
        return len(self.times)

    def _element(self, row: int) -> DatedPlace:
        return float(self.times[row]), self.targets.place(self.first + row)


def in_parts(lines: Sequence[DatedPlace]) -> Iterator[Sequence[DatedPlace]]:
    """Divide statements into those of announced targets, as columns, and others as they are."""
    begin = 0
    for end in range(1, len(lines) + 1):
        if end < len(lines) and _is_next(lines[end - 1][1], lines[end][1]):
            continue
        row, part = lines[begin][1].row, lines[begin:end]
        times = np.array([time_s for time_s, _ in part])
        yield part if row is None else DatedRows(times, row.targets, row.number)
        begin = end


def _is_next(before: Place, after: Place) -> bool:
    one, other = before.row, after.row
    if one is None or other is None:
        return one is other
    return one.targets is other.targets and other.number == one.number + 1


class ExecutedLines(RowSequence[ExecutedLine]):
    """Statements of a task in order of time; each is created when it is needed."""

    __slots__ = ("_begins", "_order", "_parts", "_task", "times")

    def __init__(self, task: str, parts: Sequence[Sequence[DatedPlace]]) -> None:
        """Sort the statements of a task by time; at the same time, they retain their order."""
        self._task, self._parts = task, tuple(part for part in parts if len(part))
        self._begins = list(accumulate(map(len, self._parts), initial=0))
        columns = [
            part.times if isinstance(part, DatedRows) else np.array([time_s for time_s, _ in part])
            for part in self._parts
        ]
        times = np.concatenate([np.zeros(0), *columns])
        self._order = np.argsort(times, kind="stable")
        self.times: Array = times[self._order]
        """Shape (k,) [s]."""

    def __len__(self) -> int:
        """Number of statements."""
        return len(self.times)

    def _element(self, row: int) -> ExecutedLine:
        number = int(self._order[row])
        part = bisect_right(self._begins, number) - 1
        time_s, place = self._parts[part][number - self._begins[part]]
        return ExecutedLine(time_s, self._task, place)


def times_of(lines: Sequence[ExecutedLine]) -> Array:
    """Return the times (k,) [s] of statements."""
    if isinstance(lines, ExecutedLines):
        return lines.times
    return np.array([line.time_s for line in lines], dtype=np.float64)
