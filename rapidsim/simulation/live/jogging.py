"""Jogging: steps of a robot by an operator, in manual mode while no program executes.

A step goes from rest to rest, no faster than manual mode permits. A robot whose program was stopped
on its path is not jogged, for the path would then begin where the robot no longer is.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.language.data import WobjData
from rapidsim.motion.configurations import targets
from rapidsim.motion.configurations.jog_steps import JogArm, JogFrame, JogStep
from rapidsim.motion.geometry.segments import Waypoint
from rapidsim.motion.guidance.joint_law import CYCLE_S, GuidedAxes
from rapidsim.motion.guidance.return_motion import return_motion
from rapidsim.motion.trajectory.guided_section import GuidedSection
from rapidsim.simulation.live.states import (
    ControllerState,
    OperatingMode,
    RefusalReason,
    RequestRefused,
)

if TYPE_CHECKING:
    from rapidsim.simulation.live.controller import LiveController
    from rapidsim.simulation.live.live_task import LiveTask

_TCP_SPEED: Final = 0.25
"""Fastest TCP [m/s] in manual mode."""
_AXIS_SHARE: Final = 0.25
"""Share of the speed of axes that a step uses."""
_RAMPED: Final = 1.875
"""Peak speed of a step over its mean."""
_PLACES: Final = 21


def jog_arm(task: LiveTask) -> JogArm:
    """Return the arm of a task as it stands after all steps, with the active tool.

    Raises:
        RequestRefused: If the task moves no robot, or its tool is stationary.
    """
    robot = task.setup.robot
    if robot is None:
        raise RequestRefused(RefusalReason.STATE, f"{task.name} moves no robot")
    tool = task.run.controller.motion.active_tool()
    if not tool.robhold:
        raise RequestRefused(RefusalReason.STATE, "a stationary tool cannot be jogged")
    member = task.unit.member
    return JogArm(member.robot, targets.tcp_from_flange(tool), member.standing().joints)


def frame_of(task: LiveTask, arm: JogArm, frame: JogFrame) -> Transform | None:
    """Return base_from_frame; None for the axes of the arm."""
    base_from_world = task.run.controller.coordination.resolver.base_from_world
    motion = task.run.controller.motion
    return arm.base_from_frame(
        frame, base_from_world, lambda: base_from_world @ _object(motion.active_wobj())
    )


def _object(wobj: WobjData) -> Transform:
    if wobj.robhold or not wobj.ufprog:
        raise RequestRefused(RefusalReason.STATE, "something moves the work object: jog in another")
    return targets.transform(wobj.uframe) @ targets.transform(wobj.oframe)


def reason_against_jogging(live: LiveController, task: LiveTask) -> str | None:
    """Return why a robot cannot be jogged at present; None if it can."""
    if live.panel.mode is OperatingMode.AUTO:
        return "jogging needs manual mode"
    if live.panel.state is not ControllerState.MOTORS_ON:
        return "the motors are off"
    if live.executes:
        return "the program executes"
    if task.unit.queue.is_open:
        return "the program has stopped on its path: set the pointer to main first"
    if task.unit.team is not None or task.unit.member.is_guided:
        return "the robot moves with another one, or a sensor guides it"
    return None


def jog(live: LiveController, task: LiveTask, frame: JogFrame, axis: int, distance: float) -> None:
    """Jog a robot by a step, after those that it still makes.

    Args:
        live: The controller.
        task: That of the robot.
        frame: Along whose axes.
        axis: Axis of the arm; or x, y, z, rx, ry, rz of the frame, from 0.
        distance: [deg, mm]

    Raises:
        RequestRefused: If the robot cannot be jogged, or not so far.
    """
    reason = reason_against_jogging(live, task)
    if reason is not None:
        raise RequestRefused(RefusalReason.STATE, reason)
    arm = jog_arm(task)
    step = step_of(task, arm, frame, axis, distance)
    reason = arm.reason_against(step)
    if reason is not None:
        raise RequestRefused(RefusalReason.VALUE, reason)
    member = task.unit.member
    stands = member.standing()
    start_s = max(live.now_s, member.trajectory.duration)
    if start_s > live.now_s + 1.0:
        raise RequestRefused(RefusalReason.STATE, "the robot still moves")
    section = GuidedSection(
        start_s,
        CYCLE_S,
        arm.robot.forward,
        arm.tcp_from_flange,
        stands.external,
        stands.joints,
    )
    joints = _motion(task, arm, step)
    if isinstance(joints, str):
        raise RequestRefused(RefusalReason.VALUE, joints)
    speeds = np.gradient(joints, CYCLE_S, axis=0)
    speeds[-1] = 0.0
    member.trajectory.guide(section)
    for row, speed in zip(joints[1:], speeds[1:], strict=True):
        section.append(row, speed)
    task.unit.queue.begin_again(section.end_s)
    member.end = Waypoint(section.end, arm.robot.forward(section.end), stands.external)
    member.start_is_free = False


def step_of(task: LiveTask, arm: JogArm, frame: JogFrame, axis: int, distance: float) -> JogStep:
    """Return a step of so many degrees or mm.

    Raises:
        RequestRefused: If there is no such axis, or the step is too long.
    """
    step = arm.step(frame_of(task, arm, frame), axis, distance)
    if isinstance(step, str):
        raise RequestRefused(RefusalReason.VALUE, step)
    return step


def _motion(task: LiveTask, arm: JogArm, step: JogStep) -> Array | str:
    """Joints (k, n) [rad], one a cycle from the start on; or why the step is impossible."""
    coarse = arm.along(step, np.linspace(0.0, 1.0, _PLACES))
    if isinstance(coarse, str):
        return coarse
    limits, count = task.unit.member.limits, len(arm.joints)
    flange = arm.robot.forward(coarse)
    tcp = (flange @ arm.tcp_from_flange.inverse()[None]).translation
    travelled = float(np.linalg.norm(np.diff(tcp, axis=0), axis=1).sum())
    # The path as one axis, whose speed and acceleration all axes of the arm can follow.
    rates = np.abs(np.diff(coarse, axis=0)).max(axis=0) * (_PLACES - 1)
    fastest, hardest = limits.max_speed[:count], limits.max_acceleration[:count]
    speed = float(np.min(_AXIS_SHARE * fastest / np.maximum(rates, 1e-9)))
    acceleration = float(np.min(_AXIS_SHARE * hardest / np.maximum(rates, 1e-9)))
    one = np.ones(1)
    axes = GuidedAxes(0.0 * one, one, speed * one, acceleration * one)
    ramp = return_motion(axes, 0.0 * one, one, max(0.1, _RAMPED * travelled / _TCP_SPEED))
    cycles = math.ceil(ramp.duration_s / CYCLE_S)
    shares = np.array([ramp.at(CYCLE_S * k)[0][0] for k in range(cycles + 1)])
    return arm.along(step, shares)
