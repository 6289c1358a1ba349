"""Progress of each robot on its own path as a function of a common parameter.

Segment k of all paths begins and ends at the same time. The common parameter is nominal time: along
segment k it grows by the time of the robot that needs longest at its own programmed speeds. In
between, each robot's position is proportional to it; around fly-by points, where the ratio may
change, the robots' rates change linearly and the parameter keeps its pace.

Source: logs of two synchronised arms (docs/fidelity.md). Moves of equal nominal time take equal
time however much the lengths and speeds of the single robots jump, so the programmed speed of one
robot is no limit at an instant in a zone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.geometry.segments import Segment, Speed, Zone
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.path.nominal_times import NominalTimes
from rapidsim.values import value_class

PACE = 0.25
"""Rate [m/s] of the common parameter at the programmed speeds: nominal time as a length, on the
scale of the paths of single robots."""


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
    zones: Array
    """Shape (segments - 1,): extent [m] of the zone on either side of each inner end."""
    members: tuple[MemberProgress, ...]
    slowest: Index
    """Shape (segments,): number of the robot that determines the nominal time of each segment."""
    turns: Mask
    """Shape (segments,): whether that is its reorientation, not its TCP speed."""


def shared_progress(
    rows: Sequence[Sequence[Segment]],
    own: Sequence[Array],
    nominal: Sequence[NominalTimes],
    stops: Mask,
) -> SharedProgress:
    """Return the progress of several robots in synchronised motion.

    Args:
        rows: The segments of each robot.
        own: Segment ends on the robot's own path, (segments + 1,) [m].
        nominal: Times of the robot's segments.
        stops: Shape (segments - 1,): mask of the segment ends where a robot, and thus all of
            them, stop.
    """
    lengths = np.array([np.diff(one) for one in own])
    times = np.array([one.times for one in nominal])
    slowest = times.argmax(axis=0)
    common: Array = PACE * times.max(axis=0)
    # Where nothing that has a programmed speed moves, the parameter only needs some extent.
    common = np.where(common > 0.0, common, lengths.max(axis=0))
    slopes = lengths / np.where(common > 0.0, common, 1.0)
    segments = tuple(
        _common_segment([row[k] for row in rows], slopes[:, k], float(common[k]) / PACE)
        for k in range(len(common))
    )
    zones = np.array([one.zone.position if one.zone else 0.0 for one in segments[:-1]])
    # A zone takes at most half of either segment.
    half = np.where(stops, 0.0, np.minimum(zones, 0.5 * np.minimum(common[:-1], common[1:])))
    ends = np.concatenate([[0.0], np.cumsum(common)])
    members = tuple(
        _progress(ends, places, slope, half) for places, slope in zip(own, slopes, strict=True)
    )
    turns = np.array([one.turns for one in nominal])[slowest, np.arange(len(slowest))]
    return SharedProgress(segments, ends, half, members, slowest, turns)


def _common_segment(segments: Sequence[Segment], slopes: Array, time_s: float) -> Segment:
    """Return the data of one segment of all robots for timing and the path queue."""
    pairs = zip(segments, slopes.tolist(), strict=True)
    zones = [one.zone.position / rate for one, rate in pairs if one.zone and rate > 0.0]
    stops = any(one.zone is None for one in segments)
    is_timed = any(one.duration is not None for one in segments)
    return replace(
        segments[0],
        speed=Speed(PACE, PACE),
        zone=None if stops else Zone(max(zones, default=0.0), max(zones, default=0.0), 0.0),
        duration=time_s if is_timed else None,
        acceleration_share=min(one.acceleration_share for one in segments),
        load=max(one.load for one in segments),
        tcp_acceleration=np.inf,
        tcp_deceleration=np.inf,
        world_acceleration=np.inf,
    )


def _progress(ends: Array, own: Array, slope: Array, half: Array) -> MemberProgress:
    """Return one robot's progress: linear pieces, with a parabola around each inner end.

    Around the end of a segment its rate changes linearly from that of the segment to that of the
    next, which takes as long as both rates one after the other: half (a + b) of its own path.
    """
    into, out = slope[:-1], slope[1:]
    inner, at = ends[1:-1], own[1:-1]
    steep = np.where(half > 0.0, 2.0 * half, 1.0)
    straight = (
        np.append(0.0, inner + half),
        np.append(own[0], at + out * half),
        slope,
        np.zeros(len(slope)),
    )
    corner = (inner - half, at - into * half, into, (out - into) / steep)
    bounds, start, rate, bend = (
        np.insert(s, np.arange(1, len(s)), one) for s, one in zip(straight, corner, strict=True)
    )
    bounds = np.append(bounds, ends[-1])
    kept = np.diff(bounds) > 0.0
    # If no robot moves, there is one piece without length.
    kept[0] |= not kept.any()
    bounds = np.append(bounds[:-1][kept], bounds[-1])
    return MemberProgress(bounds, start[kept], rate[kept], bend[kept], float(own[-1]))
