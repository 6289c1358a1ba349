"""Constants of the motion model for one arm: measured, else scaled by its speeds and size."""

from __future__ import annotations

from dataclasses import replace
from math import pow

from rapidsim.motion.kinematics.closed_form.opw_geometry import JOINT_COUNT, OpwGeometry
from rapidsim.motion.model import ACCELERATION_TIME_S, DWELL_S, FILTER_S, ZONE_SHARE
from rapidsim.motion.robot.catalogue import CatalogueEntry, MeasuredConstants
from rapidsim.motion.robot.dynamics import Dynamics, Torques
from rapidsim.motion.robot.scaled_torques import (
    scaled_torques,
    torques_of_version_2,
    wrist_time,
)
from rapidsim.values import value_class

_LARGE = 2.55
"""Reach [m] of the large measured arm."""
_SHORT = 1.2
"""Reach [m] below which cycle times are less certain."""
_MEASURED_FACTOR = 1.05
_SCALED_FACTOR = 1.5


@value_class(frozen=True, slots=True)
class MotionConstants:
    """Constants of the motion model for one arm; the defaults are for arms of unknown size."""

    dynamics: Dynamics | None = None
    """Torque limits of its main axes; None if only axis speeds are known."""
    filter_time: float = FILTER_S
    """Width [s] of the smoothing of the command."""
    fine_dwell: float = DWELL_S
    """Time [s] at a stop point from the end of the command to the start of the next."""
    zone_share: float = ZONE_SHARE
    """Share of torques and accelerations that is used in a narrow zone."""
    basis: str = "assumed"
    """Basis of torques or accelerations, such as `as measured on this arm`."""
    is_measured: bool = False
    """Whether it is a measurement of this arm."""
    factor: float = 2.0
    """Factor within which torques and accelerations are right."""
    cycle_percent: float | None = None
    """Percentage within which cycle times near these limits are right; None if unknown."""

    @property
    def limits_text(self) -> str:
        """Description of torques or accelerations."""
        limits = (
            f"axis acceleration = axis speed / {ACCELERATION_TIME_S:g} s,"
            if self.dynamics is None
            else "torques of axes 1 to 3 and accelerations of the wrist"
        )
        return f"{limits} {self.basis}, {self.band}"

    @property
    def band(self) -> str:
        """Accuracy: `accurate within a factor of 1.5 (cycle times near the limits: 20 %)`."""
        cycles = (
            ""
            if self.cycle_percent is None
            else f" (cycle times near the limits: {self.cycle_percent:g} %)"
        )
        return f"accurate within a factor of {self.factor:g}{cycles}"


def constants_of_version_2(entry: CatalogueEntry) -> MotionConstants:
    """Return the constants that version 2 of the motion model has for an arm of the catalogue."""
    geometry, measured = entry.geometry, entry.measured
    if not isinstance(geometry, OpwGeometry):
        return MotionConstants()
    if measured is not None:
        return MotionConstants(
            Dynamics(measured.torques, geometry),
            measured.filter_time,
            measured.fine_dwell,
            basis="as measured on this arm",
            is_measured=True,
            factor=_MEASURED_FACTOR,
        )
    speeds, reach = _speeds(entry), entry.reach_m
    if entry.maker != "ABB" or reach is None or len(speeds) != JOINT_COUNT:
        return MotionConstants()
    return MotionConstants(
        Dynamics(torques_of_version_2(geometry, speeds, reach), geometry),
        filter_time(reach),
        fine_dwell(reach),
        basis="scaled from measured arms",
        factor=_SCALED_FACTOR,
    )


def constants_of(entry: CatalogueEntry) -> MotionConstants:
    """Return the constants of an arm of the catalogue."""
    reach, measured = entry.reach_m, entry.measured
    if reach is None:
        return MotionConstants()
    times = filter_time(reach), fine_dwell(reach), zone_share(reach)
    if not isinstance(entry.geometry, OpwGeometry):
        return MotionConstants(None, *times)
    if measured is not None:
        return MotionConstants(
            Dynamics(_known_torques(measured, _speeds(entry), reach), entry.geometry),
            measured.filter_time,
            measured.fine_dwell,
            zone_share(reach),
            basis="as measured on this arm",
            is_measured=True,
            factor=measured.factor,
            cycle_percent=measured.cycle_percent,
        )
    speeds = _speeds(entry)
    if entry.maker != "ABB" or len(speeds) != JOINT_COUNT:
        return MotionConstants(None, *times)
    torques = scaled_torques(entry.geometry, speeds, reach, entry.shape)
    of_shape = "" if entry.shape is None else ", in the proportions of its drawing"
    is_certain = reach >= _SHORT and entry.geometry.coupling == 0
    return MotionConstants(
        Dynamics(torques, entry.geometry),
        *times,
        basis=f"scaled from measured arms by axis speeds and reach{of_shape}",
        factor=_SCALED_FACTOR,
        cycle_percent=15.0 if is_certain else 20.0,
    )


def filter_time(reach: float) -> float:
    """Width [s] of the smoothing of an arm by its reach [m], through both measured arms."""
    return 0.068 * pow(reach, 0.35)


def fine_dwell(reach: float) -> float:
    """Time [s] at a stop point by the reach [m], through the large measured arm."""
    return 0.058 * pow(reach, 0.35) + 0.025


def zone_share(reach: float) -> float:
    """Share of torques that is used in a narrow zone, by the reach [m]; assumed.

    It falls as the smoothing rises: corners are limited by the natural period of the arm.
    """
    return min(1.0, ZONE_SHARE * pow(_LARGE / reach, 0.35))


def _known_torques(measured: MeasuredConstants, speeds: tuple[float, ...], reach: float) -> Torques:
    """Return measured torques; a wrist of which only lower bounds are known is scaled."""
    if not measured.wrist_is_lower_bound:
        return measured.torques
    w4, w5, w6 = (speed / wrist_time(reach) for speed in speeds[3:])
    return replace(measured.torques, wrist=(w4, w5, w6))


def _speeds(entry: CatalogueEntry) -> tuple[float, ...]:
    return tuple(speed for speed in entry.max_speeds if speed is not None)
