"""Derivatives of an ortho-parallel arm along lines and their corners, in scalar formulas.

All formulas are written once and run in two modes: on columns of NumPy arrays (`line_derivatives`)
and, if numba is installed, compiled, on single numbers (`line_loops`). Therefore vectors are tuples
of three columns and matrices of nine, row by row, and no code branches on a value.

Frames: everything is expressed in the base of the arm's formulas; rotations are of the last frame
of the formulas, whose origin is the wrist centre.
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.rigid import product
from rapidsim.frames.transform import Array
from rapidsim.frames.vectors import crossed, minus, plus, scaled
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.kinematics.unwrapping import TURN

Pair = tuple[Array, Array]
Vector = tuple[Array, Array, Array]
Matrix = tuple[Array, Array, Array, Array, Array, Array, Array, Array, Array]
Four = tuple[Array, Array, Array, Array]
Six = tuple[Array, Array, Array, Array, Array, Array]
Lengths = tuple[float, float, float, float, float, float]
OfJoints = tuple[float, ...]
"""One value per joint."""

TINY = 1e-40
SMALLEST_ARM = 1e-5
"""Distance [m] of the wrist centre from axis 1, and area [m2] of the triangle of the two arms,
above which the arm counts as regular."""
SMALLEST_WRIST = 1e-5
"""sin of axis 5 above which the wrist counts as regular."""


def turned(m: Matrix, v: Vector) -> Vector:
    """Return M v."""
    return (
        m[0] * v[0] + m[1] * v[1] + m[2] * v[2],
        m[3] * v[0] + m[4] * v[1] + m[5] * v[2],
        m[6] * v[0] + m[7] * v[1] + m[8] * v[2],
    )


def transposed(m: Matrix) -> Matrix:
    """Return the inverse of a rotation."""
    return m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]


def rotation(v: Vector) -> Matrix:
    """Return the rotation by a vector [rad]."""
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


def turned_twice(
    turn: tuple[Matrix, Vector, Matrix, Vector], before: Array, after: Array
) -> tuple[Matrix, Matrix]:
    """Return the rotation in a corner: back along the line before, then along the line after.

    Args:
        turn: Rotation at the start of the line before and its rate [rad/m], then of the line after.
        before: Position on the line before [m].
        after: Position on the line after.
    """
    start, rate, next_start, next_rate = turn
    backwards = product(product(rotation(scaled(rate, before)), start), transposed(next_start))
    return backwards, product(rotation(scaled(next_rate, after)), next_start)


def turning_on(
    start: Matrix,
    rate: Vector,
    next_start: Matrix,
    next_rate: Vector,
    before: Vector,
    after: Vector,
) -> tuple[Matrix, Vector, Vector]:
    """Return rotation, angular velocity and its derivative in a corner between two lines.

    Args:
        start: Rotation at the start of the line before.
        rate: Rotation rate [rad/m] of the line before.
        next_start: Rotation at the start of the line after.
        next_rate: Rotation rate [rad/m] of the line after.
        before: Position on the line before with both derivatives; see `parameterisation.Sides`.
        after: Position on the line after with both derivatives.
    """
    backwards, forwards = turned_twice((start, rate, next_start, next_rate), before[0], after[0])
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
    """Return the wrist centre with two derivatives, and the TCP velocity, in a corner of lines.

    Args:
        start: TCP at the start of the line before [m].
        rate: Direction of the line before times TCP travel per unit of the parameter.
        next_rate: Direction of the line after times TCP travel per unit of the parameter.
        before: Position on the line before with both derivatives.
        after: Position on the line after with both derivatives.
        lever: From the TCP to the wrist centre [m], in the current orientation of the tool.
        turning: Angular velocity.
        turning_change: Derivative of the angular velocity.
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


