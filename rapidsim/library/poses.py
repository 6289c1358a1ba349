"""Frames and vectors as plain tuples, on which the position functions compute.

Rounding happens only when a value returns to the program.
"""

from __future__ import annotations

from rapidsim.frames import quaternion
from rapidsim.frames.quaternion import Quaternion, Vector
from rapidsim.frames.vectors import plus, scaled
from rapidsim.language.data import Orient, Pos, Pose
from rapidsim.language.error_numbers import ERR_ILLQUAT, rapid_error
from rapidsim.language.single_precision import single

ILLEGAL_NORM_ERROR = 0.1
"""Tolerance for the length of a quaternion, as its deviation from 1."""


def composed(a_from_b: Pose, b_from_c: Pose) -> Pose:
    """Compose two frames to a_from_c, without rounding."""
    rotation = unit(a_from_b.rot)
    trans = plus(a_from_b.trans, quaternion.rotate(rotation, b_from_c.trans))
    return Pose(Pos(*trans), Orient(*quaternion.multiply(rotation, unit(b_from_c.rot))))


def inverted(a_from_b: Pose) -> Pose:
    """Invert a frame to b_from_a, without rounding."""
    back = quaternion.conjugate(unit(a_from_b.rot))
    return Pose(Pos(*scaled(quaternion.rotate(back, a_from_b.trans), -1.0)), Orient(*back))


def rounded(pose: Pose) -> Pose:
    """The frame with all numbers rounded to single precision."""
    return Pose(single_pos(pose.trans), single_orient(pose.rot))


def unit(rotation: Orient) -> Quaternion:
    """Normalise an orientation, whose digits are rounded.

    Raises:
        RapidError: ERR_ILLQUAT, if its length deviates from 1 by more than the tolerance.
    """
    require_unit(rotation)
    return normalised(rotation)


def require_unit(rotation: Orient) -> None:
    """Check that a quaternion is an orientation.

    Raises:
        RapidError: ERR_ILLQUAT, if its length deviates from 1 by more than the tolerance.
    """
    length = quaternion.norm(rotation)
    if abs(length - 1.0) > ILLEGAL_NORM_ERROR:
        written = ",".join(f"{q:g}" for q in rotation)
        raise rapid_error(
            ERR_ILLQUAT, f"the orientation [{written}] is none: its length is {length:.4g}, not 1"
        )


def normalised(rotation: Orient) -> Quaternion:
    """Normalise an orientation of any length.

    Raises:
        RapidError: ERR_ILLQUAT, if it is all zero, as in a target that was never taught.
    """
    if quaternion.norm(rotation) < 1e-6:
        raise rapid_error(
            ERR_ILLQUAT,
            "the orientation [0,0,0,0] is not a rotation: it was never assigned a value",
        )
    return quaternion.normalised(rotation)


def single_pos(vector: Vector) -> Pos:
    """A vector as a position, rounded to single precision."""
    x, y, z = vector
    return Pos(single(x), single(y), single(z))


def single_orient(q: Quaternion) -> Orient:
    """A quaternion as an orientation, rounded to single precision."""
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
