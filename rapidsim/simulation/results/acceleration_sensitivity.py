"""What a run's time would be if the arm accelerated otherwise: the path stays, only time changes.

The acceleration of the axes is the weakest assumption behind a cycle time. The blocks of the run
are timed again along the same paths, each from the speed at which the one before leaves it; waits
and dwells stay as they were.
"""

from __future__ import annotations

from rapidsim.motion.timing.axis_limits import Limits
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.trajectory.trajectory import Trajectory

MOST_SEGMENTS = 2000
"""Runs of more planned segments are not timed again: it would take as long as they did."""
_TOGETHER_S = 1e-9


def extra_time_s(trajectory: Trajectory, limits: Limits, factor: float) -> float | None:
    """How much longer [s] a run takes with accelerations times a factor; None if it is too long.

    Args:
        trajectory: Of the run.
        limits: Of the arm in the run.
        factor: On the accelerations of all axes.
    """
    if sum(len(piece.path.segments) for piece in trajectory.pieces) > MOST_SEGMENTS:
        return None
    scaled = limits.scaled(factor)
    extra_s, speed, ends_s = 0.0, 0.0, 0.0
    for piece in trajectory.pieces:
        goes_on = piece.start_time - ends_s < _TOGETHER_S
        timing = plan(piece.path, scaled, start=piece.from_s, start_speed=speed if goes_on else 0.0)
        until_s = timing.time_at(piece.to_s)
        before_s = piece.timing.time_at(piece.to_s) - piece.timing.time_at(piece.from_s)
        extra_s += until_s - before_s
        speed = timing.speed_at(until_s)
        ends_s = piece.start_time + before_s
    return extra_s
