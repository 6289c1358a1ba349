"""From RAPID's frames to the arm's: the one place where mm become m.

Below this file everything is SI; above it RAPID's mm and degrees. The chain of a robot-held tool:

    base_from_world @ world_from_user @ user_from_object @ object_from_tcp @ tcp_from_flange

Source: Technical reference manual RAPID Overview, "Coordinate systems"; data types tooldata and
    wobjdata.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.language.data import (
    UNUSED_AXIS,
    JointTarget,
    Orient,
    Pos,
    Pose,
    RobJoint,
    RobTarget,
    ToolData,
    WobjData,
)

MM = 1e-3
"""Metres in a millimetre."""

TOLERATED_NORM_ERROR = 1e-4
"""Quaternions are written with six or seven digits; within this the length is rounding."""
REFUSED_NORM_ERROR = 1e-2
"""Beyond this the numbers are no orientation that anyone meant."""


@dataclass(frozen=True, slots=True)
class NotSimulatedFrame:
    """A frame set-up that is not simulated, and why."""

    reason: str


def transform(pose: Pose) -> Transform:
    """A frame [mm] as a transform [m]; the orientation is normalised."""
    return Transform.from_quaternion(pose.rot, np.array(pose.trans) * MM)


def pose(a_from_b: Transform) -> Pose:
    """A transform [m] as a frame [mm]."""
    x, y, z = (a_from_b.translation / MM).tolist()
    return Pose(Pos(x, y, z), Orient(*a_from_b.quaternion.tolist()))


def unsupported(tool: ToolData, wobj: WobjData) -> NotSimulatedFrame | None:
    """Why this pair of tool and work object cannot be simulated; None if it can."""
    if not tool.robhold or wobj.robhold:
        return NotSimulatedFrame(
            "a stationary tool or a work object held by the robot (robhold) is not simulated"
        )
    if not wobj.ufprog:
        return NotSimulatedFrame(
            f"a user frame moved by the mechanical unit `{wobj.ufmec}` is not simulated"
        )
    return None


def base_from_object(wobj: WobjData, base_from_world: Transform) -> Transform:
    """The work object in the robot's base."""
    return base_from_world @ transform(wobj.uframe) @ transform(wobj.oframe)


def base_from_tcp(target: RobTarget, wobj: WobjData, base_from_world: Transform) -> Transform:
    """Where a target puts the TCP."""
    object_from_tcp = transform(Pose(target.trans, target.rot))
    return base_from_object(wobj, base_from_world) @ object_from_tcp


def tcp_from_flange(tool: ToolData) -> Transform:
    """The inverse of the tool frame."""
    return transform(tool.tframe).inverse()


def joints(target: JointTarget, count: int) -> Array:
    """Axis positions [deg] of a target as joints (count,) [rad].

    The joint that seven-axis arms have more is `eax_a`; it stays 0 where that is not given.
    """
    axes = np.array([*target.robax, _given(target.extax.eax_a)], dtype=np.float64)
    radians: Array = np.radians(axes[_axes(count)])
    return radians


def rob_joint(joints: Array) -> RobJoint:
    """Joints (n,) [rad] as axis positions [deg]; missing axes are 0."""
    axes = np.zeros(7)
    axes[_axes(len(joints))] = np.degrees(joints)
    return RobJoint(*axes[:6].tolist())


def _axes(count: int) -> list[int]:
    """Which of RAPID's six axes and `eax_a` the joints of an arm are, from base to flange.

    Palletizers keep their fourth joint as axis 6; the additional joint of seven-axis arms stands
    third in their chain.
    """
    return {4: [0, 1, 2, 5], 7: [0, 1, 6, 2, 3, 4, 5]}.get(count, list(range(count)))


def _given(external_axis: float) -> float:
    """An external axis, 0 where it is 9E9: not programmed."""
    return 0.0 if external_axis >= UNUSED_AXIS else external_axis
