"""Work objects that a robot held and moved during uncoordinated moves of another robot on them."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence

from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.controller.moves.move_request import target_name
from rapidsim.diagnostics import Diagnostic
from rapidsim.findings.reach_and_motion_data import CoordinationImpossible
from rapidsim.language.equipment import robot_name
from rapidsim.simulation.results.simulation import RobotRun

_AT_ONCE_S = 1e-9
_WHY = (
    "{}, which holds the work object, moves from {:.3f} s on, and the robots are not synchronised"
)


def moved_object_findings(
    robots: Sequence[RobotRun], labels: Sequence[str | None]
) -> tuple[Diagnostic, ...]:
    """Return one error for each statement, at its first occurrence.

    Args:
        robots: The robots, in the order in which a controller numbers them.
        labels: Names of the robots in the station; None without a name.
    """
    if len(robots) == 1:
        return ()
    numbers = {robot_name(number).lower(): number - 1 for number in range(1, len(robots) + 1)}
    numbers |= {label.lower(): number for number, label in enumerate(labels) if label}
    found: dict[tuple[str, int], Diagnostic] = {}
    for one in robots:
        for move in one.moves:
            wobj = move.move.wobj
            number = None if wobj.ufprog or wobj.robhold else numbers.get(wobj.ufmec.lower())
            # Synchronized moves are planned together.
            if number is None or robots[number] is one or move.move.sync_id is not None:
                continue
            for other in _overlapping(move, robots[number].moves):
                why = _WHY.format(wobj.ufmec, other.start_s)
                span = move.place.span
                violation = CoordinationImpossible(target_name(move.place, move.move), why)
                told = Diagnostic(violation, span, routine=move.place.routine)
                found.setdefault((str(span.file), span.start), told)
    return tuple(found.values())


def _overlapping(move: ExecutedMove, other_moves: Sequence[ExecutedMove]) -> Iterator[ExecutedMove]:
    """Yield the latest of other moves that overlaps in time with a move."""
    index = bisect_left(other_moves, move.end_s - _AT_ONCE_S, key=lambda one: one.start_s) - 1
    if (
        index >= 0
        and other_moves[index].end_s > max(move.start_s, other_moves[index].start_s) + _AT_ONCE_S
    ):
        yield other_moves[index]
