"""Move instructions of a program's text by number, those of bulk statements as columns."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Set
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from rapidsim.analysis.program import Program
from rapidsim.diagnostics import Span
from rapidsim.repeated_rows import Index
from rapidsim.row_sequence import RowSequence
from rapidsim.syntax import tree
from rapidsim.syntax.tree.bulk_statements import TARGET_WIDTH

if TYPE_CHECKING:
    from rapidsim.syntax.tree.bulk_statements import Numbers

MoveStatement: TypeAlias = tree.Call | tree.BulkRow
"""A move instruction in the text: in the tree, or a row of bulk statements."""
Runs: TypeAlias = Mapping[tree.Call, tree.BulkStatements]
"""Bulk statements of a program, by the statement in the tree before each."""
_NONE: Index = np.zeros(0, dtype=np.int64)
_Written: TypeAlias = tuple[MoveStatement, tree.Module]


def runs_of(program: Program) -> Runs:
    """Return the bulk statements of a program."""
    runs = (run for module in program.modules for run in module.runs)
    return {run.like: run for run in runs if isinstance(run.like, tree.Call)}


def in_tree(call: MoveStatement) -> tree.Call:
    """Return the tree's statement equivalent to a move, except for the numbers of its target."""
    return call.like if isinstance(call, tree.BulkRow) else call


@dataclass(frozen=True, eq=False)
class MoveInstructions(RowSequence[_Written]):
    """Move instructions with their modules, in order; each is created when it is needed."""

    of_tree: tuple[tuple[tree.Call, tree.Module], ...]
    """Those in the tree."""
    runs: Runs

    def __len__(self) -> int:
        """Return the number of instructions."""
        return int(self._firsts[-1])

    def _element(self, row: int) -> _Written:
        of = int(self._firsts.searchsorted(row, "right")) - 1
        call, module = self.of_tree[of]
        behind = row - int(self._firsts[of]) - 1
        if behind < 0:
            return call, module
        return next(self.runs[call].rows(slice(behind, behind + 1))), module

    def __iter__(self) -> Iterator[_Written]:
        """Iterate over the instructions."""
        return ((one, module) for call, module in self.of_tree for one in self._with_rows(call))

    def _with_rows(self, call: tree.Call) -> tuple[MoveStatement, ...]:
        return (call, *self.runs[call].rows()) if call in self.runs else (call,)

    @cached_property
    def _firsts(self) -> Index:
        """Number of each statement in the tree, and of all instructions: shape (calls + 1,)."""
        counts = [1 + len(self.runs.get(call, ())) for call, _ in self.of_tree]
        return np.cumsum([0, *counts])

    @cached_property
    def number_of(self) -> Mapping[tree.Call, int]:
        """Number of each statement in the tree; its rows have the next."""
        firsts = self._firsts.tolist()
        return {call: first for (call, _), first in zip(self.of_tree, firsts, strict=False)}

    def spans(self, calls: Set[tree.Call]) -> Iterator[Span]:
        """Yield the spans of some statements in the tree, and of those that they represent."""
        for call, module in self.of_tree:
            if call in calls:
                yield from map(module.span, self._with_rows(call))

    def start_around(self, file: str, offset: int) -> int | None:
        """Return the start of the last instruction that begins up to an offset and contains it."""
        starts, ends = self._places.get(file, (_NONE, _NONE))
        at = int(starts.searchsorted(offset, "right")) - 1
        return int(starts[at]) if at >= 0 and offset < ends[at] else None

    @cached_property
    def _places(self) -> Mapping[str, tuple[Index, Index]]:
        """Starts and ends (m,) of the instructions of each file, in order."""
        found: dict[str, list[tuple[Index, Index]]] = {}
        for call, module in self.of_tree:
            places = found.setdefault(module.source.file, [])
            places.append((np.array([call.start]), np.array([call.end])))
            if call in self.runs:
                places.append((self.runs[call].starts, self.runs[call].ends))
        return {
            file: (np.concatenate([one for one, _ in of]), np.concatenate([one for _, one in of]))
            for file, of in found.items()
        }

    @cached_property
    def by_place(self) -> Mapping[tuple[str, int], int]:
        """Numbers of the instructions by file and offset: for programs that a check runs."""
        return {
            (module.source.file, call.start): number for number, (call, module) in enumerate(self)
        }

    def numbers_of_rows(self, instruction: Index) -> Numbers:
        """Return the numbers (m, 17) of the targets of bulk statements."""
        of = self._firsts.searchsorted(instruction, "right") - 1
        numbers: Numbers = self._numbers[instruction - of - 1]
        return numbers

    @cached_property
    def _numbers(self) -> Numbers:
        tables = [self.runs[call].numbers for call, _ in self.of_tree if call in self.runs]
        if len(tables) == 1:
            return tables[0]
        return np.concatenate(tables) if tables else np.zeros((0, TARGET_WIDTH), dtype=np.float32)
