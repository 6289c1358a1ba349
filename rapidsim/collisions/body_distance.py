"""Distances between bodies of many parts, for many poses at once.

Trees of bounding volumes select the pairs of parts that may be nearest; the exact distance is
computed only for those.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rapidsim.collisions.bounds import straight
from rapidsim.collisions.bounds_tree import (
    BoundsTrees,
    NodePairs,
    best_first,
    first_of_each,
)
from rapidsim.collisions.convex import NO_TRIANGLES, ConvexParts, Index, Mask
from rapidsim.collisions.distance import distances
from rapidsim.collisions.nearest_parts import CLOSE, CLOSE_M, NearestParts
from rapidsim.collisions.outer_hull import HullStore, outer_hull
from rapidsim.collisions.overlap import depths, most_overlaps, shortest
from rapidsim.collisions.shape import Shape
from rapidsim.frames.transform import Array, Transform
from rapidsim.repeated_rows import repeated
from rapidsim.values import value_class

_ALIKE_M = 8e-3
"""Travel [m] between poses of two bodies in which parts that may touch are sought at once."""
_AT_ONCE = 100
"""Number of pairs of bodies whose depths are computed at once: more do not fit the cache."""
_OF_NORMALS_M, _OF_NORMALS = 1e-4, 0.01
"""Tolerances of the distances that give normals of planes, absolute [m] and relative."""


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

    def __init__(self, shapes: Sequence[Shape], store: HullStore | None = None) -> None:
        """Build the trees of all bodies; those of one shape share one.

        Args:
            shapes: Their shapes.
            store: See `outer_hull`.
        """
        distinct = {id(shape): shape for shape in shapes}
        number = {key: row for row, key in enumerate(distinct)}
        parts = [part for shape in distinct.values() for part in shape.parts]
        triangles = np.concatenate([NO_TRIANGLES, *(one.triangles for one in distinct.values())])
        self._parts = ConvexParts(parts, triangles)
        bodies: list[Index] = []
        part, triangle = 0, len(parts)
        for shape in distinct.values():
            ends = part + len(shape.parts), triangle + len(shape.triangles)
            bodies.append(np.r_[part : ends[0], triangle : ends[1]])
            part, triangle = ends
        self._trees = BoundsTrees(self._parts, bodies)
        self._shape: Index = np.array([number[id(shape)] for shape in shapes], dtype=np.int64)
        hulls = [outer_hull(shape, store) for shape in distinct.values()] if len(triangles) else []
        self._hulls = ConvexParts(hulls)
        self._has_surface = np.array([len(shape.triangles) > 0 for shape in shapes], dtype=np.bool_)
        self._overlapping: dict[tuple[int, int], Index] = {}
        """Parts (2,) of surfaces that overlapped when two bodies were last found to do so."""
        self.bounds = self._trees.bounds.rows(self._shape)
        """Bounds of the bodies."""

    def gaps(
        self,
        first: Index,
        second: Index,
        second_from_first: Transform,
        enough: Array,
        close: Array | float = CLOSE_M,
        share: float = CLOSE,
    ) -> Gaps:
        """Return the gaps of pairs of bodies.

        Args:
            first: Indices of the first bodies (k,).
            second: Indices of the second bodies (k,); points and directions are in their frames.
            second_from_first: Poses of the first bodies (k,).
            enough: Gap (k,) [m] above which a lower bound suffices.
            close: Absolute tolerances [m] of all gaps or of each (k,).
            share: Relative tolerance of gaps of surfaces; the larger applies.
        """
        roots = self._roots(first, second, second_from_first)
        surfaces = self.has_surfaces(first, second)
        search = NearestParts(
            self._trees, second_from_first, enough, close, share, roots.near, surfaces
        )
        near = np.flatnonzero(surfaces & (roots.near < enough))
        self._start_from_overlaps(search, roots.rows(near), first, second)
        near = near[search.limit[near] > -np.inf]
        self._start_from_hulls(search, roots.rows(near), first, second)
        search.follow(roots.rows(search.least < enough))
        for row in np.flatnonzero(np.isneginf(search.found) & surfaces).tolist():
            self._overlapping[int(first[row]), int(second[row])] = search.found_of[row]
        # Pairs that were not checked, or not completely, are no nearer than requested.
        found = search.found - 1.01 * search.tolerance(np.arange(len(first)), search.found)
        least = np.maximum(search.least, np.minimum(search.limit, found))
        return Gaps(least, search.found, search.point)

    def _start_from_overlaps(
        self, search: NearestParts, roots: NodePairs, first: Index, second: Index
    ) -> None:
        """Measure the parts of surfaces that overlapped at another instant: they often still do."""
        pairs = list(zip(first[roots.query].tolist(), second[roots.query].tolist(), strict=True))
        known = [row for row, pair in enumerate(pairs) if pair in self._overlapping]
        if known:
            a, b = np.array([self._overlapping[pairs[row]] for row in known]).T
            search.measure(NodePairs(roots.query[known], a, b, roots.near[known]))

    def _start_from_hulls(
        self, search: NearestParts, roots: NodePairs, first: Index, second: Index
    ) -> None:
        """Bound gaps of surfaces from below by the hulls, and measure the parts at their ends."""
        if not len(roots.query):
            return
        rows, seen = roots.query, search.seen[roots.query]
        a, b = self._shape[first[rows]], self._shape[second[rows]]
        hulls = distances(self._hulls, a, b, seen, search.limit[rows], CLOSE_M, CLOSE)
        search.least[rows] = np.maximum(search.least[rows], hulls.least)
        disjoint = (hulls.least > 0.0) & (hulls.least < search.limit[rows])
        search.slide(roots.rows(disjoint), hulls.first[disjoint], hulls.second[disjoint])

    def normals_between(self, first: Index, second: Index, second_from_first: Transform) -> Array:
        """Return normals (k, 3) of planes between surfaces, toward the first; 0 if there is none.

        Args:
            first: Indices of the first bodies (k,), one of each pair with surfaces of triangles.
            second: Indices of the second bodies (k,), in whose frames the normals are.
            second_from_first: Poses of the first bodies (k,).
        """
        a, b = self._shape[first], self._shape[second]
        return distances(
            self._hulls, a, b, second_from_first, close=_OF_NORMALS_M, share=_OF_NORMALS
        ).direction

    def spaces(
        self, first: Index, second: Index, row: Index, second_from_first: Transform, normal: Array
    ) -> Array:
        """Return spaces (n,) [m] between planes around surfaces; negative if they overlap.

        Args:
            first: Indices of the first bodies (k,), one of each pair with surfaces of triangles.
            second: Indices of the second bodies (k,).
            row: Pairs (n,) to which the poses belong.
            second_from_first: Poses of the first bodies (n,).
            normal: Normals (k, 3) of the planes, toward the first body.
        """
        a, b = self._shape[first], self._shape[second]
        top = np.einsum("kj,kj->k", self._hulls.farthest(b, normal), normal)
        top += self._hulls.radius[a] + self._hulls.radius[b]
        turned = np.einsum("kji,kj->ki", second_from_first.rotation, normal[row])
        bottom = np.einsum("kj,kj->k", self._hulls.farthest(a[row], -turned), turned)
        bottom += np.einsum("kj,kj->k", second_from_first.translation, normal[row])
        spaces: Array = bottom - top[row]
        return spaces

    def has_surfaces(self, first: Index, second: Index) -> Mask:
        """Mask of pairs of bodies (k,) that have surfaces of triangles."""
        found: Mask = self._has_surface[first] | self._has_surface[second]
        return found

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
        found = [
            self._depths(first[some], second[some], second_from_first[some], exact=exact)
            for begin in range(0, len(first), _AT_ONCE)
            for some in (slice(begin, begin + _AT_ONCE),)
        ]
        return np.concatenate([np.zeros(0), *found])

    def _depths(
        self, first: Index, second: Index, second_from_first: Transform, *, exact: bool
    ) -> Array:
        found = np.zeros(len(first))
        part_a, part_b, row = self._touching_parts(first, second, second_from_first)

        def overlapping(some: Index) -> Index:
            """Return the rows whose hulls overlap; of the others note how much their radii do."""
            pose = second_from_first[row[some]]
            got = distances(self._parts, part_a[some], part_b[some], pose, 0.0, CLOSE_M)
            hulls = np.isneginf(got.distances_found)
            np.maximum.at(found, row[some[~hulls]], -got.distances_found[~hulls])
            return some[hulls]

        overlapping(np.flatnonzero(self._parts.radius[part_a] + self._parts.radius[part_b]))
        # Pairs whose overlap is at most the deepest so far are irrelevant; so are disjoint ones.
        most = most_overlaps(self._parts, part_a, part_b, second_from_first[row])
        deepest, pair = np.zeros(len(first)), np.full(len(first), -1, dtype=np.int64)
        batches = best_first(row, -most, lambda waiting: most[waiting] > deepest[row[waiting]])
        for batch in batches:
            tried = overlapping(batch[most[batch] > 0.0])
            deep, _ = depths(
                self._parts, part_a[tried], part_b[tried], second_from_first[row[tried]]
            )
            better = first_of_each(row[tried], -deep, 1) & (deep > deepest[row[tried]])
            deepest[row[tried[better]]], pair[row[tried[better]]] = deep[better], tried[better]
        if exact:
            rows = np.flatnonzero(pair >= 0)
            a, b = part_a[pair[rows]], part_b[pair[rows]]
            deepest[rows] = shortest(self._parts, a, b, second_from_first[rows])
        return np.maximum(found, deepest)

    def _touching_parts(
        self, first: Index, second: Index, second_from_first: Transform
    ) -> tuple[Index, Index, Index]:
        """Return pairs of parts (n,) that may touch, and the pairs of bodies they belong to.

        In consecutive poses that are near each other they are sought once, for all of them.
        """
        rows = np.arange(len(first))
        before = np.maximum(rows - 1, 0)
        same = (first == first[before]) & (second == second[before]) & (rows > 0)
        step = straight(self.bounds, first, second_from_first[before], second_from_first)
        walked = np.cumsum(np.where(same, step, 0.0)) // _ALIKE_M
        starts = np.flatnonzero(~same | (walked != walked[before]))
        size = np.diff(starts, append=len(first))
        some = starts + size // 2
        poses = second_from_first[some]
        apart = straight(
            self.bounds, first, second_from_first, poses[np.repeat(rows[: len(size)], size)]
        )
        reach = np.maximum.reduceat(apart, starts)
        pairs = self._roots(first[some], second[some], poses)
        while True:
            pairs = pairs.rows(pairs.near < reach[pairs.query])
            leaf = self._trees.is_leaf(pairs)
            if leaf.all():
                break
            below = self._trees.below(pairs.rows(~leaf), poses, reach)
            pairs = pairs.rows(leaf).and_also(below)
        each, number = repeated(size[pairs.query])
        return pairs.first[each], pairs.second[each], starts[pairs.query[each]] + number

    def _roots(self, first: Index, second: Index, second_from_first: Transform) -> NodePairs:
        return self._trees.roots(self._shape[first], self._shape[second], second_from_first)
