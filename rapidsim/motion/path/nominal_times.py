"""Nominal times of the segments of a robot: at its programmed speeds, without ramps."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.curves import Curves, Index
from rapidsim.motion.geometry.segments import Segment
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class NominalTimes:
    """Times of segments."""

    times: Array
    """Shape (segments,) [s]; 0 for segments that do not move the robot."""
    turns: Mask
    """Shape (segments,): whether the reorientation determines the time, not the TCP, or external
    axes alone do."""


def nominal_times(segments: Sequence[Segment], curves: Curves, active: Index) -> NominalTimes:
    """Return the times that a robot needs for its segments at its programmed speeds.

    A programmed time replaces the speeds. External axes count if nothing else moves, but not those
    of other robots that only carry the work object.

    Args:
        segments: All segments.
        curves: Curves of those with a length.
        active: Their indices in `segments`.
    """
    moving = [segments[index] for index in active.tolist()]
    travel = np.where(curves.turns_only, 0.0, curves.length)
    with_tcp = travel / [one.speed.tcp for one in moving]
    # On its way, a joint move turns the tool by any amount; only its ends are programmed.
    turned = np.where(curves.in_joints & ~curves.turns_only, curves.angle, curves.turned)
    turning = turned / [one.speed.reorientation for one in moving]
    idle = curves.turns_only.tolist()
    with_axes = [_external_s(moving[k]) if idle[k] else 0.0 for k in range(len(moving))]
    times = np.zeros(len(segments))
    times[active] = np.maximum(np.maximum(with_tcp, turning), with_axes)
    turns = np.zeros(len(segments), dtype=np.bool_)
    turns[active] = turning >= with_tcp
    for index, segment in enumerate(segments):
        if segment.duration is not None:
            times[index] = segment.duration
    return NominalTimes(times, turns)


def _external_s(segment: Segment) -> float:
    """Return the time [s] of the slowest of the robot's own external axes."""
    ways = np.abs(segment.end.external - segment.start.external)
    return float(np.max(ways / segment.external_speeds[: len(ways)], initial=0.0))
