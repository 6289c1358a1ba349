"""Outputs that a program set after a fly-by move: distance of the robot from its target then.

The program pointer runs ahead of the robot, so an output after such a move is set while the robot
is still moving.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from collections.abc import Set as AbstractSet

import numpy as np

from rapidsim.controller.journal.events import Event, EventKind
from rapidsim.controller.moves.executed_move import CornerKind, ExecutedMove
from rapidsim.diagnostics import Diagnostic, Related
from rapidsim.findings.runs import OutputBeforeTarget
from rapidsim.language.moves import Place
from rapidsim.simulation.results.sampling import MOST_EXACT, evaluate
from rapidsim.simulation.results.simulation import RobotRun
from rapidsim.values import value_class

_AT_ONCE_S = 1e-9
"""Tolerance [s]: the pointer continues at the instant at which a move starts."""
_NEAR_MM = 0.1


@value_class(frozen=True, slots=True)
class _Early:
    """A change of a signal before the robot reached the target of the last move."""

    event: Event
    place: Place
    move: ExecutedMove
    distance_mm: float


def early_output_findings(
    events: Sequence[Event], robot_run: RobotRun, traps: AbstractSet[str]
) -> tuple[Diagnostic, ...]:
    """Return one note for each statement that set an output early, for its worst time.

    Args:
        events: Events of the run, in any order.
        robot_run: A robot. With external axes nothing is reported: they may carry the target.
        traps: Folded names of the traps of its task, which run at any time.
    """
    by_statement: dict[tuple[str, int], list[_Early]] = {}
    for early in _early(events, robot_run, traps):
        span = early.place.span
        by_statement.setdefault((str(span.file), span.start), []).append(early)
    findings = []
    for times in by_statement.values():
        worst = max(times, key=lambda early: early.distance_mm)
        move = worst.move.place
        more = f" (the worst of {len(times)} times)" if len(times) > 1 else ""
        violation = OutputBeforeTarget(
            str(worst.event.details["signal"]),
            worst.distance_mm,
            move.arguments.get("topoint") or move.arguments.get("tojointpos") or "its target",
            more,
        )
        related = Related(move.span, "the last move before it")
        place = worst.place
        findings.append(Diagnostic(violation, place.span, (related,), routine=place.routine))
    return tuple(findings)


def _early(
    events: Sequence[Event], robot_run: RobotRun, traps: AbstractSet[str]
) -> Iterator[_Early]:
    before = list(_during_fly_by(events, robot_run, traps))
    if not before:
        return
    times = np.array([event.time_s for event, _, _ in before])
    coarse = len(robot_run.moves) > MOST_EXACT
    here = evaluate(robot_run.trajectory, times, coarse=coarse).base_from_tcp.translation
    ends = np.array([move.base_from_tcp.translation for _, _, move in before])
    distances = (1000.0 * np.linalg.norm(here - ends, axis=1)).tolist()
    set_at: set[tuple[float, str]] = set()
    for (event, place, move), distance in zip(before, distances, strict=True):
        if distance > _NEAR_MM and (event.time_s, event.message) not in set_at:
            set_at.add((event.time_s, event.message))
            yield _Early(event, place, move, distance)


def _during_fly_by(
    events: Sequence[Event], robot_run: RobotRun, traps: AbstractSet[str]
) -> Iterator[tuple[Event, Place, ExecutedMove]]:
    """Yield changes of signals during a fly-by move, the last one before the statement."""
    set_by_task = [
        (event, event.place)
        for event in events
        if event.kind is EventKind.SIGNAL and event.task == robot_run.task and event.place
    ]
    if not set_by_task:
        return
    columns = robot_run.moves.columns
    files = np.array([source.file for source in columns.sources], dtype=np.object_)
    with_outputs = {place.span.file for _, place in set_by_task}
    by_moves = {file: frozenset(columns.starts[files == file].tolist()) for file in with_outputs}
    for event, place in set_by_task:
        if place.routine.lower() in traps or place.span.start in by_moves[place.span.file]:
            # Outputs of the move itself are set at its target.
            continue
        latest_s = event.time_s + _AT_ONCE_S
        number = int(np.searchsorted(columns.start_s, latest_s, side="right")) - 1
        while number >= 0 and columns.index[number] >= event.moves_given:
            # It starts at this very instant, but its instruction follows the output.
            number -= 1
        if number < 0:
            continue
        move = robot_run.moves[number]
        is_there = event.time_s >= move.end_s - _AT_ONCE_S
        if not (is_there or move.corner is CornerKind.STOP or len(move.external)):
            yield event, place, move
