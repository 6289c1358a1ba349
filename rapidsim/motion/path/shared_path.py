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
from rapidsim.motion.path.path import Path
from rapidsim.motion.path.path_derivatives import PathPoints, PathRates
from rapidsim.motion.path.shared_progress import MemberProgress, SharedProgress, shared_progress
from rapidsim.values import value_class

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

    def joints_at(self, s: Array) -> Array:
        """Return joints at values of the common parameter; see `Path.joints_at`."""
        return self.own.joints_at(self.progress.place(*self._pieces(s)))[:, : self.axis_count]

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

    @property
    def parts(self) -> tuple[Path, ...]:
        """Path of each robot, over the common parameter."""
        return self.robots

    @property
    def axis_count(self) -> int:
        """Joint count of the first robot: programmed speeds of external axes are ignored."""
        return self.kinematics.joint_count

    @cached_property
    def zone_radius(self) -> Array:
        """Radius (p,) [m] of the smallest zone that any robot is in; 0 if all are outside zones."""
        radii = np.array(
            [
                robot.own.zone_radius[robot.own_piece]
                / np.maximum(robot.progress.fastest_rate, 1e-12)
                for robot in self.robots
            ]
        )
        narrowest: Array = np.where(radii > 0.0, radii, np.inf).min(axis=0)
        return np.where(np.isfinite(narrowest), narrowest, 0.0)

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

        TCP travel and reorientation are taken from the robot closest to its programmed speed,
        relative to that of the common segment.
        """
        segment = self.segment_of(piece)
        found = [robot.rates(s, piece) for robot in self.robots]
        tcp, turn = [], []
        for robot, rates in zip(self.robots, found, strict=True):
            speeds = [one.speed for one in robot.segments]
            tcp.append(rates.tcp_rate / np.array([one.tcp for one in speeds])[segment])
            turn.append(rates.turn_rate / np.array([one.reorientation for one in speeds])[segment])
        common = [one.speed for one in self.segments]
        return PathRates(
            np.concatenate([rates.first for rates in found], axis=1),
            np.concatenate([rates.second for rates in found], axis=1),
            np.max(tcp, axis=0) * np.array([one.tcp for one in common])[segment],
            np.max(turn, axis=0) * np.array([one.reorientation for one in common])[segment],
            np.concatenate([rates.stance for rates in found], axis=1),
        )


def shared_path(paths: Sequence[Path]) -> Path:
    """Join the paths of robots, which have equally many segments; that of one is returned."""
    if len(paths) == 1:
        return paths[0]
    own = [path.segment_bounds for path in paths]
    stops = np.any([[corner.stops for corner in path.corners[:-1]] for path in paths], axis=0)
    return joined(paths, shared_progress([path.segments for path in paths], own, stops))


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
    corner = np.max(
        [
            path.layout.in_corner[path.layout.piece_at(one.middles)]
            for path, one in zip(paths, refined, strict=True)
        ],
        axis=0,
    )
    for path, one in zip(paths, refined, strict=True):
        layout = _layout(path.layout, places, row, corner)
        arm = path.kinematics, layout, path.arms, active, path.nodes, path.model, None
        members.append(PartPath(path.segments, *arm, ends[:-1], path, one))
    lead = paths[0]
    arm = lead.kinematics, members[0].layout, lead.arms, active, lead.nodes, lead.model, None
    return SharedPath(progress.segments, *arm, ends[:-1], tuple(members))


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
