"""Several controllers as one cell, such as those of a packed station.

Tasks of one cell share persistents and signals by name; those of several controllers do not. So
controllers form a cell only if no name refers to data, signals or units of two of them.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import combinations

from rapidsim.files import InputError
from rapidsim.jobs.inputs.text_identifiers import words_of
from rapidsim.module_files import Backup, packed_station, read_tasks
from rapidsim.station.robot import StationRobot
from rapidsim.station.station import Station
from rapidsim.station.tasks import StationTask
from rapidsim.values import value_class

# Neither LOCAL nor TASK, and no parameter.
_SHARED = re.compile(
    r"^[ \t]*PERS[ \t]+\w+[ \t]+(\w+)[ \t]*(?:\{[ \t]*\d[^}\n]*\}[ \t]*)?(?::=|;)",
    re.MULTILINE | re.IGNORECASE,
)
_MOST_NAMED = 3
_WORLDS = (
    "{} form one cell: their backups do not state where they are relative to each other, so their "
    "world frames are taken as one; programs read no system parameters"
)


@value_class(frozen=True, slots=True)
class _Controller:
    """A controller and the names in its programs."""

    name: str
    station: Station
    words: frozenset[str]
    """Folded words of its modules."""
    persistents: frozenset[str]
    """Folded names of the persistents that its tasks share."""

    @property
    def units(self) -> frozenset[str]:
        """Folded names of its robots and other mechanical units."""
        labels = (robot.label for robot in self.station.robots if robot.label)
        return frozenset(name.lower() for name in (*labels, *self.station.units))

    @property
    def signals(self) -> frozenset[str]:
        """Folded names of its signals."""
        return frozenset(signal.name.lower() for signal in self.station.io.signals)


def joined_station(backups: Sequence[tuple[str, Backup, Station]]) -> Station | None:
    """Return the station of several controllers; None if a backup does not name its tasks.

    Args:
        backups: Path, backup and its station for each controller.

    Raises:
        InputError: If they are no cell, because a name has two meanings.
    """
    paths = [path for path, *_ in backups]
    if any(len(backup.tasks) != len(station.tasks) for _, backup, station in backups):
        _refuse_packed(paths, "a backup among them does not name its tasks")
        return None
    controllers = [_controller(path, backup, station) for path, backup, station in backups]
    for one, other in combinations(controllers, 2):
        why = next(_clashes(one, other), None)
        if why is not None:
            _refuse_packed(paths, why)
            raise InputError(
                f"{' and '.join(paths)} are no single cell: {why}",
                "name one of them; check --each checks all",
            )
    return _joined(controllers)


def _refuse_packed(paths: Sequence[str], reason: str) -> None:
    """Reject the controllers of one packed station.

    Raises:
        InputError: If all paths are in one archive.
    """
    archives = {packed[0] if (packed := packed_station(path)) else None for path in paths}
    file = archives.pop()
    if file is None or archives:
        return
    raise InputError(
        f"{file} holds {len(paths)} controllers; name one: {', '.join(paths)}; check --each checks "
        "all",
        f"they are no single cell: {reason}",
    )


def _controller(path: str, backup: Backup, station: Station) -> _Controller:
    texts = [file.text for task in read_tasks([path]) for file in task.files]
    persistents = (name.lower() for text in texts for name in _SHARED.findall(text))
    words = frozenset[str]().union(*map(words_of, texts))
    return _Controller(backup.root.name, station, words, frozenset(persistents))


def _clashes(one: _Controller, other: _Controller) -> Iterator[str]:
    """Yield reasons why two controllers are no cell."""
    both = f"{one.name} and {other.name} both"
    tasks = ({task.name.lower(): task.name for task in each.station.tasks} for each in (one, other))
    ours, theirs = tasks
    if common := [name for key, name in ours.items() if key in theirs]:
        yield f"{both} have a task {_named(common)}"
    if shared := one.persistents & other.persistents:
        yield (
            f"{both} declare the persistent {_named(sorted(shared))}, which tasks of one cell "
            "share; LOCAL PERS or TASK PERS is not shared"
        )
    mentioned = one.words | other.words
    if signals := one.signals & other.signals & mentioned:
        yield f"the programs of one use the signal {_named(sorted(signals))}, which {both} have"
    if units := one.units & other.units & mentioned:
        yield f"the programs of one use the unit {_named(sorted(units))}, which {both} have"


def _named(names: Sequence[str]) -> str:
    more = len(names) - _MOST_NAMED
    return ", ".join(names[:_MOST_NAMED]) + (f" and {more} more" if more > 0 else "")


def _joined(controllers: Sequence[_Controller]) -> Station:
    """Join stations in order; of equal names that no program uses the first counts."""
    first, *others = (one.station for one in controllers)
    robots: list[StationRobot] = []
    tasks: list[StationTask] = []
    io, labels = first.io, set[str]()
    for station in (first, *others):
        own = _robots_of(station, is_first=station is first)
        offset = len(robots)
        robots += (_relabelled(robot, labels) for robot in own)
        tasks += (
            replace(
                task,
                robot_number=None if task.robot_number is None else task.robot_number + offset,
            )
            for task in station.tasks
        )
        io = station.io.and_also(io) if station is not first else io
    names = ", ".join(one.name for one in controllers)
    versions = {station.robotware for station in (first, *others)}
    remarks = [f"{one.name}: {text}" for one in controllers for text in one.station.remarks]
    return replace(
        first,
        robots=tuple(robots),
        tasks=tuple(tasks),
        io=io,
        robotware=first.robotware if len(versions) == 1 else None,
        configured={},
        other_units=tuple(unit for station in (first, *others) for unit in station.other_units),
        robot_source="the backups' MOC.cfg" if first.robot_source else None,
        remarks=(_WORLDS.format(names), *remarks),
    )


def _robots_of(station: Station, *, is_first: bool) -> Iterable[StationRobot]:
    """Return the robots of a controller with their external axes, one for each task that moves.

    A station stores the external axes of its first robot separately.
    """
    named = [
        replace(robot, external=station.external_axes) if number == 0 and not is_first else robot
        for number, robot in enumerate(station.robots)
    ]
    wanted = max((task.robot_number or 0 for task in station.tasks), default=0) + 1
    return (*named, *(StationRobot() for _ in range(wanted - len(named))))


def _relabelled(robot: StationRobot, labels: set[str]) -> StationRobot:
    """Return a robot, without its label if another robot has it."""
    if robot.label is None:
        return robot
    if robot.label.lower() in labels:
        return replace(robot, label=None)
    labels.add(robot.label.lower())
    return robot
