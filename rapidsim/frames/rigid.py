"""Single rigid transform in plain floats.

For one transform at a time, plain Python is several times as fast as arrays; batches live in
`transform`. A `Rigid` is a matrix of nine floats, row by row, and a translation [m]; names are
`a_from_b` as everywhere.
"""

from __future__ import annotations

import math

import numpy as np

from rapidsim.frames.quaternion import Quaternion, Vector
from rapidsim.frames.transform import Transform
from rapidsim.frames.vectors import Number

Nine = tuple[Number, Number, Number, Number, Number, Number, Number, Number, Number]
Matrix = tuple[float, float, float, float, float, float, float, float, float]
Rigid = tuple[Matrix, Vector]


def product(a_from_b: Nine[Number], b_from_c: Nine[Number]) -> Nine[Number]:
    """Compose two rotations: a_from_c; of floats, or of columns of any length."""
    a, b, c, d, e, f, g, h, i = a_from_b
    j, k, m, n, o, p, q, r, s = b_from_c
    return (
        a * j + b * n + c * q,
        a * k + b * o + c * r,
        a * m + b * p + c * s,
        d * j + e * n + f * q,
        d * k + e * o + f * r,
        d * m + e * p + f * s,
        g * j + h * n + i * q,
        g * k + h * o + i * r,
        g * m + h * p + i * s,
    )


def moved(a_from_b: Rigid, point_in_b: Vector) -> Vector:
    """Return a point [m], expressed in a."""
    (a, b, c, d, e, f, g, h, i), (u, v, w) = a_from_b
    x, y, z = point_in_b
    return a * x + b * y + c * z + u, d * x + e * y + f * z + v, g * x + h * y + i * z + w


def composed(a_from_b: Rigid, b_from_c: Rigid) -> Rigid:
    """Compose two transforms: a_from_c."""
    return product(a_from_b[0], b_from_c[0]), moved(a_from_b, b_from_c[1])


def inverse(a_from_b: Rigid) -> Rigid:
    """Return the inverse, b_from_a."""
    (a, b, c, d, e, f, g, h, i), (x, y, z) = a_from_b
    return (a, d, g, b, e, h, c, f, i), (
        -(a * x + d * y + g * z),
        -(b * x + e * y + h * z),
        -(c * x + f * y + i * z),
    )


def from_quaternion(quaternion: Quaternion, translation: Vector) -> Rigid:
    """Build from a quaternion of nonzero length, scalar first, and a translation [m]."""
    w, x, y, z = quaternion
    length = math.sqrt(w * w + x * x + y * y + z * z)
    w, x, y, z = w / length, x / length, y / length, z / length
    matrix = (
        1.0 - 2.0 * (y * y + z * z),
        2.0 * (x * y - w * z),
        2.0 * (x * z + w * y),
        2.0 * (x * y + w * z),
        1.0 - 2.0 * (x * x + z * z),
        2.0 * (y * z - w * x),
        2.0 * (x * z - w * y),
        2.0 * (y * z + w * x),
        1.0 - 2.0 * (x * x + y * y),
    )
    return matrix, translation


def from_transform(transform: Transform) -> Rigid:
    """Convert a transform, which must not be a batch."""
    (a, b, c), (d, e, f), (g, h, i) = transform.rotation.tolist()
    x, y, z = transform.translation.tolist()
    return (a, b, c, d, e, f, g, h, i), (x, y, z)


def to_transform(rigid: Rigid) -> Transform:
    """Convert to a transform of arrays."""
    matrix, translation = rigid
    # Not reshaped: a view would keep a second array, and long runs have millions of these.
    rows = (matrix[:3], matrix[3:6], matrix[6:])
    return Transform(np.array(rows), np.array(translation))
