"""Names that a station declares for its programs."""

from __future__ import annotations

from dataclasses import replace

from rapidsim.analysis.cell_names import CellNames, cell_names
from rapidsim.language.types import SIGNALS
from rapidsim.station.station import Station

_TYPE_OF_KIND = {signal.name.removeprefix("signal"): signal for signal in SIGNALS}


def declared_names(station: Station) -> CellNames:
    """Return the signals, mechanical units and tasks of a station."""
    numbered = (f"ROB_{number}" for number in range(1, len(station.robots) + 1))
    labelled = (robot.label for robot in station.robots if robot.label)
    conveyors = (conveyor.unit for conveyor in station.io.conveyors)
    names = cell_names(
        [(signal.name, _TYPE_OF_KIND[signal.kind]) for signal in station.io.signals],
        (*numbered, *labelled, *station.units, *conveyors),
        [task.name for task in station.tasks] or [station.task],
        [camera.name for camera in station.io.cameras],
        station.io.wired,
    )
    return replace(
        names,
        robotware=station.robotware,
        has_signals=bool(station.io.signals),
        places_parts=bool(station.io.parts),
    )
