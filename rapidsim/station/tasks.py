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

from rapidsim.controller.cell.message_queues import QueueSettings
from rapidsim.files import did_you_mean
from rapidsim.station.declared_tables import values_of
from rapidsim.station.task_kind import TaskKind
from rapidsim.station.toml_reader import Reader, Table
from rapidsim.values import value_class

DEFAULT_TASK = "T_ROB1"
_KEYS = ("name", "modules", "type", "motion", "robot", "entry", "check_references", "rmq")


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
    is_system: bool = False
    """Whether it is a task of the controller itself, such as of its safety board: no run has it."""


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
    reader: Reader, path: str, task: Table, backup: Mapping[str, StationTask]
) -> StationTask:
    reader.note_unknown_keys(path, task, _KEYS)
    name = reader.text(task, path, "name") or DEFAULT_TASK
    known = backup.get(name.lower(), _NO_TASK)
    modules = reader.texts(task, path, "modules")
    motion = task.get("motion")
    if motion is not None and not isinstance(motion, bool):
        reader.wrong(f"{path}.motion", "true or false is needed")
        motion = None
    robot = reader.text(task, path, "robot")
    if robot is not None and motion is False:
        reader.wrong(f"{path}.robot", "a task with `motion = false` has no robot")
    files = tuple(reader.file.parent / one for one in modules)
    kind = _kind(reader, path, task) if "type" in task else known.kind
    checks = task.get("check_references", not known.refers_late)
    if not isinstance(checks, bool):
        reader.wrong(f"{path}.check_references", "true or false is needed")
    return replace(
        known,
        name=name,
        modules=files if "modules" in task else known.modules,
        kind=kind,
        motion=motion if motion is not None else True if robot else known.motion,
        robot=robot,
        robot_number=None if robot or motion is False else known.robot_number,
        entry=reader.text(task, path, "entry") or known.entry,
        queue=_queue(reader, path, task, known.queue),
        refers_late=checks is False,
    )


def _queue(
    reader: Reader, path: str, task: Table, default: QueueSettings | None
) -> QueueSettings | None:
    """Read the message queue, completed from that of a backup; None without either."""
    if "rmq" not in task:
        return default
    path = f"{path}.rmq"
    found = values_of(reader, QueueSettings, reader.table(task, "rmq", path), path)
    return replace(default or QueueSettings(), **found)


def _kind(reader: Reader, path: str, task: Table) -> TaskKind:
    text = (reader.text(task, path, "type") or TaskKind.NORMAL.value).lower()
    names = [kind.value for kind in TaskKind]
    if text not in names:
        reader.wrong(f"{path}.type", f"`{text}` is not a type", f"known: {', '.join(names)}")
        return TaskKind.NORMAL
    return TaskKind(text)


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
