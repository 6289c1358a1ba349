"""What a station declares, as names that its programs may use."""

from __future__ import annotations

from rapidsim.analysis.cell_names import CellNames, cell_names
from rapidsim.language.types import SIGNALS
from rapidsim.station.station import Station

_TYPE_OF_KIND = {signal.name.removeprefix("signal"): signal for signal in SIGNALS}


def declared_names(station: Station) -> CellNames:
    """The signals, mechanical units and tasks of a station."""
    numbered = (f"ROB_{number}" for number in range(1, len(station.robots) + 1))
    labelled = (robot.label for robot in station.robots if robot.label)
    return cell_names(
        [(signal.name, _TYPE_OF_KIND[signal.kind]) for signal in station.io.signals],
        (*numbered, *labelled, *station.units),
        [task.name for task in station.tasks] or [station.task],
        station.io.wired,
    )
