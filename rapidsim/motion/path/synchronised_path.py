"""Paths of several robots travelled in sync, as one path with one parameter.

Segment k of all paths begins and ends at the same time. In between, the robots' positions are
functions of the common parameter s: proportional within a segment, with a smooth transition around
fly-by points, where the ratio of their speeds may change. The common length of a segment is the
longest of the robots' own.

Timing sees one path whose axes are those of all robots: at every point the slowest decides.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.geometry.blends import Corner
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.geometry.parameterisation import Layout
from rapidsim.motion.geometry.segments import Segment, Speed, Zone
from rapidsim.motion.path.path import Path
from rapidsim.motion.path.path_derivatives import PathPoints, PathRates
from rapidsim.values import dataclass

_SLIVER = 1e-9
"""Breakpoints so near [m] count as one."""


@dataclass(frozen=True, eq=False)
class MemberPath:
    """The position of one robot on its own path as a function of the common parameter.

    On each common piece it is `start + slope u + bend u2 / 2`, with u counted from the piece's
    start.
    """

    path: Path
    bounds: Array
    """Shape (p + 1,): the common parameter [m] at the ends of the common pieces."""
    start: Array
    """Shape (p,) [m]."""
    slope: Array
    """Shape (p,)."""
    bend: Array
    """Shape (p,) [1/m]."""

    @cached_property
    def piece(self) -> Index:
        """The piece (p,) of the robot's own path on each common piece."""
        middle = np.diff(self.bounds) / 2.0
        s = self.start + middle * (self.slope + 0.5 * middle * self.bend)
        return self.path.layout.piece_at(s)

    def place(self, s: Array, piece: Index) -> Array:
        """Positions (k,) [m] on the robot's own path."""
        u = s - self.bounds[piece]
        own: Array = self.start[piece] + u * (self.slope[piece] + 0.5 * u * self.bend[piece])
        return np.clip(own, 0.0, self.path.length)

    def rate(self, s: Array, piece: Index) -> Array:
        """The derivative (k,) [m/m] of the position on the robot's own path."""
        rate: Array = self.slope[piece] + (s - self.bounds[piece]) * self.bend[piece]
        return rate

    @property
    def fastest_rate(self) -> Array:
        """The maximum derivative (p,) [m/m] on each common piece."""
        after: Array = self.slope + np.diff(self.bounds) * self.bend
        return np.maximum(self.slope, after)

    def rates(self, s: Array, piece: Index) -> PathRates:
        """Derivatives with respect to the common parameter."""
        own = self.path.rates(self.place(s, piece), self.piece[piece])
        rate, bend = self.rate(s, piece)[:, None], self.bend[piece][:, None]
        return PathRates(
            own.first * rate,
            own.second * rate**2 + own.first * bend,
            own.tcp_rate * rate[:, 0],
            own.turn_rate * rate[:, 0],
            own.stance,
        )


@dataclass(frozen=True, eq=False)
class SharedPath(Path):
    """The common parameter and its pieces, shared by the path of one robot and that of all."""

    starts: Array
    """Shape (segments,): the common parameter at the start of each segment."""

    @property
    def length(self) -> float:
        """Range of the common parameter [m]."""
        return float(self.layout.bounds[-1])

    @cached_property
    def segment_starts(self) -> Array:
        """The common parameter at the start of each segment, shape (segments,)."""
        return self.starts

    def _pieces(self, s: Array) -> tuple[Array, Index]:
        s = np.clip(np.asarray(s, dtype=np.float64), 0.0, self.length)
        return s, self.layout.piece_at(s)


@dataclass(frozen=True, eq=False)
class PartPath(SharedPath):
    """The path of one robot of a team, over the common parameter."""

    course: MemberPath

    @cached_property
    def stops(self) -> Array:
        """Where the team comes to rest between the ends."""
        own = [corner.stops for corner in self.course.path.corners[:-1]]
        stops: Array = self.starts[1:][np.array(own, dtype=bool)]
        return stops

    @cached_property
    def lengths(self) -> Array:
        """TCP travel (segments,) [m] of the robot along its programmed curves."""
        return self.course.path.lengths

    @cached_property
    def corners(self) -> tuple[Corner, ...]:
        """The planned corner at the end of each segment of the robot."""
        return self.course.path.corners

    def joints_at(self, s: Array) -> Array:
        """Joints at values of the common parameter; see `Path.joints_at`."""
        return self.course.path.joints_at(self.course.place(*self._pieces(s)))

    def evaluate(self, s: Array) -> PathPoints:
        """The arm at places s (k,) [m] of the common parameter."""
        s, piece = self._pieces(s)
        points = self.course.path.evaluate(self.course.place(s, piece))
        return replace(
            points,
            segment=self.segment_of(piece),
            tcp_rate=points.tcp_rate * self.course.rate(s, piece),
        )

    def beside(self, s: Array, joints: Array, rates: Array) -> tuple[Transform, Index, Array]:
        """The arm with other joints; see `Path.beside`."""
        s, piece = self._pieces(s)
        pose, _, speed = self.course.path.beside(self.course.place(s, piece), joints, rates)
        return pose, self.segment_of(piece), speed

    def rates(self, s: Array, piece: Index) -> PathRates:
        """Derivatives with respect to the common parameter."""
        return self.course.rates(s, piece)

    def tcp_derivatives(self, s: Array, piece: Index) -> tuple[Array, Array]:
        """Both derivatives (k, 3) of the TCP's position."""
        own = self.course
        first, second = own.path.tcp_derivatives(own.place(s, piece), own.piece[piece])
        rate, bend = own.rate(s, piece)[:, None], own.bend[piece][:, None]
        return first * rate, second * rate**2 + first * bend

    def travelled(self, s: Array) -> Array:
        """TCP travel (k,) [m] of the robot, with corners cut."""
        return self.course.path.travelled(self.course.place(*self._pieces(s)))


