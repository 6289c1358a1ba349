"""Configuration files outside a backup: a folder with SYS.cfg, EIO.cfg and MOC.cfg to load.

This is how a program published for a controller comes with its tasks and signals.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rapidsim.controller.cell.description import CellIo
from rapidsim.station.backup.cfg_file import Instance, read_configuration, text_in
from rapidsim.station.backup.loaded_modules import is_loaded_into, module_name
from rapidsim.station.backup.robots import backup_robots
from rapidsim.station.backup.signals import backup_io
from rapidsim.station.backup.tasks import TaskSettings, configured_tasks
from rapidsim.station.robot import StationRobot
from rapidsim.values import dataclass

_FILES = ("sys.cfg", "eio.cfg", "moc.cfg")


@dataclass(frozen=True, slots=True)
class ConfiguredTask:
    """A task and the modules loaded into it."""

    settings: TaskSettings
    modules: tuple[str, ...]
    """Folded names."""


@dataclass(frozen=True, slots=True)
class LooseConfiguration:
    """The content of a folder's configuration files."""

    tasks: tuple[ConfiguredTask, ...]
    io: CellIo
    robots: tuple[StationRobot, ...]


def has_configuration(folder: Path) -> bool:
    """Whether a folder contains configuration files."""
    return folder.is_dir() and any(one.name.lower() in _FILES for one in folder.iterdir())


def loose_configuration(folder: Path) -> LooseConfiguration:
    """Read the files of a folder."""
    system = read_configuration(text_in(folder, "SYS.cfg"))
    loaded = system.get("CAB_TASK_MODULES", ())
    io, _ = backup_io(read_configuration(text_in(folder, "EIO.cfg")))
    return LooseConfiguration(
        tuple(
            ConfiguredTask(settings, _modules_of(settings, loaded))
            for settings in configured_tasks(system).values()
        ),
        io,
        backup_robots(read_configuration(text_in(folder, "MOC.cfg"))),
    )


def _modules_of(task: TaskSettings, loaded: Sequence[Instance]) -> tuple[str, ...]:
    wanted = (one for one in loaded if is_loaded_into(one, task.name, moves=task.moves))
    return tuple(dict.fromkeys(module_name(one).lower() for one in wanted))
