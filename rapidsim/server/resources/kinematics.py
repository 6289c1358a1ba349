"""Kinematics of robots for clients: calculations, which move nothing, in m and rad."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.confdata import confdata_of
from rapidsim.motion.configurations.pose_solutions import PoseSolution, solve_pose, solve_pose_as
from rapidsim.motion.robot.robot import Robot
from rapidsim.server.messages import Answer, Fields, Item, Request
from rapidsim.server.resources.codes import BAD_PARAMETER, BAD_STATE, refused
from rapidsim.server.resources.context import RequestContext, required_value
from rapidsim.server.resources.motion import robot_of

_AXES: Final = 6
_QUARTERS: Final = ("j1", "j4", "j6", "jx")


def pose_from_joints(context: RequestContext, request: Request, unit: str) -> Answer:
    """The pose of a tool, in the base of its robot, at joints."""
    robot, form = _arm(context, request, unit), request.form
    joints = _vector(form, "rob_joints", _AXES)[: len(robot.joints)]
    pose = robot.forward(joints) @ _transform(form, "tool_frame_position", "tool_frame_orientation")
    quarters = confdata_of(robot.kinematics, joints).tolist()
    fields = _named("position-", "xyz", pose.translation.tolist())
    fields |= _named("robtargetorientation-u", "0123", pose.quaternion.tolist())
    fields |= _named("quarter-rev-", _QUARTERS, quarters)
    return Answer((Item("position-from-joint", "positionData", fields),))


def joints_from_cartesian(context: RequestContext, request: Request, unit: str) -> Answer:
    """The joints of a pose of a tool in a configuration.

    Raises:
        RefusedRequest: If the robot does not reach the pose so.
    """
    robot, form = _arm(context, request, unit), request.form
    quarters = [round(one) for one in _vector(form, "robot_configuration", 4).tolist()]
    found = solve_pose_as(robot, _flange(form), quarters)
    if found.reason is not None:
        raise refused(BAD_PARAMETER, found.reason)
    return Answer(tuple(_joints("joints-from-cartesian", one) for one in found.solutions))


def all_joint_solutions(context: RequestContext, request: Request, unit: str) -> Answer:
    """The joints of a pose of a tool in each configuration that reaches it.

    Raises:
        RefusedRequest: If none does.
    """
    robot = _arm(context, request, unit)
    found = solve_pose(robot, _flange(request.form), everything=False)
    if found.reason is not None:
        raise refused(BAD_PARAMETER, found.reason)
    # The first name is so spelt by controllers.
    names = ("j11", *_QUARTERS[1:])
    return Answer(
        tuple(
            _joints("all-joint-solutions", one, _named("quarter_rev_", names, one.confdata))
            for one in found.solutions
        )
    )


def _arm(context: RequestContext, request: Request, unit: str) -> Robot:
    name, task = robot_of(context, unit)
    robot = task.unit.member.robot
    if len(robot.joints) > _AXES:
        raise refused(BAD_STATE, f"{name} has more than {_AXES} axes")
    if request.form.get("robot_fixed_object", "FALSE").upper() == "TRUE":
        raise refused(BAD_PARAMETER, "stationary tools are not calculated")
    return robot


def _flange(form: Fields) -> Transform:
    tool = _transform(form, "tool_frame_position", "tool_frame_orientation")
    return _transform(form, "curr_position", "curr_orientation") @ tool.inverse()


def _transform(form: Fields, position: str, orientation: str) -> Transform:
    quaternion = _vector(form, orientation, 4)
    if not np.linalg.norm(quaternion) > 0.0:
        raise refused(BAD_PARAMETER, f"`{orientation}` is no orientation")
    return Transform.from_quaternion(quaternion, _vector(form, position, 3))


def _vector(form: Fields, name: str, count: int) -> Array:
    """Return the numbers of a field as `[1,2,3]`, shape (count,).

    Raises:
        RefusedRequest: If the field is missing, or has other content.
    """
    text = required_value(form, name)
    try:
        values = json.loads(text) if len(text) < 1000 else None
    except ValueError:
        values = None
    if (
        not isinstance(values, list)
        or len(values) != count
        or not all(type(one) in (int, float) and math.isfinite(one) for one in values)
    ):
        raise refused(BAD_PARAMETER, f"`{name}` is a list of {count} numbers")
    return np.array(values, dtype=np.float64)


def _joints(kind: str, solution: PoseSolution, more: Mapping[str, str] | None = None) -> Item:
    joints = [*solution.joints.tolist(), *[0.0] * _AXES][:_AXES]
    return Item(kind, "joints", {**_named("robotjoint", "123456", joints), **(more or {})})


def _named(prefix: str, names: Sequence[str], values: Sequence[float]) -> dict[str, str]:
    return {f"{prefix}{name}": f"{one + 0:.9G}" for name, one in zip(names, values, strict=True)}
