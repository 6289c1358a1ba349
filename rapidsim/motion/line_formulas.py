"""Derivatives of an ortho-parallel arm along lines and their corners, number by number.

Everything here is written once and runs twice: on columns of NumPy arrays, and, where numba is
installed, compiled, on single numbers (see `line_kernel`). Therefore vectors are tuples of three
columns and matrices of nine, row by row, and nothing branches on a value.

Frames: all is seen in the base of the arm's formulas; rotations are those of the last frame of the
formulas, whose origin is the wrist centre.
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.arms import Index
from rapidsim.motion.kinematics import Mask

Vector = tuple[Array, Array, Array]
Matrix = tuple[Array, Array, Array, Array, Array, Array, Array, Array, Array]
Six = tuple[Array, Array, Array, Array, Array, Array]
Lengths = tuple[float, float, float, float, float, float]

TINY = 1e-40
SMALLEST_ARM = 1e-5
"""Distance [m] of the wrist centre from axis 1, and area [m2] of the triangle of the two arms, from
which on derivatives are those of a regular arm."""
SMALLEST_WRIST = 1e-5
"""sin of axis 5 likewise."""


def plus(a: Vector, b: Vector) -> Vector:
    """A + b."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def minus(a: Vector, b: Vector) -> Vector:
    """A - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def scaled(a: Vector, share: Array) -> Vector:
    """A times a number."""
    return a[0] * share, a[1] * share, a[2] * share


def crossed(a: Vector, b: Vector) -> Vector:
    """A x b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def turned(m: Matrix, v: Vector) -> Vector:
    """M v."""
    return (
        m[0] * v[0] + m[1] * v[1] + m[2] * v[2],
        m[3] * v[0] + m[4] * v[1] + m[5] * v[2],
        m[6] * v[0] + m[7] * v[1] + m[8] * v[2],
    )


def transposed(m: Matrix) -> Matrix:
    """The inverse of a rotation."""
    return m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]


def product(a: Matrix, b: Matrix) -> Matrix:
    """A @ b."""
    return (
        a[0] * b[0] + a[1] * b[3] + a[2] * b[6],
        a[0] * b[1] + a[1] * b[4] + a[2] * b[7],
        a[0] * b[2] + a[1] * b[5] + a[2] * b[8],
        a[3] * b[0] + a[4] * b[3] + a[5] * b[6],
        a[3] * b[1] + a[4] * b[4] + a[5] * b[7],
        a[3] * b[2] + a[4] * b[5] + a[5] * b[8],
        a[6] * b[0] + a[7] * b[3] + a[8] * b[6],
        a[6] * b[1] + a[7] * b[4] + a[8] * b[7],
        a[6] * b[2] + a[7] * b[5] + a[8] * b[8],
    )


def rotation(v: Vector) -> Matrix:
    """The rotation by a vector [rad]."""
    x, y, z = v
    angle = np.sqrt(x * x + y * y + z * z + TINY)
    sine = np.sin(angle) / angle
    half = np.sin(0.5 * angle) / angle
    cosine = 2.0 * half * half  # (1 - cos) / angle2
    xx, yy, zz = cosine * x * x, cosine * y * y, cosine * z * z
    xy, xz, yz = cosine * x * y, cosine * x * z, cosine * y * z
    return (
        1.0 - yy - zz,
        xy - sine * z,
        xz + sine * y,
        xy + sine * z,
        1.0 - xx - zz,
        yz - sine * x,
        xz - sine * y,
        yz + sine * x,
        1.0 - xx - yy,
    )


