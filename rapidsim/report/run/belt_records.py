"""Belts of a run as records of JSON."""

from __future__ import annotations

from rapidsim.json_records.declarations import Rounded
from rapidsim.motion.geometry.belts import BeltCourse
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.values import value_class

_MM = 1e3


@value_class(frozen=True, slots=True)
class BeltSpeedRecord:
    """Speed of a belt from a time on."""

    time_s: Rounded
    travel_mm: Rounded
    """Travel of the belt by then, from the start of the run."""
    speed_mm_s: Rounded


@value_class(frozen=True, slots=True)
class BeltRecord:
    """A conveyor of the cell."""

    unit: str
    """Its mechanical unit."""
    travel_mm: Rounded
    """Travel of the belt by the end of the run."""
    speeds: tuple[BeltSpeedRecord, ...]
    """Its speeds, from the start of the run on."""


def belt_records(simulation: Simulation) -> tuple[BeltRecord, ...]:
    """The belts of a run in the order of the station file."""
    return tuple(_belt(belt, simulation.time_s) for belt in simulation.belts)


def _belt(belt: BeltCourse, end_s: float) -> BeltRecord:
    speeds = (
        BeltSpeedRecord(time_s, _MM * travel, _MM * speed) for time_s, travel, speed in belt.speeds
    )
    return BeltRecord(belt.name, _MM * belt.belt_at(end_s), tuple(speeds))
