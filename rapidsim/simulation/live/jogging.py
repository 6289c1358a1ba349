"""Jogging: steps of a robot by an operator, in manual mode while no program executes.

A step goes from rest to rest, no faster than manual mode permits. A robot whose program was stopped
on its path is not jogged, for the path would then begin where the robot no longer is. While a
button is held, steps are as long as they may be, and end when it is released.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final

from rapidsim.frames.transform import Transform
from rapidsim.language.data import WobjData
from rapidsim.motion.configurations import targets
from rapidsim.motion.configurations.jog_steps import JogArm, JogFrame, JogStep
from rapidsim.simulation.live.jog_motion import begin_step
from rapidsim.simulation.live.states import (
    ControllerState,
    OperatingMode,
    RefusalReason,
    RequestRefused,
)

if TYPE_CHECKING:
    from rapidsim.simulation.live.controller import LiveController
    from rapidsim.simulation.live.live_task import LiveTask

_HALVINGS: Final = 7
"""Trials to find how much of a step that is too long is possible."""


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


def jog(
    live: LiveController,
    task: LiveTask,
    frame: JogFrame,
    axis: int,
    distance: float,
    *,
    is_pressed: bool = False,
) -> None:
    """Jog a robot by a step, after those that it still makes.

    Args:
        live: The controller.
        task: That of the robot.
        frame: Along whose axes.
        axis: Axis of the arm; or x, y, z, rx, ry, rz of the frame, from 0.
        distance: [deg, mm]
        is_pressed: Whether a button is held: the step may be shorter, and does not follow another.

    Raises:
        RequestRefused: If the robot cannot be jogged, or not so far.
    """
    reason = reason_against_jogging(live, task)
    if reason is not None:
        raise RequestRefused(RefusalReason.STATE, reason)
    start_s = max(live.now_s, task.unit.member.trajectory.duration)
    if is_pressed and start_s > live.now_s:
        return
    arm = jog_arm(task)
    step = step_of(task, arm, frame, axis, distance)
    reason = arm.reason_against(step)
    if is_pressed and reason is not None:
        step = _longest(arm, step)
        reason = arm.reason_against(step) if step.distance else reason
    if reason is not None:
        raise RequestRefused(RefusalReason.VALUE, reason)
    if start_s > live.now_s + 1.0:
        raise RequestRefused(RefusalReason.STATE, "the robot still moves")
    motion = begin_step(task.unit, arm, step, start_s)
    if isinstance(motion, str):
        raise RequestRefused(RefusalReason.VALUE, motion)
    task.add_jogging(motion)


def _longest(arm: JogArm, step: JogStep) -> JogStep:
    """Return as much of a step as is possible, none of it perhaps."""
    possible, tried = 0.0, 0.5
    for halving in range(_HALVINGS):
        if arm.reason_against(replace(step, distance=tried * step.distance)) is None:
            possible = tried
            tried += 0.5 ** (halving + 2)
        else:
            tried -= 0.5 ** (halving + 2)
    return replace(step, distance=possible * step.distance)


def step_of(task: LiveTask, arm: JogArm, frame: JogFrame, axis: int, distance: float) -> JogStep:
    """Return a step of so many degrees or mm.

    Raises:
        RequestRefused: If there is no such axis, or the step is too long.
    """
    step = arm.step(frame_of(task, arm, frame), axis, distance)
    if isinstance(step, str):
        raise RequestRefused(RefusalReason.VALUE, step)
    return step