def turning_on(
    start: Matrix,
    rate: Vector,
    next_start: Matrix,
    next_rate: Vector,
    before: Vector,
    after: Vector,
) -> tuple[Matrix, Vector, Vector]:
    """Rotation, angular velocity and its derivative in a corner between two lines.

    Args:
        start: Rotation at the start of the line before.
        rate: Its turning [rad/m].
        next_start: Rotation at the start of the line after.
        next_rate: Its turning.
        before: Place on the line before with both derivatives; see `layout.Sides`.
        after: The same on the line after.
    """
    backwards = product(product(rotation(scaled(rate, before[0])), start), transposed(next_start))
    forwards = product(rotation(scaled(next_rate, after[0])), next_start)
    next_turning = turned(backwards, next_rate)
    first, second = scaled(rate, before[1]), scaled(next_turning, after[1])
    change = plus(scaled(rate, before[2]), scaled(next_turning, after[2]))
    return (
        product(backwards, forwards),
        plus(first, second),
        plus(change, crossed(first, second)),
    )


def lever_motion(
    start: Vector,
    rate: Vector,
    next_rate: Vector,
    before: Vector,
    after: Vector,
    lever: Vector,
    turning: Vector,
    turning_change: Vector,
) -> tuple[Vector, Vector, Vector, Vector]:
    """The wrist centre with two derivatives, and the velocity of the TCP, in a corner of two lines.

    Args:
        start: TCP at the start of the line before [m].
        rate: Its direction, times TCP travel per unit of the parameter.
        next_rate: The same of the line after.
        before: Place on the line before with both derivatives.
        after: The same on the line after.
        lever: From the TCP to the wrist centre [m], turned as the tool is now.
        turning: Angular velocity.
        turning_change: Its derivative.
    """
    velocity = plus(scaled(rate, before[1]), scaled(next_rate, after[1]))
    acceleration = plus(scaled(rate, before[2]), scaled(next_rate, after[2]))
    tcp = plus(start, plus(scaled(rate, before[0]), scaled(next_rate, after[0])))
    swing = crossed(turning, lever)
    return (
        plus(tcp, lever),
        plus(velocity, swing),
        plus(acceleration, plus(crossed(turning_change, lever), crossed(turning, swing))),
        velocity,
    )


