"""Findings about the path between two points, at the move that requires it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import chain

import numpy as np

from rapidsim.controller.moves.configuration_choice import excess_without_switch
from rapidsim.controller.moves.move_request import target_name
from rapidsim.controller.moves.queued_move import MotionError, QueuedMove
from rapidsim.controller.moves.settled_lines import SettledLines
from rapidsim.controller.moves.target_checks import excess_text
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.findings.reach_and_motion_data import (
    MainAxesSwitched,
    PathConfiguration,
    PathNotReachable,
    PathThroughSingularity,
    TooLittleTime,
    WristTurnsFar,
)
from rapidsim.findings.wrist_circles import WristCircleFails
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.confdata import Configuration
from rapidsim.motion.path.curve_following import FaultKind, PathFault
from rapidsim.motion.robot.robot import Robot

WRIST_TURNS_FAR = np.radians(140.0)
r"""Turn [rad] beyond which a line may stop under ConfL \On. Source: RAPID Reference Manual,
"ConfL", from memory: the limit is between 140 and 180 degrees."""
_WRIST = slice(3, 6)
_EXCESS = 1.01
"""A timed move is planned to a tenth of a per cent; a greater ratio means that it is too slow."""


def path_violation(error: MotionError) -> Violation:
    """Violation of a move that cannot be made."""
    queued = error.queued
    return fault_violation(error.fault, target_name(queued.place, queued.move))


def fault_violation(fault: PathFault, target: str) -> Violation:
    """Violation of the path to a target."""
    if fault.kind is FaultKind.WRIST_PAIR:
        percent, distance_mm = 100.0 * fault.fraction, 1000.0 * fault.distance
        return WristCircleFails(target, percent, distance_mm, fault.reason, fault.cure)
    if fault.kind is FaultKind.NOT_SIMULATED:
        return PathNotReachable(target, 0.0, 0.0, fault.reason, is_simulated=False)
    of_kind = {
        FaultKind.SINGULARITY: PathThroughSingularity,
        FaultKind.CONFIGURATION: PathConfiguration,
    }
    return of_kind.get(fault.kind, PathNotReachable)(
        target=target,
        percent=100.0 * fault.fraction,
        distance_mm=1000.0 * fault.distance,
        reason=fault.reason,
    )


def switched(
    target: str,
    robot: Robot,
    base_from_flange: Transform,
    before: Configuration,
    after: Configuration,
) -> MainAxesSwitched:
    """Finding for a switch of the main axes to a target with free configuration, with its cause."""
    joints = excess_without_switch(robot, base_from_flange, before)
    why = "no other posture gets there"
    if joints is not None:
        rest = np.clip(0.0, robot.axes.lower, robot.axes.upper)[len(joints) :]
        why = f"without that, {excess_text(robot, np.concatenate([joints, rest]))}"
    return MainAxesSwitched(target, before.confdata[3], after.confdata[3], why)


def wrist_turning_far(target: str, start: Array, end: Array) -> WristTurnsFar | None:
    r"""The wrist axis of a six-axis arm that turns too far for ConfL \On; None if there is none.

    Args:
        target: Target of the line or arc.
        start: Joints (n,) [rad] before it.
        end: Joints (n,) [rad] at its end.
    """
    if len(start) != _WRIST.stop:
        return None
    turns = np.abs(end - start)[_WRIST]
    axis = int(turns.argmax())
    if turns[axis] <= WRIST_TURNS_FAR:
        return None
    return WristTurnsFar(target, _WRIST.start + axis + 1, float(np.degrees(turns[axis])))


def hasty_move_findings(parts: Iterable[Sequence[QueuedMove]]) -> tuple[Diagnostic, ...]:
    r"""A warning for each move that takes longer than its `\T` because the axes are too slow."""
    found = []
    timed = (part for part in parts if not isinstance(part, SettledLines) or part.is_timed)
    for queued in chain.from_iterable(timed):
        programmed_s, started_s = queued.move.duration_s, queued.started.time
        if programmed_s is None or started_s is None or queued.ended_s is None:
            continue
        if queued.was_stopped:
            continue
        needed_s = queued.ended_s - started_s
        if needed_s > _EXCESS * programmed_s:
            violation = TooLittleTime(programmed_s, needed_s)
            place = queued.place
            found.append(Diagnostic(violation, place.span, routine=place.routine))
    return tuple(found)
