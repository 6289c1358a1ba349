"""The frames of a guidance by EGMActJoint or EGMActPose."""

from __future__ import annotations

import math
from types import MappingProxyType

import numpy as np

from rapidsim.controller.motion_state import MotionState
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.moves.target_checks import require_orientation
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.data import TOOL0, Pose, ToolData, WobjData
from rapidsim.language.errors import NotAllowed
from rapidsim.language.guidance import Activation
from rapidsim.motion.configurations import targets
from rapidsim.motion.geometry.segments import Waypoint
from rapidsim.motion.guidance.feedback import Frames
from rapidsim.motion.guidance.goals import Band, Chosen, PoseGoal

_BASE, _TOOL, _WOBJ, _WORLD = 0.0, 1.0, 2.0, 3.0
_FRAME_NAMES = MappingProxyType({4.0: "EGM_FRAME_JOINT"})


def frames_of(
    resolver: Resolver, state: MotionState, activation: Activation, waypoint: Waypoint
) -> Frames:
    """Frames of the TCP in the feedback: the sensor frame for poses, else the work object.

    Raises:
        NotAllowed: If tool and work object are not plain.
    """
    if activation.frames is None:
        return told_frames(resolver, state, activation.tool, activation.wobj, waypoint.external)
    tool, wobj = activation.tool or state.tool, activation.wobj or state.wobj
    frames = activation.frames
    base_from_told = _frame(resolver, waypoint, wobj, frames.sensor, frames.sensor_type)
    return Frames(resolver.robot.kinematics, _tool(tool), base_from_told.inverse())


def told_frames(
    resolver: Resolver,
    state: MotionState,
    tool: ToolData | None,
    wobj: WobjData | None,
    external: Array,
) -> Frames:
    """Frames of the TCP in the work object; None selects the tool or work object of the last move.

    Raises:
        NotAllowed: If tool and work object are not plain.
    """
    base_from_object = _work_object(resolver, wobj or state.wobj, external)
    tcp_from_flange = _tool(tool or state.tool)
    return Frames(resolver.robot.kinematics, tcp_from_flange, base_from_object.inverse())


def pose_aim(
    resolver: Resolver,
    waypoint: Waypoint,
    state: MotionState,
    activation: Activation,
    offset: Pose | None,
    bands: Array,
    chosen: Chosen,
    filters_hz: tuple[float, ...],
) -> PoseGoal:
    """Goal of a guidance by poses, with the frames to which the poses refer.

    Args:
        resolver: Of the robot.
        waypoint: Position of the robot.
        state: Of the task's motion.
        activation: The data of EGMActPose.
        offset: Applied after each goal.
        bands: Shape (6, 2) [mm, deg]: x, y, z, rx, ry, rz.
        chosen: Which of the bands apply.
        filters_hz: Of the goal.

    Raises:
        NotAllowed: If a frame is invalid.
    """
    tool, wobj = activation.tool or state.tool, activation.wobj or state.wobj
    assert activation.frames is not None
    frames = activation.frames
    limits = bands * np.array([targets.MM] * 3 + [np.pi / 180.0] * 3)[:, None]
    return PoseGoal(
        resolver.robot.kinematics,
        _tool(tool),
        _frame(resolver, waypoint, wobj, frames.sensor, frames.sensor_type),
        _frame(resolver, waypoint, wobj, frames.correction, frames.correction_type),
        Transform.identity() if offset is None else _pose("the offset", offset),
        Band(chosen, limits[:, 0], limits[:, 1]),
        filters_hz,
        waypoint.joints,
    )


def _frame(
    resolver: Resolver, waypoint: Waypoint, wobj: WobjData, frame: Pose, of: float
) -> Transform:
    """base_from_frame of a frame that is expressed in a frame of the type `of`."""
    if of == _BASE:
        base_from_type = Transform.identity()
    elif of == _TOOL:
        # The manual: relative to tool0, not to the tool.
        base_from_type = resolver.robot.forward(waypoint.joints) @ _tool(TOOL0).inverse()
    elif of == _WOBJ:
        base_from_type = _work_object(resolver, wobj, waypoint.external)
    elif of == _WORLD:
        base_from_type = _world(resolver, waypoint.external)
    else:
        name = _FRAME_NAMES.get(of, f"{of:g}")
        raise NotAllowed(f"EGMActPose: {name} is no frame that a pose can be given in")
    return base_from_type @ _pose("a frame", frame)


def _tool(tool: ToolData) -> Transform:
    if not tool.robhold:
        raise NotAllowed("a robot with a stationary tool, guided by a sensor, is not simulated")
    require_orientation("the frame of the tool", tool.tframe.rot)
    return targets.tcp_from_flange(tool)


def _world(resolver: Resolver, external: Array) -> Transform:
    """base_from_world for positions of external axes (e,) [m or rad]."""
    axes, world_from_base = resolver.robot.external, resolver.base_from_world.inverse()
    if not axes:
        return resolver.base_from_world
    return targets.world_from_base_at(axes, world_from_base, external[None])[0].inverse()


def _work_object(resolver: Resolver, wobj: WobjData, external: Array) -> Transform:
    moved = targets.unit_of(wobj, resolver.robot.external) or resolver.has_carrier(wobj)
    if wobj.robhold or moved:
        raise NotAllowed(
            "a robot guided by a sensor in a work object that something moves is not simulated"
        )
    return (
        _world(resolver, external)
        @ _pose("the user frame", wobj.uframe)
        @ _pose("the object frame", wobj.oframe)
    )


def _pose(name: str, pose: Pose) -> Transform:
    require_orientation(name, pose.rot)
    if not all(map(math.isfinite, pose.trans)):
        raise NotAllowed(f"{name} is infinitely far away")
    return targets.transform(pose)
