"""The program that a file belongs to: the cell of its station file or backup, its folder, itself.

Modules of one folder are one task, unless two of them have a `main` or the same name: then they are
programs that only lie side by side, and each file is checked by itself.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from rapidsim.files import InputError, input_bytes
from rapidsim.jobs.inputs.job import Job, job
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.module_files import MODULE_SUFFIXES, backup_among, has_modules
from rapidsim.station.station import find_station
from rapidsim.workspace.workspace import Workspace

_MAIN = re.compile(r"^[ \t]*PROC[ \t]+main\b", re.IGNORECASE | re.MULTILINE)
_MODULE = re.compile(r"^[ \t]*MODULE[ \t]+(\w+)", re.IGNORECASE | re.MULTILINE)
_MOST_LEVELS = 6
"""Folders above a file in which a backup is searched."""


def job_of_file(path: str) -> Job | None:
    """Return the job of the program that a file belongs to.

    Returns:
        None if the file is not on the disk, or is no RAPID.

    Raises:
        InputError: If the station file or a module cannot be read.
    """
    file = Path(path)
    if not file.is_file() or file.suffix.lower() not in MODULE_SUFFIXES:
        return None
    for folder in _roots(file):
        found = job(RunRequest(paths=(str(folder),)))
        if any(_is_same(Path(one.name), file) for one in found.files):
            return found
    return job(RunRequest(paths=(path,)))


def job_of_folder(path: str) -> Job | None:
    """Return the job of a folder that an editor opens; None if it is not one program.

    Raises:
        InputError: If the station file or a module cannot be read.
    """
    folder = Path(path)
    if not folder.is_dir() or not has_modules(folder):
        return None
    is_program = backup_among((path,)) is not None or _is_one_task(folder)
    return job(RunRequest(paths=(path,))) if is_program or find_station((path,)) else None


def frozen(of: Job, workspace: Workspace) -> Job:
    """Return a job with the present texts of a workspace."""
    known = frozenset(workspace.paths)
    return replace(
        of,
        tasks=tuple(
            replace(
                task,
                files=tuple(
                    replace(file, text=workspace.text(file.name)) if file.name in known else file
                    for file in task.files
                ),
            )
            for task in of.tasks
        ),
    )


def _roots(file: Path) -> Iterator[Path]:
    """Yield the folders that may be the program of a file, the widest first."""
    station = find_station((str(file),))
    if station is not None:
        yield station.parent
    for folder in list(file.parents)[:_MOST_LEVELS]:
        if backup_among((str(folder),)) is not None:
            yield folder
            break
    if station is None and _is_one_task(file.parent):
        yield file.parent


def _is_one_task(folder: Path) -> bool:
    """Whether the modules of a folder can be one task."""
    mains, names = 0, set()
    try:
        files = [one for one in folder.iterdir() if one.suffix.lower() in MODULE_SUFFIXES]
        for file in files:
            text = input_bytes(file).decode("latin-1")
            mains += bool(_MAIN.search(text))
            for name in _MODULE.findall(text):
                if name.lower() in names:
                    return False
                names.add(name.lower())
    except (OSError, InputError):
        return False
    return mains < 2


def _is_same(path: Path, file: Path) -> bool:
    try:
        return path == file or path.samefile(file)
    except OSError:
        return False
