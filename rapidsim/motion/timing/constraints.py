"""Limits of motion along a path, as rows of numbers: the solver's only information on an arm.

With v = ds/dt and u = d2s/dt2, a speed row requires |rate| v <= 1, an acceleration row |slope u +
bend v2| <= 1. Each row is divided by its limit, so the solver treats rows of axes, of the TCP and
of other quantities alike. A new kind of limit is a new entry in `_SPEEDS` or
`_ACCELERATIONS`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from enum import Enum
from types import MappingProxyType

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.path.path import Path
from rapidsim.motion.robot.external_axes import Axes
from rapidsim.motion.timing.axis_limits import Limits
from rapidsim.motion.timing.discretisation import GridPoints
from rapidsim.values import value_class

Paces = Mapping[int, float]
"""Path speeds [m/s] that produce the programmed times of segments, by index of the segment."""
_NARROW, _GROWTH = 0.010, 3.5
"""Zone radius [m] above which a larger share of the limits is used; increase [1/m]: 79 % at z50."""
_MOST_OF_ZONE = 0.85
_NO_BEND = 1e-12
"""[s2/m2]"""
NO_PACES: Paces = MappingProxyType({})


class Quantity(Enum):
    """A quantity that has a limit."""

    AXIS_SPEED = "axis speed"
    AXIS_ACCELERATION = "axis acceleration"
    TORQUE = "torque"
    TCP_SPEED = "TCP speed"
    REORIENTATION_SPEED = "reorientation speed"
    EXTERNAL_AXIS_SPEED = "programmed speed of external axes"
    TCP_ACCELERATION = "PathAccLim"
    WORLD_ACCELERATION = "WorldAccLim"
    CYCLE = "interpolation cycle in a zone"
    DURATION = "programmed time"
    CORNER = "corner"
    """A slow zone nearby, past which the smoothed motion would be too fast."""
    RAMP = "AccSet's ramp"
    STOP = "stop on the path"
    NOTHING = "nothing"
    """The segment has no length, or is before the start of the timing."""


@value_class(frozen=True, slots=True)
class Limiter:
    """A limit that was reached."""

    quantity: Quantity
    axis: int | None = None
    """Axis, counted from 1; None if the limit is not of a single axis."""
    robot: int | None = None
    """Robot whose programmed speed or time it is, if several share a path; counted from 0."""

    @property
    def is_programmed(self) -> bool:
        """Whether it is a programmed speed of the TCP or a programmed time."""
        return self.quantity in _OF_PACE

    @property
    def is_acceleration(self) -> bool:
        """Whether it is a limit of an acceleration or a torque."""
        return self.quantity in _OF_ACCELERATION

    def __str__(self) -> str:
        """Return a description such as `acceleration of axis 2`."""
        return self._of(f"axis {self.axis}")

    def text(self, axes: Axes) -> str:
        """Return a description for a robot, such as `speed of axis eax_a of TRACK`."""
        if self.axis is None or self.axis > len(axes.lower):
            return str(self)
        return self._of(axes.name(self.axis - 1))

    def _of(self, axis: str) -> str:
        match self.quantity:
            case Quantity.AXIS_SPEED:
                return f"speed of {axis}"
            case Quantity.AXIS_ACCELERATION:
                return f"acceleration of {axis}"
            case Quantity.TORQUE:
                return f"torque of {axis}"
            case _:
                return str(self.quantity.value)


@value_class(frozen=True, slots=True, eq=False)
class SpeedRows:
    """Limits of the path speed."""

    limiters: tuple[Limiter, ...]
    """One per row."""
    rate: Array
    """Shape (k, rows) [s/m]: share of the limit that a path speed of 1 m/s uses, not negative; 0
    for no limit."""
    of_command: int = 0
    """Number of last rows for the command alone: the smoothed motion may exceed these."""

    @property
    def largest(self) -> Array:
        """Rate (k,) of the motion's tightest row; by columns, because rows are short."""
        largest = self.rate[:, 0].copy()
        for column in range(1, self.rate.shape[1] - self.of_command):
            np.maximum(largest, self.rate[:, column], out=largest)
        return largest


