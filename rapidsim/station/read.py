"""Read the station file `rapidsim.toml`: robot, motion model, tasks, signals and their drivers.

Every key is checked and all errors are reported at once; unsupported features are errors with a
clear message, never ignored. A file for `--io` contains only the tables of signals.

Each missing key has the value of the controller backup, if there is one.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, cast

from rapidsim.controller.cell.conveyor_scripts import ConveyorScript
from rapidsim.controller.cell.description import CellIo, DescribedFingers
from rapidsim.station.cameras import read_cameras
from rapidsim.station.check import read_check
from rapidsim.station.controller import ClockTable, ControllerTable
from rapidsim.station.declared_tables import read_records, read_table
from rapidsim.station.faults import read_faults
from rapidsim.station.grippers import read_grippers
from rapidsim.station.motion import ConfigurationRule, read_motion
from rapidsim.station.searches import read_searches
from rapidsim.station.signals import read_crosses, read_signals
from rapidsim.station.sockets import read_sockets
from rapidsim.station.station import Station
from rapidsim.station.stimuli import read_stimuli
from rapidsim.station.tasks import read_tasks
from rapidsim.station.toml_reader import Reader, Table, as_toml, read_toml

if TYPE_CHECKING:
    from rapidsim.collisions.geometry import CellGeometry
    from rapidsim.motion.robot.external_axes import ExternalAxis
    from rapidsim.station.robot import StationRobot

_IO_KEYS = (
    "signals",
    "cross",
    "stimulus",
    "fault",
    "socket",
    "camera",
    "conveyor",
    "gripper",
    "smart_gripper",
    "search",
)
NO_BACKUP = Station()
_GEOMETRY_KEYS = ("object", "attach", "source", "sink", "collisions")
TABLES = (
    "controller",
    "robot",
    "external_axis",
    "motion",
    "dynamics",
    "task",
    *_IO_KEYS,
    "clock",
    "check",
    *_GEOMETRY_KEYS,
)
"""Keys of a station file, each a table or a list of tables."""


def read_station(file: Path, backup: Station = NO_BACKUP) -> Station:
    """Read a station file.

    Args:
        file: Path of the file.
        backup: The values of missing keys.

    Raises:
        InputError: If it is missing, not TOML, or contains something unknown, of the wrong type or
            not simulated yet; all such errors at once.
    """
    table = read_toml(file)
    reader = Reader(file)
    reader.note_unknown_keys("", table, TABLES)
    robots, dropped = _robots(reader, table, backup.robots)
    model, configuration, remarks = read_motion(
        reader, reader.table(table, "motion"), reader.table(table, "dynamics")
    )
    external_axes = _external_axes(reader, table, model.acceleration_time, backup.external_axes)
    tasks = read_tasks(reader, table, [robot.label for robot in robots] or [None], backup.tasks)
    io = _io(reader, table, backup.io)
    controller = read_table(reader, table, "controller", ControllerTable)
    names_arm = bool(robots) and (not backup.robots or robots[0].name != backup.robots[0].name)
    station = Station(
        file=file,
        robots=robots,
        external_axes=external_axes,
        model=model,
        nearest_configuration=configuration is ConfigurationRule.NEAREST,
        exact_configuration=configuration is ConfigurationRule.EXACT,
        tasks=tasks,
        io=io,
        robotware=controller.robotware or backup.robotware,
        stubs=controller.stubs,
        starts_at=read_table(reader, table, "clock", ClockTable).start,
        check=read_check(reader, reader.table(table, "check")),
        geometry=_geometry(reader, table),
        configured=backup.configured,
        robot_source=None if names_arm else backup.robot_source,
        other_units=backup.other_units,
        remarks=(*remarks, *backup.remarks, *dropped),
    )
    reader.finish()
    return station


def read_io(source: Path | Table) -> CellIo:
    """Read signals, cross connections, stimuli and the like from a file, or from its tables.

    Files that tables name are in the working directory.

    Raises:
        InputError: See `read_station`.
    """
    if isinstance(source, Path):
        table, reader = read_toml(source), Reader(source)
    else:
        table, reader = cast(Table, as_toml(source)), Reader(Path("io"))
    reader.note_unknown_keys("", table, _IO_KEYS)
    io = _io(reader, table)
    reader.finish()
    return io


# What a station does not describe is not imported: frames need NumPy, and shapes take a while.


def _robots(
    reader: Reader, table: Table, defaults: tuple[StationRobot, ...]
) -> tuple[tuple[StationRobot, ...], tuple[str, ...]]:
    """Return the robots, and remarks on the values of a backup that they do not have."""
    if "robot" not in table:
        return defaults, ()
    from rapidsim.station.robot import dropped_bounds, read_robots  # noqa: PLC0415

    robots = read_robots(reader, table, defaults)
    return robots, tuple(dropped_bounds(robots, defaults))


def _external_axes(
    reader: Reader, table: Table, acceleration_time: float, defaults: tuple[ExternalAxis, ...]
) -> tuple[ExternalAxis, ...]:
    if "external_axis" not in table:
        return tuple(sorted(defaults, key=lambda axis: axis.letter))
    from rapidsim.station.external_axes import read_external_axes  # noqa: PLC0415

    return read_external_axes(reader, table, acceleration_time, defaults)


def _geometry(reader: Reader, table: Table) -> CellGeometry | None:
    if not table.keys() & set(_GEOMETRY_KEYS):
        return None
    from rapidsim.station.objects import read_geometry  # noqa: PLC0415

    return read_geometry(reader, table)


def _io(reader: Reader, table: Table, backup: CellIo = NO_BACKUP.io) -> CellIo:
    return CellIo(
        read_signals(reader, reader.table(table, "signals"), backup.signals),
        read_crosses(reader, table, backup.crosses),
        read_stimuli(reader, table),
        read_faults(reader, table),
        read_sockets(reader, table),
        read_cameras(reader, table),
        read_records(reader, table, "conveyor", ConveyorScript),
        read_grippers(reader, table),
        read_records(reader, table, "smart_gripper", DescribedFingers),
        read_searches(reader, table),
    )
