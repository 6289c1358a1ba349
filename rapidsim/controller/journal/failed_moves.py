"""Moves that could not be made, with their geometry: for displays of a run.

A finding explains in words why a move fails. A `FailedMove` has the programmed path of the TCP and
the point on it at which the move fails, in the base frame of the robot.
"""

from __future__ import annotations

import numpy as np

from rapidsim.diagnostics import Violation
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.moves import Place
from rapidsim.motion.geometry.curves import circle_fault, curves_of
from rapidsim.motion.geometry.joint_mapping import arms_of
from rapidsim.motion.geometry.segments import Geometry, Segment
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import value_class

_WAY_POINTS = 49
"""Enough points to draw a joint move or an arc as a smooth curve."""


@value_class(frozen=True, slots=True, eq=False)
class FailedMove:
    """A move that the arm cannot make."""

    place: Place
    violation: Violation
    base_from_tcp: Transform
    """The programmed end."""
    curve: Array
    """The programmed path of the TCP (k, 3) [m] in base; only the end if no more is known."""
    fails_at: Array
    """Point (3,) [m] of the path at which it fails; the end if that cannot be reached."""


def refused_move(place: Place, violation: Violation, segment: Segment, robot: Robot) -> FailedMove:
    """A move whose end cannot be reached; the pose of `segment` is used, its joints are ignored."""
    end = segment.end.base_from_tcp
    if segment.geometry is Geometry.JOINT:
        way = end.translation[None]
    elif circle_fault(segment) is not None and segment.via is not None:
        start, via = segment.start.base_from_tcp, segment.via
        way = np.stack([start.translation, via.translation, end.translation])
    else:
        way = _sample_curve(segment, robot)
    return FailedMove(place, violation, end, way, end.translation)


def refused_axes(place: Place, violation: Violation, base_from_tcp: Transform) -> FailedMove:
    """A move to joints past their limits; the pose is that of the TCP at these joints."""
    end = base_from_tcp.translation
    return FailedMove(place, violation, base_from_tcp, end[None], end)


def failed_at_fraction(
    place: Place, violation: Violation, segment: Segment, fraction: float, robot: Robot
) -> FailedMove:
    """A move that fails after a fraction of its path, 0 to 1."""
    way = _sample_curve(segment, robot)
    place_on_way = fraction * (len(way) - 1)
    before = min(int(place_on_way), len(way) - 2)
    rest = place_on_way - before
    fails_at = (1.0 - rest) * way[before] + rest * way[before + 1]
    end = segment.end.base_from_tcp
    if segment.carrier is not None and segment.carrier.robot is not None:
        # The pose is relative to what another robot carries; the path is in base.
        end = Transform(end.rotation, way[-1])
    return FailedMove(place, violation, end, way, fails_at)


def _sample_curve(segment: Segment, robot: Robot) -> Array:
    """The curve of a segment at evenly spaced points (k, 3) [m]."""
    curves = curves_of((segment,), robot.kinematics)
    row = np.zeros(_WAY_POINTS, dtype=np.int64)
    x = np.linspace(0.0, float(curves.length[0]), _WAY_POINTS)
    joints = curves.joints_at(row, x)
    if segment.geometry is Geometry.JOINT:
        base_from_flange = robot.kinematics.forward(joints[:, : len(robot.joints)])
    elif segment.carrier is None:
        return curves.at(row, x).position
    else:
        arms = arms_of((segment,), robot.kinematics, curves.joint_travel, curves.length)
        base_from_flange = arms.base_from_flange(curves.at(row, x), row, joints)
    return (base_from_flange @ segment.tcp_from_flange.inverse()).translation
