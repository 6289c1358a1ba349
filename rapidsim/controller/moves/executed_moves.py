"""Moves of a run: a sequence of which each move is made when it is asked for, and its columns."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import cached_property
from typing import TypeAlias, overload

import numpy as np
import numpy.typing as npt

from rapidsim.controller.moves.executed_move import CornerKind, ExecutedMove
from rapidsim.controller.moves.queued_move import QueuedMove, executed_move
from rapidsim.frames.transform import Array
from rapidsim.language.moves import Move, Place
from rapidsim.values import value_class

Index = npt.NDArray[np.int64]


MoveRow: TypeAlias = QueuedMove | ExecutedMove
"""They have most attributes in common."""


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
    rows: Sequence[MoveRow]

    @cached_property
    def moves(self) -> tuple[Move, ...]:
        """The moves as programmed."""
        return tuple(row.move for row in self.rows)

    @cached_property
    def places(self) -> tuple[Place, ...]:
        """Their places in the program."""
        return tuple(row.place for row in self.rows)

    @cached_property
    def corners(self) -> tuple[CornerKind, ...]:
        """Types of their ends."""
        return tuple(row.corner for row in self.rows)

    @cached_property
    def zone_m(self) -> Array:
        """Shape (k,)."""
        return np.array([row.zone_m for row in self.rows])

    @cached_property
    def length_m(self) -> Array:
        """Shape (k,)."""
        return np.array([row.length_m for row in self.rows])

    @cached_property
    def end_m(self) -> Array:
        """Shape (k, 3): position of the TCP at the programmed end, in base."""
        ends = [row.base_from_tcp.translation for row in self.rows]
        return np.array(ends).reshape(-1, 3)

    @cached_property
    def speed_mm_s(self) -> Array:
        """Shape (k,): programmed speed [mm/s] of the TCP."""
        return np.array([move.speed.v_tcp for move in self.moves])


class ExecutedMoves(Sequence[ExecutedMove]):
    """Moves in order; each is made anew when it is asked for."""

    __slots__ = ("columns",)

    def __init__(self, columns: MoveColumns) -> None:
        """Show columns as moves."""
        self.columns = columns

    def __len__(self) -> int:
        """Number of moves."""
        return len(self.columns.rows)

    @overload
    def __getitem__(self, at: int) -> ExecutedMove: ...
    @overload
    def __getitem__(self, at: slice) -> tuple[ExecutedMove, ...]: ...

    def __getitem__(self, at: int | slice) -> ExecutedMove | tuple[ExecutedMove, ...]:
        """Return the move of a row, or those of a slice."""
        if isinstance(at, slice):
            return tuple(map(self.__getitem__, range(len(self))[at]))
        columns, row = self.columns, self.columns.rows[at]
        index = int(columns.index[at])
        if isinstance(row, ExecutedMove):
            return row if row.index == index else replace(row, index=index)
        start_s, end_s = float(columns.start_s[at]), float(columns.end_s[at])
        return executed_move(index, columns.tasks[at], row, start_s, end_s)


def moves_of(moves: Iterable[ExecutedMove]) -> ExecutedMoves:
    """Return executed moves with their columns."""
    rows = tuple(moves)
    index = np.array([row.index for row in rows], dtype=np.int64)
    start_s = np.array([row.start_s for row in rows], dtype=np.float64)
    end_s = np.array([row.end_s for row in rows], dtype=np.float64)
    return ExecutedMoves(MoveColumns(index, start_s, end_s, tuple(row.task for row in rows), rows))


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
            tuple(row for own in every for row in own.rows),
        )
    )
