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
from rapidsim.station.task_kind import TaskKind

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
    robots = station.robots or (StationRobot(),)
    with_axes = replace(first, external=station.external_axes) if station.external_axes else first
    setups: list[TaskSetup] = []
    given = 0
    unsaid = [task for task in tasks if task.name.lower() not in known]
    seated = any(task.robot_number is not None for task in station.tasks)
    movers = [task for task in unsaid if task.has_moves]
    if not movers and not seated:
        movers = unsaid[:1]
    for task in tasks:
        said = known.get(task.name.lower())
        kind = TaskKind.NORMAL if said is None else said.kind
        number = None if said is None else said.robot_number
        queue = None if said is None else said.queue
        if task in movers or (number is None and len(tasks) == 1):
            number = given
        if number is None:
            setups.append(
                TaskSetup(task.name, task.program, kind=kind, written=task.written, queue=queue)
            )
            continue
        given += 1
        robot = robots[number] if number < len(robots) else StationRobot()
        arm = with_axes if number == 0 else first
        if number and robot.name:
            arm = robot.fitted(open_robot(robot.name, robot.scale))
        if number and robot.external:
            arm = replace(arm, external=robot.external)
        start, place = robot.start_joints_deg, robot.world_from_base
        _require_axes(station, arm, start)
        setups.append(
            TaskSetup(
                task.name,
                task.program,
                arm,
                start,
                place,
                kind,
                task.written,
                queue=queue,
                robot_label=robot.label,
                is_base_known=not robot.carried_by or bool(station.external_axes),
            )
        )
    return tuple(setups)


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
