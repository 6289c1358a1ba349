"""Trees of bounding volumes, which find the pairs of parts of two bodies that are near each other.

A node is one part, or a group of nodes that are near each other; the root of a tree is a body.
Pairs of nodes are followed down from the roots, for many pairs of bodies at once: the larger node
of a pair is replaced by its members, and pairs farther apart than wanted are dropped.

Parts are ordered along a curve that fills space (Morton order), so that consecutive ones are near
each other. Bounds of nodes are computed when a search first reaches them: of a large surface it
reaches few.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from rapidsim.collisions.bounds import Bounds, around, around_triangles
from rapidsim.collisions.convex import ConvexParts, Index, Mask
from rapidsim.frames.transform import Array, Transform
from rapidsim.repeated_rows import repeated
from rapidsim.values import value_class

_MEMBERS, _FEW = 4, 64
"""Number of members of a group, and of parts up to which a body is a single group; larger pieces of
a surface are hardly flat, so that turned boxes would cost more than they exclude."""
_FIRST, _MORE = 4, 8
"""Number of rows of each query in the first batch of `best_first`, and its growth."""
_BITS = 20
"""Number of bits of each coordinate in the order of the parts."""


@value_class(frozen=True, slots=True, eq=False)
class NodePairs:
    """Pairs of nodes (k,) that belong to queries."""

    query: Index
    first: Index
    second: Index
    near: Array
    """[m]: lower bounds of their gaps; negative if undecided."""

    def rows(self, at: Mask | Index | slice) -> NodePairs:
        """Return a subset of the pairs."""
        return NodePairs(self.query[at], self.first[at], self.second[at], self.near[at])

    def and_also(self, other: NodePairs) -> NodePairs:
        """Return these pairs followed by others."""
        return NodePairs(
            np.concatenate([self.query, other.query]),
            np.concatenate([self.first, other.first]),
            np.concatenate([self.second, other.second]),
            np.concatenate([self.near, other.near]),
        )


class BoundsTrees:
    """One tree of bounds for each of some bodies."""

    def __init__(self, parts: ConvexParts, bodies: Sequence[Index]) -> None:
        """Build the trees.

        Args:
            parts: All parts, which are the first nodes.
            bodies: Indices of the parts of each body.
        """
        self.parts = parts
        count = len(parts.centre)
        no = np.zeros(count, dtype=np.int64)
        members, orders = [no[:0]], [no[:0]]
        starts, sizes, firsts, counts, forms = [no], [no], [no], [no], [no]
        roots: list[int] = []
        placed = ordered = 0
        for body in bodies:
            nodes = body
            if len(body) > 1:
                nodes = body[_along_curve(parts.centre[body])]
            orders.append(nodes)
            span, form = 1, int((body >= parts.first_triangle).all())
            has_many = len(body) > _FEW
            members_each = _MEMBERS if has_many else len(body)
            while len(nodes) > 1:
                span *= members_each
                edges = np.arange(0, len(nodes), members_each)
                first = np.arange(0, len(body), span)
                firsts.append(ordered + first)
                counts.append(np.minimum(span, len(body) - first))
                forms.append(np.full(len(first), form + 2 * (has_many and span <= _FEW)))
                members.append(nodes)
                starts.append(placed + edges)
                sizes.append(np.diff(edges, append=len(nodes)))
                placed += len(nodes)
                nodes = count + np.arange(len(edges))
                count += len(edges)
            roots.append(int(nodes[0]))
            ordered += len(body)
        self._order = np.concatenate(orders)
        self._first, self._count = np.concatenate(firsts), np.concatenate(counts)
        self._form: Index = np.concatenate(forms)
        """Form of groups: 1 for those of triangles only, plus 2 for those with turned boxes."""
        end = parts.first_triangle
        has_axes = len(parts.triangles) > 0 or self._form.max(initial=0) > 1
        self._nodes = Bounds.unknown(count, turned=bool(has_axes))
        solids = np.arange(end)
        self._nodes.put(solids, Bounds(parts.centre[:end], parts.half[:end], parts.bound))
        self._is_known = np.arange(count) < end
        self._members = np.concatenate(members)
        self._start, self._size = np.concatenate(starts), np.concatenate(sizes)
        self._roots: Index = np.array(roots, dtype=np.int64)
        self._reach(self._roots)
        self.bounds = self._nodes.rows(self._roots)
        """Bounds of the bodies."""

    def _reach(self, nodes: Index) -> None:
        """Compute the bounds of nodes (k,) that no search has reached."""
        nodes = nodes[~self._is_known[nodes]]
        if not len(nodes):
            return
        nodes = np.unique(nodes)
        self._is_known[nodes] = True
        is_part = self._size[nodes] == 0
        triangles, groups = nodes[is_part], nodes[~is_part]
        if len(triangles):
            corners = self.parts.corners_of_triangles(triangles)
            self._nodes.put(triangles, around_triangles(corners))
        for form in np.unique(self._form[groups]).tolist():
            some = groups[self._form[groups] == form]
            size = self._count[some]
            row, number = repeated(size)
            part = self._order[self._first[some][row] + number]
            corners = (
                self.parts.corners_of_triangles(part) if form % 2 else self.parts.corners(part)
            )
            self._nodes.put(some, around(corners, np.cumsum(size) - size, turned=form > 1))

    def roots(self, first: Index, second: Index, second_from_first: Transform) -> NodePairs:
        """Return pairs of bodies (k,), each a query."""
        a, b = self._roots[first], self._roots[second]
        near = self._nodes.gaps(a, b, second_from_first)
        return NodePairs(np.arange(len(first)), a, b, near)

    def parts_at(self, node: Index, points: Array, count: int) -> tuple[Index, Index]:
        """Return parts below nodes (k,) near points (k, 3) in their frames, and their rows.

        For each node some of the nearest, at most `count`.
        """
        row, found = np.arange(len(node)), node
        while (self._size[found] > 0).any():
            each, number = repeated(np.maximum(self._size[found], 1))
            group = self._size[found[each]] > 0
            member = found[each]
            member[group] = self._members[self._start[member[group]] + number[group]]
            row = row[each]
            self._reach(member)
            distance = self._nodes.from_points(member, points[row])
            nearest = first_of_each(row, distance, count)
            row, found = row[nearest], member[nearest]
        return found, row

    def is_leaf(self, pairs: NodePairs) -> Mask:
        """Mask of pairs of parts, whose nodes are their indices."""
        leaf: Mask = (self._size[pairs.first] == 0) & (self._size[pairs.second] == 0)
        return leaf

    def below(self, pairs: NodePairs, second_from_first: Transform, enough: Array) -> NodePairs:
        """Return the pairs below pairs that are not leaves, with their bounds.

        Args:
            pairs: Pairs of nodes (k,).
            second_from_first: Poses of all queries.
            enough: Bounds [m] of all queries above which a smaller one suffices.
        """
        a, b = pairs.first, pairs.second
        bound = self._nodes.bound
        opens_first = self._size[a] > 0
        opens_first &= (self._size[b] == 0) | (bound[a] >= bound[b])
        opened = np.where(opens_first, a, b)
        row, number = repeated(self._size[opened])
        member = self._members[self._start[opened][row] + number]
        opens = opens_first[row]
        first, second = np.where(opens, member, a[row]), np.where(opens, b[row], member)
        query = pairs.query[row]
        self._reach(member)
        near = self._nodes.gaps(first, second, second_from_first[query], enough[query])
        return NodePairs(query, first, second, near)


def first_of_each(query: Index, order: Array, count: int | Index) -> Mask:
    """Mask of the rows (k,) of each query that come first in an order, at most `count` (k,)."""
    rows = np.lexsort((order, query))
    of_row = query[rows]
    starts = np.flatnonzero(np.diff(of_row, prepend=-1))
    rank = np.arange(len(rows)) - np.repeat(starts, np.diff(starts, append=len(rows)))
    found = np.zeros(len(rows), dtype=np.bool_)
    found[rows[rank < (count if isinstance(count, int) else count[rows])]] = True
    return found


def best_first(query: Index, order: Array, matters: Callable[[Index], Mask]) -> Iterator[Index]:
    """Yield rows (k,) of each query in an order: a few at first, then more of those that matter."""
    waiting, many = np.arange(len(query)), _FIRST
    while len(waiting):
        some = first_of_each(query[waiting], order[waiting], many)
        yield waiting[some]
        waiting = waiting[~some]
        waiting = waiting[matters(waiting)]
        many *= _MORE


def _along_curve(centres: Array) -> Index:
    """Return the order of points (k, 3) along a curve that fills space."""
    low = centres.min(axis=0)
    size = float(np.ptp(centres, axis=0).max())
    cells = ((centres - low) * ((2**_BITS - 1) / max(size, 1e-12))).astype(np.uint64)
    code = np.zeros(len(centres), dtype=np.uint64)
    for axis in range(3):
        code |= _spread(cells[:, axis]) << np.uint64(axis)
    return np.argsort(code, kind="stable")


def _spread(
    number: np.ndarray[tuple[int, ...], np.dtype[np.uint64]],
) -> np.ndarray[tuple[int, ...], np.dtype[np.uint64]]:
    """Return numbers (k,) of 21 bits with two zeros before each bit."""
    for shift, mask in (
        (32, 0x1F00000000FFFF),
        (16, 0x1F0000FF0000FF),
        (8, 0x100F00F00F00F00F),
        (4, 0x10C30C30C30C30C3),
        (2, 0x1249249249249249),
    ):
        number = (number | (number << np.uint64(shift))) & np.uint64(mask)
    return number
