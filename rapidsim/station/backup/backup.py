"""What a controller backup says: its tasks, robots and signals.

`BACKINFO/backinfo.txt` names the task of each folder `RAPID/TASKn`; `SYSPAR/SYS.cfg` has the type
of each task and `-MotionTask` for those that move. A task without a type is semistatic there.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from rapidsim.backinfo import listed_tasks
from rapidsim.station.backup.cfg_file import (
    SWITCHED_ON,
    Configuration,
    read_configuration,
    text_in,
)
from rapidsim.station.backup.loaded_modules import is_loaded_into, missing_modules
from rapidsim.station.backup.robots import backup_robots
from rapidsim.station.backup.signals import backup_io
from rapidsim.station.station import Station
from rapidsim.station.task_kind import TaskKind
from rapidsim.station.tasks import StationTask

_BOUNDS = ("upper_joint_bound", "lower_joint_bound")


def backup_station(folders: Sequence[Path]) -> Station:
    """What a backup says.

    Args:
        folders: Its task folders, one or more; see `rapidsim.files.backup_folders`.
    """
    root = folders[0].parent.parent
    robots, unknown = backup_robots(root)
    io, remarks = backup_io(root)
    return Station(
        robots=robots,
        robot_source="the backup's MOC.cfg" if robots else None,
        unknown_robots=unknown,
        tasks=_tasks_of(root, folders),
        io=io,
        remarks=(*remarks, *_not_read(root, len(robots))),
    )


def _not_read(root: Path, robots: int) -> Iterator[str]:
    """What the configuration says of robots and is left out, a remark each."""
    arms = read_configuration(text_in(root, "SYSPAR", "MOC.cfg")).get("ARM", ())
    if any(bound in arm for arm in arms for bound in _BOUNDS):
        yield (
            "the joint bounds in the backup's MOC.cfg are not read: arms have the limits of the "
            "catalogue"
        )
    groups = read_configuration(text_in(root, "SYSPAR", "SYS.cfg")).get("MECHANICAL_UNIT_GROUP", ())
    if groups and robots > 1:
        yield (
            "the mechanical unit groups in the backup's SYS.cfg are not read: tasks that move get "
            "the robots in the order of MOC.cfg"
        )


def _tasks_of(root: Path, folders: Sequence[Path]) -> tuple[StationTask, ...]:
    """In the order of the folders; none where the backup does not say what its folders are."""
    listed = listed_tasks(text_in(root, "BACKINFO", "backinfo.txt"))
    if any(f.name.upper().startswith("TASK") and f.name.lower() not in listed for f in folders):
        return ()
    configuration = read_configuration(text_in(root, "SYSPAR", "SYS.cfg"))
    configured = _configured(configuration)
    loaded = configuration.get("CAB_TASK_MODULES", ())
    tasks: list[StationTask] = []
    robots = 0
    for folder in folders:
        known = listed.get(folder.name.lower())
        name = folder.name if known is None else known.name
        settings = configured.get(name.lower())
        # Without a configuration the task that is first is the one that moves.
        moves = not tasks and not configured if settings is None else settings.moves
        wanted = [one for one in loaded if is_loaded_into(one, name, moves=moves)]
        modules, unseen = missing_modules(wanted, folder)
        number = robots if moves else None
        tasks.append(
            StationTask(
                name,
                modules,
                TaskKind.NORMAL if settings is None else settings.kind,
                moves,
                robot_number=number,
                entry=None if settings is None else settings.entry,
                unseen=unseen,
                # The safety controller has its task, which a configuration does not name.
                is_system=bool(configured) and settings is None,
            )
        )
        robots += moves
    return tuple(tasks)


@dataclass(frozen=True, slots=True)
class _Settings:
    """What a configuration says of a task."""

    kind: TaskKind
    moves: bool
    entry: str | None


def _configured(configuration: Configuration) -> Mapping[str, _Settings]:
    """The tasks by folded name."""
    found: dict[str, _Settings] = {}
    for task in configuration.get("CAB_TASKS", ()):
        word = task.get("type", "").lower()
        known = word in [one.value for one in TaskKind]
        found[task.get("name", "").lower()] = _Settings(
            TaskKind(word) if known else TaskKind.SEMISTATIC,
            task.get("motiontask", "").lower() == SWITCHED_ON,
            task.get("entry"),
        )
    return found
