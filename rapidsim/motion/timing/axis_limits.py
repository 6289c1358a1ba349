"""Axis limits of an arm, observed by timing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.path import Path
from rapidsim.motion.path.path_derivatives import PathRates
from rapidsim.motion.robot.dynamics import Dynamics
from rapidsim.motion.robot.motion_constants import MotionConstants
from rapidsim.motion.robot.robot import Robot, RobotError
from rapidsim.values import value_class

_FREE_SPEED, _FREE_ACCELERATION = 1e3, 1e6
"""Speed [m/s] and acceleration [m/s2] that limit no belt."""


@value_class(frozen=True, slots=True, eq=False)
class ArmTorques:
    """Torques of one of the moving arms."""

    dynamics: Dynamics
    torque: Array
    """Shape (3,): factors on the known torques of the arm."""
    first_axis: int = 0
    """Index of its first axis among all axes."""
    number: int = 0
    """Index of the arm."""

    @property
    def axes(self) -> slice:
        """Its main axes among all axes."""
        return slice(self.first_axis, self.first_axis + len(self.torque))

    @property
    def wrist(self) -> slice:
        """Its wrist axes among all axes."""
        first = self.first_axis + len(self.torque)
        return slice(first, first + len(self.dynamics.wrist))

    def rows(self, rates: PathRates, load: Array) -> tuple[Array, Array]:
        """Return slope and bend (k, 3) at points (k,) with loads (k,); see `AccelerationRows`."""
        stance = rates.stance[:, 4 * self.number : 4 * self.number + 4]
        first, second = rates.first[:, self.axes], rates.second[:, self.axes]
        slope, bend = self.dynamics.rows(stance, first, second, load)
        return slope / self.torque, bend / self.torque

    def shares(self, stance: Array, rates: Array, changes: Array, load: Array) -> Array:
        """Shares (k, 3) of the torques used by rates and accelerations (k, n) of all axes."""
        of_main = rates[:, self.axes], changes[:, self.axes]
        shares: Array = self.dynamics.shares(stance, *of_main, load) / self.torque
        return shares


@value_class(frozen=True, slots=True, eq=False)
class Limits:
    """Limits of each axis, equal in both directions: the arm's axes, then external ones."""

    max_speed: Array
    """Shape (n + e,) [rad/s, m/s]."""
    max_acceleration: Array
    """Shape (n + e,) [rad/s2, m/s2]. For axes limited by torques, about the smallest acceleration
    that they allow: a discretisation fine enough for that is fine enough for larger ones."""
    zone_share: Array
    """Shape (n + e,): share of the limits of acceleration that is used in a narrow zone."""
    arms: tuple[ArmTorques, ...] = ()
    """Torques that limit main axes instead of an acceleration; empty if there are none."""

    def scaled(self, factor: float) -> Limits:
        """Return the limits with a factor on accelerations and torques."""
        return replace(
            self,
            max_acceleration=self.max_acceleration * factor,
            arms=tuple(replace(arm, torque=factor * arm.torque) for arm in self.arms),
        )


def limits_of(robot: Robot, model: MotionModel) -> Limits:
    """Return the limits of an arm under a motion model.

    Raises:
        RobotError: If the speed of an axis is not known, or the model's speeds or accelerations are
            not one per axis.
    """
    max_speed = _max_speed(robot, model)
    acceleration = max_speed / _acceleration_times(robot, model)
    if model.acceleration is not None:
        if len(model.acceleration) != len(robot.joints):
            raise RobotError(
                f"{robot.name}: {len(robot.joints)} axes, but {len(model.acceleration)} "
                "accelerations"
            )
        acceleration = np.array(model.acceleration, dtype=np.float64)
    elif model.own_accelerations and model.version == "1":
        own = (joint.max_acceleration for joint in robot.joints)
        acceleration = np.array(
            [
                scaled if known is None else known
                for scaled, known in zip(acceleration, own, strict=True)
            ]
        )
    arms = torques_of(robot, model)
    share = model_of(robot, model).share_in_zones
    for arm in arms:
        acceleration = np.append(
            arm.torque * arm.dynamics.least_accelerations,
            model.wrist * np.array(arm.dynamics.wrist),
        )
    return Limits(
        np.append(max_speed, [axis.max_speed for axis in robot.external]),
        np.append(acceleration, [axis.max_acceleration for axis in robot.external]),
        np.full(len(max_speed) + len(robot.external), share),
        arms,
    )


def torques_of(robot: Robot, model: MotionModel) -> tuple[ArmTorques, ...]:
    """Return the torques of an arm under a motion model; empty if accelerations limit its axes."""
    dynamics = constants_of(robot, model).dynamics
    if dynamics is None or not model.own_accelerations or model.acceleration is not None:
        return ()
    return (ArmTorques(dynamics, np.array(model.torque)),)


def constants_of(robot: Robot, model: MotionModel) -> MotionConstants:
    """Return the constants of an arm in a version of the motion model."""
    match model.version:
        case "1":
            return MotionConstants()
        case "2":
            return robot.constants_2
        case "3":
            return robot.constants


def combined_limits(limits: Sequence[Limits]) -> Limits:
    """Return the limits of several robots that move as one."""
    arms, axis = [], 0
    for number, one in enumerate(limits):
        arms += [replace(arm, first_axis=axis, number=number) for arm in one.arms]
        axis += len(one.max_speed)
    return Limits(
        np.concatenate([one.max_speed for one in limits]),
        np.concatenate([one.max_acceleration for one in limits]),
        np.concatenate([one.zone_share for one in limits]),
        tuple(arms),
    )


def limits_along(path: Path, limits: Limits) -> Limits:
    """Return the limits of all axes of a path: one that stands for a belt has none."""
    if path.belts is None:
        return limits
    return replace(
        limits,
        max_speed=np.append(limits.max_speed, _FREE_SPEED),
        max_acceleration=np.append(limits.max_acceleration, _FREE_ACCELERATION),
        zone_share=np.append(limits.zone_share, 1.0),
    )


def model_of(robot: Robot, model: MotionModel) -> MotionModel:
    """Return a motion model in which the constants of an arm replace unset ones."""
    own = constants_of(robot, model)
    return model.of_arm(own.filter_time, own.fine_dwell, own.zone_share)


def _acceleration_times(robot: Robot, model: MotionModel) -> Array | float:
    """Return times [s] in which axes reach their speed: one, or one per axis (n,)."""
    own = constants_of(robot, model).acceleration_times
    known = model.own_accelerations and own is not None
    return np.array(own) if known else model.acceleration_time


def _max_speed(robot: Robot, model: MotionModel) -> Array:
    """Return axis speeds (n,) [rad/s]: of the model, else of the robot."""
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
