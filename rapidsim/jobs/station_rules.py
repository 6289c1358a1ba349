"""Rules that hold because of what the station says, in a check and before a run."""

from __future__ import annotations

from rapidsim.analysis.passes.checker import Find
from rapidsim.analysis.rules.names.robotware import find_newer
from rapidsim.station.station import Station


def rules_of_station(station: Station) -> tuple[Find, ...]:
    """What to look for on a controller such as the station's."""
    return () if station.robotware is None else (find_newer(station.robotware),)
