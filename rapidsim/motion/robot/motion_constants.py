"""Constants of the motion model for one arm: measured, else scaled by its speeds and size."""

from __future__ import annotations

from dataclasses import replace
from math import pow

from rapidsim.motion.kinematics.closed_form.opw_geometry import JOINT_COUNT, OpwGeometry
from rapidsim.motion.kinematics.closed_form.palletizer import PalletizerGeometry
from rapidsim.motion.kinematics.closed_form.scara import ScaraGeometry
from rapidsim.motion.kinematics.numerical.revolute_chain import AxisRowGeometry
from rapidsim.motion.model import ACCELERATION_TIME_S, DWELL_S, FILTER_S, ZONE_SHARE
from rapidsim.motion.robot.catalogue import CatalogueEntry
from rapidsim.motion.robot.dynamics import Dynamics, ElbowDynamics, Torques
from rapidsim.motion.robot.known_constants import MeasuredConstants
from rapidsim.motion.robot.scaled_torques import (
    LARGE,
    LEAST_WRIST_S,
    scaled_torques,
    torques_of_version_2,
    wrist_time,
)
from rapidsim.motion.robot.scara_dynamics import ScaraDynamics, links_by_lengths
from rapidsim.values import value_class

_SHORT = 1.2
"""Reach [m] below which cycle times are less certain."""
_PALLETIZER_S = 0.12
"""Time [s] in which axes of palletizers reach their speed; assumed."""
_MEASURED_FACTOR = 1.05
_SCALED_FACTOR = 1.5


@value_class(frozen=True, slots=True)
class MotionConstants:
    """Constants of the motion model for one arm; the defaults are for arms of unknown size."""

    dynamics: Dynamics | None = None
    """Torque limits of its main axes; None if only axis speeds are known."""
    acceleration_times: tuple[float, ...] | None = None
    """Time [s] in which each axis reaches its speed, without torques; None if unknown."""
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
        match self.dynamics:
            case None:
                limits = f"axis acceleration = axis speed / {self._times_text} s,"
            case ScaraDynamics():
                limits = "torques of axes 1 and 2 and accelerations of axes 3 and 4"
            case _:
                limits = "torques of axes 1 to 3 and accelerations of the wrist"
        return f"{limits} {self.basis}, {self.band}"

    @property
    def _times_text(self) -> str:
        """Acceleration times [s]: one, or one per axis if they differ."""
        times = self.acceleration_times or (ACCELERATION_TIME_S,)
        return ", ".join(f"{one:g}" for one in (times if len(set(times)) > 1 else times[:1]))

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
            ElbowDynamics(measured.torques, geometry),
            filter_time=measured.filter_time,
            fine_dwell=measured.fine_dwell,
            basis="as measured on this arm",
            is_measured=True,
            factor=_MEASURED_FACTOR,
        )
    speeds, reach = _speeds(entry), entry.reach_m
    if entry.maker != "ABB" or reach is None or len(speeds) != JOINT_COUNT:
        return MotionConstants()
    return MotionConstants(
        ElbowDynamics(torques_of_version_2(geometry, speeds, reach), geometry),
        filter_time=filter_time(reach),
        fine_dwell=fine_dwell(reach),
        basis="scaled from measured arms",
        factor=_SCALED_FACTOR,
    )


def constants_of(entry: CatalogueEntry, *, are_speeds_own: bool = True) -> MotionConstants:
    """Return the constants of an arm of the catalogue, `are_speeds_own` unless of another arm."""
    reach = entry.reach_m
    if reach is None:
        return MotionConstants()
    unknown = MotionConstants(
        filter_time=filter_time(reach), fine_dwell=fine_dwell(reach), zone_share=zone_share(reach)
    )
    match entry.geometry:
        case OpwGeometry() as geometry:
            return _of_elbow(entry, geometry, reach, unknown)
        case ScaraGeometry() as geometry:
            return _of_scara(entry, geometry, unknown, are_speeds_own=are_speeds_own)
        case PalletizerGeometry():
            times = (_PALLETIZER_S,) * len(entry.limits)
            return replace(unknown, acceleration_times=times, cycle_percent=25.0)
        case AxisRowGeometry() as geometry:
            return _of_axis_row(entry, geometry, unknown)
        case _:
            return unknown


