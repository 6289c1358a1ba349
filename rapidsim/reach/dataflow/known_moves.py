"""Moves of a program that are known statically."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

from rapidsim.diagnostics import Span
from rapidsim.language.moves import MotionSettings, Move
from rapidsim.syntax import tree
from rapidsim.syntax.bulk_rows import statement_of
from rapidsim.values import value_class

MoveStatement: TypeAlias = tree.Call | tree.BulkRow
"""A move instruction in the text: in the tree, or a row of bulk statements."""


def in_tree(call: MoveStatement) -> tree.Call:
    """Return the tree's statement equivalent to a move, except for the numbers of its target."""
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


@value_class(frozen=True, slots=True, eq=False)
class WalkedProgram:
    """Moves of a program that are known statically."""

    written: tuple[tuple[MoveStatement, tree.Module], ...]
    """Every move instruction of the text."""
    moves: tuple[KnownMove, ...]
    unknown: Mapping[MoveStatement, str]
    """Reasons why moves are unknown on at least one path of the program."""
    settings_set: frozenset[str]
    """Fields of the settings that some instruction of the program sets."""
