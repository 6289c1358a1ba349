"""An arc through three points."""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array

_STRAIGHT = 1e-9
"""Share of the area of three points below which they lie on a line."""


def arc_through(start: Array, via: Array, end: Array, count: int) -> Array:
    """Return points (count, 3) on the arc from `start` through `via` to `end`, each (3,) [m].

    For three points on a line, which have no circle, return the polyline through them.
    """
    a, b = via - start, end - start
    normal = np.cross(a, b)
    area = float(np.linalg.norm(normal))
    if area <= _STRAIGHT * float(a @ a + b @ b):
        return np.stack([start, via, end])
    offset = np.cross(float(a @ a) * b - float(b @ b) * a, normal) / (2.0 * area * area)
    centre = start + offset
    x = start - centre
    y = np.cross(normal / area, x)
    angle = float(np.arctan2((end - centre) @ y, (end - centre) @ x)) % (2.0 * np.pi)
    turn = np.linspace(0.0, angle, count)[:, None]
    arc: Array = centre + np.cos(turn) * x + np.sin(turn) * y
    return arc
