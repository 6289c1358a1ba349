"""Paths of several robots in synchronised motion, as one path with one parameter.

`shared_progress` defines the position of each robot at a value of the parameter. The path of a
robot alone is its own: `shared_path` returns it unchanged.

Timing sees one path with the axes of all robots: at every point the slowest is the bottleneck.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.geometry.blends import Corner
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.geometry.parameterisation import PathParameterisation
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.path.path import Path
from rapidsim.motion.path.path_derivatives import PathPoints, PathRates
from rapidsim.motion.path.shared_progress import (
    PACE,
    MemberProgress,
    SharedProgress,
    shared_progress,
)
from rapidsim.values import value_class

_STANDING = 1e-9
"""Rate [m/m] below which a robot does not move along its path."""
_SLIVER = 1e-9
"""Distance [m] below which breakpoints count as one."""


@value_class(frozen=True, eq=False)
class _CommonPath(Path):
    """A path over the common parameter of several robots, in common pieces."""

    starts: Array
    """Shape (segments,): common parameter at the start of each segment."""

    @property
    def length(self) -> float:
        """Range of the common parameter [m]."""
        return float(self.layout.bounds[-1])

    @cached_property
    def segment_starts(self) -> Array:
        """Common parameter at the start of each segment, shape (segments,)."""
        return self.starts

    @cached_property
    def stops(self) -> Array:
        """Common parameters at which a robot, and thus all of them, come to rest."""
        stops = [corner.stops for corner in self.corners[:-1]]
        places: Array = self.starts[1:][np.array(stops, dtype=bool)]
        return places

    def _pieces(self, s: Array) -> tuple[Array, Index]:
        s = np.clip(np.asarray(s, dtype=np.float64), 0.0, self.length)
        return s, self.layout.piece_at(s)


@value_class(frozen=True, eq=False)
class PartPath(_CommonPath):
    """Path of one of the robots, over the common parameter."""

    own: Path
    """Its path over its own parameter."""
    progress: MemberProgress

    @property
    def axis_count(self) -> int:
        """Number of joints of the arm and its external axes."""
        return self.own.own_axis_count

    @cached_property
    def fastest_rate(self) -> float:
        """Upper bound of the TCP travel per unit of the common parameter; see `Path`."""
        return float(self.progress.fastest_rate.max())

    @cached_property
    def own_piece(self) -> Index:
        """Piece (p,) of the robot's own path on each common piece."""
        return self.own.layout.piece_at(self.progress.middles)

    @cached_property
    def lengths(self) -> Array:
        """TCP travel (segments,) [m] of the robot along its programmed curves."""
        return self.own.lengths

    @cached_property
    def corners(self) -> tuple[Corner, ...]:
        """Planned corner at the end of each segment of the robot."""
        return self.own.corners

    def joints_at(self, s: Array, *, quick: bool = False) -> Array:
        """Return joints at values of the common parameter; see `Path.joints_at`."""
        place = self.progress.place(*self._pieces(s))
        return self.own.joints_at(place, quick=quick)[:, : self.axis_count]

    def evaluate(self, s: Array) -> PathPoints:
        """Return the arm at values s (k,) [m] of the common parameter."""
        s, piece = self._pieces(s)
        points = self.own.evaluate(self.progress.place(s, piece))
        return replace(
            points,
            external=points.external[:, : self.axis_count - self.kinematics.joint_count],
            segment=self.segment_of(piece),
            tcp_rate=points.tcp_rate * self.progress.rate(s, piece),
        )

    def nearby_state(
        self, s: Array, joints: Array, rates: Array, speed: Array
    ) -> tuple[Transform, Index, Array]:
        """Return the arm with other joints; see `Path.nearby_state`."""
        s, piece = self._pieces(s)
        own, place = self.own, self.progress.place(s, piece)
        own_speed = self.progress.rate(s, piece) * speed
        more = own.axis_count - self.axis_count
        if more:
            # Carriers are at their commanded position, next to the actual one, as this robot is.
            led, first = np.zeros((2, len(s), more))
            own.layout.fill_carrier_axes(place, self.own_piece[piece], led, first)
            joints = np.concatenate([joints, led], axis=1)
            rates = np.concatenate([rates, first * own_speed[:, None]], axis=1)
        pose, _, tcp_speed = own.nearby_state(place, joints, rates, own_speed)
        return pose, self.segment_of(piece), tcp_speed

    def rates(self, s: Array, piece: Index) -> PathRates:
        """Return derivatives with respect to the common parameter."""
        own = self.own.rates(self.progress.place(s, piece), self.own_piece[piece])
        rate, bend = self.progress.rate(s, piece)[:, None], self.progress.bend[piece][:, None]
        axes = slice(self.axis_count)
        first, second = own.first[:, axes], own.second[:, axes]
        return PathRates(
            first * rate,
            second * rate**2 + first * bend,
            own.tcp_rate * rate[:, 0],
            own.turn_rate * rate[:, 0],
            own.stance,
        )

    def tcp_derivatives(self, s: Array, piece: Index) -> tuple[Array, Array]:
        """Return both derivatives (k, 3) of the TCP's position."""
        place = self.progress.place(s, piece)
        first, second = self.own.tcp_derivatives(place, self.own_piece[piece])
        rate, bend = self.progress.rate(s, piece)[:, None], self.progress.bend[piece][:, None]
        return first * rate, second * rate**2 + first * bend

    def travelled(self, s: Array) -> Array:
        """Return the TCP travel (k,) [m] of the robot, with corners cut."""
        return self.own.travelled(self.progress.place(*self._pieces(s)))