@dataclass(frozen=True, eq=False)
class TeamPath(SharedPath):
    """The paths of all robots of a team as one, as timing sees it."""

    courses: tuple[MemberPath, ...]

    def part(self, number: int) -> PartPath:
        """The path of one robot, counted from 0."""
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
        """The joint count of the first robot: in a team, speeds of external axes do not count."""
        return self.kinematics.joint_count

    @cached_property
    def stops(self) -> Array:
        """Where one of the robots must come to rest, and thus all of them."""
        stops = [corner.stops for corner in self.corners[:-1]]
        places: Array = self.starts[1:][np.array(stops, dtype=bool)]
        return places

    @cached_property
    def zone_radius(self) -> Array:
        """Radius (p,) [m] of the smallest zone that any robot is in; 0 if none is in one."""
        radii = np.array(
            [
                course.path.zone_radius[course.piece] / np.maximum(course.fastest_rate, 1e-12)
                for course in self.courses
            ]
        )
        narrowest: Array = np.where(radii > 0.0, radii, np.inf).min(axis=0)
        return np.where(np.isfinite(narrowest), narrowest, 0.0)

    @cached_property
    def zone_speed(self) -> Array:
        """Maximum speed (p,) [m/s] of the command: the smallest of the robots'."""
        speeds = [
            course.path.zone_speed[course.piece] / np.maximum(course.fastest_rate, 1e-12)
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
        """The planned corner at the end of each segment: a robot that stops there decides."""
        return tuple(
            next((corner for corner in corners if corner.stops), corners[0])
            for corners in zip(*(course.path.corners for course in self.courses), strict=True)
        )

    def rates(self, s: Array, piece: Index) -> PathRates:
        """Derivatives of the axes of all robots, side by side.

        TCP travel and reorientation are those of the robot closest to its programmed speed,
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
    own_ends = [path.segment_bounds for path in paths]
    lengths = np.array([np.diff(one) for one in own_ends])
    longest: Array = lengths.max(axis=0)
    slopes = lengths / np.where(longest > 0.0, longest, 1.0)
    segments = tuple(
        _common_segment([path.segments[k] for path in paths], slopes[:, k])
        for k in range(len(longest))
    )
    stops = np.any([[corner.stops for corner in path.corners[:-1]] for path in paths], axis=0)
    passages = _passages(segments, longest, slopes, stops)
    short = passages.before - passages.half
    common = longest - np.append(short, 0.0) - np.append(0.0, short)
    ends = np.concatenate([[0.0], np.cumsum(common)])
    rough = [
        _course(path, ends, own, slope, passages)
        for path, own, slope in zip(paths, own_ends, slopes, strict=True)
    ]
    places = _merged(
        ends, np.concatenate([one.bounds for one in rough] + [_breakpoints(one) for one in rough])
    )
    middles = 0.5 * (places[1:] + places[:-1])
    row = np.clip(np.searchsorted(ends, middles, side="right") - 1, 0, len(common) - 1)
    courses = tuple(_refined(one, places) for one in rough)
    corner = np.max([_corner(one) for one in courses], axis=0)
    lead = paths[0]
    return TeamPath(
        segments,
        lead.kinematics,
        _layout(lead.layout, places, row, corner),
        lead.arms,
        np.arange(len(segments)),
        lead.nodes,
        lead.model,
        None,
        ends[:-1],
        courses,
    )


def _common_segment(segments: Sequence[Segment], slopes: Array) -> Segment:
    """What timing and the path queue must know of one segment of all robots."""
    moving = [(one, rate) for one, rate in zip(segments, slopes, strict=True) if rate > 0.0]
    durations = [one.duration for one in segments if one.duration is not None]
    zones = [one.zone.position / rate for one, rate in moving if one.zone]
    stops = any(one.zone is None for one in segments)
    first = segments[0]
    return replace(
        first,
        speed=Speed(
            max((one.speed.tcp / rate for one, rate in moving), default=first.speed.tcp),
            first.speed.reorientation,
        ),
        zone=None if stops else Zone(max(zones, default=0.0), max(zones, default=0.0), 0.0),
        duration=max(durations, default=None),
        acceleration_share=min(one.acceleration_share for one in segments),
        load=max(one.load for one in segments),
        tcp_acceleration=np.inf,
        tcp_deceleration=np.inf,
        world_acceleration=np.inf,
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Passages:
    """How the rates of the robots pass over at each inner end of a segment.

    From a rate a before to b after, each robot first goes to a rate c in between, both evenly. With
    c = (a + b) / M, M the largest a + b of all robots, the fastest of them is always near rate 1:
    the common parameter stays a length that all of them can be driven along at even speed.
    """

    before: Array
    """Shape (segments - 1,) [m]: so far before and after the end, as if rates did not change."""
    half: Array
    """Half the length [m] of the passage in the common parameter."""
    largest: Array
    """M."""


def _passages(
    segments: Sequence[Segment], longest: Array, slopes: Array, stops: Array
) -> _Passages:
    zones = np.array([one.zone.position if one.zone else 0.0 for one in segments[:-1]])
    before = np.where(stops, 0.0, np.minimum(zones, 0.5 * np.minimum(longest[:-1], longest[1:])))
    largest = np.maximum((slopes[:, :-1] + slopes[:, 1:]).max(axis=0), 1e-12)
    # Each robot goes as far as it would at its rates before and after:
    # half (a + 2 c + b) / 2 = before (a + b).
    return _Passages(before, 2.0 * before * largest / (largest + 2.0), largest)


def _course(path: Path, ends: Array, own: Array, slope: Array, passages: _Passages) -> MemberPath:
    """One robot's place: straight pieces, and between them two parabolas around each end."""
    before, half = passages.before, passages.half
    into, out = slope[:-1], slope[1:]
    between = (into + out) / passages.largest
    inner, at = ends[1:-1], own[1:-1]
    steep = np.where(half > 0.0, half, 1.0)
    straight = (
        np.append(0.0, inner + half),
        np.append(own[0], at + out * before),
        slope,
        np.zeros(len(slope)),
    )
    first = (inner - half, at - into * before, into, (between - into) / steep)
    second = (
        inner,
        at - into * before + 0.5 * half * (into + between),
        between,
        (out - between) / steep,
    )
    bounds, start, rate, bend = (
        np.insert(s, np.repeat(np.arange(1, len(s)), 2), np.column_stack([one, other]).ravel())
        for s, one, other in zip(straight, first, second, strict=True)
    )
    bounds = np.append(bounds, ends[-1])
    kept = np.diff(bounds) > 0.0
    # Where nobody moves at all there is one piece without length.
    kept[0] |= not kept.any()
    return MemberPath(
        path, np.append(bounds[:-1][kept], bounds[-1]), start[kept], rate[kept], bend[kept]
    )


def _breakpoints(course: MemberPath) -> Array:
    """The common parameter at the breakpoints of a robot's own path."""
    places = course.path.breakpoints[1:-1]
    index = np.clip(np.searchsorted(course.start, places, side="right") - 1, 0, None)
    index = np.minimum(index, len(course.start) - 1)
    way = places - course.start[index]
    slope, bend = course.slope[index], course.bend[index]
    rate = slope + np.sqrt(np.maximum(slope**2 + 2.0 * bend * way, 0.0))
    found: Array = (course.bounds[index] + 2.0 * way / np.maximum(rate, 1e-300))[rate > 0.0]
    return np.clip(found, 0.0, course.bounds[-1])


def _merged(ends: Array, inner: Array) -> Array:
    """The ends of segments and all other breakpoints that are not one of them, increasing."""
    ends = np.unique(ends)
    if len(ends) == 1:
        return np.repeat(ends, 2)
    after = np.clip(np.searchsorted(ends, inner), 1, len(ends) - 1)
    nearest = np.minimum(np.abs(inner - ends[after - 1]), np.abs(inner - ends[after]))
    others = np.sort(inner[nearest > _SLIVER])
    apart = np.diff(others, prepend=-np.inf) > _SLIVER
    return np.sort(np.concatenate([ends, others[apart]]))


def _refined(course: MemberPath, bounds: Array) -> MemberPath:
    """The same course on more pieces."""
    index = np.searchsorted(course.bounds, 0.5 * (bounds[1:] + bounds[:-1]), side="right") - 1
    index = np.clip(index, 0, len(course.start) - 1)
    u = bounds[:-1] - course.bounds[index]
    slope, bend = course.slope[index], course.bend[index]
    start = course.start[index] + u * (slope + 0.5 * u * bend)
    return MemberPath(course.path, bounds, start, slope + u * bend, bend)


def _corner(course: MemberPath) -> Index:
    """The corner in which each common piece lies for one robot; -1 where it lies in none."""
    corner: Index = course.path.layout.in_corner[course.piece]
    return corner


def _layout(of: Layout, bounds: Array, row: Index, corner: Index) -> Layout:
    """A layout that says where the pieces are, and nothing of the curves on them."""
    none = np.full(len(row), -1, dtype=np.int64)
    return replace(
        of,
        bounds=bounds,
        row=row.astype(np.int64),
        position_corner=none,
        orientation_corner=corner,
        joint_corner=none,
    )
