"""Sphere around the base that a trajectory stays out of, and paths around it.

Near the base an arm is folded, and a small motion of the TCP requires large axis motions.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.waypoints.curves import BaseArc, Curve, SplineCurve, StraightLine
from rapidsim.motion.waypoints.points import between

_ROUNDING = 1e-9
"""Depth [m] inside the sphere that still counts as on the sphere."""
_PLACES = 2000
"""Number of points of a spline at which its distance from the base is evaluated."""


class ThroughBaseError(ValueError):
    """A line passes through the centre of the sphere: all paths around it are equally long."""


def nearest(curve: Curve) -> float:
    """Return the minimum distance [m] of a curve from the origin of the base."""
    match curve:
        case StraightLine():
            along = curve.end - curve.start
            square = float(along @ along)
            share = 0.0 if square == 0.0 else float(np.clip(-(curve.start @ along) / square, 0, 1))
            return float(np.linalg.norm(curve.start + share * along))
        case SplineCurve():
            parameters = np.linspace(curve.positions.breaks[0], curve.positions.end, _PLACES)
            distances = np.linalg.norm(curve.positions.at(parameters), axis=1)
            return float(distances.min())
        case _:
            ends = curve.at(np.array([0.0, curve.length])).translation
            return float(np.linalg.norm(ends, axis=1).min())


def around(line: StraightLine, radius: float) -> tuple[Curve, ...]:
    """Return a line with the part inside a sphere [m] around the base replaced by an arc on it.

    Args:
        line: A line with ends outside the sphere, or on it.
        radius: Radius of the sphere [m].

    Returns:
        The line itself, or its parts before and after an arc.

    Raises:
        ThroughBaseError: If the line passes through the centre.
    """
    closest = nearest(line)
    if closest > radius - _ROUNDING:
        return (line,)
    if closest < _ROUNDING:
        raise ThroughBaseError
    along = line.end - line.start
    way = float(np.linalg.norm(along))
    middle = -float(line.start @ along) / way
    half = sqrt(radius**2 - closest**2)
    first, last = (middle - half) / way, (middle + half) / way
    entry, leave = (line.start + share * along for share in (first, last))
    # Both points are on the sphere to the last bit, so that arc and lines meet.
    entry, leave = (radius * point / np.linalg.norm(point) for point in (entry, leave))
    turned = between(line.start_attitude, line.end_attitude, np.array([first, last]))
    angle = float(np.arctan2(np.linalg.norm(np.cross(entry, leave)), entry @ leave))
    arc = BaseArc(entry, leave, turned[0], turned[1], radius * angle)
    pieces: list[Curve] = [arc]
    before, after = first * line.length, (1.0 - last) * line.length
    if before > _ROUNDING:
        pieces.insert(0, StraightLine(line.start, entry, line.start_attitude, turned[0], before))
    if after > _ROUNDING:
        pieces.append(StraightLine(leave, line.end, turned[1], line.end_attitude, after))
    return tuple(pieces)


def pushed_out(positions: Array, radius: float) -> Array:
    """Return positions (k, 3) [m], those inside a sphere [m] moved radially to its surface.

    Raises:
        ThroughBaseError: If a position is at the centre.
    """
    distance = np.linalg.norm(positions, axis=1, keepdims=True)
    if (distance < _ROUNDING).any():
        raise ThroughBaseError
    out: Array = positions * np.maximum(1.0, radius / distance)
    return out
