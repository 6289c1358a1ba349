"""Tasks in a configuration: CAB_TASKS in `SYS.cfg`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rapidsim.controller.cell.message_queues import QueueMode, QueueSettings, QueueType
from rapidsim.station.backup.cfg_file import SWITCHED_ON, Configuration, Instance
from rapidsim.station.task_kind import TaskEvent, TaskKind
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class TaskSettings:
    """Settings of one task."""

    name: str
    kind: TaskKind
    """Semistatic if not specified, as on a controller."""
    moves: bool
    entry: str | None
    group: str | None
    """Its mechanical unit group."""
    queue: QueueSettings
    refers_late: bool
    """Whether it is loaded with unresolved references: -BindRef 0."""
    events: tuple[tuple[TaskEvent, str], ...] = ()
    """Event routines, in the order of their calls."""


def configured_tasks(configuration: Configuration) -> Mapping[str, TaskSettings]:
    """Return the tasks by folded name."""
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
            _queue_of(task),
            task.get("bindref") == "0",
            _events_of(name, configuration.get("CAB_EXEC_HOOKS", ())),
        )
    return found


def _events_of(task: str, hooks: Sequence[Instance]) -> tuple[tuple[TaskEvent, str], ...]:
    """Return the event routines of a task; others than those of `TaskEvent` are left out."""
    found = []
    for hook in hooks:
        event, number = hook.get("shelf", "").upper(), hook.get("seqno", "")
        is_own = "alltask" in hook or hook.get("task", "").lower() == task.lower()
        if is_own and event in list(TaskEvent):
            order = int(number) if number.isdecimal() and len(number) < 10 else 0
            found.append((order, TaskEvent(event), hook.get("routine", "")))
    return tuple((event, name) for _, event, name in sorted(found, key=lambda one: one[0]) if name)


def _queue_of(task: Instance) -> QueueSettings:
    """Return the message queue of a task; none by default, as on a controller."""
    kind, mode = task.get("rmqtype", "").lower(), task.get("rmqmode", "").lower()
    size, most = task.get("rmqmaxmsgsize", ""), task.get("rmqmaxnoofmsg", "")
    usual = QueueSettings()
    return QueueSettings(
        QueueType(kind) if kind in [one.value for one in QueueType] else QueueType.NONE,
        QueueMode.SYNCHRONOUS if mode == QueueMode.SYNCHRONOUS else QueueMode.INTERRUPT,
        int(size) if size.isdecimal() else usual.max_bytes,
        int(most) if most.isdecimal() else usual.max_messages,
    )
