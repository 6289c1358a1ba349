"""What commands are given: the files of one task, a station, a robot."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from rapidsim.cli.terminal import say
from rapidsim.diagnostics import Diagnostic
from rapidsim.files import (
    InputError,
    SourceFile,
    TaskFiles,
    backup_folders,
    did_you_mean,
    named_tasks,
    neighbours,
    read_tasks,
    require_inside,
)
from rapidsim.station.station import Station, find_station

DEFAULT_ROBOT = "irb1600-6-1.2"

# Rules that find a name which another module may declare.
_UNDECLARED = ("N201", "N209", "N210")
_NAMED_NEIGHBOURS = 4


@dataclass(frozen=True, slots=True)
class RobotChoice:
    """Which robot, and what decided it."""

    name: str
    reason: str | None
    """For the summary; None where the user named the robot on the command line."""


def choose_station(paths: Sequence[str], file: str | None) -> Station:
    """The named station file, else the one next to the program or above it, else the defaults.

    Where it says nothing of robots, tasks and signals, a backup does; what of that is left out is
    said on stderr.
    """
    backup = _backup(paths)
    for remark in backup.remarks:
        say(f"note: {remark}", err=True)
    found = Path(file) if file is not None else find_station(paths)
    if found is None:
        return backup
    from rapidsim.station.read import read_station

    return read_station(found).and_backup(backup)


def _backup(paths: Sequence[str]) -> Station:
    folders = backup_folders(paths)
    if not folders:
        return Station()
    # Most of what is named is no backup, and does not pay for importing NumPy here.
    from rapidsim.station.backup.backup import backup_station

    return backup_station(folders)


def choose_robot(robot: str | None, station: Station) -> RobotChoice:
    """The named robot, else that of the station file or the backup, else the default."""
    if robot is not None:
        return RobotChoice(robot, None)
    if station.robot is not None:
        return RobotChoice(station.robot, f"from {station.robot_source or station.file}")
    unknown = (
        f"the catalogue has no {station.unknown_robots[0]}; " if station.unknown_robots else ""
    )
    return RobotChoice(DEFAULT_ROBOT, f"by default; {unknown}--robot names another")


def all_tasks(paths: Sequence[str], station: Station) -> tuple[TaskFiles, ...]:
    """The files of every task, by name.

    The tasks of a backup are those of the station file in its order, or T_ROB1, T_ROB2 ... without
    one. Other files that are named belong to the first task, unless a task of the station file
    lists them.

    Raises:
        InputError: If something is missing, unreadable, or no RAPID, or a task has no module.
    """
    # What the station file lists lies in its folder, or in one that the command line names.
    rooms = (*([station.file.parent] if station.file else ()), *_folders(paths))
    for listing in station.tasks:
        require_inside(listing.modules, rooms)
    if len(station.tasks) < 2:
        everything = (*paths, *_as_typed(station.modules))
        return named_tasks(read_tasks(everything, rooms), station.task)
    named = read_tasks(paths, rooms)
    listed = [
        read_tasks(_as_typed(task.modules), rooms)[0].files if task.modules else ()
        for task in station.tasks
    ]
    if len(named) > 1:
        if len(named) != len(station.tasks):
            raise InputError(
                f"there are {len(named)} task folders and {len(station.tasks)} [[task]] tables in "
                f"{station.file}"
            )
        own = [task.files for task in named]
    else:
        claimed = {os.path.realpath(file.name) for files in listed for file in files}
        rest = tuple(one for one in named[0].files if os.path.realpath(one.name) not in claimed)
        own = [rest, *(() for _ in listed[1:])]
    tasks = tuple(
        TaskFiles(task.name, (*mine, *more))
        for task, mine, more in zip(station.tasks, own, listed, strict=True)
    )
    for task in tasks:
        if not task.files:
            raise InputError(
                f"{station.file}: the task {task.name} has no module",
                "list them: modules = [...]",
            )
    return tasks


def chosen_tasks(paths: Sequence[str], station: Station, task: str | None) -> tuple[TaskFiles, ...]:
    """All tasks, or only the one that is named.

    Raises:
        InputError: If there is no such task; see `all_tasks`.
    """
    tasks = all_tasks(paths, station)
    if task is None:
        return tasks
    chosen = tuple(one for one in tasks if one.name and one.name.lower() == task.lower())
    if not chosen:
        names = [one.name for one in tasks if one.name]
        help = did_you_mean(task, names) or f"there are {', '.join(names)}"
        raise InputError(f"there is no task {task}", help)
    return chosen


def one_task(
    paths: Sequence[str], station: Station, task: str | None = None
) -> tuple[SourceFile, ...]:
    """The files of the only task, or of the one that is named.

    Raises:
        InputError: If there are several to choose from; see `chosen_tasks`.
    """
    tasks = chosen_tasks(paths, station, task)
    if len(tasks) > 1:
        names = ", ".join(one.name or station.task for one in tasks)
        raise InputError(f"there are {len(tasks)} tasks ({names})", "name one with --task")
    return tasks[0].files


def _folders(paths: Sequence[str]) -> tuple[Path, ...]:
    """The folders that a command names, or in which the files lie that it names."""
    places = [Path(path) for path in paths if path != "-"]
    return tuple(place if place.is_dir() else place.parent for place in places)


def _as_typed(modules: Iterable[Path]) -> tuple[str, ...]:
    return tuple(str(seen_from_here(module)) for module in modules)


def seen_from_here(path: Path) -> Path:
    """A path below the working directory as the user would write it; others unchanged."""
    here = Path.cwd().resolve()
    return path.relative_to(here) if path.is_relative_to(here) else path


def program_name(paths: Sequence[str]) -> str:
    """What files that belong to the run are called: the first path without its suffix."""
    return "stdin" if paths[0] == "-" else Path(os.path.realpath(paths[0])).stem


def missing_neighbours(paths: Sequence[str], diagnostics: Iterable[Diagnostic]) -> str | None:
    """A line that names the modules beside a lone file, if it uses names nobody declares."""
    beside = neighbours(paths[0]) if len(paths) == 1 else ()
    if not beside or not any(d.violation.code in _UNDECLARED for d in diagnostics):
        return None
    named = ", ".join(beside[:_NAMED_NEIGHBOURS])
    named += ", ..." if len(beside) > _NAMED_NEIGHBOURS else ""
    return f"Modules beside it: {named}; name the folder to load them too."