@value_class(frozen=True, slots=True, eq=False)
class AccelerationRows:
    """Limits of the path acceleration."""

    limiters: tuple[Limiter, ...]
    """One per row."""
    slope: Array
    """Shape (k, rows) [s2/m]: signed share of the limit that a path acceleration of 1 m/s2 uses; 0
    for no limit."""
    bend: Array
    """Shape (k, rows) [s2/m2]: signed share that a path speed of 1 m/s uses; 0 for no limit."""

    @property
    def largest_bend(self) -> Array:
        """Largest magnitude (k,) of bend."""
        largest = np.abs(self.bend[:, 0])
        for column in range(1, self.bend.shape[1]):
            np.maximum(largest, np.abs(self.bend[:, column]), out=largest)
        return largest


def speed_rows(path: Path, places: GridPoints, limits: Limits, paces: Paces) -> SpeedRows:
    """Return all limits of the path speed.

    Args:
        path: The geometry.
        places: The points to evaluate.
        limits: Axis limits.
        paces: Maximum path speeds [m/s] of segments with a programmed time, by index; they
            replace the programmed speeds there.
    """
    found = [_programmed_speeds(path, places, limits, paces)]
    found += [rows for kind in _SPEEDS if (rows := kind(path, places, limits)) is not None]
    return SpeedRows(
        tuple(limiter for rows in found for limiter in rows.limiters),
        np.concatenate([rows.rate for rows in found], axis=-1),
        of_command=len(found[-1].limiters) if found[-1].of_command else 0,
    )


def acceleration_rows(path: Path, places: GridPoints, limits: Limits) -> AccelerationRows:
    """Return all limits of the path acceleration."""
    found = [rows for kind in _ACCELERATIONS if (rows := kind(path, places, limits)) is not None]
    return AccelerationRows(
        tuple(limiter for rows in found for limiter in rows.limiters),
        np.concatenate([rows.slope for rows in found], axis=-1),
        np.concatenate([rows.bend for rows in found], axis=-1),
    )


def _axis_speeds(path: Path, places: GridPoints, limits: Limits) -> SpeedRows:
    del path
    rate = np.abs(places.rates.first) / limits.max_speed
    return SpeedRows(_of_axes(Quantity.AXIS_SPEED, rate), rate)


def _programmed_speeds(path: Path, places: GridPoints, limits: Limits, paces: Paces) -> SpeedRows:
    """Return rows of the four programmed speeds, or of the pace of a programmed time.

    Where the largest speed of an external axis replaces the programmed one, its own row counts.
    """
    segment = path.segment_of(places.piece)
    paced, timed = np.zeros(len(path.segments), dtype=np.bool_), np.zeros(len(path.segments))
    if paces:
        positions = list(paces)
        paced[positions], timed[positions] = True, 1.0 / np.array(list(paces.values()))
    tcp = np.where(paced, 0.0, 1.0 / path.programmed.tcp)
    turn = np.where(paced, 0.0, 1.0 / path.programmed.reorientation)
    rate = np.empty((len(segment), len(_PROGRAMMED)))
    rate[:, 0] = places.rates.tcp_rate * tcp[segment]
    rate[:, 1] = places.rates.turn_rate * turn[segment]
    rate[:, 2] = timed[segment]
    joint_count = path.kinematics.joint_count
    if path.axis_count == joint_count:
        return SpeedRows(_PROGRAMMED, rate)
    allowed = path.programmed.external
    own = allowed >= limits.max_speed[joint_count : joint_count + allowed.shape[1]]
    share = np.where(paced[:, None] | own, 0.0, 1.0 / allowed)[segment]
    external = np.abs(places.rates.first[:, joint_count:]) * share
    limiters = _PROGRAMMED + (Limiter(Quantity.EXTERNAL_AXIS_SPEED),) * external.shape[1]
    return SpeedRows(limiters, np.concatenate([rate, external], axis=-1))


