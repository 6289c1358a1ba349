"""Moves of a run: a sequence of which each move is made when it is asked for, and its columns."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import accumulate, chain
from operator import attrgetter
from typing import TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt

from rapidsim.controller.moves.executed_move import CornerKind, ExecutedMove
from rapidsim.controller.moves.queued_move import QueuedMove, executed_move
from rapidsim.controller.moves.settled_lines import SettledLines
from rapidsim.diagnostics import Source
from rapidsim.frames.transform import Array
from rapidsim.language.moves import Move, Place
from rapidsim.row_sequence import RowSequence
from rapidsim.values import value_class

Index = npt.NDArray[np.int64]


MoveRow: TypeAlias = QueuedMove | ExecutedMove
"""They have most attributes in common."""
Part: TypeAlias = Sequence[MoveRow]
"""Moves in order; lines that have settled are columns."""
Value = TypeVar("Value")


class MoveRows(RowSequence[MoveRow]):
    """Moves in parts, of which some are columns; each of theirs is created when it is needed."""

    __slots__ = ("_begins", "parts")

    def __init__(self, parts: Sequence[Part]) -> None:
        """Join parts."""
        self.parts = tuple(part for part in parts if len(part))
        self._begins = list(accumulate(map(len, self.parts), initial=0))

    def __len__(self) -> int:
        """Number of moves."""
        return self._begins[-1]

    def __iter__(self) -> Iterator[MoveRow]:
        """Iterate over the moves."""
        return chain.from_iterable(self.parts)

    def _element(self, row: int) -> MoveRow:
        part = bisect_right(self._begins, row) - 1
        return self.parts[part][row - self._begins[part]]

    def values(
        self,
        of_lines: Callable[[SettledLines], Sequence[Value]],
        of_row: Callable[[MoveRow], Value],
    ) -> tuple[Value, ...]:
        """Return a value of each move: those of settled lines together, the others one by one."""
        return tuple(
            value
            for part in self.parts
            for value in (of_lines(part) if isinstance(part, SettledLines) else map(of_row, part))
        )

    def column(
        self, of_lines: Callable[[SettledLines], Array], of_row: Callable[[MoveRow], object]
    ) -> Array:
        """Return numbers (k, ...) of the moves."""
        columns = [
            of_lines(part)
            if isinstance(part, SettledLines)
            else np.array(list(map(of_row, part)), dtype=np.float64)
            for part in self.parts
        ]
        return np.concatenate(columns) if columns else np.zeros(0)


class RowValues(RowSequence[Value]):
    """A value of each move, created when it is needed."""

    __slots__ = ("_of_line", "_of_row", "_rows")

    def __init__(
        self,
        rows: MoveRows,
        of_line: Callable[[SettledLines, int], Value],
        of_row: Callable[[MoveRow], Value],
    ) -> None:
        """Take the value of a settled line by its number, and of other moves."""
        self._rows, self._of_line, self._of_row = rows, of_line, of_row

    def __len__(self) -> int:
        """Number of moves."""
        return len(self._rows)

    def __iter__(self) -> Iterator[Value]:
        """Iterate over the values."""
        for part in self._rows.parts:
            if isinstance(part, SettledLines):
                yield from (self._of_line(part, number) for number in range(len(part)))
            else:
                yield from map(self._of_row, part)

    def _element(self, row: int) -> Value:
        return self._of_row(self._rows[row])


@value_class(frozen=True, eq=False)
class MoveColumns:
    """Moves as columns of k rows; fields as those of `ExecutedMove`."""

    index: Index
    """Shape (k,): numbers of the moves, increasing for each robot."""
    start_s: Array
    """Shape (k,)."""
    end_s: Array
    """Shape (k,)."""
    tasks: Sequence[str]
    rows: MoveRows

    @cached_property
    def moves(self) -> Sequence[Move]:
        """The moves as programmed."""
        return RowValues(self.rows, SettledLines.move, attrgetter("move"))

    @cached_property
    def places(self) -> Sequence[Place]:
        """Their places in the program."""
        return RowValues(self.rows, SettledLines.place, attrgetter("place"))

    @cached_property
    def templates(self) -> tuple[Move, ...]:
        """For each move one that differs from it, if at all, in its target."""
        return self.rows.values(lambda lines: (lines.rows.like,) * len(lines), attrgetter("move"))

    @cached_property
    def sources(self) -> tuple[Source, ...]:
        """Texts that contain their statements."""
        return self.rows.values(
            lambda lines: (lines.place(0).span.source,) * len(lines),
            lambda row: row.place.span.source,
        )

    @cached_property
    def starts(self) -> Index:
        """Shape (k,): offsets of their statements in these texts."""
        return self.rows.column(SettledLines.starts, lambda row: row.place.span.start).astype(
            np.int64
        )

    @cached_property
    def lines(self) -> Index:
        """Shape (k,): lines of their statements, from 1."""
        found = np.zeros(len(self.rows), dtype=np.int64)
        names = np.array([id(source) for source in self.sources], dtype=np.int64)
        for source in {id(one): one for one in self.sources}.values():
            own = names == id(source)
            found[own] = np.searchsorted(source.line_starts, self.starts[own], side="right")
        return found

    @cached_property
    def corners(self) -> tuple[CornerKind, ...]:
        """Types of their ends."""
        return self.rows.values(SettledLines.corners, attrgetter("corner"))

    @cached_property
    def zone_m(self) -> Array:
        """Shape (k,)."""
        return self.rows.column(attrgetter("zone_m"), attrgetter("zone_m"))

    @cached_property
    def length_m(self) -> Array:
        """Shape (k,)."""
        return self.rows.column(attrgetter("length_m"), attrgetter("length_m"))

    @property
    def end_m(self) -> Array:
        """Shape (k, 3): position of the TCP at the programmed end, in base; computed anew."""
        ends = self.rows.column(SettledLines.end_m, lambda row: row.base_from_tcp.translation)
        return ends.reshape(-1, 3)

    @cached_property
    def speed_mm_s(self) -> Array:
        """Shape (k,): programmed speed [mm/s] of the TCP."""
        return np.array([move.speed.v_tcp for move in self.templates])


class ExecutedMoves(RowSequence[ExecutedMove]):
    """Moves in order; each is made anew when it is asked for."""

    __slots__ = ("columns",)

    def __init__(self, columns: MoveColumns) -> None:
        """Show columns as moves."""
        self.columns = columns

    def __len__(self) -> int:
        """Number of moves."""
        return len(self.columns.rows)

    def _element(self, row: int) -> ExecutedMove:
        columns, move = self.columns, self.columns.rows[row]
        index = int(columns.index[row])
        if isinstance(move, ExecutedMove):
            return move if move.index == index else replace(move, index=index)
        start_s, end_s = float(columns.start_s[row]), float(columns.end_s[row])
        return executed_move(index, columns.tasks[row], move, start_s, end_s)


def moves_of(moves: Iterable[ExecutedMove]) -> ExecutedMoves:
    """Return executed moves with their columns."""
    done = tuple(moves)
    index = np.array([row.index for row in done], dtype=np.int64)
    start_s = np.array([row.start_s for row in done], dtype=np.float64)
    end_s = np.array([row.end_s for row in done], dtype=np.float64)
    tasks = tuple(row.task for row in done)
    return ExecutedMoves(MoveColumns(index, start_s, end_s, tasks, MoveRows([done])))


def moves_of_all(parts: Sequence[ExecutedMoves], offsets: Sequence[int]) -> ExecutedMoves:
    """Return moves of several robots one after the other, with offsets added to their numbers."""
    if len(parts) == 1:
        return parts[0]
    every = [part.columns for part in parts]
    index = [own.index + offset for own, offset in zip(every, offsets, strict=True)]
    return ExecutedMoves(
        MoveColumns(
            np.concatenate(index),
            np.concatenate([own.start_s for own in every]),
            np.concatenate([own.end_s for own in every]),
            tuple(task for own in every for task in own.tasks),
            MoveRows([part for own in every for part in own.rows.parts]),
        )
    )
