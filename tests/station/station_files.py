"""Station files of tests."""

from pathlib import Path

from rapidsim.station.read import NO_BACKUP, read_station
from rapidsim.station.station import Station

AXIS = (
    '[[external_axis]]\nname = "T"\naxis = "b"\nkind = "rotational"\n'
    "limits = [-90, 180]\nspeed = 45\n"
)
"""A positioner."""


def station(text: str, folder: Path, backup: Station = NO_BACKUP) -> Station:
    """Read a station file with a text."""
    file = folder / "rapidsim.toml"
    file.write_text(text, encoding="utf-8")
    return read_station(file, backup)
