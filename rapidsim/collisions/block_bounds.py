"""Bounds on the gaps of pairs in the intervals of a block of instants, and finer intervals.

Two bounds exclude intervals. The gaps at both ends, less the relative travel in between: cheap, but
a body that passes another travels far without coming nearer. So for surfaces, whose gaps cost most,
there is a second: along a fixed direction no point of a body is, between two instants, lower than
at the lower one of them, but for its acceleration. If a plane parts the bodies at all instants of
an interval, the least of the spaces along its normal is a bound for all of it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rapidsim.collisions.body_distance import Bodies
from rapidsim.collisions.bounds import straight
from rapidsim.collisions.contact import FARTHEST_M
from rapidsim.collisions.convex import Index, Mask
from rapidsim.collisions.intervals import PairIntervals, unseen
from rapidsim.collisions.overlap import TOUCH_M
from rapidsim.collisions.scene import Scene
from rapidsim.collisions.travel import LONGEST, Travel
from rapidsim.frames.transform import Array, Transform
from rapidsim.repeated_rows import repeated

_AT_ONCE = 100_000
"""Number of pairs times instants whose bounds are computed at once."""


class BlockBounds:
    """Bounds on the gaps in one block of instants."""

    def __init__(self, scene: Scene, bodies: Bodies, times: Array, pairs: Index) -> None:
        """Place the bodies.

        Args:
            scene: Arms, bodies and pairs.
            bodies: Bodies of the scene.
            times: Instants (k,) [s].
            pairs: Pairs that exist in the block.
        """
        self._scene, self._bodies, self._pairs = scene, bodies, pairs
        self._first: Index = np.array([pair.first for pair in scene.pairs])
        self._second: Index = np.array([pair.second for pair in scene.pairs])
        self._touch_only = np.array([pair.touch_only for pair in scene.pairs])
        self.poses = scene.poses(times)
        """Poses at these instants, then at those within steps."""
        self._steps = len(times)
        self.travel = Travel(scene, bodies.bounds, self.poses, pairs)

    def initial_intervals(self) -> PairIntervals:
        """Return the longest intervals of pairs that bounds of the bodies leave undecided."""
        pairs, last = self._pairs, self._steps - 1
        nodes: Index = np.unique(np.append(np.arange(0, self._steps, LONGEST), last))
        start, end = np.arange(len(nodes) - 1), np.arange(1, len(nodes))
        some = max(1, _AT_ONCE // len(nodes))
        found = []
        for begin in range(0, max(1, len(pairs)), some):
            pair = pairs[begin : begin + some]
            every = np.repeat(pair, len(nodes)), np.tile(nodes, len(pair))
            near = self._bounded(*every).reshape(len(pair), len(nodes))
            each, at = np.repeat(pair, len(start)), np.tile(start, len(pair))
            stretches = unseen(
                each,
                nodes[at],
                nodes[np.tile(end, len(pair))],
                near[:, :-1].reshape(-1),
                near[:, 1:].reshape(-1),
            )
            wanted = np.where(self._touch_only[each], -TOUCH_M, FARTHEST_M)
            found.append(stretches.rows(self.least(stretches) < wanted))
        return found[0].and_also(*found[1:])

    def seen(self, pair: Index, at: Index) -> Transform:
        """Return second_from_first of pairs (k,) at instants (k,)."""
        return self.poses.seen(self._first[pair], self._second[pair], at)

    def lasts(self, some: PairIntervals) -> Array:
        """Return the lengths (k,) [s] of intervals."""
        times = self.poses.times
        lasts: Array = times[some.end] - times[some.start]
        return lasts

    def several(self, some: PairIntervals) -> Mask:
        """Mask of intervals of several steps."""
        found: Mask = self._whole(some) & (some.end - some.start > 1)
        return found

    def least(self, some: PairIntervals) -> Array:
        """Return lower bounds (k,) [m] of the gaps within intervals."""
        by_travel = 0.5 * (some.gap_start + some.gap_end - self.approach(some))
        least: Array = np.maximum(by_travel, some.floor)
        return least

    def approach(self, some: PairIntervals) -> Array:
        """Return the most (k,) [m] by which a gap within, twice, is less than those at the ends."""
        way, whole = np.empty(len(some.pair)), self._whole(some)
        steps, parts = some.rows(whole), some.rows(~whole)
        way[whole] = self.travel.between(steps.pair, steps.start, steps.end)
        if len(parts.pair):
            seen = (self.seen(parts.pair, at) for at in (parts.start, parts.end))
            way[~whole] = straight(self._bodies.bounds, self._first[parts.pair], *seen)
        longest: Array = way + 2.0 * self._slack(some, whole)
        return longest

    def parted(self, some: PairIntervals) -> PairIntervals:
        """Return intervals of surfaces with the bounds by planes between the bodies.

        The normals are along the shortest way between the hulls of both in the middle.
        """
        pair, whole = some.pair, self._whole(some)
        first, second = self._first[pair], self._second[pair]
        middle = np.where(whole, (some.start + some.end) // 2, some.start)
        normal = self._bodies.normals_between(first, second, self.seen(pair, middle))
        count = np.where(whole, some.end - some.start + 1, 2)
        row, number = repeated(count)
        inner = np.where(whole[row], some.start[row] + number, some.end[row])
        seen = self.seen(pair[row], np.where(number == 0, some.start[row], inner))
        spaces = self._bodies.spaces(first, second, row, seen, normal)
        least = np.minimum.reduceat(spaces, np.cumsum(count) - count) - self._slack(some, whole)
        floor = np.where(least > 0.0, np.maximum(some.floor, least), some.floor)
        return replace(some, floor=floor, has_plane=np.ones(len(pair), dtype=np.bool_))

    def halves(self, some: PairIntervals, least: Array) -> tuple[PairIntervals, PairIntervals]:
        """Halve intervals; the gap in the middle is at least `least` (k,) [m]."""
        if not len(some.pair):
            return some, some
        middle: Index = (some.start + some.end) // 2
        within = (some.end - some.start == 1) | ~self._whole(some)
        bend = some.bend.copy()
        if within.any():
            times, first = self.poses.times, within & self._whole(some)
            bend[first] = self.travel.bend(some.pair[first], some.start[first])
            instants = 0.5 * (times[some.start[within]] + times[some.end[within]])
            distinct, place = np.unique(instants, return_inverse=True)
            middle[within] = len(times) + place
            self.poses = self.poses.and_also(self._scene.poses(distinct))
        near = np.maximum(least, self._bounded(some.pair, middle))
        no = np.zeros(len(near), dtype=np.bool_)
        some = replace(some, bend=bend, has_plane=no)
        return (
            replace(some, end=middle, gap_end=near, seen_end=no),
            replace(some, start=middle, gap_start=near, seen_start=no),
        )

    def _whole(self, some: PairIntervals) -> Mask:
        """Mask of intervals of whole steps; the others are within one."""
        found: Mask = np.maximum(some.start, some.end) < self._steps
        return found

    def _slack(self, some: PairIntervals, in_steps: Mask) -> Array:
        """Return the deviations (k,) [m] from straight lines between the instants of intervals."""
        slack = some.bend * self.lasts(some) ** 2 / 8.0
        steps = some.rows(in_steps)
        slack[in_steps] = self.travel.slack(steps.pair, steps.start, steps.end)
        return slack

    def _bounded(self, pair: Index, at: Index) -> Array:
        """Return lower bounds of the gaps of pairs (k,) at instants (k,) by bounding volumes."""
        first, second = self._first[pair], self._second[pair]
        return self._bodies.bounds.gaps(first, second, self.seen(pair, at))
