"""Detection of joint jumps of an arm that follows a path of its TCP."""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.unwrapping import turning
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.waypoints.plan import TcpMotion

LARGEST_STEP = 0.5
"""Largest step [rad] of an axis between two samples; faster motion is a jump."""
_SMOOTH = 0.1
"""Deviation [rad] of the joints midway between two samples from their mean without a jump."""
_HALVINGS = 24
"""Bisections of the time between two samples, after which a branch change is on the path itself."""


def jump_on(
    robot: Robot, motion: TcpMotion, tcp_from_flange: Transform, times: Array, joints: Array
) -> tuple[int, int, float] | None:
    """Return sample before, joint and size [rad] of a jump of the arm; None if there is none.

    A jump occurs between two samples, and may be hidden: close to a singularity joints on two
    branches nearly coincide, and only the poses in between show whether the path passes from one to
    the other.
    """
    step = np.abs(turning(np.diff(joints, axis=0), robot.kinematics.turns))
    row, joint = (int(i) for i in np.unravel_index(np.argmax(step), step.shape))
    if step[row, joint] > LARGEST_STEP:
        return row, joint, float(step[row, joint])
    branch = robot.kinematics.branch_of(joints)
    for row in np.flatnonzero(np.diff(branch)).tolist():
        ends = {int(branch[row]): joints[row], int(branch[row + 1]): joints[row + 1]}
        first = int(branch[row])
        low, high = float(times[row]), float(times[row + 1])
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            flange = motion.at(np.array([middle]))[0] @ tcp_from_flange
            average = sum(ends.values()) / 2.0
            found = {
                at: robot.kinematics.inverse_on_branch(flange, at, average[None]) for at in ends
            }
            off = {
                at: np.abs(turning(one.joints[0] - average, robot.kinematics.turns))
                if one.exists[0]
                else np.full_like(average, np.pi)
                for at, one in found.items()
            }
            nearer = min(off, key=lambda at: float(off[at].max()))
            if off[nearer].max() > _SMOOTH:
                return row, int(off[nearer].argmax()), 2.0 * float(off[nearer].max())
            ends[nearer] = found[nearer].joints[0]
            low, high = (middle, high) if nearer == first else (low, middle)
    return None
