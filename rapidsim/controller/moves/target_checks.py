"""Checks of a target itself: orientation, external axes, axes past their limits."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from rapidsim.controller.journal.failed_moves import refused_axes
from rapidsim.controller.journal.journal import Journal
from rapidsim.controller.journal.stop_reasons import MoveImpossible
from rapidsim.controller.moves.move_request import LocatedMoveRequest, NotReachableError
from rapidsim.findings.reach_and_motion_data import (
    ExternalAxisMissing,
    ExternalAxisUnknown,
    JointOutOfRange,
)
from rapidsim.frames.quaternion import norm
from rapidsim.frames.transform import Array
from rapidsim.language.data import (
    NO_EXTERNAL_AXES,
    UNUSED_AXIS,
    ExtJoint,
    Orient,
    ToolData,
    WobjData,
)
from rapidsim.language.error_numbers import ERR_OUTSIDE_REACH
from rapidsim.language.target_violations import QuaternionNotUnit
from rapidsim.motion.configurations.targets import (
    TOLERATED_NORM_ERROR,
    external_values,
    is_no_orientation,
    unit_of,
)
from rapidsim.motion.robot.external_axes import ExternalAxis
from rapidsim.motion.robot.robot import Robot

_NOTHING_MEANT = (0.0, 9999.0)
"""Values in old and generated programs for axes that do not exist."""


def check_orientation(
    request: LocatedMoveRequest, name: str, rotation: Orient, journal: Journal
) -> None:
    """Report a quaternion that is not quite a unit; refuse one that is no orientation.

    Raises:
        NotReachableError: When it is far off.
    """
    length = norm(rotation)
    if abs(length - 1.0) > TOLERATED_NORM_ERROR:
        require_orientation(name, rotation)
        violation = QuaternionNotUnit(name, length)
        journal.finding(violation, request.place, once=("norm", request.written, name))


def require_orientation(name: str, rotation: Orient) -> None:
    """Refuse a quaternion that is no orientation.

    Raises:
        NotReachableError: When it is far off.
    """
    length = norm(rotation)
    if is_no_orientation(rotation):
        raise NotReachableError(ERR_OUTSIDE_REACH, QuaternionNotUnit(name, length, refused=True))


def frame_orientations(
    tool: ToolData, wobj: WobjData, external: Sequence[ExternalAxis]
) -> Iterator[tuple[str, Orient]]:
    """The orientations that a tool and a work object add to a move, named as in findings."""
    yield "tframe of the tool", tool.tframe.rot
    if not unit_of(wobj, external):
        yield "uframe of the work object", wobj.uframe.rot
    yield "oframe of the work object", wobj.oframe.rot


def external_end(
    request: LocatedMoveRequest, extax: ExtJoint, near: Array, robot: Robot, journal: Journal
) -> Array:
    """External axes (e,) [m or rad] at the end of a move; inactive units keep their values.

    Raises:
        MoveImpossible: When an active axis has no value.
    """
    axes = robot.external
    if not axes and extax == NO_EXTERNAL_AXES:
        return near
    values, missing = external_values(extax, axes, near)
    inactive = request.request.settings.inactive_units
    independent = request.request.settings.independent_axes
    for axis in missing:
        if axis.unit.lower() not in inactive and axis.component not in independent:
            raise MoveImpossible(ExternalAxisMissing(request.name, axis.component, axis.unit))
    # `eax_a` also has the additional joint of a seven-axis arm.
    known = {axis.component for axis in axes} | ({"eax_a"} if len(robot.joints) > 6 else set())
    unknown = [
        f"{field} = {value:g}"
        for field, value in zip(extax._fields, extax, strict=True)
        if value < UNUSED_AXIS and value not in _NOTHING_MEANT and field not in known
    ]
    if unknown:
        told = ExternalAxisUnknown(request.name, ", ".join(unknown))
        journal.finding(told, request.place, once=("external", request.written))
    passive = [axis.unit.lower() in inactive or axis.component in independent for axis in axes]
    return np.where(passive, near, values)


def require_limits(
    request: LocatedMoveRequest, joints: Array, external: Array, robot: Robot, journal: Journal
) -> None:
    """Refuse joints (n,) [rad] and external axes (e,) [m or rad] past their limits.

    Raises:
        MoveImpossible: When one is past its limit.
    """
    over = excess_text(robot, np.concatenate([joints, external]))
    if over:
        violation = JointOutOfRange(request.name, robot.title, over, is_of_joints=True)
        base_from_tcp = request.request.placed.base_from_tcp(robot.kinematics, joints, external)
        journal.failed_move(refused_axes(request.place, violation, base_from_tcp))
        raise MoveImpossible(violation)


def excess_text(robot: Robot, wide: Array) -> str:
    """The joints and external axes (n + e,) past their limits, as text; empty if none is."""
    axes = robot.axes
    excess = np.maximum(wide - axes.upper, axes.lower - wide)
    return ", ".join(
        f"{axes.name(i)} at {axes.text(i, wide[i])}, {axes.text(i, excess[i])} past its limit"
        for i in map(int, np.flatnonzero(excess > axes.tolerances))
    )