@value_class(frozen=True, eq=False)
class SharedPath(_CommonPath):
    """Paths of several robots as one, for timing."""

    robots: tuple[PartPath, ...]
    pace_setters: Index
    """Shape (segments,): see `slowest`."""
    turns: Mask
    """Shape (segments,): whether a reorientation determines the nominal time of a segment."""
    neighbours: Index
    """Shape (p, 2): segments before and after the end whose zone contains each common piece; twice
    its own segment outside zones."""

    @cached_property
    def passing(self) -> Mask:
        """Mask (p,) of the common pieces in zones."""
        passing: Mask = self.neighbours[:, 0] != self.neighbours[:, 1]
        return passing

    @property
    def parts(self) -> tuple[Path, ...]:
        """Path of each robot, over the common parameter."""
        return self.robots

    @property
    def axis_count(self) -> int:
        """Joint count of the first robot: programmed speeds of external axes are ignored."""
        return self.kinematics.joint_count

    @property
    def slowest(self) -> Index:
        """Robot (segments,) that sets the nominal time of each segment; see `Path`."""
        return self.pace_setters

    @cached_property
    def _zones(self) -> tuple[Array, Array]:
        """Radius (p,) [m] of the zone of the robot that passes its own first, and its extent."""
        pieces = np.arange(len(self.layout.row))
        radii = np.array([robot.own.zone_radius[robot.own_piece] for robot in self.robots])
        rates = [np.maximum(robot.progress.fastest_rate, 1e-12) for robot in self.robots]
        extents = np.where(radii > 0.0, radii / rates, np.inf)
        narrowest = extents.argmin(axis=0)
        radius, extent = radii[narrowest, pieces], extents[narrowest, pieces]
        return radius, np.where(np.isfinite(extent), extent, 0.0)

    @property
    def zone_radius(self) -> Array:
        """Radius (p,) [m] of the narrowest zone that any robot is in; 0 if all are outside."""
        return self._zones[0]

    @property
    def zone_extent(self) -> Array:
        """Radius (p,) of that zone in units of the common parameter."""
        return self._zones[1]

    @cached_property
    def zone_speed(self) -> Array:
        """Maximum speed (p,) [m/s] of the command: the smallest of the robots' speeds."""
        speeds = [
            robot.own.zone_speed[robot.own_piece] / np.maximum(robot.progress.fastest_rate, 1e-12)
            for robot in self.robots
        ]
        fastest: Array = np.min(speeds, axis=0)
        return fastest

    @cached_property
    def lengths(self) -> Array:
        """Common length of each segment (segments,) [m]."""
        return np.diff(np.append(self.starts, self.length))

    @cached_property
    def corners(self) -> tuple[Corner, ...]:
        """Planned corner at the end of each segment: a robot that stops there decides."""
        return tuple(
            next((corner for corner in corners if corner.stops), corners[0])
            for corners in zip(*(robot.corners for robot in self.robots), strict=True)
        )

    def rates(self, s: Array, piece: Index) -> PathRates:
        """Return derivatives of the axes of all robots, side by side.

        TCP travel and reorientation are shares of the programmed speeds; see `_shares`.
        """
        each = [robot.rates(s, piece) for robot in self.robots]
        tcp_rate, turn_rate = self._shares(s, piece, each)
        return PathRates(
            np.concatenate([rates.first for rates in each], axis=1),
            np.concatenate([rates.second for rates in each], axis=1),
            tcp_rate,
            turn_rate,
            np.concatenate([rates.stance for rates in each], axis=1),
        )

    def _shares(self, s: Array, piece: Index, each: Sequence[PathRates]) -> tuple[Array, Array]:
        """Return shares (k,) of the programmed TCP and reorientation speeds that `PACE` uses.

        Outside zones they are those of the robot that is closest to its own speed, and at least the
        nominal pace. In a zone the pace alone counts: that of the robots that set it before and
        after, which may cut their corners.
        """
        segment, passing = self.segment_of(piece), self.passing[piece]
        setters = self.pace_setters[self.neighbours[piece]]
        cut = np.zeros(len(s))
        tcp, turn = cut.copy(), cut.copy()
        for number, (robot, rates) in enumerate(zip(self.robots, each, strict=True)):
            tcp = np.maximum(tcp, PACE * rates.tcp_rate / robot.programmed.tcp[segment])
            turn = np.maximum(
                turn, PACE * rates.turn_rate / robot.programmed.reorientation[segment]
            )
            rate = robot.progress.rate(s, piece)
            own = np.divide(rates.tcp_rate, rate, out=np.ones(len(s)), where=rate > _STANDING)
            cut = np.maximum(cut, np.where((setters == number).any(axis=1), own, 0.0))
        turns = self.turns[segment]
        cut = np.where(self.turns[self.neighbours[piece]].any(axis=1), 1.0, cut)
        tcp = np.where(passing, cut, np.maximum(tcp, ~turns))
        turn = np.where(passing, 0.0, np.maximum(turn, turns))
        return tcp, turn


