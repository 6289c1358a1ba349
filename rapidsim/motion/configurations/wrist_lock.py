r"""SingArea \LockAxis4: the posture closest to a pose with axis 4 held at 0 or half a turn.

The TCP is exactly at its programmed position; the other five axes approximate its orientation as
closely as possible.

Source: Technical reference manual RAPID Instructions, "SingArea".
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.rotation_vectors import cross, vector_from_rotation
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.arm import Kinematics

AXIS_4 = 3
_MAIN = [0, 1, 2]
_WRIST = [4, 5]
_STEPS = 60
_LARGEST_STEP = 0.4
_ARRIVED = 1e-10


def lock_axis_4(
    kinematics: Kinematics, base_from_tcp: Transform, tcp_from_flange: Transform, near: Array
) -> Array | None:
    """Return joints (6,) [rad] with axis 4 locked that bring the TCP to its position.

    Args:
        kinematics: A six-axis arm.
        base_from_tcp: The programmed pose.
        tcp_from_flange: The inverse of the tool frame.
        near: Joints (6,) [rad] that reach the pose; axis 4 goes to the closest half turn.

    Returns:
        The joints; None if the position is unreachable with the axis locked.
    """
    joints = near.copy()
    joints[AXIS_4] = np.pi * np.round(near[AXIS_4] / np.pi)
    flange_from_tcp = tcp_from_flange.inverse()
    for _ in range(_STEPS):
        flange = kinematics.forward(joints)
        tcp = flange @ flange_from_tcp
        miss = base_from_tcp.translation - tcp.translation
        tilt = vector_from_rotation(base_from_tcp.rotation @ tcp.rotation.T)
        jacobian = kinematics.jacobian(joints)
        turning = jacobian[3:]
        lever = tcp.translation - flange.translation
        moving = jacobian[:3] + cross(turning.T, np.broadcast_to(lever, (6, 3))).T
        # The main axes compensate the effect of the wrist on the position of the TCP.
        by_main = np.linalg.pinv(moving[:, _MAIN])
        reachable = turning[:, _WRIST] - turning[:, _MAIN] @ by_main @ moving[:, _WRIST]
        wanted = tilt - turning[:, _MAIN] @ by_main @ miss
        wrist = np.linalg.lstsq(reachable, wanted, rcond=None)[0]
        step = np.zeros(6)
        step[_WRIST] = wrist
        step[_MAIN] = by_main @ (miss - moving[:, _WRIST] @ wrist)
        joints += step * min(1.0, _LARGEST_STEP / max(float(np.abs(step).max()), 1e-300))
        if np.abs(step).max() < _ARRIVED:
            return joints
    return None
