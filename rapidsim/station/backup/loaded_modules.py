"""Modules that a configuration loads into tasks: CAB_TASK_MODULES in `SYSPAR/SYS.cfg`.

A backup stores them in the folder of the task, except modules of an add-in, of which only the names
are known. Modules of the system itself (RELEASE:) are covered by the library.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from rapidsim.files import require_inside
from rapidsim.station.backup.cfg_file import SWITCHED_ON, Instance

_HOME = re.compile(r"HOME:?[/\\]+", re.IGNORECASE)
_SYSTEM = re.compile(r"RELEASE:?[/\\]", re.IGNORECASE)


def is_loaded_into(module: Instance, task: str, *, moves: bool) -> bool:
    """Whether an instance of CAB_TASK_MODULES is for a task."""
    for_all = ("alltask", "shared", "install", *(("allmotiontask",) if moves else ()))
    named = module.get("task", "").lower() == task.lower()
    return named or any(module.get(switch, "").lower() == SWITCHED_ON for switch in for_all)


def module_name(module: Instance) -> str:
    """Return the name of the module that an instance loads."""
    return module.get("modname") or Path(module.get("file", "").replace("\\", "/")).stem


def missing_modules(
    wanted: Sequence[Instance], folder: Path
) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """Return the modules of a task that its folder lacks.

    Args:
        wanted: The modules that the configuration loads into the task.
        folder: The task's folder, in the RAPID folder of a backup.

    Returns:
        Modules in HOME of the backup, and names of modules that the backup lacks.
    """
    own = {module.stem.lower() for module in folder.rglob("*") if module.is_file()}
    found: list[Path] = []
    unseen: list[str] = []
    for module in wanted:
        written, name = module.get("file", ""), module_name(module)
        if name.lower() in own or _SYSTEM.match(written):
            continue
        home = _in_home(written, folder.parent.parent)
        if home is None:
            unseen.append(f"{name} (from {written})")
        else:
            found.append(home)
    return tuple(found), tuple(unseen)


def _in_home(written: str, root: Path) -> Path | None:
    if not _HOME.match(written):
        return None
    below = _HOME.sub("", written, count=1).replace("\\", "/")
    file = root / "HOME" / below
    if not file.is_file():
        return None
    return require_inside([file], [root])[0]
