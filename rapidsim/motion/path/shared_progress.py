"""Progress of each robot on its own path as a function of a common parameter.

Segment k of all paths begins and ends at the same time. In between, the robots' positions are
functions of the common parameter s: proportional within a segment, with a smooth transition around
fly-by points, where the ratio of their speeds may change. The common length of a segment is the
longest of the robots' own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.geometry.segments import Segment, Speed, Zone
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class MemberProgress:
    """Position of one robot on its own path as a function of the common parameter.

    On each common piece it is `start + slope u + bend u2 / 2`, with u counted from the piece's
    start.
    """

    bounds: Array
    """Shape (p + 1,): common parameter [m] at the ends of the common pieces."""
    start: Array
    """Shape (p,) [m]."""
    slope: Array
    """Shape (p,)."""
    bend: Array
    """Shape (p,) [1/m]."""
    length: float
    """Length of the robot's own path [m]."""

    def piece_at(self, s: Array) -> Index:
        """Return the common piece (k,) that contains each common s (k,)."""
        piece = np.searchsorted(self.bounds, s, side="right") - 1
        return np.clip(piece, 0, len(self.start) - 1).astype(np.int64)

    def place(self, s: Array, piece: Index) -> Array:
        """Return positions (k,) [m] on the robot's own path."""
        u = s - self.bounds[piece]
        own: Array = self.start[piece] + u * (self.slope[piece] + 0.5 * u * self.bend[piece])
        return np.clip(own, 0.0, self.length)

    def rate(self, s: Array, piece: Index) -> Array:
        """Return the derivative (k,) [m/m] of the position on the robot's own path."""
        rate: Array = self.slope[piece] + (s - self.bounds[piece]) * self.bend[piece]
        return rate

    @property
    def fastest_rate(self) -> Array:
        """Maximum derivative (p,) [m/m] on each common piece."""
        after: Array = self.slope + np.diff(self.bounds) * self.bend
        return np.maximum(self.slope, after)

    @property
    def middles(self) -> Array:
        """Positions (p,) [m] on the robot's own path in the middle of each common piece."""
        half = np.diff(self.bounds) / 2.0
        middles: Array = self.start + half * (self.slope + 0.5 * half * self.bend)
        return middles

    def at_own(self, places: Array) -> tuple[Array, Index]:
        """Return the common parameter (k,), and its piece, for positions (k,) of the robot.

        While the robot waits at a position, it is the end of the wait.
        """
        index = np.clip(np.searchsorted(self.start, places, side="right") - 1, 0, None)
        index = np.minimum(index, len(self.start) - 1).astype(np.int64)
        return self.in_piece(places, index), index

    def in_piece(self, places: Array, piece: Index) -> Array:
        """Return the common parameter (k,) on pieces (k,) for positions (k,) of the robot."""
        way = places - self.start[piece]
        slope, bend = self.slope[piece], self.bend[piece]
        rate = slope + np.sqrt(np.maximum(slope**2 + 2.0 * bend * way, 0.0))
        found = self.bounds[piece] + np.where(rate > 0.0, 2.0 * way / np.maximum(rate, 1e-300), 0.0)
        return np.clip(found, 0.0, self.bounds[-1])

    def refined(self, bounds: Array) -> MemberProgress:
        """Return this progress on more pieces."""
        index = np.searchsorted(self.bounds, 0.5 * (bounds[1:] + bounds[:-1]), side="right") - 1
        index = np.clip(index, 0, len(self.start) - 1)
        u = bounds[:-1] - self.bounds[index]
        slope, bend = self.slope[index], self.bend[index]
        start = self.start[index] + u * (slope + 0.5 * u * bend)
        return MemberProgress(bounds, start, slope + u * bend, bend, self.length)


@value_class(frozen=True, slots=True, eq=False)
class SharedProgress:
    """Common segments, and the progress of each robot."""

    segments: tuple[Segment, ...]
    """Common segments, with the data for timing and the path queue."""
    ends: Array
    """Shape (segments + 1,): common parameter [m] at their ends."""
    members: tuple[MemberProgress, ...]


def shared_progress(
    rows: Sequence[Sequence[Segment]], own: Sequence[Array], stops: Mask
) -> SharedProgress:
    """Return the progress of several robots in synchronised motion.

    Args:
        rows: The segments of each robot.
        own: Segment ends on the robot's own path, (segments + 1,) [m].
        stops: Shape (segments - 1,): mask of the segment ends where a robot, and thus all of
            them, stop.
    """
    lengths = np.array([np.diff(one) for one in own])
    longest: Array = lengths.max(axis=0)
    slopes = lengths / np.where(longest > 0.0, longest, 1.0)
    segments = tuple(
        _common_segment([row[k] for row in rows], slopes[:, k]) for k in range(len(longest))
    )
    passages = _passages(segments, longest, slopes, stops)
    short = passages.before - passages.half
    common = longest - np.append(short, 0.0) - np.append(0.0, short)
    ends = np.concatenate([[0.0], np.cumsum(common)])
    members = (
        _progress(ends, places, slope, passages) for places, slope in zip(own, slopes, strict=True)
    )
    return SharedProgress(segments, ends, tuple(members))


def _common_segment(segments: Sequence[Segment], slopes: Array) -> Segment:
    """Return the data of one segment of all robots for timing and the path queue."""
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


@value_class(frozen=True, slots=True, eq=False)
class _Passages:
    """Transition of the robots' rates at each inner end of a segment.

    Between a rate a before and b after, each robot passes through a rate c, with linear
    transitions. With c = (a + b) / M, M the largest a + b of all robots, the fastest of them is
    always near rate 1: the common parameter remains a length along which all of them can move at
    constant speed.
    """

    before: Array
    """Shape (segments - 1,) [m]: extent before and after the end, for constant rates."""
    half: Array
    """Half the length [m] of the transition in the common parameter."""
    largest: Array
    """M."""


def _passages(segments: Sequence[Segment], longest: Array, slopes: Array, stops: Mask) -> _Passages:
    zones = np.array([one.zone.position if one.zone else 0.0 for one in segments[:-1]])
    before = np.where(stops, 0.0, np.minimum(zones, 0.5 * np.minimum(longest[:-1], longest[1:])))
    largest = np.maximum((slopes[:, :-1] + slopes[:, 1:]).max(axis=0), 1e-12)
    # The travel of each robot equals that at its rates before and after:
    # half (a + 2 c + b) / 2 = before (a + b).
    return _Passages(before, 2.0 * before * largest / (largest + 2.0), largest)


def _progress(ends: Array, own: Array, slope: Array, passages: _Passages) -> MemberProgress:
    """Return one robot's progress: linear pieces, with two parabolas around each inner end."""
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
    # If no robot moves, there is one piece without length.
    kept[0] |= not kept.any()
    bounds = np.append(bounds[:-1][kept], bounds[-1])
    return MemberProgress(bounds, start[kept], rate[kept], bend[kept], float(own[-1]))
