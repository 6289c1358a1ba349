"""Versions of RobotWare that a controller reports to its clients.

Recorded on virtual controllers: 6.16.2027 (6.16.02.00), 7.21.0+229, 8.1.1+614.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from rapidsim.language.robotware import RobotWare
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class ServedVersion:
    """A version with its texts."""

    robotware: RobotWare
    text: str
    """Value of `rwversion`."""
    name: str
    """Value of `rwversionname`, which RobotWare 7 omits."""


_RECORDED: Final = MappingProxyType(
    {
        6: ServedVersion(RobotWare(6, 16), "6.16.2027", "6.16.02.00"),
        7: ServedVersion(RobotWare(7, 21), "7.21.0+229", "7.21.0"),
        8: ServedVersion(RobotWare(8, 1), "8.1.1+614", "8.1.1"),
    }
)


def served_versions(
    station: RobotWare | None, major: int | None = None
) -> Mapping[int, ServedVersion]:
    """Return the version that each generation of Robot Web Services reports.

    Args:
        station: Version of the station or backup; None if it names none.
        major: Version that the user has chosen: 6, 7 or 8; None for that of the station.
    """
    if station is not None and major not in (None, station.major):
        station = None
    chosen = major or (station.major if station is not None else 7)
    return MappingProxyType({1: _version(6, station), 2: _version(max(7, chosen), station)})


def _version(major: int, station: RobotWare | None) -> ServedVersion:
    recorded = _RECORDED.get(major, _RECORDED[8])
    if station is None or station.major != major or station == recorded.robotware:
        return recorded
    name = f"{station.major}.{station.minor:02}.00.00"
    return ServedVersion(station, f"{station.major}.{station.minor}.0", name)
