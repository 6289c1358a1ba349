"""Cubic not-a-knot splines: the third derivative is continuous at the second point.

The spline of collinear points is a straight line, of three points a parabola, of two a line.
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.waypoints.piecewise_polynomials import Piecewise


def spline(knots: Array, values: Array) -> Piecewise:
    """Return the cubic spline through values (k, d) at ascending knots (k,)."""
    width = np.diff(knots)[:, None]
    slope = np.diff(values, axis=0) / width
    bend = _second_derivatives(width, slope)
    coefficients = [
        values[:-1],
        slope - width * (2.0 * bend[:-1] + bend[1:]) / 6.0,
        0.5 * bend[:-1],
        (bend[1:] - bend[:-1]) / (6.0 * width),
    ]
    return Piecewise(np.asarray(knots, dtype=np.float64), np.stack(coefficients, axis=1))


def _second_derivatives(width: Array, slope: Array) -> Array:
    """Return second derivatives (k, d), from widths (k - 1, 1) and slopes (k - 1, d) of knots."""
    count = len(width) + 1
    bend: Array = np.zeros((count, slope.shape[1]))
    if count == 2:
        return bend
    if count == 3:
        bend[:] = 2.0 * (slope[1] - slope[0]) / (width[0] + width[1])
        return bend
    lower, upper = width[:-1].copy(), width[1:].copy()
    middle = 2.0 * (lower + upper)
    right = 6.0 * np.diff(slope, axis=0)
    # The ends follow from their two neighbours and drop out of the first and the last equation.
    middle[0] += width[0] * (1.0 + width[0] / width[1])
    upper[0] -= width[0] ** 2 / width[1]
    middle[-1] += width[-1] * (1.0 + width[-1] / width[-2])
    lower[-1] -= width[-1] ** 2 / width[-2]
    for row in range(1, count - 2):
        factor = lower[row] / middle[row - 1]
        middle[row] -= factor * upper[row - 1]
        right[row] -= factor * right[row - 1]
    bend[count - 2] = right[-1] / middle[-1]
    for row in range(count - 4, -1, -1):
        bend[row + 1] = (right[row] - upper[row] * bend[row + 2]) / middle[row]
    bend[0] = bend[1] + width[0] / width[1] * (bend[1] - bend[2])
    bend[-1] = bend[-2] + width[-1] / width[-2] * (bend[-2] - bend[-3])
    return bend
