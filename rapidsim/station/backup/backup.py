"""Content of a controller backup: its tasks, robots and signals.

`BACKINFO/backinfo.txt` names the task of each folder `RAPID/TASKn`; `SYSPAR/SYS.cfg` has the type
of each task, and `-MotionTask` for tasks that move. In SYS.cfg, a task without a type is
semistatic. Robots and external axes are in `MOC.cfg`, the RobotWare version is in `backinfo.txt`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from rapidsim.backinfo import ListedTask, listed_products, listed_tasks
from rapidsim.frames.transform import Transform
from rapidsim.language.equipment import Configured
from rapidsim.language.robotware import RobotWare, read_robotware
from rapidsim.module_files import Backup
from rapidsim.station.backup.cfg_file import Configuration, read_configuration, text_in
from rapidsim.station.backup.external_units import UNIT_GROUP, ExternalUnits, external_units
from rapidsim.station.backup.loaded_modules import is_loaded_into, missing_modules
from rapidsim.station.backup.options import unknown_options
from rapidsim.station.backup.robots import backup_robots
from rapidsim.station.backup.signals import backup_io
from rapidsim.station.backup.tasks import TaskSettings, configured_tasks
from rapidsim.station.robot import StationRobot
from rapidsim.station.station import Station
from rapidsim.station.tasks import StationTask

_DOMAINS = ("EIO", "MMC", "MOC", "PROC", "SIO", "SYS")
_NUMBERED = re.compile(r"TASK\d+", re.IGNORECASE)
_ROBOTWARE = re.compile(r"RobotWare(?: Version)?:?[\s_]*(\d+\.\d+)", re.IGNORECASE)


def backup_station(backup: Backup) -> Station:
    """Return the station described by a backup."""
    root = backup.root
    configured = configured_in(root, "SYSPAR")
    cell = configured_cell(configured)
    system = configured.get("SYS", {})
    # If all modules are in HOME there are no folders; each would have the name of its task.
    folders = backup.tasks or [
        root / "RAPID" / task.name for task in configured_tasks(system).values()
    ]
    tasks = _tasks_of(root, folders, system, cell.robots)
    return replace(
        cell,
        robot_source="the backup's MOC.cfg" if cell.robots else None,
        tasks=tasks,
        robotware=_robotware(root),
        remarks=(*cell.remarks, *_without_robot(tasks, cell.robots)),
    )


def configured_cell(configured: Configured) -> Station:
    """Return the robots, units and signals of a configuration, without tasks."""
    motion, system = configured.get("MOC", {}), configured.get("SYS", {})
    robots = backup_robots(motion)
    units = external_units(motion, system)
    first, *further = units.axes
    robots = (
        *robots[:1],
        *(replace(one, external=axes) for one, axes in zip(robots[1:], further, strict=True)),
    )
    known = {axis.unit for axes in units.axes for axis in axes}
    robots = tuple(_on_unit(one, units) if one.carried_by in known else one for one in robots)
    io, remarks = backup_io(configured.get("EIO", {}))
    return Station(
        robots=robots,
        external_axes=first,
        other_units=units.unsupported,
        robot_source="MOC.cfg" if robots else None,
        io=io,
        configured=configured,
        remarks=(*remarks, *_not_simulated(units), *_carried(robots)),
    )


def _on_unit(robot: StationRobot, units: ExternalUnits) -> StationRobot:
    """Return a robot that a simulated unit carries; its base is in the frame of a gantry's end."""
    end = units.world_from_end.get(robot.carried_by or "", Transform.identity())
    return replace(robot, carried_by=None, world_from_base=end @ robot.world_from_base)


def configured_in(root: Path, *names: str) -> Configured:
    """Return the system parameters in the files of a folder below a root, by domain."""
    texts = ((domain, text_in(root, *names, f"{domain}.cfg")) for domain in _DOMAINS)
    return {domain: read_configuration(text) for domain, text in texts if text}


def _robotware(root: Path) -> RobotWare | None:
    """Return the version in `backinfo.txt`; None if it names no version."""
    named = _ROBOTWARE.search(text_in(root, "BACKINFO", "backinfo.txt"))
    return None if named is None else read_robotware(named[1])


def _not_simulated(units: ExternalUnits) -> Iterator[str]:
    """Yield notices about units whose axes are not simulated."""
    for unit in units.unsupported:
        yield (
            f"the unit {unit} of the backup is known only by name: MOC.cfg does not "
            "describe its axes fully, it is not active at the start, or it belongs to another "
            "task; [[external_axis]] tables declare it for the first robot"
        )


