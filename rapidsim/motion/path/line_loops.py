"""Point-by-point loops over the formulas for lines, for compilation; else columns are used.

`CurveColumns` contains the arrays of a layout for both loops: the table of
`line_derivatives.Lines`, s at the start of each curve, lengths of curves, radii of corners for
position and for orientation, and for each piece its curve and the corners that contain its position
and orientation, or -1.
"""

from __future__ import annotations

from typing import Any

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry import blend_shape
from rapidsim.motion.geometry.blend_shape import corner_sides
from rapidsim.motion.geometry.joint_mapping import Index
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.path import line_formulas
from rapidsim.motion.path.line_formulas import (
    Lengths,
    Matrix,
    OfJoints,
    Six,
    Vector,
    joints_near,
    joints_on_lines,
    rates_of_joints,
    rates_on_lines,
)

CurveColumns = tuple[Array, Array, Array, Array, Array, Index, Index, Index]

TINY_LENGTH = 1e-9
"""Copy of `curves.STANDSTILL`."""


def rates_one_by_one(
    lengths: Lengths,
    signs: OfJoints,
    coupling: float,
    shapes: tuple[int, int],
    course: CurveColumns,
    s: Array,
    piece: Index,
    first: Array,
    second: Array,
    tcp_rate: Array,
    turn_rate: Array,
    stance: Array,
    regular: Mask,
) -> None:
    """Fill in derivatives at points.

    Args:
        lengths: See `line_formulas.main_axes`.
        signs: Signs of the joints relative to the angles of the formulas.
        coupling: See `OpwGeometry`.
        shapes: Blend shapes of corners for position and orientation; see `corner_sides`.
        course: See above.
        s: Points (k,) [m].
        piece: Their pieces (k,).
        first: Filled with first derivatives of the joints (k, 6).
        second: Filled with second derivatives (k, 6).
        tcp_rate: Filled with TCP travel (k,) per unit of s.
        turn_rate: Filled with rotation (k,) per unit of s.
        stance: Filled with the arm's stance (k, 4); see `PathRates`.
        regular: Filled with a mask (k,) of valid rows.
    """
    for k in range(len(s)):
        arm, lever, line, sides, turn, turn_sides = place_on_lines(course, shapes, s[k], piece[k])
        q1, q2, tcp_rate[k], turn_rate[k], stands, regular[k] = rates_on_lines(
            lengths, arm, lever, line, sides, turn, turn_sides
        )
        for i in range(4):
            stance[k, i] = stands[i]
        q1, q2 = rates_of_joints(signs, coupling, q1), rates_of_joints(signs, coupling, q2)
        for i in range(6):
            first[k, i] = q1[i]
            second[k, i] = q2[i]


def joints_one_by_one(
    lengths: Lengths,
    signs: OfJoints,
    offsets: OfJoints,
    coupling: float,
    shapes: tuple[int, int],
    course: CurveColumns,
    start_joints: Array,
    joint_travel: Array,
    s: Array,
    piece: Index,
    joints: Array,
    regular: Mask,
) -> None:
    """Fill in joints (k, 6) at points, each in the turn closest to linear interpolation.

    Args:
        lengths: See `rates_one_by_one`.
        signs: See `rates_one_by_one`.
        offsets: See `OpwGeometry`.
        coupling: See `OpwGeometry`.
        shapes: See `rates_one_by_one`.
        course: See `CurveColumns`.
        start_joints: Joints (m, 6) [rad] at the start of each curve.
        joint_travel: End joints minus start joints of each curve.
        s: Points (k,) [m].
        piece: Their pieces (k,).
        joints: Filled with joints (k, 6) [rad].
        regular: Filled with a mask (k,) of valid rows.
    """
    for k in range(len(s)):
        arm, lever, line, sides, turn, turn_sides = place_on_lines(course, shapes, s[k], piece[k])
        angles, holds = joints_on_lines(lengths, arm, lever, line, sides, turn, turn_sides)
        row = course[5][piece[k]]
        share = (s[k] - course[1][row]) / max(course[2][row], TINY_LENGTH)
        start, way = six(start_joints, row), six(joint_travel, row)
        near = (
            start[0] + share * way[0],
            start[1] + share * way[1],
            start[2] + share * way[2],
            start[3] + share * way[3],
            start[4] + share * way[4],
            start[5] + share * way[5],
        )
        found = joints_near(signs, offsets, coupling, angles, near)
        for i in range(6):
            joints[k, i] = found[i]
        regular[k] = holds


def place_on_lines(
    course: CurveColumns,
    shapes: tuple[int, int],
    s: float,
    piece: int,
) -> tuple[
    Vector,
    Vector,
    tuple[Vector, Vector, Vector],
    tuple[Vector, Vector],
    tuple[Matrix, Vector, Matrix, Vector],
    tuple[Vector, Vector],
]:
    """Arguments of `rates_on_lines` at one point: arm, lever, line, sides, turn, turn_sides."""
    table, _, _, radii, turn_radii, rows, corners, turn_corners = course
    row, corner, turn_corner = rows[piece], corners[piece], turn_corners[piece]
    a, b, before, after = sides_at(course, radii, shapes[0], corner, row, s)
    c, d, turn_before, turn_after = a, b, before, after
    if (
        turn_corner != corner
        or shapes[0] != shapes[1]
        or (corner >= 0 and turn_radii[corner] != radii[corner])
    ):
        c, d, turn_before, turn_after = sides_at(course, turn_radii, shapes[1], turn_corner, row, s)
    return (
        three(table, row, 21),
        three(table, row, 18),
        (three(table, a, 0), three(table, a, 3), three(table, b, 3)),
        (before, after),
        (nine(table, c, 9), three(table, c, 6), nine(table, d, 9), three(table, d, 6)),
        (turn_before, turn_after),
    )


def sides_at(
    course: CurveColumns,
    radii: Array,
    shape: int,
    corner: int,
    row: int,
    s: float,
) -> tuple[int, int, Any, Any]:
    """Return lines before and after a corner, and positions on both; see `corner_sides`.

    Outside corners both are the line itself, and the second contributes nothing.
    """
    if corner < 0:
        return row, row, (s - course[1][row], 1.0, 0.0), (0.0, 0.0, 0.0)
    past = s - course[1][corner + 1]
    before, after = corner_sides(shape, past, radii[corner], course[2][corner])
    return corner, corner + 1, before, after


def three(table: Array, row: int, column: int) -> Vector:
    """Return a vector in a row of a table."""
    return table[row, column], table[row, column + 1], table[row, column + 2]


def six(table: Array, row: int) -> Six:
    """Return a row of six."""
    return (
        table[row, 0],
        table[row, 1],
        table[row, 2],
        table[row, 3],
        table[row, 4],
        table[row, 5],
    )


def nine(table: Array, row: int, column: int) -> Matrix:
    """Return a matrix in a row of a table."""
    return (
        table[row, column],
        table[row, column + 1],
        table[row, column + 2],
        table[row, column + 3],
        table[row, column + 4],
        table[row, column + 5],
        table[row, column + 6],
        table[row, column + 7],
        table[row, column + 8],
    )


COMPILED = (
    *blend_shape.COMPILED,
    *line_formulas.COMPILED,
    three,
    six,
    nine,
    sides_at,
    place_on_lines,
    rates_one_by_one,
    joints_one_by_one,
)
"""All functions, each after its callees."""