def _zone_speeds(path: Path, places: GridPoints, limits: Limits) -> SpeedRows | None:
    """The command takes at least one interpolation cycle through a zone."""
    del limits
    if np.isinf(path.zone_speed).all():
        return None
    rate = (1.0 / path.zone_speed)[places.piece][:, None]
    return SpeedRows((Limiter(Quantity.CYCLE),), rate, of_command=1)


def axis_rows(path: Path, places: GridPoints, limits: Limits) -> AccelerationRows:
    """Return the limits of axis accelerations, or of torques where these are known.

    A load may raise the limits in some directions, because it also adds to the coupling of axes 2
    and 3; that has not been observed, so the limits without it apply as well.
    """
    share = path.acceleration_share[places.piece][:, None]
    allowed = limits.max_acceleration * share
    slope, bend = places.rates.first / allowed, places.rates.second / allowed
    limiters = list(_of_axes(Quantity.AXIS_ACCELERATION, slope))
    load = path.programmed.load[path.segment_of(places.piece)]
    more: list[tuple[Array, Array]] = []
    for arm in limits.arms:
        own_slope, own_bend = arm.rows(places.rates, 0.0 * load)
        slope[:, arm.axes], bend[:, arm.axes] = own_slope / share, own_bend / share
        torques = [
            Limiter(
                Quantity.TORQUE if axis <= arm.dynamics.torque_axes else Quantity.AXIS_ACCELERATION,
                arm.first_axis + axis,
            )
            for axis in (1, 2, 3)
        ]
        limiters[arm.axes] = torques
        if load.any():
            of_load = arm.rows(places.rates, load)
            more.append((of_load[0] / share, of_load[1] / share))
            limiters += torques
    if more:
        slope = np.concatenate([slope, *(one for one, _ in more)], axis=1)
        bend = np.concatenate([bend, *(one for _, one in more)], axis=1)
    if limits.zone_share.min() < 1.0:
        slope, bend = _in_zones(path, places, limits, limiters, slope, bend)
    return AccelerationRows(tuple(limiters), slope, bend)


def _in_zones(
    path: Path,
    places: GridPoints,
    limits: Limits,
    limiters: Sequence[Limiter],
    slope: Array,
    bend: Array,
) -> tuple[Array, Array]:
    """Return slopes and bends (k, rows) of axes, scaled for the reduced limits in zones."""
    own = limits.zone_share
    # Robots that share a path may use different shares; one robot uses one.
    share = own[:1] if own.min() == own.max() else own[[(one.axis or 1) - 1 for one in limiters]]
    taken = _more_in_zones(path, places, bend, share, 1.0, path.model.zone_cycles)
    slopes, bends = slope * taken, bend * taken
    for arm in limits.arms:
        known, wrist = arm.dynamics.wrist_in_zones, arm.wrist
        if known is not None:
            taken = _more_in_zones(path, places, bend[:, wrist], own[wrist][:1], *known)
            slopes[:, wrist], bends[:, wrist] = slope[:, wrist] * taken, bend[:, wrist] * taken
    return slopes, bends


def _more_in_zones(
    path: Path, places: GridPoints, bend: Array, narrow: Array, part: float, cycles: float
) -> Array:
    """Return factors on the used share of limits in zones, where not all of it is available.

    A zone of radius r that is passed at u counts as one of r + n u T, T the interpolation cycle and
    n `cycles`. The speed used here is the largest that the bend (k, axes) alone would allow. Of the
    limits in a narrow zone the axes use the share `narrow` (axes,), or (1,) if all use the same;
    `part` is a factor on it. The result has the shape (k, axes) or (k, 1).

    Source: fit to logs of corners of 3 to 30 deg, z1 to z500, at v1000 and more; for the wrist, to
    rotations of 22 deg on straight lines, where nothing else has to accelerate.
    """
    factors = np.ones((len(places.s), len(narrow)))
    radius, extent = path.zone_radius[places.piece], path.zone_extent[places.piece]
    at = np.flatnonzero(radius > 0.0)
    piece = places.piece[at]
    wide = cycles * path.model.cycle / extent[at]
    more = _GROWTH * np.maximum(radius[at] - _NARROW, 0.0)[:, None]
    share = part * np.minimum(narrow + more, np.maximum(_MOST_OF_ZONE, narrow))
    bends = np.maximum((np.abs(bend[at]) / share).max(axis=1), _NO_BEND)
    fastest = (wide + np.sqrt(wide * wide + 4.0 * bends)) / (2.0 * bends)
    fastest = np.minimum(fastest, path.zone_speed[piece])
    fastest = np.minimum(fastest, path.programmed.tcp[path.segment_of(piece)])
    factors[at] = np.maximum(1.0 / (share * (1.0 + wide * fastest)[:, None]), 1.0)
    return factors