def main_axes(
    lengths: Lengths, side: Array, bend: Array, centre: Vector
) -> tuple[Pair, Pair, Pair, Pair, Array, Mask]:
    """Return the rotation of axis 1, and lower arm and forearm in the arm's vertical plane.

    No angle is computed: derivatives need only sines and cosines, which follow from the
    triangle of both arms by the law of cosines.

    Args:
        lengths: a1, a2, b, c1, c2, c3 of `OpwGeometry` [m].
        side: 1 if the wrist centre is in front of axis 1, -1 if behind.
        bend: 1 if the wrist centre is in front of the lower arm, -1 if behind.
        centre: Wrist centre [m].

    Returns:
        Cosine and sine of axis 1; lower arm and the rest above it, each with its forward and upward
        extent [m]; cosine and sine of the forearm's angle from vertical; the distance [m] of the
        wrist centre in front of axis 1; and whether it is within reach and away from axis 1.
    """
    a1, a2, b, c1, c2, c3 = lengths
    x, y, z = centre
    around = x * x + y * y
    off = around - b * b
    forward = side * np.sqrt(np.maximum(off, TINY))
    around = np.maximum(around, TINY)
    axis_1 = (x * forward + y * b) / around, (y * forward - x * b) / around

    # The triangle of both arms; see `two_link.close_triangle`.
    ahead, up = forward - a1, z - c1
    fore = np.sqrt(a2 * a2 + c3 * c3)
    square = ahead * ahead + up * up
    distance = np.sqrt(square)
    short = (c2 + fore - distance) * (c2 + fore + distance)
    beyond = square - (c2 - fore) * (c2 - fore)
    # The end of the forearm, seen along the lower arm and across it.
    square = np.maximum(square, TINY)
    along = 0.5 * (square + (c2 - fore) * (c2 + fore)) / square
    across = 0.5 * bend * np.sqrt(np.maximum(short * beyond, TINY)) / square
    lower = ahead * along - up * across, up * along + ahead * across
    upper = ahead - lower[0], up - lower[1]
    forearm = (
        (a2 * upper[0] + c3 * upper[1]) / (fore * fore),
        (c3 * upper[0] - a2 * upper[1]) / (fore * fore),
    )
    regular = (off > SMALLEST_ARM * SMALLEST_ARM) & (short > 0.0) & (beyond > 0.0)
    return axis_1, lower, upper, forearm, forward, regular


def forearm_from_base(axis_1: Pair, forearm: Pair) -> Matrix:
    """Return the rotation from base to the forearm frame, in which axis 4 is z."""
    cos1, sin1 = axis_1
    cos23, sin23 = forearm
    return (
        cos1 * cos23,
        sin1 * cos23,
        -sin23,
        -sin1,
        cos1,
        0.0 * cos1,
        cos1 * sin23,
        sin1 * sin23,
        cos23,
    )


def angles_of_arm(
    lengths: Lengths, arm: Vector, centre: Vector, rotation_6: Matrix
) -> tuple[Six, Mask]:
    """Return the angles of the formulas [rad], in no particular turn, and whether they are regular.

    Args:
        lengths: See `main_axes`.
        arm: Side and bend as in `main_axes`; flip is 1 if axis 5 is positive, -1 if negative.
        centre: Wrist centre [m].
        rotation_6: Rotation of the last frame.
    """
    axis_1, lower, _, forearm, _, regular = main_axes(lengths, arm[0], arm[1], centre)
    m = product(forearm_from_base(axis_1, forearm), rotation_6)
    sine = np.sqrt(m[2] * m[2] + m[5] * m[5] + TINY)
    cos4, sin4 = arm[2] * m[2] / sine, arm[2] * m[5] / sine
    t1, t2 = np.arctan2(axis_1[1], axis_1[0]), np.arctan2(lower[0], lower[1])
    t23 = np.arctan2(forearm[1], forearm[0])
    t5 = np.arctan2(arm[2] * sine, m[8])
    t6 = np.arctan2(cos4 * m[3] - sin4 * m[0], cos4 * m[4] - sin4 * m[1])
    return (
        (t1, t2, t23 - t2, np.arctan2(sin4, cos4), t5, t6),
        regular & (sine > SMALLEST_WRIST),
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
) -> tuple[Six, Six, Four, Mask]:
    """Return both derivatives of the formulas' angles, the arm's stance, and whether it is regular.

    The stance is that of `PathRates`.

    The wrist centre determines axes 1 to 3, in the vertical plane of the arm that axis 1 turns; the
    remaining rotation determines axes 4 to 6.

    Args:
        lengths: See `main_axes`.
        side: See `main_axes`.
        bend: See `main_axes`.
        flip: 1 where axis 5 is positive, -1 where negative.
        centre: Wrist centre [m].
        velocity: First derivative of the wrist centre.
        acceleration: Second derivative of the wrist centre.
        rotation_6: Rotation of the last frame.
        turning: Angular velocity of the last frame.
        turning_change: Derivative of the angular velocity.
    """
    b = lengths[2]
    axis_1, lower, upper, forearm, forward, regular = main_axes(lengths, side, bend, centre)
    cos1, sin1 = axis_1
    lower_ahead, lower_up = lower
    fore_ahead, fore_up = upper
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

    # The wrist, in the frame of the forearm.
    frame = forearm_from_base(axis_1, forearm)
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

    regular = regular & (np.abs(area) > SMALLEST_ARM) & (sine > SMALLEST_WRIST)
    stance = lower_ahead / lengths[4], lower_up / lengths[4], forearm[1], forearm[0]
    return (d1, d2, d23 - d2, d4, d5, d6), (e1, e2, e23 - e2, e4, e5, e6), stance, regular


