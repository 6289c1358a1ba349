"""Gantries of a backup: units whose axes slide one on the other, and carry a robot.

Such a unit refers by `use_robot` to an instance of ROBOT with the kinematics GEN_KIN. The frame of
each joint follows from the previous one by the ARM_TYPE of its arm, in modified Denavit-Hartenberg
parameters: turn by `attitude` about x, shift by `length` along x, turn by `theta_home_position`
about z, shift by `offset_z` along z. The joint slides along its z axis. `base_pose` of the
ROBOT_TYPE comes before the first joint, and the base frame of the robot is in the frame of the
last. Joints that are locked in the interpolator do not move.

Source: Technical reference manual System parameters, topic Motion. Order and signs agree with the
gravity of two hanging robots in a real controller, and with the quadrants of axis 1 in seven of the
nine targets that it has stored.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from rapidsim.frames.transform import Transform
from rapidsim.motion.robot.external_axes import ExternalAxis
from rapidsim.station.backup.axis_drives import Named, axis_drive, instance_of
from rapidsim.station.backup.cfg_file import Configuration, Instance
from rapidsim.station.backup.robots import base_frame, carrier_instances, frame_of, number
from rapidsim.values import value_class

_JOINTS = 6
_UNSUPPORTED = ("offset_x", "offset_y")


@value_class(frozen=True, slots=True)
class Gantry:
    """The axes of a gantry, from the world to the robot."""

    axes: tuple[ExternalAxis, ...]
    world_from_end: Transform
    """Frame of the last joint, with all axes at zero."""


def gantries(motion: Configuration, named: Named) -> Mapping[str, Gantry | None]:
    """Return the units that carry a robot by a chain of joints; None if not fully described."""
    carriers = {one.get("name"): one for one in carrier_instances(motion)}
    return {
        name: _gantry(name, carrier, named)
        for unit in motion.get("MECHANICAL_UNIT", ())
        if (name := unit.get("name")) and (carrier := carriers.get(unit.get("use_robot")))
    }


def _gantry(unit: str, robot: Instance, named: Named) -> Gantry | None:
    kind = instance_of(named, "ROBOT_TYPE", robot.get("use_robot_type"))
    frame = base_frame(robot) @ frame_of(kind, "base_pose_pos", "base_pose_rot")
    axes: list[ExternalAxis] = []
    for index in range(_JOINTS):
        joint = instance_of(named, "JOINT", robot.get(f"use_joint_{index}"))
        if not joint or "lock_joint_in_ipol" in joint:
            continue
        drive = axis_drive(named, joint)
        arm = instance_of(named, "ARM", joint.get("use_arm"))
        form = instance_of(named, "ARM_TYPE", arm.get("use_arm_type"))
        transmission = instance_of(named, "TRANSMISSION", joint.get("use_transmission"))
        turns = "rotating_move" in transmission
        if drive is None or turns or any(number(form, key) for key in _UNSUPPORTED):
            return None
        frame = frame @ _joint_frame(form)
        axes.append(drive.axis(unit, "robot", frame.rotation[:, 2], linear=True))
    return Gantry(tuple(axes), frame) if axes else None


def _joint_frame(form: Instance) -> Transform:
    """Return the frame of a joint in that of the previous one."""
    attitude, theta = (number(form, key) or 0.0 for key in ("attitude", "theta_home_position"))
    length, offset = (number(form, key) or 0.0 for key in ("length", "offset_z"))
    about_x = (math.cos(attitude / 2.0), math.sin(attitude / 2.0), 0.0, 0.0)
    about_z = (math.cos(theta / 2.0), 0.0, 0.0, math.sin(theta / 2.0))
    along_x = Transform.from_quaternion(about_x, (length, 0.0, 0.0))
    return along_x @ Transform.from_quaternion(about_z, (0.0, 0.0, offset))
