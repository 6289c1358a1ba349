"""Station and robot of a job, and the source of each choice.

No other module searches for a station.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rapidsim.files import relative_to_cwd
from rapidsim.jobs.inputs.robot_choice import DEFAULT_ROBOT, RobotChoice
from rapidsim.module_files import backups_among, loose_cell_among
from rapidsim.station.station import Station, find_station

if TYPE_CHECKING:
    from rapidsim.motion.robot.robot import Robot


def choose_station(paths: Sequence[str], file: str | None) -> Station:
    """Return the station: the requested file, the nearest file above the program, or defaults.

    Keys that the file lacks come from a backup.
    """
    backup = configured_station(paths)
    found = Path(file) if file is not None else find_station(paths)
    if found is None:
        return backup
    from rapidsim.station.read import read_station

    return read_station(found, backup)


def configured_station(paths: Sequence[str]) -> Station:
    """Return the station of a backup or of configuration files next to modules; else defaults."""
    # Most paths have no configuration, and an import of NumPy would not pay.
    backups = backups_among(paths)
    if backups:
        from rapidsim.station.backup.backup import backup_station

        stations = [(path, backup, backup_station(backup)) for path, backup in backups]
        if len(stations) > 1:
            from rapidsim.jobs.inputs.controllers import joined_station

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
    """Return the requested robot, else that of the station file or backup, else the default."""
    if robot is not None:
        return RobotChoice(robot if isinstance(robot, str) else robot.name, None, scale)
    if station.robot is not None:
        scale = station.robots[0].scale if scale is None else scale
        source = station.robot_source or (station.file and relative_to_cwd(station.file))
        return RobotChoice(station.robot, f"from {source}", scale)
    first = station.robots[0].unknown if station.robots else None
    unknown = f"the catalogue has no {first}; " if first else ""
    return RobotChoice(DEFAULT_ROBOT, f"by default; {unknown}--robot names another", scale)
