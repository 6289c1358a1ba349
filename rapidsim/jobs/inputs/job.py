"""Convert a user's request to a job: files, station, tasks, robot, and the source of each.

All commands and the Python API use this module. A robot is loaded on demand, so that programs
without moves import no NumPy.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Final

from rapidsim.analysis.cell_names import CellNames
from rapidsim.files import InputError, SourceFile, did_you_mean
from rapidsim.jobs.inputs.api_options import with_api_options
from rapidsim.jobs.inputs.input_resolution import choose_robot, choose_station
from rapidsim.jobs.inputs.robot_choice import RobotChoice
from rapidsim.jobs.inputs.run_request import DEFAULT_ENTRY, RunRequest
from rapidsim.jobs.inputs.selection import choose_settings
from rapidsim.jobs.inputs.task_files import chosen_tasks
from rapidsim.module_files import TaskFiles, has_modules, single_programs
from rapidsim.station.cell_names import declared_names
from rapidsim.station.station import Station
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.motion.robot.robot import Robot
    from rapidsim.station.robot import StationRobot

OpenRobot = Callable[[str, float | None], "Robot"]
"""Loads an arm by its name and the scale of a URDF file."""
_USER: Final = SourceFile("user.sys", "MODULE user(SYSMODULE)\nENDMODULE\n", "utf-8")
"""The module that a controller without programs has."""


@value_class(frozen=True, slots=True)
class Job:
    """Inputs of a check or a run."""

    request: RunRequest
    station: Station
    """Station with the effective signals and settings of check."""
    tasks: tuple[TaskFiles, ...]
    """Tasks with their names."""
    robot: RobotChoice
    """Arm of the first robot."""
    open_robot: OpenRobot

    @property
    def files(self) -> tuple[SourceFile, ...]:
        """Files of all tasks."""
        return tuple(file for task in self.tasks for file in task.files)

    @property
    def is_arm_named(self) -> bool:
        """Whether the arm was named; if not, the program may be meant for another."""
        return self.robot.reason is None or self.station.robot is not None

    @property
    def is_arm_guessed(self) -> bool:
        """Whether an arm replaces one that is not named or that the catalogue lacks."""
        lacking = any(robot.unknown for robot in self.station.robots)
        return not self.is_arm_named or (lacking and self.request.robot is None)

    @property
    def unknown_arm(self) -> StationRobot | None:
        """First robot whose arm is unknown and has no substitute; None if there is no such robot.

        Such a robot runs only on an arm that the user names.
        """
        if self.request.robot is not None:
            return None
        robots = self.station.robots
        return next((one for one in robots if one.unknown and not one.can_be_guessed), None)

    def require_arms(self) -> None:
        """Reject robots whose arm is unknown and has no substitute.

        Raises:
            InputError: If there is such a robot.
        """
        lacking = self.unknown_arm
        if lacking is not None:
            raise InputError(
                f"the catalogue has no {lacking.unknown}, the arm of the backup with "
                f"{lacking.axis_count} axes, and no other arm can replace it",
                "--robot NAME runs the program on an arm of the catalogue",
            )

    @property
    def is_strict(self) -> bool:
        """Whether unknown, unsimulated and unchecked parts fail, too."""
        return self.request.strict or self.station.check.strict

    @property
    def cell(self) -> CellNames:
        """Names that the station declares for programs."""
        real = {os.path.realpath(stub) for stub in self.station.stubs}
        stubs = (file.name for file in self.files if os.path.realpath(file.name) in real)
        return replace(
            declared_names(self.station),
            assumes=self.request.assume_missing or self.station.check.assume_missing,
            stubs=frozenset(stubs),
        )

    @property
    def tables(self) -> tuple[Path, ...]:
        """Files that define changes of inputs."""
        io = (Path(self.request.io),) if isinstance(self.request.io, str) else ()
        return (*(() if self.station.file is None else (self.station.file,)), *io)

    def entry(self, task: str) -> str:
        """Return the entry procedure of a task: that of the request, else that of the station."""
        own = self.station.entry(task) if self.request.entry == DEFAULT_ENTRY else None
        return own or self.request.entry

    @property
    def only_task(self) -> TaskFiles:
        """The only task.

        Raises:
            InputError: If there are several tasks.
        """
        if len(self.tasks) > 1:
            names = ", ".join(one.name or self.station.task for one in self.tasks)
            raise InputError(f"there are {len(self.tasks)} tasks ({names})", "name one with --task")
        return self.tasks[0]

    def arm(self) -> Robot:
        """Load the arm of the first robot.

        Raises:
            InputError: If it is unknown; `RobotError` if `open_robot` raises it.
        """
        if self.unknown_arm is not None and self.unknown_arm is self.station.robots[0]:
            self.require_arms()
        given = self.request.robot
        if given is not None and not isinstance(given, str):
            return given
        arm = self.open_robot(self.robot.name, self.robot.scale)
        first = next(iter(self.station.robots), None)
        if first is None or not (given is None or _is_arm_of(first, arm, self.open_robot)):
            return arm
        return first.fitted(arm)


def job(request: RunRequest, *, open_robot: OpenRobot | None = None) -> Job:
    """Find the station near the files, read the files of its tasks, choose the robot.

    Args:
        request: The user's request.
        open_robot: Loads an arm by name and scale; None takes `rapidsim.load_robot`.

    Raises:
        InputError: If something is missing, unreadable, not RAPID, or contradicts itself.
    """
    # Each controller of a packed station is a separate path.
    paths = tuple(program for path in request.paths for program in single_programs(path))
    request = replace(request, paths=paths)
    station = choose_station(request.paths, request.station)
    if request.cell is not None:
        station = with_api_options(station, request.cell)
    if request.io is not None:
        from rapidsim.station.read import read_io

        io = Path(request.io) if isinstance(request.io, str) else request.io
        station = replace(station, io=station.io.and_also(read_io(io)))
    settings = choose_settings(request.paths, station.check)
    if request.fail_on is not None:
        settings = replace(settings, fail_on=request.fail_on)
    station = replace(station, check=settings)
    tasks = _read_tasks(request, station)
    open_robot = open_robot or _of_the_catalogue
    remarks = (
        *station.remarks,
        *_remarks(tasks),
        *_of_another_arm(request, station, open_robot),
        *_of_lacking_arms(station),
    )
    station = replace(station, remarks=remarks)
    robot = choose_robot(request.robot, station, request.scale)
    return Job(request, station, tasks, robot, open_robot)


def _remarks(tasks: Iterable[TaskFiles]) -> Iterator[str]:
    """Yield notices about skipped files."""
    for task in tasks:
        if task.unseen:
            names = ", ".join(task.unseen)
            yield f"task {task.name} has modules that cannot be read here: {names}"
        if task.left_out:
            names = ", ".join(task.left_out)
            yield f"task {task.name}: skipped, because backinfo.txt does not list them: {names}"


def _of_another_arm(request: RunRequest, station: Station, open_robot: OpenRobot) -> Iterator[str]:
    """Yield a note if the station's shapes and joint limits do not apply to the requested arm."""
    first = next(iter(station.robots), None)
    if first is None or not first.is_special or not isinstance(request.robot, str):
        return
    arm = open_robot(request.robot, request.scale)
    if not _is_arm_of(first, arm, open_robot):
        yield f"shapes and joint limits given for {first.name} are not used for {arm.name}"


