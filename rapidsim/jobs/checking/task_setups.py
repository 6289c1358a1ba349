"""Assignment of robots to tasks, according to the programs and the station file."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import degrees

from rapidsim.files import InputError
from rapidsim.jobs.checking.load_tasks import LoadedTask
from rapidsim.motion.robot.robot import Robot
from rapidsim.simulation.task_run import TaskSetup
from rapidsim.station.robot import StationRobot
from rapidsim.station.station import Station
from rapidsim.station.tasks import StationTask

_ROUNDING_DEG = 1e-6
"""Tolerance [deg] for a limit that was written in degrees and stored in radians."""


def task_setups(
    tasks: Sequence[LoadedTask],
    station: Station,
    first: Robot,
    open_robot: Callable[[str, float | None], Robot],
) -> tuple[TaskSetup, ...]:
    """Return the setup of each task of a run.

    If the station file does not assign a robot to a task, a task with moves gets the next one, and
    an arm like the first if the file has no more robots. If no task has moves, the first unassigned
    task gets the robot, as it is the initial one on a controller. A task that runs alone always
    gets a robot.

    Args:
        tasks: Tasks with their programs.
        station: The content of the station file.
        first: The arm of the first robot, without external axes.
        open_robot: Loads an arm by name and scale.

    Raises:
        InputError: If a start position does not have one value per axis, or has one past its limit.
    """
    known = {task.name.lower(): task for task in station.tasks}
    movers = _movers_without_robot(tasks, station)
    setups: list[TaskSetup] = []
    given = 0
    for task in tasks:
        listed = known.get(task.name.lower(), StationTask())
        number = listed.robot_number
        if task in movers or (number is None and len(tasks) == 1):
            number = given
        setup = TaskSetup(
            task.name,
            task.program,
            kind=listed.kind,
            written=task.written,
            queue=listed.queue,
            events=listed.events,
        )
        if number is not None:
            given += 1
            setup = _with_robot(setup, number, station, first, open_robot)
        setups.append(setup)
    return tuple(setups)


def _movers_without_robot(tasks: Sequence[LoadedTask], station: Station) -> Sequence[LoadedTask]:
    """The tasks that the station file does not list and that get a robot."""
    listed = {task.name.lower() for task in station.tasks}
    unlisted = [task for task in tasks if task.name.lower() not in listed]
    movers = [task for task in unlisted if task.has_moves]
    is_assigned = any(task.robot_number is not None for task in station.tasks)
    return movers if movers or is_assigned else unlisted[:1]


def _with_robot(
    setup: TaskSetup,
    number: int,
    station: Station,
    first: Robot,
    open_robot: Callable[[str, float | None], Robot],
) -> TaskSetup:
    """The setup of a task with a robot, by its number in the station file."""
    robots = station.robots or (StationRobot(),)
    robot = robots[number] if number < len(robots) else StationRobot()
    arm, external = first, station.external_axes
    if number:
        arm = robot.fitted(open_robot(robot.name, robot.scale)) if robot.name else first
        external = robot.external
    if external:
        arm = replace(arm, external=external)
    _require_axes(station, arm, robot.start_joints_deg)
    return replace(
        setup,
        robot=arm,
        start_joints_deg=robot.start_joints_deg,
        world_from_base=robot.world_from_base,
        robot_label=robot.label,
        is_base_known=not robot.carried_by or bool(station.external_axes),
    )


def _require_axes(station: Station, arm: Robot, start: tuple[float, ...] | None) -> None:
    if start is None:
        return
    if len(start) != len(arm.joints):
        raise InputError(
            f"{station.file}: robot.start: {arm.name} has {len(arm.joints)} joints, "
            f"not {len(start)}"
        )
    for number, (angle, joint) in enumerate(zip(start, arm.joints, strict=True), start=1):
        lower, upper = degrees(joint.lower), degrees(joint.upper)
        if not lower - _ROUNDING_DEG <= angle <= upper + _ROUNDING_DEG:
            raise InputError(
                f"{station.file}: robot.start: joint {number} of {arm.name} goes from {lower:g} to "
                f"{upper:g} {joint.measure}, not to {angle:g}"
            )
