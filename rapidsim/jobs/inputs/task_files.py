"""Modules of a job by task: those of the command line, and those that the station file lists."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from rapidsim.analysis.names.name_violations import DuplicateName
from rapidsim.diagnostics import Diagnostic
from rapidsim.files import InputError, did_you_mean, relative_to_cwd, require_inside
from rapidsim.jobs.inputs.run_request import DEFAULT_ENTRY
from rapidsim.module_files import (
    TaskFiles,
    named_tasks,
    neighbours,
    opened,
    packed_station,
    read_tasks,
)
from rapidsim.station.station import Station
from rapidsim.station.tasks import StationTask

# Rules that find a name that another module may declare.
_UNDECLARED = ("N201", "N209", "N210")
_NAMED_NEIGHBOURS = 4
_NO_FILES = TaskFiles(None, ())


def all_tasks(paths: Sequence[str], station: Station) -> tuple[TaskFiles, ...]:
    """Return the files of every task, by name.

    The tasks of a backup correspond in order to those of the station file; without one they are
    T_ROB1, T_ROB2 ... Other files belong to the first task, unless a task of the station file lists
    them.

    Raises:
        InputError: If something is missing, unreadable, or not RAPID, or a task has no module.
    """
    # Files listed by the station file are in its folder, or in one that the command line names.
    rooms = (*([station.file.parent] if station.file else ()), *_folders(paths))
    for listing in station.tasks:
        require_inside(listing.modules, rooms)
    require_inside(station.stubs, rooms)
    if len(station.tasks) < 2:
        return _files_of_one_task(paths, station, rooms)
    lists_modules = any(task.modules for task in station.tasks)
    named = read_tasks(paths, rooms, more=lists_modules) or (_NO_FILES,)
    stubs = read_tasks(_as_typed(station.stubs), rooms)[0].files if station.stubs else ()
    listed = [
        read_tasks(_as_typed(task.modules), rooms)[0] if task.modules else _NO_FILES
        for task in station.tasks
    ]
    tasks = tuple(
        replace(
            mine,
            name=task.name,
            files=(*mine.files, *more.files, *stubs),
            unseen=(*mine.unseen, *more.unseen, *task.unseen),
            refers_late=task.refers_late,
        )
        for task, mine, more in zip(
            station.tasks, _own_files(named, listed, station), listed, strict=True
        )
    )
    _require_modules(tasks, station)
    return tuple(task for task, one in zip(tasks, station.tasks, strict=True) if not one.is_system)


def _files_of_one_task(
    paths: Sequence[str], station: Station, rooms: Sequence[Path]
) -> tuple[TaskFiles, ...]:
    """The files of the only task, or of the tasks of a backup that no station file describes."""
    everything = (*paths, *_as_typed((*station.modules, *station.stubs)))
    listed = station.tasks[0] if station.tasks else StationTask()
    files = read_tasks(everything, rooms, more=bool(station.modules))
    return tuple(
        replace(task, unseen=(*task.unseen, *listed.unseen), refers_late=listed.refers_late)
        for task in named_tasks(files, station.task)
    )


def _own_files(
    named: Sequence[TaskFiles], listed: Sequence[TaskFiles], station: Station
) -> list[TaskFiles]:
    """The files that paths give to each task, without those that the station file lists."""
    if len(named) > len(station.tasks):
        raise InputError(
            f"there are {len(named)} task folders and {len(station.tasks)} [[task]] tables in "
            f"{station.file}"
        )
    if len(named) == 1:
        claimed = {os.path.realpath(file.name) for task in listed for file in task.files}
        rest = tuple(one for one in named[0].files if os.path.realpath(one.name) not in claimed)
        named = [replace(named[0], files=rest)]
    # Those that only the station file has come last.
    return [*named, *(_NO_FILES for _ in listed[len(named) :])]


def _require_modules(tasks: Sequence[TaskFiles], station: Station) -> None:
    for task in tasks:
        if task.files:
            continue
        if station.file is None:
            raise InputError(f"SYS.cfg of the backup loads no module into {task.name}")
        raise InputError(
            f"{station.file}: the task {task.name} has no module", "list them: modules = [...]"
        )


def chosen_tasks(paths: Sequence[str], station: Station, task: str | None) -> tuple[TaskFiles, ...]:
    """Return all tasks, or only the task of a name.

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


def _folders(paths: Sequence[str]) -> tuple[Path, ...]:
    """Return the folders among the paths, and the folders of the files among them."""
    places = [opened(path) for path in paths if path != "-"]
    return tuple(place if place.is_dir() else place.parent for place in places)


def _as_typed(modules: Iterable[Path]) -> tuple[str, ...]:
    return tuple(str(relative_to_cwd(module)) for module in modules)


def program_name(paths: Sequence[str]) -> str:
    """Base name of files that belong to the run: the first path without its suffix."""
    if paths[0] == "-":
        return "stdin"
    archive = _archive_of_all(paths)
    if archive is not None:
        return archive.stem
    packed = packed_station(paths[0])
    if packed is not None and packed[1]:
        return f"{packed[0].stem}-{packed[1]}"
    return Path(os.path.realpath(paths[0])).stem


def program_title(paths: Sequence[str]) -> str:
    """Displayed name of the run: its file or folder, the first of several."""
    if paths[0] == "-":
        return "standard input"
    archive = _archive_of_all(paths)
    if archive is not None:
        return archive.name
    more = f" and {len(paths) - 1} more" if len(paths) > 1 else ""
    return Path(os.path.realpath(paths[0])).name + more


def _archive_of_all(paths: Sequence[str]) -> Path | None:
    """Packed station whose controllers the paths are; None if there is no such station."""
    archives = {packed[0] if (packed := packed_station(path)) else None for path in paths}
    return archives.pop() if len(paths) > 1 and len(archives) == 1 else None


def hints(paths: Sequence[str], diagnostics: Iterable[Diagnostic]) -> Iterator[str]:
    """Yield lines on how else to name the files of a program, as its findings suggest."""
    violations = [one.violation for one in diagnostics]
    lacks_names = len(paths) == 1 and any(one.code in _UNDECLARED for one in violations)
    if beside := neighbours(paths[0]) if lacks_names else ():
        named = ", ".join(beside[:_NAMED_NEIGHBOURS])
        named += ", ..." if len(beside) > _NAMED_NEIGHBOURS else ""
        yield f"Modules next to it: {named}; name the folder to load them too."
    twice = (one for one in violations if isinstance(one, DuplicateName) and one.between_modules)
    if mains := sum(one.duplicate.lower() == DEFAULT_ENTRY for one in twice):
        yield (
            f"{mains + 1} of the modules have a main, so they are no single task: `rapidsim init`"
            " gives each a [[task]], `check --each` with their names checks one by one."
        )
