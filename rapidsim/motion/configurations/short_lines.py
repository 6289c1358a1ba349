"""End joints of a line on which no joint turns far, with a single IK solution."""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.scalar_inverse import joints_on_branch
from rapidsim.motion.robot.robot import Robot

SHORT_TURN = 0.3
"""Rotation [rad] of a joint too small to be a whole turn with a small difference."""


def end_of_short_line(
    robot: Robot, near: Array, end: Transform, tcp_from_flange: Transform, branch: int
) -> Array | None:
    """Return joints (n,) [rad] at the end of a short line; None if not short, or beyond limits.

    No joint makes a whole turn on a straight line, so a joint that ends near its start has stayed
    near it. Most moves of long programs are short.

    Args:
        robot: The arm with its limits.
        near: The joints (n,) [rad] at the start of the line, on the branch.
        end: The end of the line: base_from_tcp.
        tcp_from_flange: The inverse of the tool frame.
        branch: The branch that the line stays on.
    """
    before = near.tolist()
    joints = joints_on_branch(robot.kinematics, end, tcp_from_flange, branch, before)
    if joints is None:
        return None
    for limits, joint, start in zip(robot.joints, joints, before, strict=True):
        if abs(joint - start) > SHORT_TURN or not limits.lower <= joint <= limits.upper:
            return None
    return np.array(joints)
