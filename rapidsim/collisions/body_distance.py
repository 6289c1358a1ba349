"""Distances between bodies of many parts, for many poses at once.

Bounding volumes of parts select the relevant parts; the exact distance is computed only for those.
Bodies with very many parts, such as the triangles of a casting, have bounds around groups of parts
as well.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rapidsim.collisions.bounds import Bounds
from rapidsim.collisions.convex import ConvexPart, ConvexParts, Index
from rapidsim.collisions.distance import distances
from rapidsim.collisions.overlap import TOUCH_M, depths, flat_overlaps, shortest
from rapidsim.frames.transform import Array, Transform
from rapidsim.values import value_class

_GROUPED = 64
"""Number of parts above which a body has groups."""
_IN_GROUP = 16
_ROWS_AT_ONCE = 400_000
_FEW = 400
"""Number of pairs of groups checked at once: fewer steps cost more than fewer pairs save."""
_CLOSE_M, _CLOSE = 5e-8, 2e-3
"""Absolute [m] and relative tolerance of gaps; the larger one applies."""
_EXACT_M, _EXACT = 2.0 * _CLOSE_M, 2.0 * _CLOSE
"""Error [m], and as a share, above which a gap counts as unknown."""


@value_class(frozen=True, slots=True, eq=False)
class Gaps:
    """Gaps between pairs of bodies (k,)."""

    least: Array
    """[m]: lower bounds of the gaps."""
    distances_found: Array
    """[m]: distance between two points; inf if no gap is below the requested one, -inf if the
    bodies overlap by more than is tolerated."""
    point: Array
    """Shape (k, 3): point of the second body nearest to the first."""


class Bodies:
    """Bodies, queried in pairs."""

    def __init__(self, bodies: Sequence[Sequence[ConvexPart]]) -> None:
        """Arrange the parts of all bodies, with parts near each other in groups."""
        parts: list[ConvexPart] = []
        groups: list[int] = []
        ends: list[int] = []
        for body in bodies:
            for group in _grouped(body):
                groups.append(len(parts))
                parts += group
            ends.append(len(groups))
        self._parts = ConvexParts(parts)
        self._group_ends = _from_to([*groups, len(parts)])
        self._groups_of = _from_to([0, *ends])
        self._part_bounds = Bounds(self._parts.low, self._parts.high, self._parts.bound)
        self._group_bounds = _around(self._part_bounds, self._group_ends)
        self.bounds = _around(self._group_bounds, self._groups_of)
        """Bounds of the bodies."""

    def gaps(
        self, first: Index, second: Index, second_from_first: Transform, enough: Array
    ) -> Gaps:
        """Return the gaps of pairs of bodies.

        Args:
            first: Indices of the first bodies (k,).
            second: Indices of the second bodies (k,); points and directions are in their frames.
            second_from_first: Poses of the first bodies (k,).
            enough: Gap (k,) [m] above which a lower bound suffices.
        """
        count = len(first)
        gaps = Gaps(np.full(count, np.inf), np.full(count, np.inf), np.zeros((count, 3)))
        sizes = self._count(first) * self._count(second)
        ends = np.cumsum(sizes)
        start = 0
        while start < count:
            before = ends[start - 1] if start else 0
            end = max(start + 1, int(np.searchsorted(ends, before + _ROWS_AT_ONCE, side="right")))
            some = slice(start, end)
            self._fill(gaps, some, first[some], second[some], second_from_first[some], enough[some])
            start = end
        return gaps

    def depths(
        self, first: Index, second: Index, second_from_first: Transform, *, exact: bool
    ) -> Array:
        """Return penetration depths (k,) [m] of pairs, of their deepest parts; 0 if disjoint.

        Args:
            first: Indices of the first bodies (k,).
            second: Indices of the second bodies (k,).
            second_from_first: Poses of the first bodies (k,).
            exact: Whether to find the shortest separation of the deepest parts, not just any.
        """
        found = np.zeros(len(first))
        pairs, row = _all_pairs(self._groups_of, first, second, np.arange(len(first)))
        near = self._group_bounds.gaps(*pairs, second_from_first[row]) < 0.0
        pairs, row = _all_pairs(self._group_ends, pairs[0][near], pairs[1][near], row[near])
        near = self._part_bounds.gaps(*pairs, second_from_first[row]) < 0.0
        part_a, part_b, row = pairs[0][near], pairs[1][near], row[near]
        got = distances(self._parts, part_a, part_b, second_from_first[row], 0.0, _CLOSE_M)
        hulls = np.isneginf(got.distances_found)
        np.maximum.at(found, row[~hulls], -got.distances_found[~hulls])
        part_a, part_b, row = part_a[hulls], part_b[hulls], row[hulls]
        deep, _ = depths(self._parts, part_a, part_b, second_from_first[row])
        if exact:
            order = np.lexsort((-deep, row))
            best = order[np.flatnonzero(np.diff(row[order], prepend=-1))]
            part_a, part_b, row = part_a[best], part_b[best], row[best]
            deep = shortest(self._parts, part_a, part_b, second_from_first[row])
        np.maximum.at(found, row, deep)
        return found

    def _count(self, body: Index) -> Index:
        begin, end = self._groups_of[body].T
        count: Index = end - begin
        return count

    def _fill(
        self,
        gaps: Gaps,
        some: slice,
        first: Index,
        second: Index,
        second_from_first: Transform,
        enough: Array,
    ) -> None:
        (group_a, group_b), item = _all_pairs(self._groups_of, first, second, np.arange(len(first)))
        near = self._group_bounds.gaps(group_a, group_b, second_from_first[item])
        sizes = self._count(first) * self._count(second)
        starts = np.cumsum(sizes) - sizes
        nearest = np.minimum.reduceat(near, starts)
        bound = enough.copy()
        table = (item, group_a, group_b)
        more = near < bound[item]
        if np.count_nonzero(more) > _FEW:
            # The nearest pair of bounds first: its gap makes most others unnecessary.
            best = np.lexsort((near, item))[starts]
            self._narrow(gaps, some, best[nearest < bound], bound, table, second_from_first)
            bound = np.minimum(bound, gaps.distances_found[some])
            more = near < bound[item]
            more[best] = False
        self._narrow(gaps, some, np.flatnonzero(more), bound, table, second_from_first)
        # Pairs that were not checked, or not completely, are no nearer than requested.
        found = gaps.distances_found[some] - _slack(gaps.distances_found[some])
        gaps.least[some] = np.maximum(nearest, np.minimum(bound, found))

    def _narrow(
        self,
        gaps: Gaps,
        some: slice,
        rows: Index,
        bound: Array,
        table: tuple[Index, Index, Index],
        second_from_first: Transform,
    ) -> None:
        """Compute the gaps of all parts in pairs of groups."""
        if not len(rows):
            return
        item, group_a, group_b = table
        (part_a, part_b), row = _all_pairs(
            self._group_ends, group_a[rows], group_b[rows], item[rows]
        )
        near = self._part_bounds.gaps(part_a, part_b, second_from_first[row])
        wanted = near < bound[row]
        row, part_a, part_b = row[wanted], part_a[wanted], part_b[wanted]
        if not len(row):
            return
        got = distances(
            self._parts, part_a, part_b, second_from_first[row], bound[row], _CLOSE_M, _CLOSE
        )
        value, point = got.distances_found.copy(), got.second.copy()
        over = np.flatnonzero(np.isneginf(value))
        while len(over):
            # First one part of each pair of bodies: if it is deep inside, the others add no
            # information.
            some_rows, first = np.unique(row[over], return_index=True)
            tried = over[first]
            a, pose = part_a[tried], second_from_first[row[tried]]
            deep, out = flat_overlaps(self._parts, a, part_b[tried], pose)
            value[tried] = np.where(deep <= TOUCH_M, -deep, -np.inf)
            back = np.einsum("kji,kj->ki", pose.rotation, out)
            point[tried] = pose.apply(self._parts.farthest(a, -back))
            over = np.delete(over, first)
            known = np.isin(row[over], some_rows[deep > TOUCH_M])
            value[over[known]] = np.inf
            over = over[~known]
        # If the search stopped early, its result is not the gap.
        overlap = np.isneginf(got.distances_found)
        exact = overlap | (
            got.distances_found - np.where(overlap, 0.0, got.least) < _slack(got.distances_found)
        )
        value = np.where(exact, value, np.maximum(got.least, bound[row]))
        order = np.lexsort((value, row))
        firsts = order[np.flatnonzero(np.diff(row[order], prepend=-1))]
        at = row[firsts] + some.start
        better = value[firsts] < gaps.distances_found[at]
        at, firsts = at[better], firsts[better]
        is_gap = exact[firsts]
        gaps.distances_found[at[is_gap]] = value[firsts[is_gap]]
        gaps.point[at] = point[firsts]


def _slack(gap: Array) -> Array:
    """Return the amounts (k,) [m] by which gaps may be smaller than found; `_EXACT_M` at least."""
    slack: Array = np.maximum(_EXACT_M, _EXACT * np.where(np.isfinite(gap), gap, 0.0))
    return slack


def _from_to(edges: Sequence[int]) -> Index:
    """Return start and end of each of some consecutive ranges, (n, 2)."""
    return np.column_stack([edges[:-1], edges[1:]]).astype(np.int64)


def _all_pairs(
    within: Index, first: Index, second: Index, row: Index
) -> tuple[tuple[Index, Index], Index]:
    """Return all pairs of elements of the first and second ranges (k,), and their rows (k,)."""
    (begin_a, end_a), (begin_b, end_b) = within[first].T, within[second].T
    wide, count = end_b - begin_b, (end_a - begin_a) * (end_b - begin_b)
    each = np.repeat(np.arange(len(first)), count)
    number = np.arange(len(each)) - np.repeat(np.cumsum(count) - count, count)
    across, down = np.divmod(number, wide[each])
    return (begin_a[each] + across, begin_b[each] + down), row[each]


def _around(bounds: Bounds, groups: Index) -> Bounds:
    """Return bounds of groups (n, 2) of consecutive elements."""
    starts = groups[:, 0]
    low = np.minimum.reduceat(bounds.low, starts, axis=0)
    high = np.maximum.reduceat(bounds.high, starts, axis=0)
    middle = np.repeat(0.5 * (low + high), groups[:, 1] - starts, axis=0)
    reach = np.linalg.norm(bounds.centre - middle, axis=1) + bounds.bound
    return Bounds(low, high, np.maximum.reduceat(reach, starts))


def _grouped(body: Sequence[ConvexPart]) -> list[list[ConvexPart]]:
    """Return the parts of a body, one per group, or grouped by nearness if there are many."""
    if len(body) <= _GROUPED:
        return [[part] for part in body]
    centres = np.array([part.centre for part in body])
    groups: list[list[ConvexPart]] = []
    waiting: list[Index] = [np.arange(len(body))]
    while waiting:
        some = waiting.pop()
        if len(some) <= _IN_GROUP:
            groups.append([body[number] for number in some.tolist()])
            continue
        axis = int(np.ptp(centres[some], axis=0).argmax())
        order = some[np.argsort(centres[some, axis], kind="stable")]
        waiting += [order[len(order) // 2 :], order[: len(order) // 2]]
    return groups
