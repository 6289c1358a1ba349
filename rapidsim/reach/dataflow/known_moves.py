"""The moves of a program, as far as they are known without running it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

from rapidsim.diagnostics import Span
from rapidsim.language.moves import MotionSettings, Move
from rapidsim.syntax import tree
from rapidsim.syntax.bulk_rows import statement_of
from rapidsim.values import value_class

MoveStatement: TypeAlias = tree.Call | tree.BulkRow
"""A move instruction where it is written, in the tree or in a run of alike ones."""


def in_tree(call: MoveStatement) -> tree.Call:
    """The statement in the tree equivalent to a move, except for the numbers of its target."""
    return call.like if isinstance(call, tree.BulkRow) else call


@value_class(frozen=True, slots=True, eq=False)
class KnownMove:
    """A move instruction with known arguments, on one of the program's paths to it."""

    call: MoveStatement
    module: tree.Module
    routine: str
    move: Move
    settings: MotionSettings
    uncertain: frozenset[str]
    """Fields of the settings that may hold something else."""
    previous: int | None
    """Index of the move at whose end it starts; None where that is not known."""
    begins: bool = False
    """Whether it is the first move of a run of main."""

    @property
    def span(self) -> Span:
        """The source span of the instruction."""
        return self.module.span(self.call)

    @property
    def statement(self) -> tree.Call:
        """The instruction as written."""
        call = self.call
        if isinstance(call, tree.BulkRow):
            return statement_of(call, self.module.source.text)
        return call


@value_class(frozen=True, slots=True, eq=False)
class WalkedProgram:
    """The moves of a program, as far as they are known."""

    written: tuple[tuple[MoveStatement, tree.Module], ...]
    """Every move instruction of the text."""
    moves: tuple[KnownMove, ...]
    unknown: Mapping[MoveStatement, str]
    """Why a move is not known in at least one of the ways the program comes to it."""
    settings_set: frozenset[str]
    """Fields of the settings that some instruction of the program sets."""
