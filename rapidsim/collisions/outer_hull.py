"""A convex body around a shape: its distance from another is a lower bound of that of the shapes.

Most bodies of a cell can be parted by a plane, and this bound is then close to their distance, for
a thousandth of what many triangles cost. So that it has few points, the body is the hull of those
that are extreme in some direction, rounded by the distance of the farthest point outside it.
"""

from __future__ import annotations

import numpy as np

from rapidsim.collisions.convex import ConvexPart, ConvexParts
from rapidsim.collisions.distance import distances
from rapidsim.collisions.overlap import directions_around
from rapidsim.collisions.shape import Shape
from rapidsim.frames.transform import Array, Transform

_DIRECTIONS = 1000
_FEW = 2500
"""Number of points up to which all are kept."""
_CLOSE_M = (1e-2, 1e-3, 1e-4)
"""Tolerances [m] of the distances of points outside the hull: a finer one for the farthest."""


def outer_hull(shape: Shape) -> ConvexPart:
    """Return a convex part that contains a shape."""
    parts = ConvexParts(shape.parts)
    angular = [number for number, part in enumerate(shape.parts) if not (part.radius or part.disc)]
    round_ones = np.setdiff1d(np.arange(len(shape.parts)), angular)
    points = np.concatenate(
        [
            *(shape.parts[number].points for number in angular),
            parts.corners(round_ones).reshape(-1, 3),
            shape.triangles.reshape(-1, 3),
        ]
    )
    return _around(np.unique(points, axis=0))


def _around(points: Array) -> ConvexPart:
    """Return a convex part that contains points (n, 3)."""
    if len(points) <= _FEW:
        return ConvexPart(points)
    extreme = np.unique((directions_around(_DIRECTIONS) @ points.T).argmax(axis=1))
    hull = ConvexPart(points[extreme])
    others = np.delete(points, extreme, axis=0)
    parts = ConvexParts([ConvexPart(np.zeros((1, 3))), hull])
    excess = 0.0
    for close in _CLOSE_M:
        row = np.zeros(len(others), dtype=np.int64)
        seen = Transform(np.broadcast_to(np.eye(3), (len(others), 3, 3)), others)
        found = distances(parts, row, row + 1, seen, close=close)
        excess = float(found.least.max(initial=excess))
        others = others[found.distances_found > excess]
    return ConvexPart(hull.points, radius=excess + close)