def rates_of_arm(
    lengths: Lengths,
    side: Array,
    bend: Array,
    flip: Array,
    centre: Vector,
    velocity: Vector,
    acceleration: Vector,
    rotation_6: Matrix,
    turning: Vector,
    turning_change: Vector,
) -> tuple[Six, Six, Array]:
    """First and second derivatives of the angles of the formulas, and whether the arm is regular.

    The wrist centre gives axes 1 to 3, in the vertical plane of the arm that axis 1 turns; what is
    left of the turning gives axes 4 to 6.

    Args:
        lengths: a1, a2, b, c1, c2, c3 of `OpwGeometry` [m].
        side: 1 where the wrist centre is in front of axis 1, -1 where behind.
        bend: 1 where it is in front of the lower arm, -1 where behind.
        flip: 1 where axis 5 is positive, -1 where negative.
        centre: Wrist centre [m], with its derivatives.
        velocity: First.
        acceleration: Second.
        rotation_6: Of the last frame.
        turning: Its angular velocity.
        turning_change: The derivative of that.
    """
    a1, a2, b, c1, c2, c3 = lengths
    x, y, z = centre
    around = x * x + y * y
    off = around - b * b
    forward = side * np.sqrt(np.maximum(off, TINY))
    t1 = np.arctan2(y, x) - np.arctan2(b, forward)
    cos1, sin1 = np.cos(t1), np.sin(t1)

    # The triangle of both arms; see `two_link.close_triangle`.
    ahead, up = forward - a1, z - c1
    fore = np.sqrt(a2 * a2 + c3 * c3)
    distance = np.sqrt(ahead * ahead + up * up)
    short = (c2 + fore - distance) * (c2 + fore + distance)
    beyond = distance * distance - (c2 - fore) * (c2 - fore)
    elbow = (
        2.0 * bend * np.arctan2(np.sqrt(np.maximum(short, TINY)), np.sqrt(np.maximum(beyond, TINY)))
    )
    t2 = np.arctan2(ahead, up) - np.arctan2(fore * np.sin(elbow), c2 + fore * np.cos(elbow))
    t23 = t2 + elbow - np.arctan2(a2, c3)
    cos23, sin23 = np.cos(t23), np.sin(t23)
    lower_ahead, lower_up = c2 * np.sin(t2), c2 * np.cos(t2)
    fore_ahead, fore_up = a2 * cos23 + c3 * sin23, c3 * cos23 - a2 * sin23
    area = lower_ahead * fore_up - lower_up * fore_ahead

    out, aside = cos1 * velocity[0] + sin1 * velocity[1], cos1 * velocity[1] - sin1 * velocity[0]
    d1 = aside / forward
    d_ahead, d_up = out + b * d1, velocity[2]
    d2 = -(fore_ahead * d_ahead + fore_up * d_up) / area
    d23 = (lower_up * d_up + lower_ahead * d_ahead) / area

    out = cos1 * acceleration[0] + sin1 * acceleration[1]
    aside = cos1 * acceleration[1] - sin1 * acceleration[0]
    e1 = (aside - 2.0 * d_ahead * d1 + b * d1 * d1) / forward
    e_ahead = out + forward * d1 * d1 + b * e1 + lower_ahead * d2 * d2 + fore_ahead * d23 * d23
    e_up = acceleration[2] + lower_up * d2 * d2 + fore_up * d23 * d23
    e2 = -(fore_ahead * e_ahead + fore_up * e_up) / area
    e23 = (lower_up * e_up + lower_ahead * e_ahead) / area

    # The wrist, seen in the frame of the forearm.
    zero = 0.0 * cos1
    frame = (
        cos1 * cos23,
        sin1 * cos23,
        -sin23,
        -sin1,
        cos1,
        zero,
        cos1 * sin23,
        sin1 * sin23,
        cos23,
    )
    of_arm = (-sin1 * d23, cos1 * d23, d1)
    of_arm_change = (
        -sin1 * e23 - cos1 * d1 * d23,
        cos1 * e23 - sin1 * d1 * d23,
        e1,
    )
    rest = turned(frame, minus(turning, of_arm))
    rest_change = minus(
        turned(frame, minus(turning_change, of_arm_change)), crossed(turned(frame, of_arm), rest)
    )
    third = turned(frame, (rotation_6[2], rotation_6[5], rotation_6[8]))
    sine = np.sqrt(third[0] * third[0] + third[1] * third[1] + TINY)
    cos4, sin4 = flip * third[0] / sine, flip * third[1] / sine
    sin5, cos5 = flip * sine, third[2]
    d5 = cos4 * rest[1] - sin4 * rest[0]
    d6 = (cos4 * rest[0] + sin4 * rest[1]) / sin5
    d4 = rest[2] - cos5 * d6
    e5 = cos4 * rest_change[1] - sin4 * rest_change[0] - sin5 * d4 * d6
    e6 = (cos4 * rest_change[0] + sin4 * rest_change[1] + d4 * d5 - cos5 * d5 * d6) / sin5
    e4 = rest_change[2] + sin5 * d5 * d6 - cos5 * e6

    regular = (
        (off > SMALLEST_ARM * SMALLEST_ARM)
        & (np.abs(area) > SMALLEST_ARM)
        & (short > 0.0)
        & (beyond > 0.0)
        & (sine > SMALLEST_WRIST)
    )
    return (d1, d2, d23 - d2, d4, d5, d6), (e1, e2, e23 - e2, e4, e5, e6), regular


