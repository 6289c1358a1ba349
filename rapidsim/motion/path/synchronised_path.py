"""Paths of several robots in synchronised motion, as one path with one parameter.

`team_progress` defines the position of each robot at a value of the parameter.

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
from rapidsim.motion.path.team_progress import MemberProgress, TeamProgress, team_progress
from rapidsim.values import value_class

_SLIVER = 1e-9
"""Distance [m] below which breakpoints count as one."""


@value_class(frozen=True, eq=False)
class MemberPath:
    """Path of one robot, and its progress on it."""

    path: Path
    progress: MemberProgress

    @cached_property
    def piece(self) -> Index:
        """Piece (p,) of the robot's own path on each common piece."""
        return self.path.layout.piece_at(self.progress.middles)

    def place(self, s: Array, piece: Index) -> Array:
        """Return positions (k,) [m] on the robot's own path."""
        return self.progress.place(s, piece)

    def rate(self, s: Array, piece: Index) -> Array:
        """Return the derivative (k,) [m/m] of the position on the robot's own path."""
        return self.progress.rate(s, piece)

    def rates(self, s: Array, piece: Index) -> PathRates:
        """Return derivatives with respect to the common parameter."""
        own = self.path.rates(self.place(s, piece), self.piece[piece])
        rate, bend = self.rate(s, piece)[:, None], self.progress.bend[piece][:, None]
        axes = slice(self.path.own_axis_count)
        first, second = own.first[:, axes], own.second[:, axes]
        return PathRates(
            first * rate,
            second * rate**2 + first * bend,
            own.tcp_rate * rate[:, 0],
            own.turn_rate * rate[:, 0],
            own.stance,
        )


@value_class(frozen=True, eq=False)
class SharedPath(Path):
    """Common parameter and its pieces, shared by the path of one robot and that of all."""

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

    def _pieces(self, s: Array) -> tuple[Array, Index]:
        s = np.clip(np.asarray(s, dtype=np.float64), 0.0, self.length)
        return s, self.layout.piece_at(s)


@value_class(frozen=True, eq=False)
class PartPath(SharedPath):
    """Path of one robot of a team, over the common parameter."""

    course: MemberPath

    @property
    def axis_count(self) -> int:
        """Number of joints of the arm and its external axes."""
        return self.course.path.own_axis_count

    @cached_property
    def stops(self) -> Array:
        """Common parameters at which the team comes to rest between the ends."""
        own = [corner.stops for corner in self.course.path.corners[:-1]]
        stops: Array = self.starts[1:][np.array(own, dtype=bool)]
        return stops

    @cached_property
    def lengths(self) -> Array:
        """TCP travel (segments,) [m] of the robot along its programmed curves."""
        return self.course.path.lengths

    @cached_property
    def corners(self) -> tuple[Corner, ...]:
        """Planned corner at the end of each segment of the robot."""
        return self.course.path.corners

    def joints_at(self, s: Array) -> Array:
        """Return joints at values of the common parameter; see `Path.joints_at`."""
        joints = self.course.path.joints_at(self.course.place(*self._pieces(s)))
        return joints[:, : self.axis_count]

    def evaluate(self, s: Array) -> PathPoints:
        """Return the arm at values s (k,) [m] of the common parameter."""
        s, piece = self._pieces(s)
        points = self.course.path.evaluate(self.course.place(s, piece))
        return replace(
            points,
            external=points.external[:, : self.axis_count - self.kinematics.joint_count],
            segment=self.segment_of(piece),
            tcp_rate=points.tcp_rate * self.course.rate(s, piece),
        )

    def nearby_state(
        self, s: Array, joints: Array, rates: Array, speed: Array
    ) -> tuple[Transform, Index, Array]:
        """Return the arm with other joints; see `Path.nearby_state`."""
        s, piece = self._pieces(s)
        path, place = self.course.path, self.course.place(s, piece)
        own_speed = self.course.rate(s, piece) * speed
        more = path.axis_count - self.axis_count
        if more:
            # Carriers are at their commanded position, next to the actual one, as this robot is.
            led, first = np.zeros((2, len(s), more))
            path.layout.fill_carrier_axes(place, self.course.piece[piece], led, first)
            joints = np.concatenate([joints, led], axis=1)
            rates = np.concatenate([rates, first * own_speed[:, None]], axis=1)
        pose, _, tcp_speed = path.nearby_state(place, joints, rates, own_speed)
        return pose, self.segment_of(piece), tcp_speed

    def rates(self, s: Array, piece: Index) -> PathRates:
        """Return derivatives with respect to the common parameter."""
        return self.course.rates(s, piece)

    def tcp_derivatives(self, s: Array, piece: Index) -> tuple[Array, Array]:
        """Return both derivatives (k, 3) of the TCP's position."""
        own = self.course
        first, second = own.path.tcp_derivatives(own.place(s, piece), own.piece[piece])
        rate, bend = own.rate(s, piece)[:, None], own.progress.bend[piece][:, None]
        return first * rate, second * rate**2 + first * bend

    def travelled(self, s: Array) -> Array:
        """Return the TCP travel (k,) [m] of the robot, with corners cut."""
        return self.course.path.travelled(self.course.place(*self._pieces(s)))


