"""Mechanical units and their positions."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from rapidsim.language.data import UNUSED_AXIS
from rapidsim.motion.robot.external_axes import LETTERS
from rapidsim.server.derived_parameters import robots
from rapidsim.server.messages import Answer, Item, Request
from rapidsim.server.resources.codes import BAD_PARAMETER, NOT_FOUND, refused
from rapidsim.server.resources.context import RequestContext
from rapidsim.simulation.live import position
from rapidsim.simulation.live.live_task import LiveTask
from rapidsim.simulation.live.position import Coordinates

_FRAMES: Final = {
    "": Coordinates.BASE,
    "base": Coordinates.BASE,
    "world": Coordinates.WORLD,
    "word": Coordinates.WORLD,  # So spelt by a public client.
    "wobj": Coordinates.WOBJ,
}


def motion_system(context: RequestContext, request: Request) -> Answer:
    """The parts of the motion system."""
    del context, request
    fields = {"change-count": "0"}
    links = ("mechunits", "errorstate", "nonmotionexecution")
    return Answer((Item("ms-motionsystem", "motionsystem", fields),), links=links)


def error_state(context: RequestContext, request: Request) -> Answer:
    """The state of the motion system, which never has errors of its own in rapidsim."""
    del context, request
    fields = {"err-state": "HPJ_OK", "err-count": "0"}
    return Answer((Item("ms-errorstate", "errorstate", fields),))


def non_motion_execution(context: RequestContext, request: Request) -> Answer:
    """Whether programs run without moving the robots, which rapidsim never does."""
    del context, request
    return Answer((Item("ms-nonmotionexecution", "nonmotionexecution", {"mode": "OFF"}),))


def units(context: RequestContext, request: Request) -> Answer:
    """All robots."""
    allowed = "True" if request.generation == 1 else "true"
    items = (_unit_item(name, allowed) for name, _ in _robots(context))
    return Answer(resources=tuple(items))


def unit(context: RequestContext, request: Request, unit: str) -> Answer:
    """The fixed data of a robot (`resource=static`) and its state (`resource=dynamic`)."""
    name, task = robot_of(context, unit)
    if request.query.get("resource") == "static":
        axes = len(task.unit.member.robot.joints)
        # A client raises an error at an empty text, and interprets these words as "none".
        fields = {
            "task-name": task.name,
            "is-integrated-unit": "NoIntegratedUnit",
            "has-integrated-unit": "NoIntegratedUnit",
            "type": "TCPRobot",
            "axes": str(axes),
            "axes-total": str(axes + len(task.unit.member.robot.external)),
        }
    else:
        tool, wobj = position.active_frames(task)
        fields = {
            "tool-name": tool,
            "wobj-name": wobj,
            "payload-name": "load0",
            "total-payload-name": "load0",
            "status": "Synchronized",
            "jog-mode": "GroupOne",
            "mode": "Activated",
            "coord-system": "World",
        }
    item = Item("ms-mechunit", name, fields, href=f"rw/motionsystem/mechunits/{name}")
    return Answer((item,), links=("jointtarget", "robtarget", "cartesian", "baseframe", "axes"))


def of_task(context: RequestContext, request: Request, task: str) -> Answer:
    """The mechanical unit of a task, or its `jointtarget` or `robtarget` as `resource`.

    Raises:
        RefusedRequest: If the task moves no robot.
    """
    name = context.live.task(task).name
    for unit, one in _robots(context):
        if one.name == name:
            match request.query.get("resource"):
                case "jointtarget":
                    return joint_target(context, request, unit)
                case "robtarget":
                    return rob_target(context, request, unit)
                case _:
                    return Answer((Item("rap-motion", name, {"mechunit": unit}),))
    raise refused(BAD_PARAMETER, f"{name} moves no robot")


def joint_target(context: RequestContext, request: Request, unit: str) -> Answer:
    """The current positions of the axes of a robot; RobotWare 7 has 0 for those it lacks."""
    name, task = robot_of(context, unit)
    now = position.joints(task)
    fields = {f"rax_{index}": _text(one) for index, one in enumerate(now.robax, start=1)}
    for letter, one in zip(LETTERS, now.extax, strict=True):
        is_absent = one == UNUSED_AXIS and request.generation == 2
        fields[f"eax_{letter}"] = "0" if is_absent else _text(one)
    return Answer((Item("ms-jointtarget", name, fields),))


def rob_target(context: RequestContext, request: Request, unit: str) -> Answer:
    """The current pose of the TCP of a robot."""
    query = request.query
    name, task = robot_of(context, unit)
    frame = _frame(query.get("coordinate", ""))
    tool, wobj = query.get("tool") or "tool0", query.get("wobj") or "wobj0"
    now = position.target(task, tool, wobj, frame)
    fields = _numbers(("x", "y", "z"), now.trans) | _numbers(("q1", "q2", "q3", "q4"), now.rot)
    fields |= _numbers(("cf1", "cf4", "cf6", "cfx"), now.robconf)
    for letter, one in zip(LETTERS, now.extax, strict=True):
        # One public client reads this name, another that.
        fields |= {f"eax{letter}": _text(one), f"eax_{letter}": _text(one)}
    return Answer((Item("ms-robtargets", name, fields),))


def cartesian(context: RequestContext, request: Request, unit: str) -> Answer:
    """The current Cartesian pose of the TCP of a robot, by default of its flange in its base."""
    name, task = robot_of(context, unit)
    query = request.query
    tool, wobj = query.get("tool") or "tool0", query.get("wobj") or "wobj0"
    now = position.target(task, tool, wobj, _frame(query.get("coordinate", "")))
    fields = _numbers(("x", "y", "z"), now.trans) | _numbers(("q1", "q2", "q3", "q4"), now.rot)
    names, title = ("j1", "j4", "j6", "jx"), "cartesian"
    if request.generation == 2:
        names, title = ("cf1", "cf4", "cf6", "cfx"), name
    fields |= _numbers(names, now.robconf)
    return Answer((Item("ms-mechunit-cartesian", title, fields),))


def axes(context: RequestContext, request: Request, unit: str) -> Answer:
    """The number of axes of a robot, and the address of each."""
    del request
    name, task = robot_of(context, unit)
    count = len(task.unit.member.robot.joints)
    total = Item("ms-mechunit-axes", "axes", {"axes": str(count)})
    address = f"rw/motionsystem/mechunits/{name}/axes"
    items = (
        Item("ms-axis-li", str(number), href=f"{address}/{number}")
        for number in range(1, count + 1)
    )
    return Answer((total,), resources=tuple(items))


def axis(context: RequestContext, request: Request, unit: str, number: str) -> Answer:
    """The state of an axis of a robot.

    Raises:
        RefusedRequest: If the robot has no axis of this number.
    """
    del request
    name, task = robot_of(context, unit)
    if number not in map(str, range(1, len(task.unit.member.robot.joints) + 1)):
        raise refused(NOT_FOUND, f"{name} has no axis {number}")
    state = Item("ms-mechunit-axisstatus", "axis", {"axis-status": "Synchronized"})
    return Answer((state, Item("ms-mechunit-logicalaxis", "axis", {"logical-axis": number})))


def base_frame(context: RequestContext, request: Request, unit: str) -> Answer:
    """The pose of a robot's base in the world."""
    del request
    name, task = robot_of(context, unit)
    place = task.setup.place
    fields = _numbers(("x", "y", "z"), tuple(1e3 * float(one) for one in place.translation))
    fields |= _numbers(("q1", "q2", "q3", "q4"), tuple(map(float, place.quaternion)))
    return Answer((Item("ms-mechunit-baseframe", name, fields),))


