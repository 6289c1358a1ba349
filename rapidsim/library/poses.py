"""Frames and vectors as plain tuples: what the position functions compute with.

Nothing is rounded until a value goes back to the program.
"""

from __future__ import annotations

from rapidsim.frames import quaternion
from rapidsim.frames.quaternion import Quaternion, Vector
from rapidsim.frames.vectors import plus, scaled
from rapidsim.language.data import Orient, Pos, Pose
from rapidsim.language.error_numbers import ERR_ILLQUAT, rapid_error
from rapidsim.language.single_precision import single

ILLEGAL_NORM_ERROR = 0.1
"""How far from 1 the length of a quaternion may be for functions to compute with it."""


def composed(a_from_b: Pose, b_from_c: Pose) -> Pose:
    """a_from_c, not rounded."""
    rotation = unit(a_from_b.rot)
    trans = plus(a_from_b.trans, quaternion.rotate(rotation, b_from_c.trans))
    return Pose(Pos(*trans), Orient(*quaternion.multiply(rotation, unit(b_from_c.rot))))


def inverted(a_from_b: Pose) -> Pose:
    """b_from_a, not rounded."""
    back = quaternion.conjugate(unit(a_from_b.rot))
    return Pose(Pos(*scaled(quaternion.rotate(back, a_from_b.trans), -1.0)), Orient(*back))


def rounded(pose: Pose) -> Pose:
    """The frame with all numbers rounded to single."""
    return Pose(single_pos(pose.trans), single_orient(pose.rot))


def unit(rotation: Orient) -> Quaternion:
    """An orientation, normalised: its digits are rounded.

    Raises:
        RapidError: ERR_ILLQUAT, if its length is not about 1.
    """
    require_unit(rotation)
    return normalised(rotation)


def require_unit(rotation: Orient) -> None:
    """Refuse a quaternion that is no orientation.

    Raises:
        RapidError: ERR_ILLQUAT, if its length is not about 1.
    """
    length = quaternion.norm(rotation)
    if abs(length - 1.0) > ILLEGAL_NORM_ERROR:
        written = ",".join(f"{q:g}" for q in rotation)
        raise rapid_error(
            ERR_ILLQUAT, f"the orientation [{written}] is none: its length is {length:.4g}, not 1"
        )


def normalised(rotation: Orient) -> Quaternion:
    """An orientation with unit length, whatever length it had.

    Raises:
        RapidError: ERR_ILLQUAT, if it is all zero, as in a target nobody taught.
    """
    if quaternion.norm(rotation) < 1e-6:
        raise rapid_error(
            ERR_ILLQUAT,
            "the orientation [0,0,0,0] is not a rotation: it was never assigned a value",
        )
    return quaternion.normalised(rotation)


def single_pos(vector: Vector) -> Pos:
    """A vector as a position, rounded."""
    x, y, z = vector
    return Pos(single(x), single(y), single(z))


def single_orient(q: Quaternion) -> Orient:
    """A quaternion as an orientation, rounded."""
    q1, q2, q3, q4 = q
    return Orient(single(q1), single(q2), single(q3), single(q4))


def from_axes(x: Vector, y: Vector, z: Vector) -> Quaternion:
    """The rotation whose columns are three orthonormal axes, scalar part not negative.

    Source:
        Shepperd (1978), Quaternion from rotation matrix.
    """
    trace = x[0] + y[1] + z[2]
    largest = max((trace, 0), (x[0], 1), (y[1], 2), (z[2], 3))[1]
    rows: tuple[Quaternion, ...] = (
        (1.0 + trace, y[2] - z[1], z[0] - x[2], x[1] - y[0]),
        (y[2] - z[1], 1.0 + 2.0 * x[0] - trace, x[1] + y[0], z[0] + x[2]),
        (z[0] - x[2], x[1] + y[0], 1.0 + 2.0 * y[1] - trace, y[2] + z[1]),
        (x[1] - y[0], z[0] + x[2], y[2] + z[1], 1.0 + 2.0 * z[2] - trace),
    )
    q = quaternion.normalised(rows[largest])
    return q if q[0] >= 0.0 else (-q[0], -q[1], -q[2], -q[3])
