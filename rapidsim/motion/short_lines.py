"""Where a line ends that turns no joint far: one solution in place of a row of them."""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.robot import Robot
from rapidsim.motion.segments import Geometry, Segment

_SHORT_TURN = 0.3
"""A turn of a joint [rad] that cannot be a whole one less a bit."""


def end_of_short_line(robot: Robot, segment: Segment) -> Array | None:
    """Joints (n,) [rad] at the end of a short line; None for other curves, and out of limits.

    No joint makes a whole turn on a straight way, so one that ends near its start has stayed near.
    Most moves of long programs are such.

    Args:
        robot: The arm with its limits.
        segment: Starts at joints on its branch; the joints of its end do not count.
    """
    if segment.geometry is not Geometry.LINE or segment.carrier is not None:
        return None
    near = segment.start.joints
    base_from_flange = segment.end.base_from_tcp @ segment.tcp_from_flange
    followed = robot.kinematics.inverse_on_branch(base_from_flange[None], segment.branch, near)
    joints: Array = followed.joints[0]
    if not followed.exists[0] or np.abs(joints - near).max() > _SHORT_TURN:
        return None
    return joints if np.all((joints >= robot.lower) & (joints <= robot.upper)) else None
