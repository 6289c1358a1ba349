"""What a controller backup says: its tasks, robots and signals.

`BACKINFO/backinfo.txt` names the task of each folder `RAPID/TASKn`; `SYSPAR/SYS.cfg` has the type
of each task and `-MotionTask` for those that move. A task without a type is semistatic there. The
RobotWare stands in `backinfo.txt`, too.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

from rapidsim.language.equipment import Configured
from rapidsim.language.robotware import RobotWare, read_robotware
from rapidsim.station.backup.cfg_file import SWITCHED_ON, read_configuration, text_in
from rapidsim.station.backup.robots import backup_robots
from rapidsim.station.backup.signals import backup_io
from rapidsim.station.station import Station
from rapidsim.station.task_kind import TaskKind
from rapidsim.station.tasks import StationTask

_BOUNDS = ("upper_joint_bound", "lower_joint_bound")
_DOMAINS = ("EIO", "MMC", "MOC", "PROC", "SIO", "SYS")
_ROBOTWARE = re.compile(r"RobotWare(?: Version)?:?[\s_]*(\d+\.\d+)", re.IGNORECASE)
_FOLDER = re.compile(r"^>>(TASK\d+):\s*\(\s*([^,)\s]+)", re.MULTILINE | re.IGNORECASE)


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
        configured=_configured_in(root),
        robotware=_robotware(root),
        remarks=(*remarks, *_not_read(root, len(robots))),
    )


def _configured_in(root: Path) -> Configured:
    """What the files of SYSPAR say, by domain."""
    texts = ((domain, text_in(root, "SYSPAR", f"{domain}.cfg")) for domain in _DOMAINS)
    return MappingProxyType({domain: read_configuration(text) for domain, text in texts if text})


def _robotware(root: Path) -> RobotWare | None:
    """The version that `backinfo.txt` names; None where it does not."""
    named = _ROBOTWARE.search(text_in(root, "BACKINFO", "backinfo.txt"))
    return None if named is None else read_robotware(named[1])


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
    names = {
        folder.upper(): name
        for folder, name in _FOLDER.findall(text_in(root, "BACKINFO", "backinfo.txt"))
    }
    if any(folder.name.upper() not in names for folder in folders):
        return ()
    configured = _configured(text_in(root, "SYSPAR", "SYS.cfg"))
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
    found: dict[str, tuple[TaskKind, bool | None]] = {}
    for task in read_configuration(text).get("CAB_TASKS", ()):
        word = task.get("type", "").lower()
        known = word in [one.value for one in TaskKind]
        found[task.get("name", "").lower()] = (
            TaskKind(word) if known else TaskKind.SEMISTATIC,
            task.get("motiontask", "").lower() == SWITCHED_ON,
        )
    return found
