"""Jogging a robot, as an operator does with the joystick."""

from __future__ import annotations

from rapidsim.motion.configurations.jog_steps import JogFrame
from rapidsim.server.derived_parameters import robots
from rapidsim.server.messages import DONE, Answer, Fields, Request
from rapidsim.server.resources.codes import NOT_FOUND, refused
from rapidsim.server.resources.context import RequestContext, chosen, count, number
from rapidsim.simulation.live import jogging
from rapidsim.simulation.live.live_task import LiveTask
from rapidsim.simulation.live.states import RefusalReason, RequestRefused


def jog(context: RequestContext, request: Request) -> Answer:
    """Jog a robot by one step, or halt it where `by` is 0.

    The form has `mechunit` (default: the first robot), `frame` (joints, base, world, tool or wobj),
    `axis` (from 1) and `by` [deg, mm]. With `held` 1 the step ends where it would be impossible.

    Raises:
        RefusedRequest: If the robot cannot be jogged, or not so far.
    """
    form = request.form
    task = jogged_task(context, form)
    frame = chosen(form, "frame", JogFrame)
    axis, distance = count(form, "axis", 1) - 1, number(form, "by")
    if distance:
        is_pressed = form.get("held") == "1"
        jogging.jog(context.live, task, frame, axis, distance, is_pressed=is_pressed)
    else:
        task.halt_jogging()
    return DONE


def jogged_task(context: RequestContext, form: Fields) -> LiveTask:
    """Return the task of the mechanical unit in a form; by default that of the first robot.

    Raises:
        RefusedRequest: If there is no such unit.
    """
    wanted = form.get("mechunit", "").lower()
    for unit, one in robots(context.live.setups):
        if wanted in ("", unit.lower()):
            return context.live.task(one.name)
    raise refused(NOT_FOUND, f"there is no mechanical unit {wanted}")


def jog_panel(context: RequestContext, query: Fields) -> dict[str, object]:
    """Return which steps a robot could make from where it stands, for the panel of the page.

    Args:
        context: The controller.
        query: `mechunit` and `frame` as for `jog`, `length` [mm] and `angle` [deg] of a step.
    """
    live, task = context.live, jogged_task(context, query)
    frame = chosen(query, "frame", JogFrame)
    length, angle = number(query, "length"), number(query, "angle")
    arm = jogging.jog_arm(task)
    steps = arm.steps(jogging.frame_of(task, arm, frame), length, angle)
    if isinstance(steps, str):
        raise RequestRefused(RefusalReason.VALUE, steps)
    return {
        "reason": jogging.reason_against_jogging(live, task),
        "steps": steps,
        "stands": arm.standing(),
    }