def rates_on_lines(
    lengths: Lengths,
    arm: Vector,
    lever: Vector,
    line: tuple[Vector, Vector, Vector],
    sides: tuple[Vector, Vector],
    turn: tuple[Matrix, Vector, Matrix, Vector],
    turn_sides: tuple[Vector, Vector],
) -> tuple[Six, Six, Array, Array, Four, Mask]:
    """Return all quantities for timing at a point on a line or in a corner between two lines.

    Args:
        lengths: See `main_axes`.
        arm: Side, bend and flip at the point.
        lever: From the TCP to the wrist centre in the last frame of the formulas [m].
        line: Start and rate of the line before, rate of the line after.
        sides: Positions on both with their derivatives; outside corners the second is zero.
        turn: Start and rate of the rotation before, and after.
        turn_sides: Positions on both.

    Returns:
        Both derivatives of the angles, TCP travel and rotation per unit of the parameter, the
        stance of the arm, and whether it is regular; if not, the derivatives are meaningless.
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
    first, second, stance, regular = rates_of_arm(
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
    return first, second, tcp_rate, turn_rate, stance, regular


def rates_of_joints(signs: OfJoints, coupling: float, rates: Six) -> Six:
    """Return rates of joints from rates of the angles of the formulas; see `OpwGeometry`."""
    second = rates[1] * signs[1]
    return (
        rates[0] * signs[0],
        second,
        rates[2] * signs[2] - coupling * second,
        rates[3] * signs[3],
        rates[4] * signs[4],
        rates[5] * signs[5],
    )


def joints_near(
    signs: OfJoints, offsets: OfJoints, coupling: float, angles: Six, near: tuple[Array, ...]
) -> Six:
    """Return joints [rad] from angles of the formulas, each in the closest whole turn."""
    joints = rates_of_joints(
        signs,
        coupling,
        (
            angles[0] + offsets[0],
            angles[1] + offsets[1],
            angles[2] + offsets[2],
            angles[3] + offsets[3],
            angles[4] + offsets[4],
            angles[5] + offsets[5],
        ),
    )
    return (
        joints[0] + TURN * np.rint((near[0] - joints[0]) / TURN),
        joints[1] + TURN * np.rint((near[1] - joints[1]) / TURN),
        joints[2] + TURN * np.rint((near[2] - joints[2]) / TURN),
        joints[3] + TURN * np.rint((near[3] - joints[3]) / TURN),
        joints[4] + TURN * np.rint((near[4] - joints[4]) / TURN),
        joints[5] + TURN * np.rint((near[5] - joints[5]) / TURN),
    )


def joints_on_lines(
    lengths: Lengths,
    arm: Vector,
    lever: Vector,
    line: tuple[Vector, Vector, Vector],
    sides: tuple[Vector, Vector],
    turn: tuple[Matrix, Vector, Matrix, Vector],
    turn_sides: tuple[Vector, Vector],
) -> tuple[Six, Mask]:
    """Return the formulas' angles at a point; see `rates_on_lines` and `angles_of_arm`."""
    backwards, forwards = turned_twice(turn, turn_sides[0][0], turn_sides[1][0])
    rotation_6 = product(backwards, forwards)
    way = plus(scaled(line[1], sides[0][0]), scaled(line[2], sides[1][0]))
    centre = plus(plus(line[0], way), turned(rotation_6, lever))
    return angles_of_arm(lengths, arm, centre, rotation_6)


COMPILED = (
    plus,
    minus,
    scaled,
    crossed,
    turned,
    transposed,
    product,
    rotation,
    turned_twice,
    turning_on,
    lever_motion,
    main_axes,
    forearm_from_base,
    angles_of_arm,
    rates_of_arm,
    rates_on_lines,
    rates_of_joints,
    joints_near,
    joints_on_lines,
)
"""All functions, each after its callees."""
