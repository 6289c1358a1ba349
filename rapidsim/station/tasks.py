"""The tables [[task]]: the tasks with their modules and robots.

[[task]]
name = "T_ROB2"
modules = ["rob2.mod"]
robot = "right"            # the `name` of a [[robot]]; else the next robot that no task has
[[task]]
name = "T_BACK"
modules = ["background.mod"]
type = "semistatic"        # or "static"; "normal" by default
motion = false             # moves nothing; the default if no robot remains
entry = "watch"            # the procedure it begins with; "main" by default
check_references = false   # unresolved references are allowed (-BindRef 0)
rmq = { type = "remote", mode = "synchronous", size = 400, messages = 5 }
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

from rapidsim.controller.cell.message_queues import QueueSettings
from rapidsim.files import did_you_mean
from rapidsim.json_records.declarations import noun
from rapidsim.station.declared_tables import ReadBy, values_of
from rapidsim.station.task_kind import TaskEvent, TaskKind
from rapidsim.station.toml_reader import Reader, Table
from rapidsim.values import value_class

DEFAULT_TASK = "T_ROB1"


@value_class(frozen=True, slots=True)
class StationTask:
    """One task."""

    name: str = DEFAULT_TASK
    modules: tuple[Path, ...] = ()
    """Modules, program files or folders; the first task also has those of the command line."""
    kind: TaskKind = TaskKind.NORMAL
    motion: bool | None = None
    """None if not specified."""
    robot: str | None = None
    """Name of its robot; None if the file names none."""
    robot_number: int | None = None
    """Number of its robot in the station, from 0; None if it moves none."""
    entry: str | None = None
    """Entry procedure; None if not specified."""
    unseen: tuple[str, ...] = ()
    """Modules that a backup's configuration loads into it and that the backup lacks."""
    queue: QueueSettings | None = None
    """Message queue of the task; None if it is not described."""
    refers_late: bool = False
    """Whether it is loaded with unresolved references."""
    events: tuple[tuple[TaskEvent, str], ...] = ()
    """Event routines, in the order of their calls."""
    is_system: bool = False
    """Whether it is a task of the controller itself, such as of its safety board: no run has it."""


def _queue(reader: Reader, table: Table, path: str, key: str) -> Mapping[str, Any]:
    path = f"{path}.{key}"
    return values_of(reader, QueueSettings, reader.table(table, key, path), path)


def _events(
    reader: Reader, table: Table, path: str, key: str
) -> tuple[tuple[TaskEvent, str], ...] | None:
    """Return the routines of a table by event."""
    path = f"{path}.{key}"
    routines = reader.table(table, key, path)
    reader.note_unknown_keys(path, routines, list(TaskEvent))
    named = ((event, reader.text(routines, path, event)) for event in TaskEvent)
    return tuple((event, name) for event, name in named if name) or None


@value_class(frozen=True, slots=True)
class TaskTable:
    """A table [[task]]."""

    name: str = DEFAULT_TASK
    """Its name."""
    modules: tuple[str, ...] = ()
    """Modules, program files or folders; the first task also has those of the command line."""
    type: Annotated[TaskKind, noun("a type")] = TaskKind.NORMAL
    """Whether a run waits for its end; others run in the background and repeat main."""
    motion: bool | None = None
    """Whether it moves a robot; None for a normal task if a robot remains."""
    robot: str | None = None
    """The `name` of a [[robot]]; None for the next robot that no task has."""
    entry: str | None = None
    """The procedure it begins with; None for `main`."""
    check_references: bool | None = None
    """Whether unresolved references are errors, as without `-BindRef 0`; None for true."""
    events: Annotated[tuple[tuple[TaskEvent, str], ...], ReadBy(_events)] = ()
    """Routines that a served controller calls: `{ START = "open", STOP = "lampOff" }`."""
    rmq: Annotated[Mapping[str, Any] | None, ReadBy(_queue)] = None
    """Its message queue, by the fields of `QueueSettings`; None if it is not described."""


_NO_TASK = StationTask()