def rates_on_lines(
    lengths: Lengths,
    arm: Vector,
    lever: Vector,
    line: tuple[Vector, Vector, Vector],
    sides: tuple[Vector, Vector],
    turn: tuple[Matrix, Vector, Matrix, Vector],
    turn_sides: tuple[Vector, Vector],
) -> tuple[Six, Six, Array, Array, Array]:
    """All that timing asks of a place on a line or in a corner between two.

    Args:
        lengths: See `rates_of_arm`.
        arm: Side, bend and flip there.
        lever: From the TCP to the wrist centre in the last frame of the formulas [m].
        line: Start and rate of the line before, rate of the line after.
        sides: Places on both with their derivatives; on a line alone the second is zero.
        turn: Start and rate of the turning before, and after.
        turn_sides: Places on both.

    Returns:
        Both derivatives of the angles, TCP travel and turning per unit of the parameter, and
        whether the arm is regular; where it is not, the derivatives are worth nothing.
    """
    rotation_6, turning, change = turning_on(
        turn[0], turn[1], turn[2], turn[3], turn_sides[0], turn_sides[1]
    )
    centre, velocity, acceleration, tcp = lever_motion(
        line[0],
        line[1],
        line[2],
        sides[0],
        sides[1],
        turned(rotation_6, lever),
        turning,
        change,
    )
    first, second, regular = rates_of_arm(
        lengths,
        arm[0],
        arm[1],
        arm[2],
        centre,
        velocity,
        acceleration,
        rotation_6,
        turning,
        change,
    )
    tcp_rate = np.sqrt(tcp[0] * tcp[0] + tcp[1] * tcp[1] + tcp[2] * tcp[2])
    turn_rate = np.sqrt(turning[0] * turning[0] + turning[1] * turning[1] + turning[2] * turning[2])
    return first, second, tcp_rate, turn_rate, regular


def rates_one_by_one(
    lengths: Lengths,
    table: Array,
    row: Index,
    corners: tuple[Index, Index, Array],
    turn_corners: tuple[Index, Index, Array],
    first: Array,
    second: Array,
    speeds: Array,
    regular: Mask,
) -> None:
    """The same place after place; this is what is compiled.

    Args:
        lengths: See `rates_of_arm`.
        table: Shape (m, 24): a row a curve; see `line_rates`.
        row: The curve (k,) of each place.
        corners: The line before (k,), the line after (k,), and places on both with both
            derivatives (6, k).
        turn_corners: The same for the turning.
        first: Filled with first derivatives of the angles (k, 6).
        second: Filled with second derivatives (k, 6).
        speeds: Filled with TCP travel and turning (k, 2) per unit of the parameter.
        regular: Filled with where (k,) they hold.
    """
    for k in range(len(row)):
        own, a, b = table[row[k]], table[corners[0][k]], table[corners[1][k]]
        c, d = table[turn_corners[0][k]], table[turn_corners[1][k]]
        x, y = corners[2][:, k], turn_corners[2][:, k]
        q1, q2, tcp_rate, turn_rate, holds = rates_on_lines(
            lengths,
            (own[21], own[22], own[23]),
            (own[18], own[19], own[20]),
            ((a[0], a[1], a[2]), (a[3], a[4], a[5]), (b[3], b[4], b[5])),
            ((x[0], x[1], x[2]), (x[3], x[4], x[5])),
            (
                (c[9], c[10], c[11], c[12], c[13], c[14], c[15], c[16], c[17]),
                (c[6], c[7], c[8]),
                (d[9], d[10], d[11], d[12], d[13], d[14], d[15], d[16], d[17]),
                (d[6], d[7], d[8]),
            ),
            ((y[0], y[1], y[2]), (y[3], y[4], y[5])),
        )
        for i in range(6):
            first[k, i] = q1[i]
            second[k, i] = q2[i]
        speeds[k, 0] = tcp_rate
        speeds[k, 1] = turn_rate
        regular[k] = holds


COMPILED = (
    plus,
    minus,
    scaled,
    crossed,
    turned,
    transposed,
    product,
    rotation,
    turning_on,
    lever_motion,
    rates_of_arm,
    rates_on_lines,
    rates_one_by_one,
)
"""All functions, each after those that it calls."""
