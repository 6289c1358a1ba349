"""Search for the nearest parts of pairs of bodies, for many pairs and poses at once.

Pairs of nodes of both trees are followed down to the parts; nodes farther apart than the smallest
gap so far are dropped. So a small gap must be found early: from the nearest points of bodies around
both (`slide`), or by following only the nearest nodes first (`_descend`).
"""

from __future__ import annotations

import numpy as np

from rapidsim.collisions.bounds_tree import (
    BoundsTrees,
    NodePairs,
    best_first,
    first_of_each,
)
from rapidsim.collisions.convex import Index, Mask
from rapidsim.collisions.distance import distances
from rapidsim.collisions.overlap import TOUCH_M, flat_overlaps
from rapidsim.frames.transform import Array, Transform
from rapidsim.repeated_rows import repeated

_ROWS_AT_ONCE = 400_000
_FEW = 400
"""Number of pairs of nodes followed at once: fewer steps cost more than fewer pairs save."""
_BEAM = 32
"""Number of pairs of nodes that are followed to find a first gap of surfaces; else it is one."""
_SLIDES, _AT_POINT = 6, 3
"""Largest number of steps from nearest points to nearer ones, and of parts near a point."""
CLOSE_M, CLOSE = 5e-8, 2e-3
"""Absolute tolerance [m] of gaps by default, and relative one; the larger applies."""


