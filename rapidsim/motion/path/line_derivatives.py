"""Closed-form derivatives on lines of ortho-parallel arms, much faster than the general method.

Programs with many moves consist of lines. Anything but a line of a stationary arm holding its tool
uses the general method (`JointMapper.rates`), as do points where the arm is close to singular.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from rapidsim.frames.rotation_vectors import rotate
from rapidsim.frames.transform import Array
from rapidsim.motion.derived_values import derived_value
from rapidsim.motion.geometry.curves import STANDSTILL, Index
from rapidsim.motion.geometry.joint_mapping import JointMapper
from rapidsim.motion.geometry.parameterisation import PathParameterisation
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.kinematics.closed_form.opw import OrthoParallel
from rapidsim.motion.numba_jit import jit_function
from rapidsim.motion.path import line_formulas, line_loops
from rapidsim.motion.path.along_curves import Nodes
from rapidsim.motion.path.path_derivatives import PathRates

_CHUNK = 2048
_CLEAR_WRIST = 0.05
"""sin of axis 5 above which the pose determines axes 4 and 6."""
_POSITION, _RATE, _TURN_RATE = slice(0, 3), slice(3, 6), slice(6, 9)
_ROTATION, _LEVER, _ARM = slice(9, 18), slice(18, 21), slice(21, 24)


@dataclass(frozen=True, eq=False)
class Lines:
    """Lines of a path, in the frame of the arm's formulas."""

    arm: OrthoParallel
    layout: PathParameterisation
    arms: JointMapper
    pieces: Mask
    """Shape (p,): mask of the pieces that are lines, or corners between two lines."""
    rows: Mask
    """Shape (m,): mask of the curves that are lines."""
    turns_with_position: bool
    """Whether the tool turns in the same corners as the TCP."""

    @cached_property
    def alone(self) -> Lines:
        """Lines as programmed, without corners: the piece of each has the number of its row."""
        count = len(self.rows)
        no_corner = np.full(count, -1, dtype=np.int64)
        layout = replace(
            self.layout,
            bounds=self.layout.places,
            row=np.arange(count),
            position_corner=no_corner,
            orientation_corner=no_corner,
            joint_corner=no_corner,
        )
        return replace(self, layout=layout, pieces=self.rows, turns_with_position=True)

    def rates(self, s: Array, piece: Index) -> tuple[PathRates, Mask]:
        """Return derivatives at s (k,) on pieces (k,), and a mask (k,) of valid rows.

        They are valid on lines where the arm is not close to a singularity.
        """
        in_line = self.pieces[piece]
        rates = PathRates.not_filled(len(s), 6)
        if not in_line.all():
            line = np.flatnonzero(in_line)
            found, in_line[line] = self.rates(s[line], piece[line])
            rates.put(line, found)
            return rates, in_line
        count, regular = len(s), in_line
        kernel = jit_function(line_loops, "rates_one_by_one", count)
        if kernel is not None:
            kernel(
                *(self._lengths, self._signs, self._coupling, self._shapes, self._course),
                *(s, piece, *rates.columns, regular),
            )
            return rates, regular
        for begin in range(0, count, _CHUNK):
            part = slice(begin, begin + _CHUNK)
            q1, q2, rates.tcp_rate[part], rates.turn_rate[part], stance, regular[part] = (
                line_formulas.rates_on_lines(self._lengths, *self._in_columns(s[part], piece[part]))
            )
            rates.stance[part] = np.stack(stance, axis=-1)
            for rows, angles in ((rates.first, q1), (rates.second, q2)):
                columns = line_formulas.rates_of_joints(self._signs, self._coupling, angles)
                for i, column in enumerate(columns):
                    rows[part, i] = column
        return rates, regular

    def joints(self, s: Array, piece: Index) -> tuple[Array, Mask]:
        """Return joints (k, 6) [rad] at s (k,) on pieces (k,), and a mask of valid rows.

        Each is in the whole turn closest to linear interpolation in joint space.
        """
        in_line = self.pieces[piece]
        joints = np.empty((len(s), 6))
        if not in_line.all():
            line = np.flatnonzero(in_line)
            joints[line], in_line[line] = self.joints(s[line], piece[line])
            return joints, in_line
        count, regular = len(s), in_line
        curves, offsets = self.layout.curves, self.arm.geometry.offsets
        kernel = jit_function(line_loops, "joints_one_by_one", count)
        if kernel is not None:
            kernel(
                *(self._lengths, self._signs, offsets, self._coupling, self._shapes),
                *(self._course, curves.start_joints, curves.joint_travel),
                *(s, piece, joints, regular),
            )
            return joints, regular
        for begin in range(0, count, _CHUNK):
            part = slice(begin, begin + _CHUNK)
            angles, regular[part] = line_formulas.joints_on_lines(
                self._lengths, *self._in_columns(s[part], piece[part])
            )
            row = self.layout.row[piece[part]]
            near = curves.joints_at(row, s[part] - self.layout.places[row])
            columns = line_formulas.joints_near(
                self._signs, offsets, self._coupling, angles, tuple(near.T)
            )
            for i, column in enumerate(columns):
                joints[part, i] = column
        return joints, regular

    def regular(self, nodes: Nodes) -> Mask:
        """Return which nodes (k,) are on lines, with axis 5 well away from a singularity."""
        wrist = self.arm.theta_from_joints(nodes.joints)[:, 4]
        clear: Mask = self.rows[nodes.curve] & (np.abs(np.sin(wrist)) > _CLEAR_WRIST)
        return clear

    @cached_property
    def _lengths(self) -> line_formulas.Lengths:
        g = self.arm.geometry
        return g.a1, g.a2, g.b, g.c1, g.c2, g.c3

    @cached_property
    def _signs(self) -> tuple[float, ...]:
        return tuple(float(sign) for sign in self.arm.geometry.signs)

    @property
    def _coupling(self) -> float:
        return float(self.arm.geometry.coupling)

    @property
    def _shapes(self) -> tuple[int, int]:
        return self.layout.shape, self.layout.turn_shape

    @derived_value
    def table(self) -> Array:
        """Shape (m, 24): one row per curve; its columns are named above."""
        curves, arms = self.layout.curves, self.arms
        base = self.arm.base_from_opw.inverse()
        tcp_from_opw6 = arms.tcp_from_flange @ self.arm.opw6_from_flange.inverse()
        start = base @ curves.start
        scale = 1.0 / np.maximum(curves.length, STANDSTILL)[:, None]
        table = np.empty((len(self.rows), 24))
        table[:, _POSITION] = start.translation
        table[:, _RATE] = rotate(base.rotation, curves.chord * scale)
        table[:, _TURN_RATE] = rotate(base.rotation, curves.tool_turn * scale)
        table[:, _ROTATION] = (start.rotation @ tcp_from_opw6.rotation).reshape(-1, 9)
        # From the TCP to the wrist centre, expressed in the last frame of the formulas.
        table[:, _LEVER] = rotate(
            np.swapaxes(tcp_from_opw6.rotation, -1, -2), tcp_from_opw6.translation
        )
        for column, bit in zip(range(_ARM.start, _ARM.stop), (4, 2, 1), strict=True):
            table[:, column] = np.where(arms.branch & bit, -1.0, 1.0)
        return table

    @property
    def _course(self) -> line_loops.CurveColumns:
        layout = self.layout
        return (
            *(self.table, layout.places, layout.curves.length),
            *(layout.corners.radius, layout.corners.orientation_radius),
            *(layout.row, layout.position_corner, layout.orientation_corner),
        )

    def _in_columns(self, s: Array, piece: Index) -> tuple[Any, ...]:
        """Return inputs of the formulas at s (k,), in columns; see `line_loops.place_on_lines`."""
        layout = self.layout
        into, out, sides = self._corners(layout.position_corner[piece], s, piece, turning=False)
        own, a, b = (_columns(self.table, index) for index in (layout.row[piece], into, out))
        c, d, turn_sides = a, b, sides
        if not self.turns_with_position:
            corner = layout.orientation_corner[piece]
            into, out, turn_sides = self._corners(corner, s, piece, turning=True)
            c, d = _columns(self.table, into), _columns(self.table, out)
        x, y = sides, turn_sides
        return (
            own[_ARM],
            own[_LEVER],
            (a[_POSITION], a[_RATE], b[_RATE]),
            ((x[0], x[1], x[2]), (x[3], x[4], x[5])),
            (c[_ROTATION], c[_TURN_RATE], d[_ROTATION], d[_TURN_RATE]),
            ((y[0], y[1], y[2]), (y[3], y[4], y[5])),
        )

    def _corners(
        self, corner: Index, s: Array, piece: Index, *, turning: bool
    ) -> tuple[Index, Index, Array]:
        """Return lines before and after (k,), and positions on both with derivatives (6, k).

        Outside corners both are the line itself, and the second contributes nothing.
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
            shape = layout.turn_shape if turning else layout.shape
            before, after = layout.sides(corner[cut], radius, s[cut], shape)
            sides[:, cut] = np.stack([*before, *after])
        return into, out, sides


def lines_of(layout: PathParameterisation, arms: JointMapper) -> Lines | None:
    """Return the lines of a path; None if the arm has no closed formulas or no piece is a line."""
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
    corners = layout.corners
    turns_in_corners = corners.orientation_radius.any()
    same = not turns_in_corners or (
        layout.shape == layout.turn_shape
        and np.array_equal(layout.position_corner, layout.orientation_corner)
        and np.array_equal(corners.radius, corners.orientation_radius)
    )
    return Lines(arm, layout, arms, in_line, plain, same)


def _columns(table: Array, index: Index) -> tuple[Any, ...]:
    """Return rows of the table as separate contiguous columns."""
    return tuple(np.ascontiguousarray(table[index].T))
