"""Inverse kinematics of one TCP pose in plain floats.

Programs produce moves one at a time; arrays of one row cost several times the computation itself.
"""

from __future__ import annotations

from rapidsim.frames import rigid
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.arm import Kinematics


def base_from_tcp(kinematics: Kinematics, joints: Array, tcp_from_flange: Transform) -> Transform:
    """Return the TCP pose for joints (n,) [rad]."""
    base_from_flange = kinematics.single.forward(joints.tolist())
    flange_from_tcp = rigid.inverse(rigid.from_transform(tcp_from_flange))
    return rigid.to_transform(rigid.composed(base_from_flange, flange_from_tcp))


def joints_on_branch(
    kinematics: Kinematics,
    base_from_tcp: Transform,
    tcp_from_flange: Transform,
    branch: int,
    near: list[float],
) -> list[float] | None:
    """Return joints [rad] that bring the TCP to a pose on a branch; None if it is unreachable.

    Args:
        kinematics: The arm.
        base_from_tcp: The pose.
        tcp_from_flange: The inverse of the tool frame.
        branch: See `Kinematics.inverse_on_branch`.
        near: The previous joints [rad]: each joint takes the closest whole turn.
    """
    base_from_flange = rigid.composed(
        rigid.from_transform(base_from_tcp), rigid.from_transform(tcp_from_flange)
    )
    return kinematics.single.inverse_on_branch(base_from_flange, branch, near)
