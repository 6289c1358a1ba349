r"""Path offset of moves with \Corr: the sum of all correction generators, in path coordinates.

x is along the path, y the cross product of the tool's z and x, z that of x and y. The generators
connected when the instruction executes shift the end of the path, and the circle point of an arc;
the path begins at the end of the previous one. A controller also applies corrections that are
written while the robot moves, through a filter: neither is simulated, which moves with an offset
report.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "CorrCon".
"""

from __future__ import annotations

import math

from rapidsim.frames import quaternion
from rapidsim.frames.quaternion import Vector
from rapidsim.frames.vectors import crossed, dot, length, minus, plus, scaled
from rapidsim.language.controller import Motion
from rapidsim.language.data import Pos, RobTarget, ToolData, WobjData
from rapidsim.library.poses import normalised, single_pos

_LEAST_MM = 1e-3
"""Length [mm] below which a vector has no direction."""
_LEAST_SINE = 1e-6
"""Sine below which the tool points along its path, so that y is undefined."""


def sum_of(corrections: dict[int, Pos]) -> Vector:
    """Sum [mm] of the corrections of all generators."""
    x, y, z = zip(*corrections.values(), strict=True)
    return (math.fsum(x), math.fsum(y), math.fsum(z))


def offset(
    controller: Motion,
    to: RobTarget,
    circle_point: RobTarget | None,
    tool: ToolData,
    wobj: WobjData,
) -> tuple[RobTarget, RobTarget | None]:
    """Shift the end and the circle point of a path by the corrections of the generators.

    Args:
        controller: Provides the generators and the start of the programmed path.
        to: The programmed end, in the object frame.
        circle_point: The programmed circle point of an arc, in the object frame.
        tool: Tool of the move.
        wobj: Work object of the move.
    """
    way = sum_of(controller.corrections)
    start = controller.programmed_end(tool, wobj).trans
    if circle_point is None:
        return _moved(to, minus(to.trans, start), way), None
    at_circle_point, at_end = _tangents(start, circle_point.trans, to.trans)
    return _moved(to, at_end, way), _moved(circle_point, at_circle_point, way)


def _moved(point: RobTarget, tangent: Vector, way: Vector) -> RobTarget:
    """Shift a point in path coordinates; unchanged if path or tool define no direction."""
    if length(tangent) < _LEAST_MM:
        return point
    x = scaled(tangent, 1.0 / length(tangent))
    y = crossed(quaternion.rotate(normalised(point.rot), (0.0, 0.0, 1.0)), x)
    if length(y) < _LEAST_SINE:
        return point
    y = scaled(y, 1.0 / length(y))
    moved: Vector = point.trans
    for axis, part in zip((x, y, crossed(x, y)), way, strict=True):
        moved = plus(moved, scaled(axis, part))
    return point._replace(trans=single_pos(moved))


def _tangents(start: Vector, via: Vector, end: Vector) -> tuple[Vector, Vector]:
    """Tangents of an arc through three points, at the second and at the third."""
    to_start, to_via = minus(start, end), minus(via, end)
    normal = crossed(to_start, to_via)
    if length(normal) < _LEAST_MM * length(to_start):
        return minus(via, start), minus(end, via)
    # The centre of the circle, relative to its end.
    mixed = minus(scaled(to_via, dot(to_start, to_start)), scaled(to_start, dot(to_via, to_via)))
    centre = scaled(crossed(mixed, normal), 0.5 / dot(normal, normal))
    return crossed(normal, minus(to_via, centre)), crossed(normal, scaled(centre, -1.0))
