"""What the axes of an arm can do: the limits that timing keeps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.robot import Robot, RobotError


@dataclass(frozen=True, slots=True, eq=False)
class Limits:
    """Limits of each axis, the same in both directions: of the arm's, then of external ones."""

    max_speed: Array
    """Shape (n + e,) [rad/s, m/s]."""
    max_acceleration: Array
    """Shape (n + e,) [rad/s2, m/s2]."""


def limits_of(robot: Robot, model: MotionModel) -> Limits:
    """The limits of an arm under a motion model.

    Raises:
        RobotError: If the speed of an axis is not known, or the model's speeds or accelerations are
            not one per axis.
    """
    max_speed = _max_speed(robot, model)
    acceleration = max_speed / model.acceleration_time
    if model.acceleration is not None:
        if len(model.acceleration) != len(robot.joints):
            raise RobotError(
                f"{robot.name}: {len(robot.joints)} axes, but {len(model.acceleration)} "
                "accelerations"
            )
        acceleration = np.array(model.acceleration, dtype=np.float64)
    elif model.own_accelerations:
        own = (joint.max_acceleration for joint in robot.joints)
        acceleration = np.array(
            [
                scaled if known is None else known
                for scaled, known in zip(acceleration, own, strict=True)
            ]
        )
    return Limits(
        np.append(max_speed, [axis.max_speed for axis in robot.external]),
        np.append(acceleration, [axis.max_acceleration for axis in robot.external]),
    )


def _max_speed(robot: Robot, model: MotionModel) -> Array:
    """Axis speeds (n,) [rad/s]: those of the model, else the robot's own."""
    if model.max_speed is not None:
        if len(model.max_speed) != len(robot.joints):
            raise RobotError(
                f"{robot.name}: {len(robot.joints)} axes, but {len(model.max_speed)} axis speeds"
            )
        return np.array(model.max_speed, dtype=np.float64)
    unknown = [joint.name for joint in robot.joints if joint.max_speed is None]
    if unknown:
        raise RobotError(f"{robot.name}: no axis speed is known for {', '.join(unknown)}")
    return np.array([joint.max_speed for joint in robot.joints], dtype=np.float64)