def shared_path(paths: Sequence[Path]) -> Path:
    """Join the paths of robots, which have equally many segments; that of one is returned."""
    if len(paths) == 1:
        return paths[0]
    own = [path.segment_bounds for path in paths]
    stops = np.any([[corner.stops for corner in path.corners[:-1]] for path in paths], axis=0)
    nominal = [path.nominal for path in paths]
    return joined(paths, shared_progress([path.segments for path in paths], own, nominal, stops))


def joined(paths: Sequence[Path], progress: SharedProgress) -> SharedPath:
    """Return the paths of several robots with known progress as one."""
    ends = progress.ends
    inner = [one.bounds for one in progress.members]
    inner += [_breakpoints(*pair) for pair in zip(paths, progress.members, strict=True)]
    places = _merged(ends, np.concatenate(inner))
    middles = 0.5 * (places[1:] + places[:-1])
    row = np.clip(np.searchsorted(ends, middles, side="right") - 1, 0, len(ends) - 2)
    active, members = np.arange(len(progress.segments)), []
    refined = [one.refined(places) for one in progress.members]
    corner = np.stack(
        [
            path.layout.in_corner[path.layout.piece_at(one.middles)]
            for path, one in zip(paths, refined, strict=True)
        ]
    ).max(axis=0)
    for path, one in zip(paths, refined, strict=True):
        layout = _layout(path.layout, places, row, corner)
        arm = path.kinematics, layout, path.arms, active, path.nodes, path.model, None
        members.append(PartPath(path.segments, *arm, ends[:-1], path, one))
    lead = paths[0]
    arm = lead.kinematics, members[0].layout, lead.arms, active, lead.nodes, lead.model, None
    zones = np.concatenate([[0.0], progress.zones, [0.0]])
    before = row - (middles - ends[row] < zones[row])
    after = row + (ends[row + 1] - middles < zones[row + 1])
    pace = progress.slowest, progress.turns, np.stack([before, after], axis=1)
    return SharedPath(progress.segments, *arm, ends[:-1], tuple(members), *pace)


def _breakpoints(path: Path, progress: MemberProgress) -> Array:
    """Return the common parameter at the breakpoints of a robot's own path."""
    found, piece = progress.at_own(path.breakpoints[1:-1])
    return found[(progress.rate(found, piece) > 0.0) | (progress.slope[piece] > 0.0)]


def _merged(ends: Array, inner: Array) -> Array:
    """Return segment ends and all other breakpoints, without duplicates, increasing."""
    ends = np.unique(ends)
    if len(ends) == 1:
        return np.repeat(ends, 2)
    after = np.clip(np.searchsorted(ends, inner), 1, len(ends) - 1)
    nearest = np.minimum(np.abs(inner - ends[after - 1]), np.abs(inner - ends[after]))
    others = np.sort(inner[nearest > _SLIVER])
    apart = np.diff(others, prepend=-np.inf) > _SLIVER
    return np.sort(np.concatenate([ends, others[apart]]))


def _layout(
    of: PathParameterisation, bounds: Array, row: Index, corner: Index
) -> PathParameterisation:
    """Return a layout of pieces without information about their curves."""
    none = np.full(len(row), -1, dtype=np.int64)
    return replace(
        of,
        bounds=bounds,
        row=row.astype(np.int64),
        position_corner=none,
        orientation_corner=corner,
        joint_corner=none,
    )
