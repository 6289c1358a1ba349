"""Goals of a guidance: joints or a TCP pose, axis by axis, and the distance of the robot.

An axis that the program does not select keeps its position; for a pose these are the axes of the
correction frame, x to rz. The interpolation of poses between goals is our own: the goal passes its
filters as a pose, and the axes follow the joints that reach it.
"""

from __future__ import annotations

from dataclasses import field
from typing import Protocol

import numpy as np
import numpy.typing as npt

from rapidsim.frames import rigid
from rapidsim.frames.rotation_vectors import rotation_from_vector, vector_from_rotation
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.guidance.joint_law import CYCLE_S, LowPass
from rapidsim.motion.guidance.sensor import SensorAnswer, pose_of, radians, twist_of
from rapidsim.motion.kinematics.arm import Kinematics
from rapidsim.values import value_class

Chosen = npt.NDArray[np.bool_]


@value_class(frozen=True, slots=True, eq=False)
class Band:
    """Selected axes, and the range [rad, m] of deviation within which they have arrived."""

    chosen: Chosen
    lowest: Array
    highest: Array

    def holds(self, remaining: Array) -> bool:
        """Whether the remaining deviation of the selected axes is within the range."""
        inside = (self.lowest <= remaining) & (remaining <= self.highest)
        return bool(np.all(inside | ~self.chosen))


class GuidanceGoal(Protocol):
    """The sensor's goal for the robot."""

    def accept(self, answer: SensorAnswer) -> bool:
        """Accept a message of the sensor; return whether it contained a goal of this kind."""
        ...

    def goal(self, joints: Array) -> tuple[Array, Array] | None:
        """Return joints (n,) [rad] and the goal's own speed (n,) [rad/s], a cycle later.

        None if the arm cannot reach the goal.
        """
        ...

    def is_met(self, joints: Array) -> bool:
        """Whether joints (n,) [rad] are close enough to the goal."""
        ...


@value_class(slots=True, eq=False)
class JointGoal:
    """A goal in joints."""

    band: Band
    filters_hz: tuple[float, ...]
    start: Array
    _goal: Array = field(init=False)
    _speed: Array = field(init=False)
    _filter: LowPass = field(init=False)

    def __post_init__(self) -> None:
        """Use the current joints as the initial goal."""
        self._goal, self._speed = self.start, np.zeros_like(self.start)
        self._filter = LowPass(self.filters_hz, self.start)

    def accept(self, answer: SensorAnswer) -> bool:
        """See `GuidanceGoal`."""
        goal = radians(answer.joints, len(self.start))
        speed = radians(answer.joint_speed, len(self.start))
        if goal is not None:
            self._goal = np.where(self.band.chosen, goal, self.start)
        self._speed = np.zeros_like(self.start)
        if speed is not None:
            self._speed = np.where(self.band.chosen, speed, 0.0)
        return goal is not None or speed is not None

    def goal(self, joints: Array) -> tuple[Array, Array] | None:
        """See `GuidanceGoal`."""
        del joints
        return self._filter.follow(self._goal), self._speed

    def is_met(self, joints: Array) -> bool:
        """See `GuidanceGoal`."""
        return self.band.holds(self._goal - joints)


@value_class(slots=True, eq=False)
class PoseGoal:
    """A goal that is a TCP pose in a frame of the sensor."""

    kinematics: Kinematics
    tcp_from_flange: Transform
    base_from_sensor: Transform
    base_from_correction: Transform
    offset: Transform
    """Offset applied after each goal of the sensor."""
    band: Band
    """Band for x, y, z [m], rx, ry, rz [rad] in the correction frame."""
    filters_hz: tuple[float, ...]
    start: Array
    _start: Transform = field(init=False)
    _goal: Transform = field(init=False)
    """base_from_tcp."""
    _twist: Array | None = None
    """Twist of the goal in base; None if the sensor sends no speed."""
    _position: LowPass = field(init=False)
    _stages: list[Array] = field(init=False)

    def __post_init__(self) -> None:
        """Use the current pose as the initial goal."""
        self._start = self._goal = self.tcp(self.start)
        self._position = LowPass(self.filters_hz, self._start.translation)
        self._stages = [self._start.rotation for _ in self.filters_hz]

    def tcp(self, joints: Array) -> Transform:
        """Return the TCP pose for joints (n,) [rad]."""
        return self.kinematics.forward(joints) @ self.tcp_from_flange.inverse()

    def accept(self, answer: SensorAnswer) -> bool:
        """See `GuidanceGoal`."""
        position, rotation = pose_of(answer)
        twist = twist_of(answer)
        if position is not None or rotation is not None:
            held = self.base_from_sensor.inverse() @ self._goal @ self.offset.inverse()
            told = Transform(
                held.rotation if rotation is None else rotation,
                held.translation if position is None else position,
            )
            self._goal = self._with_chosen(self.base_from_sensor @ told @ self.offset)
        self._twist = None
        if twist is not None:
            turned = self.base_from_sensor.rotation
            self._twist = np.concatenate([turned @ twist[:3], turned @ twist[3:]])
        return position is not None or rotation is not None or twist is not None

    def goal(self, joints: Array) -> tuple[Array, Array] | None:
        """See `GuidanceGoal`."""
        pose = Transform(self._turned(), self._position.follow(self._goal.translation))
        aimed = self._reached(pose, joints)
        speed = np.zeros_like(joints)
        if aimed is not None and self._twist is not None:
            now, step = self.tcp(joints), CYCLE_S * self._twist
            turn = rotation_from_vector(step[3:]) @ now.rotation
            ahead = self._reached(Transform(turn, now.translation + step[:3]), joints)
            if ahead is None:
                return None
            speed = (ahead - joints) / CYCLE_S
        return None if aimed is None else (aimed, speed)

    def is_met(self, joints: Array) -> bool:
        """See `GuidanceGoal`."""
        return self.band.holds(self._remaining(self.tcp(joints), self._goal))

    def _remaining(self, pose: Transform, goal: Transform) -> Array:
        """Return the displacement (6,) [m, rad] between two poses along the correction axes."""
        to_frame = self.base_from_correction.rotation.T
        turn = vector_from_rotation(goal.rotation @ pose.rotation.T)
        return np.concatenate([to_frame @ (goal.translation - pose.translation), to_frame @ turn])

    def _with_chosen(self, goal: Transform) -> Transform:
        """Return the goal in its selected axes; the other axes keep their start values."""
        if self.band.chosen.all():
            return goal
        left = np.where(self.band.chosen, self._remaining(self._start, goal), 0.0)
        frame = self.base_from_correction.rotation
        turn = rotation_from_vector(frame @ left[3:])
        return Transform(turn @ self._start.rotation, self._start.translation + frame @ left[:3])

    def _turned(self) -> Array:
        """Return the filtered rotation: each stage turns by a share of the remaining rotation."""
        goal = self._goal.rotation
        for number, share in enumerate(self._position.shares):
            stage = self._stages[number]
            left = vector_from_rotation(goal @ stage.T)
            goal = self._stages[number] = rotation_from_vector(share * left) @ stage
        return goal

    def _reached(self, base_from_tcp: Transform, near: Array) -> Array | None:
        """Return joints (n,) [rad] of a pose on the branch of `near`; None if unreachable."""
        single = self.kinematics.single
        flange = rigid.from_transform(base_from_tcp @ self.tcp_from_flange)
        stands = near.tolist()
        found = single.inverse_on_branch(flange, single.branch_of(stands), stands)
        return None if found is None else np.array(found)
