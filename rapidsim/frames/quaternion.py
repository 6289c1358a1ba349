"""Unit quaternions, scalar first as in RAPID, as plain tuples.

RAPID programs compute with single orientations; for one quaternion plain Python is faster than
arrays and needs no NumPy at start-up. Batches live in `transform`.
"""

from __future__ import annotations

import math

Quaternion = tuple[float, float, float, float]
Vector = tuple[float, float, float]

IDENTITY: Quaternion = (1.0, 0.0, 0.0, 0.0)


def norm(q: Quaternion) -> float:
    """Return the norm of a quaternion; 1 for a rotation."""
    return math.sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])


def normalised(q: Quaternion) -> Quaternion:
    """Return the rotation as a quaternion of unit norm.

    Raises:
        ZeroDivisionError: If `q` is zero, which is not a rotation.
    """
    length = norm(q)
    return (q[0] / length, q[1] / length, q[2] / length, q[3] / length)


def conjugate(q: Quaternion) -> Quaternion:
    """Return the inverse rotation of a unit quaternion."""
    return (q[0], -q[1], -q[2], -q[3])


def multiply(a_from_b: Quaternion, b_from_c: Quaternion) -> Quaternion:
    """Compose two rotations: a_from_c."""
    aw, ax, ay, az = a_from_b
    bw, bx, by, bz = b_from_c
    return (
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    )


def rotate(a_from_b: Quaternion, vector_in_b: Vector) -> Vector:
    """Rotate a vector: its components in a."""
    w, x, y, z = a_from_b
    vx, vy, vz = vector_in_b
    # t = 2 u x v;  v' = v + w t + u x t
    tx = 2.0 * (y * vz - z * vy)
    ty = 2.0 * (z * vx - x * vz)
    tz = 2.0 * (x * vy - y * vx)
    return (
        vx + w * tx + y * tz - z * ty,
        vy + w * ty + z * tx - x * tz,
        vz + w * tz + x * ty - y * tx,
    )


def from_axis_angle(axis: Vector, angle: float) -> Quaternion:
    """Return the rotation by `angle` [rad] about a unit axis."""
    half = 0.5 * angle
    s = math.sin(half)
    return (math.cos(half), axis[0] * s, axis[1] * s, axis[2] * s)


def from_zyx(z: float, y: float, x: float) -> Quaternion:
    """Return Rz(z) Ry(y) Rx(x), angles in rad: RAPID's OrientZYX."""
    about_z = from_axis_angle((0.0, 0.0, 1.0), z)
    about_y = from_axis_angle((0.0, 1.0, 0.0), y)
    about_x = from_axis_angle((1.0, 0.0, 0.0), x)
    return multiply(multiply(about_z, about_y), about_x)


def angle_between(a: Quaternion, b: Quaternion) -> float:
    """Return the angle [rad] of the shortest rotation from a to b.

    The form with atan2 keeps its precision for tiny angles and near half turns, where acos of the
    dot product loses half of the digits.
    """
    w, x, y, z = multiply(conjugate(a), b)
    return 2.0 * math.atan2(math.sqrt(x * x + y * y + z * z), abs(w))
