"""Steps of an arm under an operator's hand: where one leads, and the reason why one is impossible.

A step turns one axis of the arm, or moves or turns the TCP along an axis of a frame, on a straight
line. All that a jog panel needs to know of an arm before it moves is here.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import StrEnum
from typing import Final

import numpy as np

from rapidsim.frames.rotation_vectors import rotation_from_vector
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.confdata import configuration
from rapidsim.motion.configurations.reachability import (
    limit_excess,
    over_limit,
    unreachable_reason,
)
from rapidsim.motion.configurations.targets import MM
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import value_class

_DIRECTIONS: Final = 6
_LENGTHS: Final = 3
"""Directions of a frame before those about which it turns."""
_LONGEST: Final = 0.2
"""Longest step [m]."""
_WIDEST: Final = math.radians(30.0)
"""Widest step [rad]."""
_PLACES: Final = 21
"""Number of places at which a step is tried."""
_MOST_TURN: Final = 0.35
"""Turn [rad] of an axis between two places beyond which the arm is in a singularity."""


class JogFrame(StrEnum):
    """The frame along whose axes the TCP is jogged; or the axes of the arm."""

    JOINTS = "joints"
    BASE = "base"
    WORLD = "world"
    TOOL = "tool"
    WOBJ = "wobj"


@value_class(frozen=True, slots=True, eq=False)
class JogStep:
    """A step of an arm that stands."""

    axis: int
    """Axis of the arm; or x, y, z, rx, ry, rz of the frame."""
    distance: float
    """[rad]; [m] along x, y, z."""
    base_from_frame: Transform | None = None
    """Frame with the directions; None for a step of an axis of the arm."""


@value_class(frozen=True, slots=True, eq=False)
class JogArm:
    """An arm at joints (n,) [rad], with its tool."""

    robot: Robot
    tcp_from_flange: Transform
    joints: Array

    @property
    def base_from_tcp(self) -> Transform:
        """Pose of the TCP."""
        return self.robot.forward(self.joints) @ self.tcp_from_flange.inverse()

    def base_from_frame(
        self,
        frame: JogFrame,
        base_from_world: Transform,
        base_from_object: Callable[[], Transform],
    ) -> Transform | None:
        """Return the pose of a frame to jog along; None for the axes of the arm."""
        match frame:
            case JogFrame.JOINTS:
                return None
            case JogFrame.BASE:
                return Transform.identity()
            case JogFrame.WORLD:
                return base_from_world
            case JogFrame.TOOL:
                return self.base_from_tcp
            case JogFrame.WOBJ:
                return base_from_object()

    def step(self, base_from_frame: Transform | None, axis: int, distance: float) -> JogStep | str:
        """Return a step of so many degrees or mm along an axis from 0; or why there is none."""
        count = len(self.joints) if base_from_frame is None else _DIRECTIONS
        if not 0 <= axis < count:
            return f"there is no axis {axis + 1}"
        is_length = base_from_frame is not None and axis < _LENGTHS
        size = MM * distance if is_length else math.radians(distance)
        if not abs(size) <= (_LONGEST if is_length else _WIDEST):
            return "a step is at most 30 degrees or 200 mm"
        return JogStep(axis, size, base_from_frame)

    def steps(
        self, base_from_frame: Transform | None, length: float, angle: float
    ) -> list[dict[str, object]] | str:
        """Return the size of a step along each axis, and the reasons against both senses, as JSON.

        Args:
            base_from_frame: As for a `JogStep`.
            length: Size of a step [mm].
            angle: Size of a turn [deg].

        Returns:
            A row per axis; a text if the sizes are too large.
        """
        found: list[dict[str, object]] = []
        is_joints = base_from_frame is None
        for axis in range(len(self.joints) if is_joints else _DIRECTIONS):
            size = angle if is_joints or axis >= _LENGTHS else length
            reasons: list[str | None] = []
            for sign in (-1.0, 1.0):
                step = self.step(base_from_frame, axis, sign * size)
                if isinstance(step, str):
                    return step
                reasons.append(self.reason_against(step))
            found.append({"axis": axis + 1, "size": size, "reasons": reasons})
        return found

    def along(self, step: JogStep, shares: Array) -> Array | str:
        """Joints (k, n) [rad] at shares (k,) of a step, ascending from 0; or why it is impossible.

        Only places at the given shares are tried.
        """
        robot = self.robot
        branch = int(robot.kinematics.branch_of(self.joints))
        if step.base_from_frame is None:
            joints = np.repeat(self.joints[None], len(shares), axis=0)
            joints[:, step.axis] += shares * step.distance
        else:
            poses = self._poses(step.base_from_frame, step, shares)
            found = robot.kinematics.inverse_on_branch(poses, branch, self.joints)
            joints = found.joints
            if not found.exists.all():
                row = int(np.argmin(found.exists))
                reason = unreachable_reason(robot, poses[row], branch)
                return "out of reach" if reason is None else reason.message
            if np.abs(np.diff(joints, axis=0)).max(initial=0.0) > _MOST_TURN:
                return "the arm would pass a singularity"
        excess = limit_excess(robot, joints)
        outside = np.flatnonzero(np.abs(excess).max(axis=-1) > 0.0)
        if len(outside):
            return over_limit(robot, branch, excess[outside[0]]).message
        return joints

    def reason_against(self, step: JogStep) -> str | None:
        """Return why a step is impossible; None if it is possible."""
        tried = self.along(step, np.linspace(0.0, 1.0, _PLACES))
        return tried if isinstance(tried, str) else None

    def standing(self) -> dict[str, object]:
        """Configuration, distances from limits and singularities nearby, as JSON values.

        `room` has the distance of each axis from its lower and its upper limit [deg; mm for one
        that slides]; None without a limit.
        """
        robot, joints = self.robot, self.joints
        room = np.degrees(np.stack([joints - robot.lower, robot.upper - joints], axis=-1))
        return {
            "configuration": list(map(int, configuration(robot.kinematics, joints).confdata)),
            "room": [
                [round(one, 2) if math.isfinite(one) else None for one in row]
                for row in room.tolist()
            ],
            "singularities": [
                one.name for one in robot.kinematics.singularities(joints) if one.near
            ],
        }

    def _poses(self, base_from_frame: Transform, step: JogStep, shares: Array) -> Transform:
        """Poses (k,) of the flange along a line."""
        start = self.base_from_tcp
        axis = base_from_frame.rotation[:, step.axis % _LENGTHS]
        vectors = shares[:, None] * step.distance * axis
        places = np.repeat(start.translation[None], len(shares), axis=0)
        turns = np.repeat(start.rotation[None], len(shares), axis=0)
        if step.axis < _LENGTHS:
            places = places + vectors
        else:
            turns = rotation_from_vector(vectors) @ turns
        return Transform(turns, places) @ self.tcp_from_flange
