"""Configuration files outside a backup: SYS.cfg, EIO.cfg and MOC.cfg to load into a controller.

A program published for a controller often includes its tasks and signals in this form: in a
separate folder, or next to the modules, which then form a cell.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from rapidsim.controller.cell.description import CellIo
from rapidsim.module_files import LooseCell
from rapidsim.station.backup.backup import (
    configured_cell,
    configured_in,
    configured_task,
    with_robot_numbers,
)
from rapidsim.station.backup.cfg_file import Instance, read_configuration, text_in
from rapidsim.station.backup.loaded_modules import is_loaded_into, module_name
from rapidsim.station.backup.robots import backup_robots
from rapidsim.station.backup.signals import backup_io
from rapidsim.station.backup.tasks import TaskSettings, configured_tasks
from rapidsim.station.robot import StationRobot
from rapidsim.station.station import Station
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class ConfiguredTask:
    """A task and the modules loaded into it."""

    settings: TaskSettings
    modules: tuple[str, ...]
    """Folded names."""


@value_class(frozen=True, slots=True)
class StandaloneConfiguration:
    """Content of a folder's configuration files."""

    tasks: tuple[ConfiguredTask, ...]
    io: CellIo
    robots: tuple[StationRobot, ...]


def loose_configuration(folder: Path) -> StandaloneConfiguration:
    """Read the files of a folder."""
    system = read_configuration(text_in(folder, "SYS.cfg"))
    loaded = system.get("CAB_TASK_MODULES", ())
    io, _ = backup_io(read_configuration(text_in(folder, "EIO.cfg")))
    return StandaloneConfiguration(
        tuple(
            ConfiguredTask(settings, _modules_of(settings, loaded))
            for settings in configured_tasks(system).values()
        ),
        io,
        backup_robots(read_configuration(text_in(folder, "MOC.cfg"))),
    )


def loose_station(cell: LooseCell) -> Station:
    """Return the station of modules with configuration files next to them.

    Modules that SYS.cfg does not load belong to the first task that moves; a task without any
    present module is skipped.
    """
    configured = configured_in(cell.root, *cell.below)
    station = configured_cell(configured)
    system = configured.get("SYS", {})
    loaded = system.get("CAB_TASK_MODULES", ())
    named = {task: _modules_of(task, loaded) for task in configured_tasks(system).values()}
    listed = {name for names in named.values() for name in names}
    others = tuple(one for one in cell.modules if one.stem.lower() not in listed)
    first = next((task for task in named if task.moves), None)
    modules = {
        task: tuple(one for one in cell.modules if one.stem.lower() in names)
        + (others if task is first else ())
        for task, names in named.items()
    }
    present = [task for task in named if modules[task]]
    several = len(present) > 1
    tasks = [
        replace(configured_task(one), modules=modules[one] if several else ()) for one in present
    ]
    labels = [robot.label for robot in station.robots]
    absent = (task.name for task in named if not modules[task])
    remarks = (f"SYS.cfg: no module of the task {name} is in the folder" for name in absent)
    return replace(
        station,
        tasks=with_robot_numbers(tasks, system, labels),
        remarks=(*station.remarks, *remarks),
    )


def _modules_of(task: TaskSettings, loaded: Sequence[Instance]) -> tuple[str, ...]:
    wanted = (one for one in loaded if is_loaded_into(one, task.name, moves=task.moves))
    return tuple(dict.fromkeys(module_name(one).lower() for one in wanted))
