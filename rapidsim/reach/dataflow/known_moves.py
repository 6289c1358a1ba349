"""Moves of a program that are known statically."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain
from typing import Any

import numpy as np
import numpy.typing as npt

from rapidsim.diagnostics import Span
from rapidsim.frames.transform import Array
from rapidsim.interpreter.runtime.bulk_execution import targets_of
from rapidsim.language.data import RobTarget
from rapidsim.language.moves import MotionSettings, Move
from rapidsim.reach.dataflow.move_instructions import MoveInstructions, MoveStatement
from rapidsim.repeated_rows import Index, repeated
from rapidsim.row_sequence import RowSequence
from rapidsim.syntax import tree
from rapidsim.syntax.bulk_rows import statement_of
from rapidsim.syntax.tree.bulk_statements import EXTAX, TARGET_WIDTH
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class KnownMove:
    """A move instruction with known arguments, on one of the program's paths to it."""

    call: MoveStatement
    module: tree.Module
    routine: str
    move: Move
    settings: MotionSettings
    uncertain: frozenset[str]
    """Fields of the settings that may have another value."""
    previous: int | None
    """Index of the move at whose end it starts; None if unknown."""
    begins: bool = False
    """Whether it is the first move of a run of main."""

    @property
    def span(self) -> Span:
        """Source span of the instruction."""
        return self.module.span(self.call)

    @property
    def statement(self) -> tree.Call:
        """The instruction as written."""
        call = self.call
        if isinstance(call, tree.BulkRow):
            return statement_of(call, self.module.source.text)
        return call


@dataclass(frozen=True, eq=False)
class KnownMoves(RowSequence[KnownMove]):
    """Known moves (k,) as columns; each move is created when it is needed.

    A move in the tree may be followed by those of bulk statements, which differ from it only in
    their targets: what holds for it without regard to its target holds for all of them.
    """

    instructions: MoveInstructions
    of_tree: tuple[KnownMove, ...]
    """The moves of statements in the tree."""
    number: Index
    """Number of the instruction of each of these."""
    counts: Index
    """Number of moves that each of these stands for, including itself."""

    @staticmethod
    def listed(moves: Sequence[KnownMove]) -> KnownMoves:
        """Return some moves, each by itself."""
        ones = np.ones(len(moves), dtype=np.int64)
        return KnownMoves(MoveInstructions((), {}), tuple(moves), np.arange(len(moves)), ones)

    def __len__(self) -> int:
        """Return the number of moves."""
        return int(self.counts.sum())

    def _element(self, row: int) -> KnownMove:
        of = int(self.tree_row[row])
        known = self.of_tree[of]
        if row == self._begins[of]:
            return known
        call, _ = self.instructions[int(self.instruction[row])]
        (target,) = targets_of(self.instructions.numbers_of_rows(self.instruction[row : row + 1]))
        return replace(
            known, call=call, move=replace(known.move, to=target), previous=row - 1, begins=False
        )

    @cached_property
    def _begins(self) -> Index:
        """Row of each move in the tree."""
        begins: Index = np.cumsum(self.counts) - self.counts
        return begins

    @cached_property
    def tree_row(self) -> Index:
        """Shape (k,): index of the move in the tree that differs at most in its target."""
        return repeated(self.counts)[0]

    @cached_property
    def instruction(self) -> Index:
        """Shape (k,): number of the instruction of each move."""
        number: Index = (self.number - self._begins)[self.tree_row] + np.arange(len(self))
        return number

    @cached_property
    def previous(self) -> Index:
        """Shape (k,): row of the move at whose end each starts; -1 if unknown."""
        previous: Index = np.arange(-1, len(self) - 1)
        previous[self._begins] = [
            -1 if known.previous is None else known.previous for known in self.of_tree
        ]
        return previous

    @cached_property
    def begins(self) -> npt.NDArray[np.bool_]:
        """Shape (k,): whether a run of main begins with it."""
        begins = np.zeros(len(self), dtype=bool)
        begins[self._begins] = [known.begins for known in self.of_tree]
        return begins

    def like(self, row: int) -> KnownMove:
        """Return the move in the tree that differs from a move at most in target and start."""
        return self.of_tree[int(self.tree_row[row])]

    def each(self, fact: Callable[[KnownMove], Any], dtype: Any = bool) -> npt.NDArray[Any]:
        """Return a fact about each move (k,) that does not depend on its target."""
        of_tree = np.fromiter(map(fact, self.of_tree), dtype=dtype, count=len(self.of_tree))
        found: npt.NDArray[Any] = of_tree[self.tree_row]
        return found

    def each_of(self, rows: Index, fact: Callable[[KnownMove], bool]) -> npt.NDArray[np.bool_]:
        """Return what `each` does, for some rows (m,)."""
        of_tree, which = np.unique(self.tree_row[rows], return_inverse=True)
        found: npt.NDArray[np.bool_] = np.array(
            [fact(self.of_tree[one]) for one in of_tree.tolist()], dtype=bool
        )[which]
        return found

    def numbers(self, rows: Index | slice) -> Array:
        """Return the numbers (m, 17) of the targets of rows; of axis positions only `extax`."""
        numbers: Array = self._numbers_of_tree[self.tree_row[rows]]
        instruction = self.instruction[rows]
        bulk = instruction != self.number[self.tree_row[rows]]
        numbers[bulk] = self.instructions.numbers_of_rows(instruction[bulk])
        return numbers

    @cached_property
    def _numbers_of_tree(self) -> Array:
        return np.array([numbers_of(known.move) for known in self.of_tree]).reshape(
            -1, TARGET_WIDTH
        )

    def followed_by(self, moves: Sequence[KnownMove], number: Sequence[int]) -> KnownMoves:
        """Return these moves and others of the program, by the numbers of their instructions."""
        return KnownMoves(
            self.instructions,
            (*self.of_tree, *moves),
            np.append(self.number, np.array(number, dtype=np.int64)),
            np.append(self.counts, np.ones(len(moves), dtype=np.int64)),
        )


def numbers_of(move: Move) -> list[float]:
    """Return the numbers (17,) of the target of a move; of axis positions only `extax`."""
    if isinstance(move.to, RobTarget):
        return list(chain(*move.to))
    return [np.nan] * EXTAX.start + list(move.to.extax)


@value_class(frozen=True, slots=True, eq=False)
class WalkedProgram:
    """Moves of a program that are known statically."""

    written: MoveInstructions
    """Every move instruction of the text."""
    moves: KnownMoves
    unknown: Mapping[int, str]
    """Reasons why moves are unknown on at least one path of the program, by the numbers of their
    instructions."""
    changing: frozenset[int]
    """Numbers of the instructions to which no path leads without a condition that is not known, and
    which are unknown on a path."""
    set_elsewhere: frozenset[int]
    """Numbers of those without such a path whose data some statement writes."""
    settings_set: frozenset[str]
    """Fields of the settings that some instruction of the program sets."""