def _of_lacking_arms(station: Station) -> Iterator[str]:
    """Yield notices about robots other than the first whose arm the catalogue lacks."""
    for robot in station.robots[1:]:
        if robot.unknown and robot.can_be_guessed:
            yield (
                f"the catalogue has no {robot.unknown}: the arm of the first robot replaces "
                f"that of {robot.label}"
            )


def _is_arm_of(robot: StationRobot, arm: Robot, open_robot: OpenRobot) -> bool:
    """Whether a requested arm is the one for which the station defines shapes or joint limits."""
    if not robot.is_special:
        return False
    if robot.name is None:
        # An arm that replaces the arm of a backup.
        return robot.unknown is not None
    return open_robot(robot.name, robot.scale).name == arm.name


def read_again(job: Job) -> Job:
    """Return the job with its files read again."""
    return replace(job, tasks=_read_tasks(job.request, job.station))


def _read_tasks(request: RunRequest, station: Station) -> tuple[TaskFiles, ...]:
    """Read the files of the tasks, but for those whose texts the request contains.

    Raises:
        InputError: See `job`; also if the request contains the text of a file of no task.
    """
    if request.may_be_empty and _has_no_modules(request.paths, station):
        empty = TaskFiles(None, (_USER,))
        task_names = [one.name for one in station.tasks if not one.is_system] or [station.task]
        return tuple(replace(empty, name=name) for name in task_names)
    tasks = chosen_tasks(request.paths, station, request.task)
    if not request.texts:
        return tasks
    names = {os.path.realpath(file.name): file.name for task in tasks for file in task.files}
    for path, _ in request.texts:
        if os.path.realpath(path) not in names:
            help = did_you_mean(path, names.values()) or "texts= names files of the program"
            raise InputError(f"{path} is no file of the program", help)
    texts = {names[os.path.realpath(path)]: text for path, text in request.texts}
    return tuple(
        replace(
            task,
            files=tuple(replace(file, text=texts.get(file.name, file.text)) for file in task.files),
        )
        for task in tasks
    )


def _has_no_modules(paths: Iterable[str], station: Station) -> bool:
    """Whether the paths are folders without modules, and the station file names none."""
    folders = [Path(path) for path in paths]
    are_empty = all(one.is_dir() and not has_modules(one) for one in folders)
    return are_empty and not any(task.modules for task in station.tasks)


def _of_the_catalogue(name: str, scale: float | None) -> Robot:
    from rapidsim.motion.robot.robot import load_robot

    return load_robot(name, scale)
