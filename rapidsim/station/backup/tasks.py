"""What a configuration says of tasks: CAB_TASKS of `SYS.cfg`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from rapidsim.station.backup.cfg_file import SWITCHED_ON, Configuration
from rapidsim.station.task_kind import TaskKind


@dataclass(frozen=True, slots=True)
class TaskSettings:
    """One task."""

    name: str
    kind: TaskKind
    """Semistatic where nothing is said, as on a controller."""
    moves: bool
    entry: str | None
    group: str | None
    """Its mechanical unit group."""


def configured_tasks(configuration: Configuration) -> Mapping[str, TaskSettings]:
    """The tasks by folded name."""
    found: dict[str, TaskSettings] = {}
    for task in configuration.get("CAB_TASKS", ()):
        name, word = task.get("name", ""), task.get("type", "").lower()
        known = word in [one.value for one in TaskKind]
        found[name.lower()] = TaskSettings(
            name,
            TaskKind(word) if known else TaskKind.SEMISTATIC,
            task.get("motiontask", "").lower() == SWITCHED_ON,
            task.get("entry"),
            task.get("usemechanicalunitgroup"),
        )
    return found
