"""The shape of corner paths: what is left of the curve before, what is there of the one after.

Everything here runs on columns of NumPy arrays and, compiled, on single numbers; see
`line_formulas`.
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array

Three = tuple[Array, Array, Array]


def smooth(t: Array) -> Three:
    """Phi of `c2` and its first two derivatives at t in 0..1."""
    square = t * t
    return square * t * (2.0 - t), square * (6.0 - 4.0 * t), 12.0 * t * (1.0 - t)


def parabola(t: Array) -> Three:
    """Phi of `parabola` likewise."""
    return t * t, 2.0 * t, 0.0 * t + 2.0


def corner_sides(
    parabolic: bool,
    past: Array,
    radius: Array,
    length: Array,
) -> tuple[Three, Three]:
    """Places on the two curves that a corner path is blended from, with both derivatives.

    Args:
        parabolic: Whether the shape is `parabola`, else it is `c2`.
        past: How far past the middle of the corner [m], negative before.
        radius: Of the corner [m].
        length: Of the curve before it [m].
    """
    t = np.minimum(np.maximum((past + radius) / (2.0 * radius), 0.0), 1.0)
    if parabolic:
        back, ahead = parabola(1.0 - t), parabola(t)
    else:
        back, ahead = smooth(1.0 - t), smooth(t)
    bend = 0.25 / radius
    return (
        (length - radius * back[0], 0.5 * back[1], -bend * back[2]),
        (radius * ahead[0], 0.5 * ahead[1], bend * ahead[2]),
    )


COMPILED = (smooth, parabola, corner_sides)
"""All functions, each after those that it calls."""