def _path_accelerations(path: Path, places: GridPoints, limits: Limits) -> AccelerationRows | None:
    """Return the limit of PathAccLim, the smaller of both: the solver treats braking alike."""
    del limits
    allowed = path.programmed.tcp_acceleration
    if np.isinf(allowed).all():
        return None
    along, straight, _ = _tcp_bends(path, places)
    share = 1.0 / allowed[path.segment_of(places.piece)]
    limiters = (Limiter(Quantity.TCP_ACCELERATION),)
    return AccelerationRows(limiters, (along * share)[:, None], (straight * share)[:, None])


def _world_accelerations(path: Path, places: GridPoints, limits: Limits) -> AccelerationRows | None:
    """Return WorldAccLim as an octagon within the circle of accelerations along and across."""
    del limits
    allowed = path.programmed.world_acceleration
    if np.isinf(allowed).all():
        return None
    along, straight, across = _tcp_bends(path, places)
    share = 1.0 / (np.cos(np.pi / 8.0) * allowed[path.segment_of(places.piece)])
    along, straight, across = along * share, straight * share, across * share
    diagonal = np.sqrt(0.5)
    slope = [along, 0.0 * along, diagonal * along, diagonal * along]
    bend = [straight, across, diagonal * (straight + across), diagonal * (straight - across)]
    limiters = (Limiter(Quantity.WORLD_ACCELERATION),) * 4
    return AccelerationRows(limiters, np.stack(slope, axis=-1), np.stack(bend, axis=-1))


def _tcp_bends(path: Path, places: GridPoints) -> tuple[Array, Array, Array]:
    """Return |p'|, and p'' along and across the path, (k,) each."""
    first, second = path.tcp_derivatives(places.s, places.piece)
    along = np.linalg.norm(first, axis=-1)
    straight = np.einsum("ki,ki->k", first, second) / np.maximum(along, 1e-12)
    across = np.sqrt(np.maximum(np.einsum("ki,ki->k", second, second) - straight**2, 0.0))
    return along, straight, across


def _of_axes(quantity: Quantity, values: Array) -> tuple[Limiter, ...]:
    return tuple(Limiter(quantity, axis + 1) for axis in range(values.shape[-1]))


_OF_PACE = (Quantity.TCP_SPEED, Quantity.REORIENTATION_SPEED, Quantity.DURATION)
_OF_ACCELERATION = (
    Quantity.AXIS_ACCELERATION,
    Quantity.TORQUE,
    Quantity.TCP_ACCELERATION,
    Quantity.WORLD_ACCELERATION,
)
_PROGRAMMED = tuple(Limiter(quantity) for quantity in _OF_PACE)
_SPEEDS: tuple[Callable[[Path, GridPoints, Limits], SpeedRows | None], ...] = (
    _axis_speeds,
    _zone_speeds,
)
"""Speed limits besides the programmed ones; None if a path has no such limit. Limits of the command
alone are last."""
_ACCELERATIONS: tuple[Callable[[Path, GridPoints, Limits], AccelerationRows | None], ...] = (
    axis_rows,
    _path_accelerations,
    _world_accelerations,
)
"""Acceleration limits; None if a path has no such limit."""
