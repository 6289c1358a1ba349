"""Sensitivity of a run's time to the accelerations of the arm, with an unchanged path.

The acceleration of the axes is the weakest assumption behind a cycle time. The blocks of the run
are timed again along the same paths, each starting at the final speed of its predecessor; waits and
dwells are unchanged.
"""

from __future__ import annotations

from functools import cache

from rapidsim.motion.path.path import Path
from rapidsim.motion.timing.axis_limits import Limits
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.timing.time_scaling import TimeScaling
from rapidsim.motion.trajectory.trajectory import Trajectory

MOST_SEGMENTS = 2000
"""Runs with more planned segments are not timed again: it would take as long as they did."""
_TIMES_PROGRAMMED = 20
"""Weight of a segment of a path with programmed times, whose speeds are found by bisection."""
_TOGETHER_S = 1e-9


def extra_time_s(trajectory: Trajectory, limits: Limits, factor: float) -> float | None:
    """Return the additional time [s] with scaled accelerations; None if the run is too long.

    Args:
        trajectory: Motion of the run.
        limits: Limits of the arm in the run.
        factor: Factor on the accelerations of all axes.
    """
    if sum(_weight(piece.path) for piece in trajectory.pieces) > MOST_SEGMENTS:
        return None
    scaled = limits.scaled(factor)
    extra_s, speed, ends_s = 0.0, 0.0, 0.0

    @cache
    def timed(path: Path, start: float, start_speed: float) -> TimeScaling:
        """Return the timing of a block; cycles that repeat have one path."""
        return plan(path, scaled, start=start, start_speed=start_speed)

    for piece in trajectory.pieces:
        goes_on = piece.start_time - ends_s < _TOGETHER_S
        timing = timed(piece.path, piece.from_s, speed if goes_on else 0.0)
        until_s = timing.time_at(piece.to_s)
        before_s = piece.timing.time_at(piece.to_s) - piece.timing.time_at(piece.from_s)
        extra_s += until_s - before_s
        speed = timing.speed_at(until_s)
        ends_s = piece.start_time + before_s
    return extra_s


def _weight(path: Path) -> int:
    """Return the number of segments, each as often as timing one takes longer than usual."""
    segments = path.segments
    is_timed = any(segment.duration is not None for segment in segments)
    return len(segments) * (_TIMES_PROGRAMMED if is_timed else 1)
