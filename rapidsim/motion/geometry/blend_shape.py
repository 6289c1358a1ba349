"""Shape of corner paths: the fade-out of the curve before and the fade-in of the one after.

Everything here works on columns of NumPy arrays and, compiled, on single numbers; see
`line_formulas`.
"""

from __future__ import annotations

from types import MappingProxyType

import numpy as np

from rapidsim.frames.transform import Array

Three = tuple[Array, Array, Array]


C2, PARABOLA, MEASURED = 0, 1, 2
"""Numbers of the shapes in compiled code; the names are those of `MotionModel.corner`."""
CODES = MappingProxyType({"c2": C2, "parabola": PARABOLA, "abb": MEASURED})
KNEE = 1.0 / 3.0
"""Parameter at which phi'' of `abb` has a kink: a third of the corner from either end."""


def smooth(t: Array) -> Three:
    """Return phi of `c2` and its first two derivatives at t in 0..1."""
    square = t * t
    return square * t * (2.0 - t), square * (6.0 - 4.0 * t), 12.0 * t * (1.0 - t)


def parabola(t: Array) -> Three:
    """Return phi of `parabola` and its first two derivatives at t in 0..1."""
    return t * t, 2.0 * t, 0.0 * t + 2.0


def measured(t: Array) -> Three:
    """Return phi of `abb` and its first two derivatives at t in 0..1.

    phi'' rises from 1 to 5/2, is constant in the middle third, and falls.

    Source: free fits to slow corners of a virtual controller, accurate to 30 um.
    """
    m = np.maximum(t - KNEE, 0.0)
    n = np.maximum(t - 2.0 * KNEE, 0.0)
    return (
        0.5 * t * t + 0.75 * (t * t * t - m * m * m - n * n * n),
        t + 2.25 * (t * t - m * m - n * n),
        1.0 + 4.5 * (t - m - n),
    )


def corner_sides(
    shape: int,
    past: Array,
    radius: Array,
    length: Array,
) -> tuple[Three, Three]:
    """Return the points on the two curves that a corner path blends, with both derivatives.

    Args:
        shape: One of the numbers above.
        past: Distance past the middle of the corner [m], negative before.
        radius: Radius of the corner [m].
        length: Length of the curve before the corner [m].
    """
    t = np.minimum(np.maximum((past + radius) / (2.0 * radius), 0.0), 1.0)
    if shape == MEASURED:
        back, ahead = measured(1.0 - t), measured(t)
    elif shape == PARABOLA:
        back, ahead = parabola(1.0 - t), parabola(t)
    else:
        back, ahead = smooth(1.0 - t), smooth(t)
    bend = 0.25 / radius
    return (
        (length - radius * back[0], 0.5 * back[1], -bend * back[2]),
        (radius * ahead[0], 0.5 * ahead[1], bend * ahead[2]),
    )


COMPILED = (smooth, parabola, measured, corner_sides)
"""All functions, each after its callees."""
