"""A convex body around a shape: its distance from another is a lower bound of that of the shapes.

Most bodies of a cell can be parted by a plane, and this bound is then close to their distance, for
a thousandth of what many triangles cost. So that it has few points, the body is the hull of those
that are extreme in some direction, and of those farthest outside of that hull, rounded by the
distance of the next one.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Protocol

import numpy as np

from rapidsim.collisions.convex import ConvexPart, ConvexParts
from rapidsim.collisions.distance import distances
from rapidsim.collisions.overlap import directions_around
from rapidsim.collisions.shape import Shape
from rapidsim.frames.transform import Array, Transform

_DIRECTIONS, _OUTSIDE = 1000, 1000
"""Numbers of directions, and of points outside the hull of their extreme points that are added."""
_FEW = 2500
"""Number of points up to which all are kept."""
_KEPT = 16
"""Number of bodies whose hulls are kept, by content: each run builds its bodies anew."""
_CLOSE_M = 1e-4
"""Tolerance [m] of the distances of points outside the hull."""


class HullStore(Protocol):
    """Store of numbers that earlier runs computed, by the content that they are of."""

    def numbers(self, content: bytes) -> Array | None:
        """Return the numbers stored for a content; None if there are none."""
        ...

    def keep_numbers(self, content: bytes, numbers: Array) -> None:
        """Store the numbers computed for a content."""
        ...

    def __hash__(self) -> int:
        """Hash of the place where they are."""
        ...


def outer_hull(shape: Shape, store: HullStore | None = None) -> ConvexPart:
    """Return a convex part that contains a shape.

    Args:
        shape: The shape.
        store: Has the parts around large shapes that earlier runs computed; None to compute them.
    """
    parts = ConvexParts(shape.parts)
    round_ones = [number for number, part in enumerate(shape.parts) if part.radius or part.disc]
    corners = parts.corners(np.array(round_ones, dtype=np.int64)).reshape(-1, 3)
    return _around(np.concatenate([corners, shape.vertices]).tobytes(), store)


@lru_cache(maxsize=_KEPT)
def _around(coordinates: bytes, store: HullStore | None) -> ConvexPart:
    """Return a convex part that contains points, of which these are the coordinates."""
    points = np.frombuffer(coordinates).reshape(-1, 3)
    if len(points) <= _FEW:
        return ConvexPart(points)
    if store is None:
        return _around_many(points)
    known = store.numbers(coordinates)
    if known is None or len(known) % 3 != 1:
        made = _around_many(points)
        known = np.append(made.points, made.radius)
        store.keep_numbers(coordinates, known)
    return ConvexPart(known[:-1].reshape(-1, 3), radius=float(known[-1]))


def _around_many(points: Array) -> ConvexPart:
    """Return a convex part of few points, and a radius, that contains points (k, 3)."""
    row = np.zeros(len(points), dtype=np.int64)
    every = ConvexParts([ConvexPart(points)])
    extreme = every.farthest(row[:_DIRECTIONS], directions_around(_DIRECTIONS))
    hull = ConvexPart(np.unique(extreme, axis=0))
    seen = Transform(np.broadcast_to(np.eye(3), (len(points), 3, 3)), points)
    parts = ConvexParts([ConvexPart(np.zeros((1, 3))), hull])
    excess = distances(parts, row, row + 1, seen, close=_CLOSE_M).distances_found
    *more, next_one = np.argsort(-excess, kind="stable")[: _OUTSIDE + 1]
    more = [point for point in more if excess[point] > 0.0]
    radius = max(0.0, float(excess[next_one])) + _CLOSE_M
    return ConvexPart(np.concatenate([hull.points, points[more]]), radius=radius)