class NearestParts:
    """Search for the nearest parts of pairs of bodies (k,), the queries."""

    def __init__(
        self,
        trees: BoundsTrees,
        second_from_first: Transform,
        enough: Array,
        close: Array | float,
        share: float,
        least: Array,
        surfaces: Mask,
    ) -> None:
        """Start with no gap found."""
        self._beam = np.where(surfaces, _BEAM, 1)
        self._share = np.where(surfaces, share, CLOSE)
        self._close = np.broadcast_to(np.asarray(close), (len(enough),))
        self._parts, self._trees, self.seen = trees.parts, trees, second_from_first
        self.least = least.copy()
        """[m]: known lower bounds of the gaps."""
        self.found = np.full(len(enough), np.inf)
        """[m]: gaps, as `Gaps.distances_found`."""
        self.point = np.zeros((len(enough), 3))
        self._first_point = np.zeros((len(enough), 3))
        """Shape (k, 3): points of the first bodies nearest to those of the second."""
        self.found_of = np.full((len(enough), 2), -1)
        """Shape (k, 2): parts between which the gap was found."""
        self.limit = np.array(enough)
        """[m]: bounds above which pairs of nodes are irrelevant."""

    def tolerance(self, query: Index, gap: Array) -> Array:
        """Return the tolerances (k,) [m] of gaps of queries (k,)."""
        share = self._share[query] * np.where(np.isfinite(gap), gap, 0.0)
        tolerance: Array = np.maximum(self._close[query], share)
        return tolerance

    def follow(self, pairs: NodePairs) -> None:
        """Follow pairs of nodes down to the parts, the nearest first where there are many."""
        waiting = [pairs]
        while waiting:
            pairs = waiting.pop()
            pairs = pairs.rows(self._matters(pairs))
            is_bounded = False
            while len(pairs.query):
                if len(pairs.query) > _FEW and not is_bounded:
                    self._descend(pairs)
                    pairs, is_bounded = pairs.rows(self._matters(pairs)), True
                    continue
                leaf = self._trees.is_leaf(pairs)
                if leaf.all():
                    self._measure_nearest_first(pairs)
                    break
                if len(pairs.query) > _ROWS_AT_ONCE:
                    order = np.argsort(pairs.near, kind="stable")
                    half = len(order) // 2
                    waiting += [
                        pairs.rows(np.sort(order[half:])),
                        pairs.rows(np.sort(order[:half])),
                    ]
                    break
                below = self._trees.below(pairs.rows(~leaf), self.seen, self.limit)
                pairs = pairs.rows(leaf).and_also(below)
                pairs = pairs.rows(self._matters(pairs))

    def slide(self, roots: NodePairs, first: Array, second: Array) -> None:
        """Measure parts near points, and near the nearest points of those, while gaps shrink.

        Args:
            roots: Pairs of bodies (k,).
            first: Points (k, 3) near the first bodies, in the frames of the second.
            second: Points (k, 3) near the second bodies.
        """
        for _ in range(_SLIDES):
            query = roots.query
            if not len(query):
                return
            part_a, row_a = self._trees.parts_at(
                roots.first, self.seen[query].inverse().apply(second), _AT_POINT
            )
            part_b, row_b = self._trees.parts_at(roots.second, first, _AT_POINT)
            row, a, b = _matches(row_a, row_b)
            before = self.found[query]
            self.measure(NodePairs(query[row], part_a[a], part_b[b], self.least[query[row]]))
            found = self.found[query]
            on = np.isfinite(found) & (found + self.tolerance(query, found) < before)
            on &= self.limit[query] > -np.inf
            roots = roots.rows(on)
            first, second = self._first_point[roots.query], self.point[roots.query]

    def _matters(self, pairs: NodePairs) -> Mask:
        limit = self.limit[pairs.query]
        return pairs.near < limit

    def _descend(self, pairs: NodePairs) -> None:
        """Measure some pairs of parts of each query, found by following the nearest nodes."""
        pairs = pairs.rows(first_of_each(pairs.query, pairs.near, self._beam[pairs.query]))
        while True:
            leaf = self._trees.is_leaf(pairs)
            if leaf.all():
                break
            below = self._trees.below(pairs.rows(~leaf), self.seen, self.limit)
            pairs = pairs.rows(leaf).and_also(below)
            pairs = pairs.rows(self._matters(pairs))
            pairs = pairs.rows(first_of_each(pairs.query, pairs.near, self._beam[pairs.query]))
        self._measure_nearest_first(pairs)

    def _measure_nearest_first(self, pairs: NodePairs) -> None:
        batches = best_first(
            pairs.query, pairs.near, lambda waiting: self._matters(pairs.rows(waiting))
        )
        for some in batches:
            self.measure(pairs.rows(some))

    def measure(self, pairs: NodePairs) -> None:
        """Compute the gaps of pairs of parts."""
        known = self.found_of[pairs.query]
        known_ones = (pairs.first == known[:, 0]) & (pairs.second == known[:, 1])
        pairs = pairs.rows(self._matters(pairs) & ~known_ones)
        if not len(pairs.query):
            return
        row, part_a, part_b = pairs.query, pairs.first, pairs.second
        limit, seen = self.limit[row], self.seen[row]
        got = distances(self._parts, part_a, part_b, seen, limit, self._close[row], CLOSE)
        value, point = got.distances_found.copy(), got.second.copy()
        over = np.flatnonzero(np.isneginf(value))
        _, first = np.unique(row[over], return_index=True)
        deep_inside = np.zeros(len(self.found), dtype=np.bool_)
        # First one pair of parts of each query: if it is deep inside, the others add no
        # information.
        for tried in (over[first], np.delete(over, first)):
            value[tried] = np.inf
            tried = tried[~deep_inside[row[tried]]]
            a, pose = part_a[tried], seen[tried]
            deep, out = flat_overlaps(self._parts, a, part_b[tried], pose)
            value[tried] = np.where(deep <= TOUCH_M, -deep, -np.inf)
            deep_inside[row[tried[deep > TOUCH_M]]] = True
            back = np.einsum("kji,kj->ki", pose.rotation, out)
            point[tried] = pose.apply(self._parts.farthest(a, -back))
        # If the search stopped early, its result is not the gap.
        overlap = np.isneginf(got.distances_found)
        exact = overlap | (
            got.distances_found - np.where(overlap, 0.0, got.least)
            < 1.01 * self.tolerance(row, got.distances_found)
        )
        value = np.where(exact, value, np.inf)
        order = np.lexsort((value, row))
        nearest = order[np.flatnonzero(np.diff(row[order], prepend=-1))]
        nearest = nearest[value[nearest] < self.found[row[nearest]]]
        at, gap = row[nearest], value[nearest]
        self.found[at], self.point[at] = gap, point[nearest]
        self._first_point[at] = got.first[nearest]
        self.found_of[at] = np.column_stack([part_a[nearest], part_b[nearest]])
        tolerance = self.tolerance(at, gap)
        is_least = gap - self.least[at] < 2.0 * tolerance
        self.limit[at] = np.where(is_least, -np.inf, np.minimum(self.limit[at], gap - tolerance))


def _matches(first: Index, second: Index) -> tuple[Index, Index, Index]:
    """Return all pairs of elements with equal keys in two sorted lists (k,), (m,).

    Returns:
        Their keys, and their indices in either list.
    """
    begin, end = (np.searchsorted(second, first, side=one) for one in ("left", "right"))
    a, number = repeated(end - begin)
    return first[a], a, begin[a] + number