@value_class(frozen=True, eq=False)
class TeamPath(SharedPath):
    """Paths of all robots of a team as one, for timing."""

    courses: tuple[MemberPath, ...]

    def part(self, number: int) -> PartPath:
        """Return the path of one robot, counted from 0."""
        course = self.courses[number]
        own = course.path
        row = self.layout.row
        layout = _layout(own.layout, self.layout.bounds, row, self.layout.orientation_corner)
        active = np.arange(len(own.segments))
        return PartPath(
            own.segments,
            own.kinematics,
            layout,
            own.arms,
            active,
            own.nodes,
            own.model,
            None,
            self.starts,
            course,
        )

    @property
    def axis_count(self) -> int:
        """Joint count of the first robot: in a team, speeds of external axes are ignored."""
        return self.kinematics.joint_count

    @cached_property
    def stops(self) -> Array:
        """Common parameters at which a robot, and thus the team, must come to rest."""
        stops = [corner.stops for corner in self.corners[:-1]]
        places: Array = self.starts[1:][np.array(stops, dtype=bool)]
        return places

    @cached_property
    def zone_radius(self) -> Array:
        """Radius (p,) [m] of the smallest zone that any robot is in; 0 if all are outside zones."""
        radii = np.array(
            [
                course.path.zone_radius[course.piece]
                / np.maximum(course.progress.fastest_rate, 1e-12)
                for course in self.courses
            ]
        )
        narrowest: Array = np.where(radii > 0.0, radii, np.inf).min(axis=0)
        return np.where(np.isfinite(narrowest), narrowest, 0.0)

    @cached_property
    def zone_speed(self) -> Array:
        """Maximum speed (p,) [m/s] of the command: the smallest of the robots' speeds."""
        speeds = [
            course.path.zone_speed[course.piece] / np.maximum(course.progress.fastest_rate, 1e-12)
            for course in self.courses
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
            for corners in zip(*(course.path.corners for course in self.courses), strict=True)
        )

    def rates(self, s: Array, piece: Index) -> PathRates:
        """Return derivatives of the axes of all robots, side by side.

        TCP travel and reorientation are taken from the robot closest to its programmed speed,
        relative to that of the common segment.
        """
        segment = self.segment_of(piece)
        found = [course.rates(s, piece) for course in self.courses]
        tcp, turn = [], []
        for course, rates in zip(self.courses, found, strict=True):
            speeds = [one.speed for one in course.path.segments]
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


def team_path(paths: Sequence[Path]) -> TeamPath:
    """Join the paths of several robots, which have equally many segments."""
    own = [path.segment_bounds for path in paths]
    stops = np.any([[corner.stops for corner in path.corners[:-1]] for path in paths], axis=0)
    return joined(paths, team_progress([path.segments for path in paths], own, stops))


def joined(paths: Sequence[Path], team: TeamProgress) -> TeamPath:
    """Return the paths of several robots with known progress as one."""
    ends = team.ends
    inner = [one.bounds for one in team.members]
    inner += [_breakpoints(*pair) for pair in zip(paths, team.members, strict=True)]
    places = _merged(ends, np.concatenate(inner))
    middles = 0.5 * (places[1:] + places[:-1])
    row = np.clip(np.searchsorted(ends, middles, side="right") - 1, 0, len(ends) - 2)
    courses = tuple(
        MemberPath(path, one.refined(places)) for path, one in zip(paths, team.members, strict=True)
    )
    corner = np.max([_corner(one) for one in courses], axis=0)
    lead = paths[0]
    return TeamPath(
        team.segments,
        lead.kinematics,
        _layout(lead.layout, places, row, corner),
        lead.arms,
        np.arange(len(team.segments)),
        lead.nodes,
        lead.model,
        None,
        ends[:-1],
        courses,
    )


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


def _corner(course: MemberPath) -> Index:
    """Return the corner of a robot that contains each common piece, or -1."""
    corner: Index = course.path.layout.in_corner[course.piece]
    return corner


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
