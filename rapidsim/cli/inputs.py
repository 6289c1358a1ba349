"""What commands are given: the files of one task, a station, a robot."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from rapidsim.diagnostics import Diagnostic
from rapidsim.files import InputError, SourceFile, TaskFiles, neighbours, read_tasks
from rapidsim.simulation.station import Station, find_station, read_station

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
    """The named station file, else the one next to the program or above it, else the defaults."""
    if file is not None:
        return read_station(Path(file))
    found = find_station(paths)
    return read_station(found) if found else Station()


def choose_robot(robot: str | None, station: Station) -> RobotChoice:
    """The named robot, else that of the station file, else the default."""
    if robot is not None:
        return RobotChoice(robot, None)
    if station.robot is not None:
        return RobotChoice(station.robot, f"from {station.file}")
    return RobotChoice(DEFAULT_ROBOT, "by default; --robot names another")


def all_tasks(paths: Sequence[str], station: Station) -> tuple[TaskFiles, ...]:
    """The files of every task named, with the modules that the station file adds to a lone one."""
    tasks = read_tasks((*paths, *(str(seen_from_here(module)) for module in station.modules)))
    if len(tasks) == 1:
        return (replace(tasks[0], name=tasks[0].name or station.task),)
    return tasks


def one_task(paths: Sequence[str], station: Station) -> tuple[SourceFile, ...]:
    """The files of the only task named.

    Raises:
        InputError: If a backup holds several tasks.
    """
    tasks = all_tasks(paths, station)
    if len(tasks) > 1:
        names = ", ".join(task.name or station.task for task in tasks)
        raise InputError(
            f"there are {len(tasks)} tasks ({names}), and several are not simulated together yet",
            "name the folder of one task, such as RAPID/TASK1",
        )
    return tasks[0].files


def seen_from_here(path: Path) -> Path:
    """A path below the working directory as the user would write it; others unchanged."""
    here = Path.cwd().resolve()
    return path.relative_to(here) if path.is_relative_to(here) else path


def program_name(paths: Sequence[str]) -> str:
    """What files that belong to the run are called: the first path without its suffix."""
    return "stdin" if paths[0] == "-" else Path(paths[0]).resolve().stem


def missing_neighbours(paths: Sequence[str], diagnostics: Iterable[Diagnostic]) -> str | None:
    """A line that names the modules beside a lone file, if it uses names nobody declares."""
    beside = neighbours(paths[0]) if len(paths) == 1 else ()
    if not beside or not any(d.violation.code in _UNDECLARED for d in diagnostics):
        return None
    named = ", ".join(beside[:_NAMED_NEIGHBOURS])
    named += ", ..." if len(beside) > _NAMED_NEIGHBOURS else ""
    return f"Modules beside it: {named}; name the folder to load them too."