def _carried(robots: Sequence[StationRobot]) -> Iterator[str]:
    """Yield notices about robots whose base is moved by a unit that is not simulated."""
    for robot in robots:
        if robot.carried_by:
            yield (
                f"{robot.label} is mounted on {robot.carried_by}, whose axes MOC.cfg does not "
                "describe fully: its moves are not checked, and in a run the unit stands still"
            )


def _without_robot(tasks: Sequence[StationTask], robots: Sequence[StationRobot]) -> Iterator[str]:
    """Yield notices about tasks that only move units."""
    for task in tasks:
        if robots and task.robot_number is not None and task.robot_number >= len(robots):
            yield (
                f"{task.name} moves none of the robots of the backup, but a unit that is not "
                "simulated: a run gives it its own arm, and its moves are not checked"
            )


def _tasks_of(
    root: Path,
    folders: Sequence[Path],
    system: Configuration,
    robots: Sequence[StationRobot],
) -> tuple[StationTask, ...]:
    """Return tasks in the order of the folders; empty if the backup does not name the folders."""
    information = text_in(root, "BACKINFO", "backinfo.txt")
    listed = listed_tasks(information) or _tasks_by_number(folders, system, robots)
    options = unknown_options(listed_products(information))
    if any(f.name.upper().startswith("TASK") and f.name.lower() not in listed for f in folders):
        return ()
    configured = configured_tasks(system)
    loaded = system.get("CAB_TASK_MODULES", ())
    tasks: list[StationTask] = []
    for folder in folders:
        known = listed.get(folder.name.lower())
        name = folder.name if known is None else known.name
        settings = configured.get(name.lower())
        # Without a configuration each of the first tasks moves a robot.
        unconfigured = not configured and len(tasks) < max(len(robots), 1)
        moves = unconfigured if settings is None else settings.moves
        wanted = [one for one in loaded if is_loaded_into(one, name, moves=moves)]
        modules, unseen = missing_modules(wanted, folder)
        task = StationTask(name, motion=moves) if settings is None else configured_task(settings)
        tasks.append(
            replace(
                task,
                name=name,
                modules=modules,
                unseen=(*unseen, *options),
                # The safety controller has its own task, which a configuration does not name.
                is_system=bool(configured) and settings is None,
            )
        )
    return with_robot_numbers(tasks, system, [robot.label for robot in robots])


def _tasks_by_number(
    folders: Sequence[Path], system: Configuration, robots: Sequence[StationRobot]
) -> Mapping[str, ListedTask]:
    """Return the tasks of folders TASK1, TASK2 ... in a backup without `backinfo.txt`.

    A controller numbers the tasks that move first, in the order of their robots, then the others in
    the order of SYS.cfg. Without SYS.cfg tasks of several robots are T_ROB1, T_ROB2 ...
    """
    numbered = [
        (folder.name.lower(), int(folder.name[4:]))
        for folder in folders
        if _NUMBERED.fullmatch(folder.name)
    ]
    configured = tuple(configured_tasks(system).values())
    if not configured and len(robots) > 1:
        return {folder: ListedTask(f"T_ROB{number}", ()) for folder, number in numbered}
    if any(number > len(configured) for _, number in numbered):
        return {}
    labels = [robot.label for robot in robots]
    groups = _robots_of_groups(system)

    def order(task: TaskSettings) -> tuple[bool, int]:
        robot = groups.get(task.group)
        return not task.moves, labels.index(robot) if task.moves and robot in labels else 0

    ordered = sorted(configured, key=order)
    return {folder: ListedTask(ordered[number - 1].name, ()) for folder, number in numbered}


def _robots_of_groups(system: Configuration) -> Mapping[str | None, str | None]:
    """Return the label of the robot of each mechanical unit group."""
    return {group.get("name"): group.get("robot") for group in system.get(UNIT_GROUP, ())}


def configured_task(settings: TaskSettings) -> StationTask:
    """Return a task of a configuration, without modules and robot."""
    return StationTask(
        settings.name,
        kind=settings.kind,
        motion=settings.moves,
        entry=settings.entry,
        queue=settings.queue,
        refers_late=settings.refers_late,
        events=settings.events,
    )


def with_robot_numbers(
    tasks: Sequence[StationTask], system: Configuration, labels: Sequence[str | None]
) -> tuple[StationTask, ...]:
    """Return the tasks, with robot numbers for those that move.

    A unit group names the robot of a task; other tasks get the robots in the order of MOC.cfg.
    """
    groups = _robots_of_groups(system)
    configured = configured_tasks(system)
    found: list[StationTask] = []
    robots = 0
    for task in tasks:
        settings = configured.get(task.name.lower())
        robot = groups.get(settings.group) if settings else None
        number = labels.index(robot) if robot in labels else robots
        found.append(replace(task, robot_number=number if task.motion else None))
        robots += bool(task.motion)
    return tuple(found)