def _of_elbow(
    entry: CatalogueEntry, geometry: OpwGeometry, reach: float, unknown: MotionConstants
) -> MotionConstants:
    """Return the constants of an arm with a spherical wrist: measured, or scaled."""
    measured, speeds = entry.measured, _speeds(entry)
    if measured is not None:
        return MotionConstants(
            ElbowDynamics(_known_torques(measured, speeds, reach), geometry),
            filter_time=measured.filter_time,
            fine_dwell=measured.fine_dwell,
            zone_share=unknown.zone_share,
            basis="as measured on this arm",
            is_measured=True,
            factor=measured.factor,
            cycle_percent=measured.cycle_percent,
        )
    if entry.maker != "ABB" or len(speeds) != JOINT_COUNT:
        return unknown
    of_shape = "" if entry.shape is None else ", in the proportions of its drawing"
    is_certain = reach >= _SHORT and geometry.coupling == 0
    return replace(
        unknown,
        dynamics=ElbowDynamics(scaled_torques(geometry, speeds, reach, entry.shape), geometry),
        basis=f"scaled from measured arms by axis speeds and reach{of_shape}",
        factor=_SCALED_FACTOR,
        cycle_percent=15.0 if is_certain else 20.0,
    )


def _of_scara(
    entry: CatalogueEntry,
    geometry: ScaraGeometry,
    unknown: MotionConstants,
    *,
    are_speeds_own: bool,
) -> MotionConstants:
    """Return the constants of a SCARA: masses by its lengths, torques by a picking cycle."""
    speeds = _speeds(entry)
    if entry.maker != "ABB" or entry.payload_kg is None or len(speeds) != len(entry.limits):
        return unknown
    turn = speeds[3] / LEAST_WRIST_S
    return replace(
        unknown,
        dynamics=ScaraDynamics(links_by_lengths(geometry), geometry, entry.payload_kg, turn),
        basis="fitted to the published picking cycle of an IRB 910SC-3/0.65",
        factor=1.4,
        cycle_percent=15.0 if are_speeds_own else 25.0,
    )


def _of_axis_row(
    entry: CatalogueEntry, geometry: AxisRowGeometry, unknown: MotionConstants
) -> MotionConstants:
    """Return the constants of an arm with an offset wrist or seven axes, if some are published."""
    if entry.torques is not None:
        known = entry.torques
        return replace(
            unknown,
            dynamics=ElbowDynamics(known.torques, _lengths_of(geometry), known.gravity),
            basis="by published joint torques and the inertia in drawings",
            factor=known.factor,
            cycle_percent=known.cycle_percent,
        )
    if entry.accelerations is not None:
        return replace(
            unknown,
            acceleration_times=entry.accelerations.times,
            basis="by the published acceleration of the TCP",
            factor=entry.accelerations.factor,
            cycle_percent=entry.accelerations.cycle_percent,
        )
    return unknown


def _lengths_of(geometry: AxisRowGeometry) -> OpwGeometry:
    """Return the lengths of an arm with axes along z, y and y, up to the axis after the forearm."""
    (_, second, third, _, fifth, *_), flange = geometry.points, geometry.flange_point
    return OpwGeometry(
        a1=second[0],
        a2=third[2] - fifth[2],
        b=0.0,
        c1=second[2],
        c2=third[2] - second[2],
        c3=fifth[0] - third[0],
        c4=flange[0] - fifth[0],
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
    return min(1.0, ZONE_SHARE * pow(LARGE / reach, 0.35))


def _known_torques(measured: MeasuredConstants, speeds: tuple[float, ...], reach: float) -> Torques:
    """Return measured torques; a wrist of which only lower bounds are known is scaled."""
    if not measured.wrist_is_lower_bound:
        return measured.torques
    w4, w5, w6 = (speed / wrist_time(reach) for speed in speeds[3:])
    return replace(measured.torques, wrist=(w4, w5, w6))


def _speeds(entry: CatalogueEntry) -> tuple[float, ...]:
    return tuple(speed for speed in entry.max_speeds if speed is not None)
