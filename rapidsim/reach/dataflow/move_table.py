"""The moves that the abstract interpreter meets, each known one once with what precedes it."""

from __future__ import annotations

from collections.abc import Sequence, Set
from dataclasses import dataclass, field

from rapidsim.analysis.program import RoutineSymbol
from rapidsim.language.data import JointTarget
from rapidsim.language.moves import Move
from rapidsim.reach.dataflow.bulk_moves import Runs, moves_of_run
from rapidsim.reach.dataflow.known_moves import KnownMove, MoveStatement
from rapidsim.reach.dataflow.motion_settings import DISPLACEMENTS, KnownSettings
from rapidsim.reach.dataflow.state import BEGINNING
from rapidsim.syntax import tree


@dataclass(eq=False)
class MoveTable:
    """Known moves, and the reasons why others are unknown."""

    runs: Runs
    moves: list[KnownMove] = field(default_factory=list)
    unknown: dict[MoveStatement, str] = field(default_factory=dict)
    unreached: dict[MoveStatement, str] = field(default_factory=dict)
    """Reasons why moves on no path of the program are unknown; used if no path reaches them."""
    _index: dict[object, int] = field(default_factory=dict)
    _run_ends: dict[int, int] = field(default_factory=dict)
    """By the move before bulk statements, the last of their moves."""

    def add(
        self,
        call: tree.Call,
        move: Move,
        routine: RoutineSymbol,
        settings: KnownSettings,
        previous: int | None,
    ) -> int:
        """Note a known move and the bulk statements behind it; return the index of the last.

        Args:
            call: The instruction.
            move: What it asks for.
            routine: The routine with the instruction.
            settings: The settings in force.
            previous: Index of the move at whose end it starts, or BEGINNING; None if unknown.
        """
        key = (call, move, settings, previous)
        index = self._index.get(key)
        if index is None:
            index = self._index[key] = len(self.moves)
            begins = previous == BEGINNING
            self.moves.append(
                KnownMove(
                    call,
                    routine.module,
                    routine.name,
                    move,
                    settings.settings,
                    settings.uncertain,
                    None if begins else previous,
                    begins,
                )
            )
        if call not in self.runs:
            return index
        if index not in self._run_ends:
            assert index == len(self.moves) - 1, "the first of them starts where it ends"
            self.moves += moves_of_run(*self.runs[call], self.moves[index], len(self.moves))
            self._run_ends[index] = len(self.moves) - 1
        return self._run_ends[index]


def reason_unknown(instruction: str, moves: Sequence[Move], uncertain: Set[str]) -> str | None:
    """Return the reason why the target of an instruction is unknown; None if it is known.

    Args:
        instruction: Name of the instruction.
        moves: The moves that it makes.
        uncertain: Fields of the settings that may have another value.
    """
    if len(moves) != 1:
        return f"`{instruction}` is not a single move"
    if uncertain & DISPLACEMENTS and not isinstance(moves[0].to, JointTarget):
        return "a program displacement (PDispOn, EOffsOn and their like) may be in force"
    return None
