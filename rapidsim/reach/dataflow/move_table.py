"""The moves that the abstract interpreter meets, each known one once with what precedes it."""

from __future__ import annotations

from collections.abc import Sequence, Set
from dataclasses import dataclass, field

import numpy as np

from rapidsim.analysis.program import RoutineSymbol
from rapidsim.language.data import JointTarget
from rapidsim.language.moves import Move
from rapidsim.reach.dataflow.known_moves import KnownMove, KnownMoves, numbers_of
from rapidsim.reach.dataflow.motion_settings import DISPLACEMENTS, KnownSettings
from rapidsim.reach.dataflow.move_instructions import MoveInstructions
from rapidsim.reach.dataflow.state import BEGINNING
from rapidsim.reach.dataflow.written_moves import RunNotFollowedError
from rapidsim.syntax import tree


@dataclass(eq=False)
class MoveTable:
    """Known moves, and the reasons why others are unknown."""

    written: MoveInstructions
    unknown: dict[tree.Call, str] = field(default_factory=dict)
    unreached: dict[tree.Call, str] = field(default_factory=dict)
    """Reasons why moves on no path of the program are unknown; used if no path reaches them."""
    certain: set[tree.Call] = field(default_factory=set)
    """Instructions of known moves to which a path without unknown conditions leads."""
    _rows: list[KnownMove] = field(default_factory=list)
    _ends: list[int] = field(default_factory=list)
    """Index of the last move of the bulk statements after each; its own if there are none."""
    _index: dict[object, int] = field(default_factory=dict)

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

        Raises:
            RunNotFollowedError: If the target of the move differs from the text before bulk
                statements.
        """
        key = (call, move, settings, previous)
        index = self._index.get(key)
        if index is None:
            index = self._index[key] = len(self._rows)
            begins = previous == BEGINNING
            self._rows.append(
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
            run = self.written.runs.get(call)
            if run is not None and not _is_as_written(move, run):
                raise RunNotFollowedError
            first = self._ends[-1] + 1 if self._ends else 0
            self._ends.append(first + (0 if run is None else len(run)))
        return self._ends[index]

    def moves(self) -> KnownMoves:
        """Return the known moves."""
        number = [self.written.number_of[known.call] for known in self._rows]  # type: ignore[index]
        return KnownMoves(
            self.written,
            tuple(self._rows),
            np.array(number, dtype=np.int64),
            np.array(self._ends, dtype=np.int64) - np.array([-1, *self._ends[:-1]]),
        )


def _is_as_written(move: Move, run: tree.BulkStatements) -> bool:
    """Whether the target of the move before bulk statements is that of its text."""
    return move.programmed is None and np.array_equal(run.numbers_of_like, numbers_of(move))


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
