"""Derivatives on lines of ortho-parallel arms in closed form, many times as fast as in general.

Programs of many moves are lines. What is not a line of an arm that holds its tool and stands still
is left to the general way (`Arms.rates`), and so are places where the arm is close to singular.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion import line_formulas
from rapidsim.motion.arms import Arms
from rapidsim.motion.compiled import compiled
from rapidsim.motion.curves import STANDSTILL, Index
from rapidsim.motion.kinematics import Mask
from rapidsim.motion.layout import Layout
from rapidsim.motion.opw import OrthoParallel
from rapidsim.motion.turns import rotate

_CHUNK = 2048
_POSITION, _RATE, _TURN_RATE = slice(0, 3), slice(3, 6), slice(6, 9)
_ROTATION, _LEVER, _ARM = slice(9, 18), slice(18, 21), slice(21, 24)


@dataclass(frozen=True, slots=True, eq=False)
class Lines:
    """The lines of a path, in the frame of the formulas of its arm."""

    arm: OrthoParallel
    layout: Layout
    table: Array
    """Shape (m, 24): a row a curve; its columns are named above."""
    pieces: Mask
    """Shape (p,): the pieces that are lines, or corners between two."""
    turns_with_position: bool
    """Whether the tool turns in the same corners as the TCP."""

    def rates(self, s: Array, piece: Index) -> tuple[Array, Array, Array, Mask]:
        """Derivatives at places s (k,) of pieces (k,) that are lines.

        Returns:
            First and second derivatives of the joints (k, 6), TCP travel and turning (k, 2) per
            unit of s, and where (k,) they hold: not close to a singularity.
        """
        count = len(s)
        first, second, speeds = np.empty((count, 6)), np.empty((count, 6)), np.empty((count, 2))
        regular = np.empty(count, dtype=bool)
        kernel = compiled(line_formulas, "rates_one_by_one", count)
        fill = kernel or _rates_in_columns
        geometry = self.arm.geometry
        lengths = (geometry.a1, geometry.a2, geometry.b, geometry.c1, geometry.c2, geometry.c3)
        for begin in range(0, count, _CHUNK):
            part = slice(begin, begin + _CHUNK)
            at, pieces = s[part], piece[part]
            corners = self._corners(self.layout.position_corner[pieces], at, pieces, turning=False)
            turn_corners = corners
            if not self.turns_with_position:
                corner = self.layout.orientation_corner[pieces]
                turn_corners = self._corners(corner, at, pieces, turning=True)
            fill(
                lengths,
                self.table,
                self.layout.row[pieces],
                corners,
                turn_corners,
                first[part],
                second[part],
                speeds[part],
                regular[part],
            )
        return self._of_joints(first), self._of_joints(second), speeds, regular

    def _corners(
        self, corner: Index, s: Array, piece: Index, *, turning: bool
    ) -> tuple[Index, Index, Array]:
        """Lines before and after (k,), and places on both with derivatives (6, k).

        Away from corners both are the line itself, and the one after adds nothing.
        """
        layout = self.layout
        row = layout.row[piece]
        into, out = row.copy(), row.copy()
        sides = np.zeros((6, len(s)))
        sides[0], sides[1] = s - layout.places[row], 1.0
        cut = np.flatnonzero(corner >= 0)
        if len(cut):
            into[cut], out[cut] = corner[cut], corner[cut] + 1
            corners = layout.corners
            radius = (corners.orientation_radius if turning else corners.radius)[corner[cut]]
            before, after = layout.sides(corner[cut], radius, s[cut])
            sides[:, cut] = np.stack([*before, *after])
        return into, out, sides

    def _of_joints(self, rates: Array) -> Array:
        """Rates of joints from rates of the angles of the formulas (k, 6)."""
        rates *= np.array(self.arm.geometry.signs, dtype=np.float64)
        if self.arm.geometry.coupling:
            rates[:, 2] -= self.arm.geometry.coupling * rates[:, 1]
        return rates


def lines_of(layout: Layout, arms: Arms) -> Lines | None:
    """The lines of a path, or None where there are none of an arm with closed forms."""
    arm, curves = arms.kinematics, layout.curves
    if not isinstance(arm, OrthoParallel) or curves.start_joints.shape[1] != arm.joint_count:
        return None
    plain = ~(
        curves.in_joints | arms.wrist_rows | arms.carried_rows | curves.frame_turn.any(axis=1)
    )
    in_line = plain[layout.row] & (layout.joint_corner < 0)
    for corner in (layout.position_corner, layout.orientation_corner):
        cut = np.flatnonzero(corner >= 0)
        in_line[cut] &= plain[corner[cut]] & plain[corner[cut] + 1]
    if not in_line.any():
        return None
    base = arm.base_from_opw.inverse()
    tcp_from_opw6 = arms.tcp_from_flange @ arm.opw6_from_flange.inverse()
    start = base @ curves.start
    scale = 1.0 / np.maximum(curves.length, STANDSTILL)[:, None]
    table = np.empty((len(plain), 24))
    table[:, _POSITION] = start.translation
    table[:, _RATE] = rotate(base.rotation, curves.chord * scale)
    table[:, _TURN_RATE] = rotate(base.rotation, curves.tool_turn * scale)
    table[:, _ROTATION] = (start.rotation @ tcp_from_opw6.rotation).reshape(-1, 9)
    # From the TCP to the wrist centre, as the last frame of the formulas sees it.
    table[:, _LEVER] = rotate(
        np.swapaxes(tcp_from_opw6.rotation, -1, -2), tcp_from_opw6.translation
    )
    for column, bit in zip(range(_ARM.start, _ARM.stop), (4, 2, 1), strict=True):
        table[:, column] = np.where(arms.branch & bit, -1.0, 1.0)
    corners = layout.corners
    same = np.array_equal(layout.position_corner, layout.orientation_corner) and np.array_equal(
        corners.radius, corners.orientation_radius
    )
    return Lines(arm, layout, table, in_line, same)


def _rates_in_columns(
    lengths: line_formulas.Lengths,
    table: Array,
    row: Index,
    corners: tuple[Index, Index, Array],
    turn_corners: tuple[Index, Index, Array],
    first: Array,
    second: Array,
    speeds: Array,
    regular: Mask,
) -> None:
    """See `line_formulas.rates_one_by_one`: the same for all places at once."""
    own, a, b = (_columns(table, index) for index in (row, corners[0], corners[1]))
    c, d = a, b
    if turn_corners is not corners:
        c, d = (_columns(table, index) for index in turn_corners[:2])
    x, y = corners[2], turn_corners[2]
    q1, q2, speeds[:, 0], speeds[:, 1], regular[:] = line_formulas.rates_on_lines(
        lengths,
        own[_ARM],
        own[_LEVER],
        (a[_POSITION], a[_RATE], b[_RATE]),
        ((x[0], x[1], x[2]), (x[3], x[4], x[5])),
        (c[_ROTATION], c[_TURN_RATE], d[_ROTATION], d[_TURN_RATE]),
        ((y[0], y[1], y[2]), (y[3], y[4], y[5])),
    )
    for i in range(6):
        first[:, i], second[:, i] = q1[i], q2[i]


def _columns(table: Array, index: Index) -> tuple[Any, ...]:
    """Some rows of the table, each column by itself."""
    return tuple(np.ascontiguousarray(table[index].T))
