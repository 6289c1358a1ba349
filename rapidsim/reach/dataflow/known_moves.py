"""The moves of a program, as far as they are known before it runs."""

from __future__ import annotations

from rapidsim.diagnostics import Span
from rapidsim.language.moves import MotionSettings, Move
from rapidsim.syntax import tree
from rapidsim.values import dataclass


@dataclass(frozen=True, slots=True, eq=False)
class KnownMove:
    """A move instruction with known arguments, in one of the ways the program comes to it."""

    call: tree.Call
    module: tree.Module
    routine: str
    move: Move
    settings: MotionSettings
    uncertain: frozenset[str]
    """Fields of the settings that may hold something else."""
    previous: int | None
    """Index of the move at whose end it starts; None where that is not known."""

    @property
    def span(self) -> Span:
        """Where the instruction stands."""
        return self.module.span(self.call)


@dataclass(frozen=True, slots=True, eq=False)
class WalkedProgram:
    """The moves of a program, as far as they are known."""

    written: tuple[tuple[tree.Call, tree.Module], ...]
    """Every move instruction of the text."""
    known: tuple[KnownMove, ...]
    unknown: dict[tree.Call, str]
    """Why a move is not known in at least one of the ways the program comes to it."""
    settings_set: frozenset[str]
    """Fields of the settings that some instruction of the program sets."""
