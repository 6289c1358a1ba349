"""The station and the robot of a job, and what determined them.

A station is looked for here and nowhere else.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rapidsim.files import relative_to_cwd
from rapidsim.jobs.robot_choice import DEFAULT_ROBOT, RobotChoice
from rapidsim.module_files import backups_among, loose_cell_among
from rapidsim.station.station import Station, find_station

if TYPE_CHECKING:
    from rapidsim.motion.robot.robot import Robot


def choose_station(paths: Sequence[str], file: str | None) -> Station:
    """The given station file, else the one next to the program or above it, else the defaults.

    What the file does not say comes from a backup, key by key.
    """
    backup = configured_station(paths)
    found = Path(file) if file is not None else find_station(paths)
    if found is None:
        return backup
    from rapidsim.station.read import read_station

    return read_station(found, backup)


def configured_station(paths: Sequence[str]) -> Station:
    """The station of a backup, or of configuration files beside modules; else the defaults."""
    # Most of what is named has no configuration, and does not pay for importing NumPy here.
    backups = backups_among(paths)
    if backups:
        from rapidsim.station.backup.backup import backup_station

        stations = [(path, backup, backup_station(backup)) for path, backup in backups]
        if len(stations) > 1:
            from rapidsim.jobs.controllers import joined_station

            joined = joined_station(stations)
            if joined is not None:
                return joined
        return stations[0][2]
    cell = loose_cell_among(paths)
    if cell is None:
        return Station()
    from rapidsim.station.backup.standalone_configuration import loose_station

    return loose_station(cell)


def choose_robot(
    robot: Robot | str | None, station: Station, scale: float | None = None
) -> RobotChoice:
    """The given robot, else that of the station file or the backup, else the default."""
    if robot is not None:
        return RobotChoice(robot if isinstance(robot, str) else robot.name, None, scale)
    if station.robot is not None:
        scale = station.robots[0].scale if scale is None else scale
        source = station.robot_source or (station.file and relative_to_cwd(station.file))
        return RobotChoice(station.robot, f"from {source}", scale)
    first = station.robots[0].unknown if station.robots else None
    unknown = f"the catalogue has no {first}; " if first else ""
    return RobotChoice(DEFAULT_ROBOT, f"by default; {unknown}--robot names another", scale)
