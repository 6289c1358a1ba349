"""Constants of the motion model that are known of an arm, as its `robot.toml` declares them."""

from __future__ import annotations

from collections.abc import Mapping
from math import radians
from typing import Any

from rapidsim.motion.robot.dynamics import Gravity, Torques
from rapidsim.motion.robot.scaled_torques import InertiaShape
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class MeasuredConstants:
    """Constants of the motion model that were measured on an arm."""

    torques: Torques
    filter_time: float
    """Width [s] of the smoothing of the command."""
    fine_dwell: float
    """Time [s] at a stop point from the end of the command to the start of the next."""
    wrist_is_lower_bound: bool
    """Whether the wrist may accelerate more than was seen."""
    factor: float
    """Factor within which the torques are right."""
    cycle_percent: float
    """Percentage within which cycle times near these limits are right."""


@value_class(frozen=True, slots=True)
class PublishedTorques:
    """Constants by published joint torques and the inertia of the links in a drawing."""

    torques: Torques
    gravity: Gravity
    factor: float
    """Factor within which the torques are right."""
    cycle_percent: float
    """Percentage within which cycle times near these limits are right."""


@value_class(frozen=True, slots=True)
class PublishedAccelerations:
    """Axis accelerations by published ones of the TCP."""

    times: tuple[float, ...]
    """Time [s] in which each axis reaches its speed."""
    factor: float
    """Factor within which the accelerations are right."""
    cycle_percent: float
    """Percentage within which cycle times near these limits are right."""


@value_class(frozen=True, slots=True)
class ReferenceCycle:
    """A figure for the picking cycle of an arm, for comparison only."""

    time_s: float
    load_kg: float
    source: str | None
    """None if the figure is from memory."""


@value_class(frozen=True, slots=True)
class ReferenceVolume:
    """A figure for the volume that the wrist centre of an arm reaches, for comparison only."""

    volume_m3: float
    source: str


def reference_volume(table: Mapping[str, Any]) -> ReferenceVolume:
    """Return the figure in the table [wrist_centre_volume] of an arm."""
    return ReferenceVolume(table["m3"], table["source"])


def measured_constants(table: Mapping[str, Any]) -> MeasuredConstants:
    """Return the constants in the table [dynamics] of a measured arm."""
    return MeasuredConstants(
        _torques(table),
        filter_time=table["filter_time_s"],
        fine_dwell=table["fine_dwell_s"],
        wrist_is_lower_bound=table.get("wrist_is_lower_bound", False),
        factor=table["factor"],
        cycle_percent=table["cycle_percent"],
    )


def inertia_shape(table: Mapping[str, Any]) -> InertiaShape:
    """Return the shape in the table [shape] of an arm."""
    return InertiaShape(
        x=table["x"],
        z=table["z"],
        rod_of_point=table["rod_of_point"],
        d_of_c=table["d_of_c"],
        delta=radians(table["delta_deg"]),
    )


def reference_cycle(table: Mapping[str, Any]) -> ReferenceCycle:
    """Return the figure in the table [picking_cycle] of an arm."""
    return ReferenceCycle(table["time_s"], table["load_kg"], table.get("source"))


def published_torques(table: Mapping[str, Any]) -> PublishedTorques:
    """Return the constants in the table [torques] of an arm."""
    return PublishedTorques(
        _torques(table),
        Gravity(table["gravity_lower"], table["gravity_fore"], table["gravity_load_per_m"]),
        factor=table["factor"],
        cycle_percent=table["cycle_percent"],
    )


def published_accelerations(table: Mapping[str, Any]) -> PublishedAccelerations:
    """Return the constants in the table [accelerations] of an arm."""
    return PublishedAccelerations(
        tuple(table["times_s"]), factor=table["factor"], cycle_percent=table["cycle_percent"]
    )


def _torques(table: Mapping[str, Any]) -> Torques:
    w4, w5, w6 = (radians(one) for one in table["wrist_deg_s2"])
    return Torques(
        **{name: table[name] for name in ("i1", "rod", "point", "x", "z", "c", "d", "e", "kappa")},
        delta=radians(table["delta_deg"]),
        n33=table["n33"],
        wrist=(w4, w5, w6),
        wrist_in_zones=(
            (table["wrist_zone_share"], table["wrist_zone_cycles"])
            if "wrist_zone_share" in table
            else None
        ),
    )
