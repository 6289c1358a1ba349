"""The DH table and the screw axes of an arm, and tables of matrices: mm, degrees."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees
from typing import Any, TypeAlias

import numpy as np
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.axis_tables import dh_table_of, screws_of
from rapidsim.motion.robot.robot import Robot
from rapidsim.report.untruncated_table import UntruncatedTable

_SMALL = 1e-9
Matrix: TypeAlias = Sequence[Sequence[float]]
"""Rows of a matrix."""


def axis_tables_page(robot: Robot) -> RenderableType:
    """The DH table and the screws of an arm."""
    dh, screws = dh_table_of(robot.kinematics), screws_of(robot.kinematics)
    if dh is None or screws is None:
        return Text(
            f"{robot.title} has no DH table and no screw axes: rods carry its links, so that a "
            "joint turns more than one axis",
            "dim",
        )
    table = plain_table("joint", "theta [deg]", "d [mm]", "a [mm]", "alpha [deg]")
    for number, row in enumerate(zip(dh.theta, dh.d, dh.a, dh.alpha, strict=True), start=1):
        theta, d, a, alpha = (float(value) for value in row)
        turn, way = f"q{number}{_added(degrees(theta))}", decimal_text(1000.0 * d, 3)
        if dh.slides[number - 1]:
            turn, way = decimal_text(degrees(theta), 3), f"q{number}{_added(1000.0 * d)}"
        table.add_row(
            str(number), turn, way, decimal_text(1000.0 * a, 3), decimal_text(degrees(alpha), 3)
        )
    parts: list[RenderableType] = [Text("DH, standard form", "bold"), table]
    for name, frame in (("base, before row 1", dh.base), ("flange, after the last row", dh.flange)):
        if not is_identity(frame):
            parts += [Text(), matrix_table(name, frame)]
    poe = plain_table("joint", "wx", "wy", "wz", "vx [mm]", "vy [mm]", "vz [mm]")
    for number, (turn, moment) in enumerate(
        zip(screws.turns.tolist(), screws.moments_mm.tolist(), strict=True), start=1
    ):
        poe.add_row(
            str(number), *(decimal_text(w, 6) for w in turn), *(decimal_text(v, 3) for v in moment)
        )
    parts += [
        Text(),
        Text("screw axes of the product of exponentials, in the base frame", "bold"),
        poe,
        Text(),
        matrix_table("M, joints at 0", screws.base_from_flange),
    ]
    return Group(*parts)


def matrix_in_mm(frame: Transform) -> Array:
    """Homogeneous matrix (4, 4) of a frame, translation in mm."""
    matrix = frame.matrix
    matrix[:3, 3] *= 1000.0
    return matrix


def plain_numbers(values: Array) -> list[Any]:
    """Numbers without a negative zero."""
    numbers: list[Any] = (values + 0.0).tolist()
    return numbers


def is_identity(frame: Transform) -> bool:
    """Whether a frame is the one it is expressed in, up to rounding."""
    return bool(np.abs(frame.matrix - np.eye(4)).max() <= _SMALL)


def matrix_table(name: str, frame: Transform) -> Table:
    """A 4 x 4 matrix, lengths in mm."""
    table = plain_table(name, "x", "y", "z", "position [mm]")
    matrix = frame.matrix
    matrix[:3, 3] *= 1000.0
    for words, row in zip(("", "", "", ""), matrix.tolist(), strict=True):
        table.add_row(
            words, *(decimal_text(value, 6) for value in row[:3]), decimal_text(row[3], 3)
        )
    return table


def plain_table(first: str, *others: str, padding: int = 2) -> Table:
    """A table without lines; the first column is text, the others are numbers."""
    table = UntruncatedTable.without_lines(padding)
    table.add_column(first, no_wrap=True)
    for name in others:
        table.add_column(name, justify="right", no_wrap=True)
    return table


def decimal_text(value: float, digits: int) -> str:
    """Rounded, without a negative zero."""
    return f"{round(value, digits) + 0.0:.{digits}f}"


def _added(offset: float) -> str:
    """Offset of a joint, such as ` + 90`; empty for 0."""
    if abs(offset) < _SMALL:
        return ""
    return f" {'-' if offset < 0.0 else '+'} {abs(offset):g}"