def _robots(context: RequestContext) -> Iterator[tuple[str, LiveTask]]:
    """Each task that moves a robot, with the name of its mechanical unit."""
    return ((unit, context.live.task(one.name)) for unit, one in robots(context.live.setups))


def robot_of(context: RequestContext, unit: str) -> tuple[str, LiveTask]:
    """Return the name of a mechanical unit, and the task that moves it.

    Raises:
        RefusedRequest: If there is no such unit.
    """
    for name, task in _robots(context):
        if name.lower() == unit.lower():
            return name, task
    raise refused(NOT_FOUND, f"there is no mechanical unit {unit}")


def _unit_item(name: str, allowed: str) -> Item:
    fields = {"mode": "Activated", "activation-allowed": allowed, "drive-module": "0"}
    return Item("ms-mechunit-li", name, fields, href=f"rw/motionsystem/mechunits/{name}")


def _frame(word: str) -> Coordinates:
    if word.lower() not in _FRAMES:
        raise refused(BAD_PARAMETER, f"`coordinate` cannot be `{word}` here")
    return _FRAMES[word.lower()]


def _numbers(names: tuple[str, ...], values: tuple[float, ...]) -> dict[str, str]:
    return {name: _text(one) for name, one in zip(names, values, strict=True)}


def _text(value: float) -> str:
    return "9E+09" if value == UNUSED_AXIS else f"{value + 0.0:.9G}"
