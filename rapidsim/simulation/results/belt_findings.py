"""Moves on belts that the arm cannot follow: out of reach, or past its speeds and torques.

Plans keep the limits as far as a belt can be foreseen. What is found here has happened after the
plan: the belt has started or stopped, or has run on while the program waited.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rapidsim.controller.moves.executed_moves import ExecutedMoves
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.diagnostics import Diagnostic
from rapidsim.findings.belts import BeltNotFollowed
from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.segments import Segment
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.timing.axis_limits import Limits
from rapidsim.motion.trajectory.limit_shares import limit_shares, reason_lost
from rapidsim.motion.trajectory.trajectory import Trajectory

_STEP_S = 0.004
_WORTH_SAYING = 1.05


def belt_findings(
    moves: ExecutedMoves,
    trajectory: Trajectory,
    limits: Limits,
    robot: Robot,
    end_s: float,
    *,
    by_axes: bool,
) -> Iterator[Diagnostic]:
    """Yield one finding for each move on a belt that the arm cannot follow.

    Args:
        moves: Moves of one robot.
        trajectory: Its motion.
        limits: Limits of its axes.
        robot: The arm.
        end_s: End of the run [s].
        by_axes: Whether each axis is smoothed by itself; else corners exceed torques anyway.
    """
    if not trajectory.follows_belts:
        return
    starts_s = np.append(moves.columns.start_s, max(end_s, trajectory.duration))
    for number, row in enumerate(moves.columns.rows):
        if not isinstance(row, QueuedMove) or not row.segment.rides:
            continue
        move, segment = moves[number], row.segment
        rides_on = segment.rides[-1].end == 1.0
        until_s = float(starts_s[number + 1]) if rides_on else move.end_s
        times = np.arange(move.start_s - _STEP_S, until_s + 2.0 * _STEP_S, _STEP_S)
        worst = _worst(times, trajectory, limits, robot, segment, by_axes=by_axes)
        if worst is not None:
            conveyor = segment.rides[-1].course.name
            found = BeltNotFollowed(conveyor, *worst)
            yield Diagnostic(found, move.place.span, routine=move.place.routine)


def _worst(
    times: Array,
    trajectory: Trajectory,
    limits: Limits,
    robot: Robot,
    segment: Segment,
    *,
    by_axes: bool,
) -> tuple[float, str] | None:
    """Return when [s] and why the arm cannot follow at times (k,) [s]; None if it can."""
    samples = trajectory.at(times)
    lost = reason_lost(samples, robot)
    if lost is not None:
        return float(times[lost[0]]), lost[1]
    count = len(times)
    of_move = np.full(count, segment.load), np.full(count, segment.acceleration_share)
    speed, torque = limit_shares(samples, robot.kinematics, limits, *of_move)
    used = [(speed, "speed of an axis")]
    if by_axes:
        used.append((torque, "torque or acceleration of an axis"))
    for share, what in used:
        at = int(share.argmax())
        if share[at] > _WORTH_SAYING:
            return float(times[at]), f"it needs {share[at]:.2f} times the {what}"
    return None
