"""What a controller backup says of its tasks: their names, and which of them move a robot.

`BACKINFO/backinfo.txt` names the task of each folder `RAPID/TASKn`; `SYSPAR/SYS.cfg` has the type
of each task and `-MotionTask` for those that move. A task without a type is semistatic there.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from rapidsim.files import task_folders
from rapidsim.simulation.station.tasks import StationTask
from rapidsim.simulation.task_kind import TaskKind

_FOLDER = re.compile(r"^>>(TASK\d+):\s*\(\s*([^,)\s]+)", re.MULTILINE | re.IGNORECASE)
_TASKS = re.compile(r"^CAB_TASKS:\s*$(.*?)(?:^#|\Z)", re.MULTILINE | re.DOTALL)
_CONTINUED = re.compile(r"\\\s*\n\s*")
_NAME = re.compile(r'-Name\s+"([^"]+)"', re.IGNORECASE)
_TYPE = re.compile(r'-Type\s+"([^"]+)"', re.IGNORECASE)
_MOTION = re.compile(r"-MotionTask\b", re.IGNORECASE)


def backup_tasks(paths: Iterable[str]) -> tuple[StationTask, ...]:
    """The tasks of the first backup among some paths, in the order of their folders.

    Returns:
        None of them where no path is a backup, or where it does not say what its folders are.
    """
    for path in paths:
        folder = Path(path)
        folders = task_folders(folder) if path != "-" and folder.is_dir() else ()
        if folders:
            return _tasks_of(folders)
    return ()


def _tasks_of(folders: Iterable[Path]) -> tuple[StationTask, ...]:
    folders = tuple(folders)
    root = folders[0].parent.parent
    names = {
        folder.upper(): name
        for folder, name in _FOLDER.findall(_text(root, "BACKINFO", "backinfo.txt"))
    }
    if any(folder.name.upper() not in names for folder in folders):
        return ()
    configured = _configured(_text(root, "SYSPAR", "SYS.cfg"))
    tasks: list[StationTask] = []
    robots = 0
    for folder in folders:
        name = names[folder.name.upper()]
        kind, moves = configured.get(name.lower(), (TaskKind.NORMAL, None))
        # Without a configuration the task that is first is the one that moves.
        moves = not tasks if moves is None else moves
        tasks.append(StationTask(name, (), kind, moves, None, robots if moves else None))
        robots += moves
    return tuple(tasks)


def _configured(text: str) -> Mapping[str, tuple[TaskKind, bool | None]]:
    """Type of each task by folded name, and whether it moves a robot."""
    section = _TASKS.search(_CONTINUED.sub(" ", text.replace("\r", "")))
    found: dict[str, tuple[TaskKind, bool | None]] = {}
    for line in section[1].splitlines() if section else ():
        name, kind = _NAME.search(line), _TYPE.search(line)
        if name is None:
            continue
        word = kind[1].lower() if kind else TaskKind.SEMISTATIC.value
        known = word in [one.value for one in TaskKind]
        found[name[1].lower()] = (
            TaskKind(word) if known else TaskKind.SEMISTATIC,
            _MOTION.search(line) is not None,
        )
    return found


def _text(root: Path, *names: str) -> str:
    """The text of a file whose name may be written in any case; empty if there is none."""
    for name in names:
        try:
            entries = sorted(root.iterdir())
        except OSError:
            return ""
        root = next((one for one in entries if one.name.lower() == name.lower()), root / name)
    try:
        return root.read_text("latin-1")
    except OSError:
        return ""
