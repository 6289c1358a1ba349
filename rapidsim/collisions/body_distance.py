"""How far bodies of many parts are from each other, for many poses at once.

Spheres around parts say which parts matter; only for those the exact distance is found. Bodies of
very many parts, such as the triangles of a casting, have spheres around groups of them as well.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rapidsim.collisions.convex import ConvexPart, Index, Parts
from rapidsim.collisions.distance import distances
from rapidsim.collisions.overlap import TOUCH_M, depth, flat_overlap
from rapidsim.frames.transform import Array, Transform

_GROUPED = 64
"""A body of more parts has them in groups."""
_IN_GROUP = 16
_ROWS_AT_ONCE = 400_000
_EXACT_M = 1e-7


@dataclass(frozen=True, slots=True, eq=False)
class Gaps:
    """What is known of pairs of bodies (k,)."""

    least: Array
    """[m]: the bodies are no nearer."""
    found: Array
    """[m]: of two points that were found; inf where nothing nearer than asked for is, -inf where
    the bodies overlap by more than they may."""
    point: Array
    """Shape (k, 3): where the second body is nearest to the first."""


class Bodies:
    """Bodies, asked in pairs."""

    def __init__(self, bodies: Sequence[Sequence[ConvexPart]]) -> None:
        """Lay out the parts of all bodies, those that are near each other together."""
        parts: list[ConvexPart] = []
        groups: list[tuple[int, int]] = []
        self._groups_of: list[tuple[int, int]] = []
        for body in bodies:
            start = len(groups)
            for group in _grouped(body):
                groups.append((len(parts), len(parts) + len(group)))
                parts += group
            self._groups_of.append((start, len(groups)))
        self._parts = Parts(parts)
        self._part_groups = groups
        self._group_ends: Index = np.array(groups, dtype=np.int64).reshape(-1, 2)
        spheres = [_sphere(self._parts, begin, end) for begin, end in groups]
        self._group_centre = np.array([centre for centre, _ in spheres]).reshape(-1, 3)
        self._group_bound = np.array([bound for _, bound in spheres])
        whole = [self._whole(begin, end) for begin, end in self._groups_of]
        self.centre = np.array([centre for centre, _ in whole]).reshape(-1, 3)
        """Shape (b, 3): the middle of a sphere around each body."""
        self.bound = np.array([bound for _, bound in whole])
        """Shape (b,) [m]: its radius."""
        low_high = [self._box(begin, end) for begin, end in self._groups_of]
        self.low = np.array([low for low, _ in low_high]).reshape(-1, 3)
        """Shape (b, 3): the lower corner of a box around each body."""
        self.high = np.array([high for _, high in low_high]).reshape(-1, 3)
        self._pairs: dict[tuple[int, int], tuple[Index, Index]] = {}

    def gaps(
        self, first: Index, second: Index, second_from_first: Transform, enough: Array
    ) -> Gaps:
        """Gaps of pairs of bodies.

        Args:
            first: Which body (k,).
            second: Which other (k,); places and directions are in its frame.
            second_from_first: Where the first ones are (k,).
            enough: From which gap (k,) [m] on a lower bound will do.
        """
        count = len(first)
        gaps = Gaps(np.full(count, np.inf), np.full(count, np.inf), np.zeros((count, 3)))
        sizes = [
            len(self._rows(a, b)[0]) for a, b in zip(first.tolist(), second.tolist(), strict=True)
        ]
        ends = np.cumsum(sizes)
        start = 0
        while start < count:
            before = ends[start - 1] if start else 0
            end = max(start + 1, int(np.searchsorted(ends, before + _ROWS_AT_ONCE, side="right")))
            some = slice(start, end)
            self._fill(gaps, some, first[some], second[some], second_from_first[some], enough[some])
            start = end
        return gaps

    def depth(self, first: int, second: int, second_from_first: Transform) -> float:
        """How far [m] two bodies overlap: the deepest of their parts; 0 where none do.

        Args:
            first: Which body.
            second: Which other.
            second_from_first: Where the first one is, a single transform.
        """
        part_a, part_b = (
            a.reshape(-1)
            for a in np.meshgrid(self._parts_of(first), self._parts_of(second), indexing="ij")
        )
        item = np.zeros(len(part_a), dtype=np.int64)
        pose = Transform(second_from_first.rotation[None], second_from_first.translation[None])
        spheres = (self._parts.centre, self._parts.bound)
        near = self._between_spheres(pose, item, spheres, part_a, part_b) < 0.0
        part_a, part_b = part_a[near], part_b[near]
        if not len(part_a):
            return 0.0
        poses = pose[np.zeros(len(part_a), dtype=np.int64)]
        got = distances(self._parts, part_a, part_b, poses, 0.0)
        deepest = max(0.0, -float(np.where(np.isneginf(got.found), 0.0, got.found).min()))
        for k in np.flatnonzero(np.isneginf(got.found)).tolist():
            a, b = int(part_a[k]), int(part_b[k])
            deepest = max(deepest, depth(self._parts, a, b, second_from_first, deepest))
        return deepest

    def _parts_of(self, body: int) -> Index:
        begin, end = self._groups_of[body]
        return np.arange(self._part_groups[begin][0], self._part_groups[end - 1][1])

    def _fill(
        self,
        gaps: Gaps,
        some: slice,
        first: Index,
        second: Index,
        second_from_first: Transform,
        enough: Array,
    ) -> None:
        tables = [self._rows(a, b) for a, b in zip(first.tolist(), second.tolist(), strict=True)]
        sizes = np.array([len(a) for a, _ in tables])
        item = np.repeat(np.arange(len(first)), sizes)
        group_a = np.concatenate([a for a, _ in tables])
        group_b = np.concatenate([b for _, b in tables])
        near = self._between_spheres(
            second_from_first, item, (self._group_centre, self._group_bound), group_a, group_b
        )
        starts = np.cumsum(sizes) - sizes
        nearest = np.minimum.reduceat(near, starts)
        bound = enough.copy()
        table = (item, group_a, group_b)
        # The nearest pair of spheres first: what is found there makes most others needless.
        best = np.lexsort((near, item))[starts]
        self._narrow(gaps, some, best[nearest < bound], bound, table, second_from_first)
        bound = np.minimum(bound, gaps.found[some])
        more = near < bound[item]
        more[best] = False
        self._narrow(gaps, some, np.flatnonzero(more), bound, table, second_from_first)
        # All that was not looked at, or not to its end, is no nearer than was asked for.
        gaps.least[some] = np.maximum(nearest, np.minimum(bound, gaps.found[some]))

    def _narrow(
        self,
        gaps: Gaps,
        some: slice,
        rows: Index,
        bound: Array,
        table: tuple[Index, Index, Index],
        second_from_first: Transform,
    ) -> None:
        """Find the gaps of all parts in pairs of groups."""
        if not len(rows):
            return
        item, group_a, group_b = table
        begin_a, end_a = self._group_ends[group_a[rows]].T
        begin_b, end_b = self._group_ends[group_b[rows]].T
        wide, count = end_b - begin_b, (end_a - begin_a) * (end_b - begin_b)
        each = np.repeat(np.arange(len(rows)), count)
        within = np.arange(len(each)) - np.repeat(np.cumsum(count) - count, count)
        part_a = begin_a[each] + within // wide[each]
        part_b = begin_b[each] + within % wide[each]
        row = item[rows][each]
        spheres = (self._parts.centre, self._parts.bound)
        near = self._between_spheres(second_from_first, row, spheres, part_a, part_b)
        wanted = near < bound[row]
        row, part_a, part_b = row[wanted], part_a[wanted], part_b[wanted]
        if not len(row):
            return
        got = distances(self._parts, part_a, part_b, second_from_first[row], bound[row])
        value, point = got.found.copy(), got.second.copy()
        for k in np.flatnonzero(np.isneginf(value)).tolist():
            pose = second_from_first[int(row[k])]
            deep, out = flat_overlap(self._parts, int(part_a[k]), int(part_b[k]), pose)
            value[k] = -deep if deep <= TOUCH_M else -np.inf
            inmost = self._parts.farthest(part_a[[k]], -(out @ pose.rotation)[None])[0]
            point[k] = pose.apply(inmost)
        # Where the search stopped early, what it found is not the gap.
        overlap = np.isneginf(got.found)
        exact = overlap | (got.found - np.where(overlap, 0.0, got.least) < _EXACT_M)
        value = np.where(exact, value, np.maximum(got.least, bound[row]))
        order = np.lexsort((value, row))
        firsts = order[np.flatnonzero(np.diff(row[order], prepend=-1))]
        at = row[firsts] + some.start
        better = value[firsts] < gaps.found[at]
        at, firsts = at[better], firsts[better]
        is_gap = exact[firsts]
        gaps.found[at[is_gap]] = value[firsts[is_gap]]
        gaps.point[at] = point[firsts]

    def _between_spheres(
        self,
        second_from_first: Transform,
        item: Index,
        spheres: tuple[Array, Array],
        a: Index,
        b: Index,
    ) -> Array:
        centre, bound = spheres
        apart = np.einsum("kij,kj->ki", second_from_first.rotation[item], centre[a])
        apart += second_from_first.translation[item] - centre[b]
        gap: Array = np.sqrt(np.einsum("kj,kj->k", apart, apart)) - bound[a] - bound[b]
        return gap

    def _rows(self, first: int, second: int) -> tuple[Index, Index]:
        """All pairs of groups of two bodies."""
        key = (first, second)
        if key not in self._pairs:
            a, b = np.meshgrid(
                np.arange(*self._groups_of[first]),
                np.arange(*self._groups_of[second]),
                indexing="ij",
            )
            self._pairs[key] = (a.reshape(-1), b.reshape(-1))
        return self._pairs[key]

    def _whole(self, begin: int, end: int) -> tuple[Array, float]:
        low, high = self._box(begin, end)
        centre = 0.5 * (low + high)
        apart = np.linalg.norm(self._group_centre[begin:end] - centre, axis=1)
        ball = float((apart + self._group_bound[begin:end]).max())
        return centre, min(ball, float(0.5 * np.linalg.norm(high - low)))

    def _box(self, begin: int, end: int) -> tuple[Array, Array]:
        parts: Index = np.arange(self._part_groups[begin][0], self._part_groups[end - 1][1])
        reach = []
        for axis in range(3):
            for sign in (-1.0, 1.0):
                way = np.zeros((len(parts), 3))
                way[:, axis] = sign
                far = sign * self._parts.farthest(parts, way)[:, axis] + self._parts.radius[parts]
                reach.append(sign * far.max())
        return np.array(reach[::2]), np.array(reach[1::2])


def _sphere(parts: Parts, begin: int, end: int) -> tuple[Array, float]:
    if end - begin == 1:
        return parts.centre[begin], float(parts.bound[begin])
    centre = 0.5 * (parts.centre[begin:end].min(axis=0) + parts.centre[begin:end].max(axis=0))
    apart = np.linalg.norm(parts.centre[begin:end] - centre, axis=1)
    return centre, float((apart + parts.bound[begin:end]).max())


def _grouped(body: Sequence[ConvexPart]) -> list[list[ConvexPart]]:
    """The parts of a body, each by itself, or of many those together that are near each other."""
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