def read_tasks(
    reader: Reader,
    station: Table,
    robots: Sequence[str | None],
    defaults: Sequence[StationTask] = (),
) -> tuple[StationTask, ...]:
    """Read the tables; errors are collected in the reader.

    Args:
        reader: Reads the file.
        station: The top-level table.
        robots: The names of the robots; None for one without a name.
        defaults: The tasks of a backup: they are first, in their order, and a key that a table of
            their name lacks has their value.
    """
    backup = {task.name.lower(): task for task in defaults}
    tasks = [
        _read_task(reader, path, task, backup) for path, task in reader.tables(station, "task")
    ]
    seen: set[str] = set()
    for number, task in enumerate(tasks, start=1):
        if task.name.lower() in seen:
            reader.wrong(f"task {number}.name", f"there are two tasks {task.name}")
        seen.add(task.name.lower())
    of_file = {task.name.lower(): task for task in tasks}
    whole = [of_file.pop(name, task) for name, task in backup.items()]
    return _with_robots(reader, [*whole, *of_file.values()], robots)


def _read_task(
    reader: Reader, path: str, table: Table, backup: Mapping[str, StationTask]
) -> StationTask:
    task = TaskTable(**values_of(reader, TaskTable, table, path))
    if task.robot is not None and task.motion is False:
        reader.wrong(f"{path}.robot", "a task with `motion = false` has no robot")
    known = backup.get(task.name.lower(), _NO_TASK)
    motion = True if task.robot and task.motion is None else task.motion
    files = tuple(reader.file.parent / one for one in task.modules)
    queue = known.queue
    if task.rmq is not None:
        queue = replace(queue or QueueSettings(), **task.rmq)
    return replace(
        known,
        name=task.name,
        modules=files if "modules" in table else known.modules,
        kind=task.type if "type" in table else known.kind,
        motion=known.motion if motion is None else motion,
        robot=task.robot,
        robot_number=None if task.robot or motion is False else known.robot_number,
        entry=task.entry or known.entry,
        queue=queue,
        events=task.events or known.events,
        refers_late=known.refers_late
        if task.check_references is None
        else not task.check_references,
    )


def _with_robots(
    reader: Reader, tasks: Sequence[StationTask], robots: Sequence[str | None]
) -> tuple[StationTask, ...]:
    """Assign tasks the robots they name, then the remaining robots in order."""
    taken: dict[int, str] = {}
    numbers: dict[str, int] = {}
    for task in tasks:
        number = _named_robot(reader, task, robots, taken)
        if number is not None:
            taken[number], numbers[task.name] = task.name, number
    for task in tasks:
        if task.robot_number is not None:
            taken.setdefault(task.robot_number, task.name)
            numbers[task.name] = task.robot_number
    for task in tasks:
        if task.name in numbers or not _takes_any_robot(task):
            continue
        free = next((number for number in range(len(robots)) if number not in taken), None)
        if free is not None:
            taken[free], numbers[task.name] = task.name, free
        elif task.motion:
            reader.wrong(f"task {task.name}.motion", "no robot is left for it; add a [[robot]]")
    return tuple(replace(task, robot_number=numbers.get(task.name)) for task in tasks)


def _named_robot(
    reader: Reader, task: StationTask, robots: Sequence[str | None], used: Mapping[int, str]
) -> int | None:
    """Number of the robot that a task names; None if it names no robot that is free."""
    if task.robot is None:
        return None
    names = [name.lower() if name else None for name in robots]
    if task.robot.lower() not in names:
        known = [name for name in robots if name]
        help = did_you_mean(task.robot, known) or f"robots: {', '.join(known) or 'none'}"
        reader.wrong(f"task {task.name}.robot", f"there is no [[robot]] `{task.robot}`", help)
        return None
    number = names.index(task.robot.lower())
    if number in used:
        reader.wrong(f"task {task.name}.robot", f"{used[number]} moves that robot")
        return None
    return number


def _takes_any_robot(task: StationTask) -> bool:
    """Whether a task without a named robot gets one of the remaining robots."""
    if task.robot is None and task.motion is None:
        return task.kind is TaskKind.NORMAL
    return task.robot is None and task.motion is True
