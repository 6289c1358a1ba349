"""Offsets of an arm from its path along a block that follows belts.

Where an arm begins or ends to follow a belt, the weight of the offset is a polynomial of the fifth
degree of the path parameter between the corners of that segment: with speed and acceleration
continuous. In a corner next to a segment that follows the belt the weight is 1, so the corner keeps
its shape on the belt.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.belts import BeltRide
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.geometry.segments import Segment
from rapidsim.values import value_class

_ROUNDING = 1e-9
_LEAST_RAMP = 0.5
"""Share of a segment over which the weight changes at least, however large its zones are."""


@value_class(frozen=True, slots=True, eq=False)
class _Span:
    segment: int
    ride: BeltRide
    start: float
    """Path parameter [m] from which on the weight changes."""
    width: float

    def weights(self, s: Array) -> Array:
        """Return the weights (k,) at s (k,) [m]."""
        ride = self.ride
        if not ride.changes:
            return np.full(len(s), ride.begin)
        share = np.clip((s - self.start) / self.width, 0.0, 1.0)
        risen = share**3 * (10.0 + share * (6.0 * share - 15.0))
        return ride.begin + (ride.end - ride.begin) * risen


@value_class(frozen=True, slots=True, eq=False)
class BeltOffsets:
    """Offsets of one path."""

    spans: tuple[_Span, ...]

    def at(self, segment: Index, s: Array, axis: Array, times: Array) -> Array:
        """Return offsets (k, 3) [m] in base.

        Args:
            segment: Index (k,) of the segment.
            s: Path parameters (k,) [m].
            axis: Positions (k,) [m] of the axis that stands for the belt.
            times: Times (k,) [s].
        """
        offsets = np.zeros((len(s), 3))
        for one in self.spans:
            at = np.flatnonzero(segment == one.segment)
            if not len(at):
                continue
            ahead = one.ride.course.at(times[at]) - one.ride.zero - axis[at]
            offsets[at] += (one.weights(s[at]) * ahead)[:, None] * one.ride.direction
        return offsets

    def riding(self, segment: int, s: float) -> tuple[BeltRide, ...]:
        """Return the belts that an arm at rest at s [m] follows, each with its weight there."""
        spans = [one for one in self.spans if one.segment == segment]
        weights = [float(one.weights(np.array([s]))[0]) for one in spans]
        return tuple(
            replace(one.ride, begin=weight, end=weight)
            for one, weight in zip(spans, weights, strict=True)
            if weight > _ROUNDING
        )


def belt_offsets(segments: Sequence[Segment], bounds: Array) -> BeltOffsets | None:
    """Return the offsets of a path; None if no segment follows a belt.

    Args:
        segments: Segments of the path.
        bounds: Path parameters [m] at their ends, shape (segments + 1,).
    """
    spans: list[_Span] = []
    for number, segment in enumerate(segments):
        if not segment.rides:
            continue
        start, end = bounds[number : number + 2].tolist()
        length = end - start
        most = 0.5 * (1.0 - _LEAST_RAMP) * length
        for ride in segment.rides:
            # Not those of the corners, which depend on moves that may not be known yet.
            before, after = (min(radius, most) for radius in ride.zones)
            spans.append(_Span(number, ride, start + before, length - before - after))
    return BeltOffsets(tuple(spans)) if spans else None
