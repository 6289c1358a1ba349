"""Moves on belts that the arm cannot follow: out of reach, or past its speeds and torques.

Plans keep the limits as far as a belt can be foreseen. What is found here has happened after the
plan: the belt has started or stopped, or has run on while the program waited.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.controller.moves.executed_moves import ExecutedMoves
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.diagnostics import Diagnostic
from rapidsim.findings.runs import BeltNotFollowed
from rapidsim.motion.geometry.segments import Segment
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.timing.axis_limits import Limits
from rapidsim.motion.trajectory.limit_shares import limit_shares, reasons_lost
from rapidsim.motion.trajectory.trajectory import Trajectory
from rapidsim.values import value_class

_STEP_S = 0.004
_WORTH_SAYING = 1.05
_MOST_MOVES = 500
"""Number of moves that are looked at in one go."""


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
    for section in _sections(moves, max(end_s, trajectory.duration)):
        yield from _of_section(section, trajectory, limits, robot, by_axes=by_axes)


@value_class(frozen=True, slots=True, eq=False)
class _Ride:
    """A move on a belt, with the time [s] until which the arm follows from there."""

    move: ExecutedMove
    segment: Segment
    until_s: float


def _sections(moves: ExecutedMoves, end_s: float) -> Iterator[Sequence[_Ride]]:
    """Yield successive moves on belts, not too many at once."""
    starts_s = np.append(moves.columns.start_s, end_s)
    found: list[_Ride] = []
    for number, row in enumerate(moves.columns.rows):
        rides = row.segment.rides if isinstance(row, QueuedMove) else ()
        if isinstance(row, QueuedMove) and rides:
            move = moves[number]
            until_s = float(starts_s[number + 1]) if rides[-1].end == 1.0 else move.end_s
            found.append(_Ride(move, row.segment, until_s))
        if found and (not rides or len(found) == _MOST_MOVES):
            yield found
            found = []
    if found:
        yield found


def _of_section(
    section: Sequence[_Ride],
    trajectory: Trajectory,
    limits: Limits,
    robot: Robot,
    *,
    by_axes: bool,
) -> Iterator[Diagnostic]:
    begin_s, end_s = section[0].move.start_s, section[-1].until_s
    times = np.arange(begin_s - _STEP_S, end_s + 2.0 * _STEP_S, _STEP_S)
    samples = trajectory.at(times)
    starts_s = [one.move.start_s for one in section]
    of = np.maximum(np.searchsorted(starts_s, times, side="right") - 1, 0)
    load = np.array([one.segment.load for one in section])[of]
    allowed = np.array([one.segment.acceleration_share for one in section])[of]
    speed, torque = limit_shares(samples, robot.kinematics, limits, load, allowed)
    lost = reasons_lost(samples, robot)
    for number, one in enumerate(section):
        at = np.flatnonzero((of == number) & (times <= one.until_s))
        why = next(((k, lost[k]) for k in at.tolist() if k in lost), None)
        used = [(speed, "speed of an axis")]
        if by_axes:
            used.append((torque, "torque or acceleration of an axis"))
        for share, what in used:
            worst = int(at[share[at].argmax()]) if len(at) else 0
            if why is None and len(at) and share[worst] > _WORTH_SAYING:
                why = worst, f"it needs {share[worst]:.2f} times the {what}"
        if why is not None:
            k, reason = why
            found = BeltNotFollowed(one.segment.rides[-1].course.name, float(times[k]), reason)
            yield Diagnostic(found, one.move.place.span, routine=one.move.place.routine)
