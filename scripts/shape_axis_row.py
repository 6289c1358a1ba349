"""How an arm that works beside people looks: round joints, round tubes, no edges.

One likeness for every row of axes: each joint is a drum along its axis, each link a tube from the
drum that turns it to the one that it carries. Radii fall from foot to flange.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import solids
from solids import DARK, GRAPHITE, LIGHT, STEEL, Body, Z, hull, lathe

from rapidsim.frames.rotation_vectors import rotation_from_vector
from rapidsim.motion.kinematics.numerical.revolute_chain import AxisRowGeometry

Array = npt.NDArray[np.float64]
AROUND = 26
WIDE = 2.3
"""Length of a joint's drum in radii."""


def links(geometry: AxisRowGeometry, reach: float) -> dict[str, list[Body]]:
    """The bodies of each link, in its frame."""
    axes = geometry.axes
    count = len(axes.points)
    radii = 0.092 * reach**0.75 * np.linspace(1.0, 0.56, count)
    centres = _drums(axes.points, axes.directions, radii)
    flange = axes.base_from_flange
    first = _between_foot(centres[0], radii[0])
    shapes = {"base_link": first}
    for number in range(count):
        bodies = []
        if number + 1 < count:
            here, there = centres[number], centres[number + 1]
            bodies += _tube(
                here,
                axes.directions[number],
                radii[number],
                there,
                axes.directions[number + 1],
                radii[number + 1],
            )
        else:
            bodies += _end(
                centres[number], flange.translation, flange.rotation[:, 2], radii[number]
            )
        origin = axes.base_from_link.translation[number]
        shapes[f"link_{number + 1}"] = [solids.moved(body, np.eye(3), -origin) for body in bodies]
    return shapes


def _drums(points: Array, directions: Array, radii: Array) -> Array:
    """Where the middle of each joint's drum is (n, 3): on its axis, clear of its neighbours."""
    centres = points.copy()
    for k in range(len(points)):
        if abs(directions[k, 2]) > 0.9 and k == 0:
            centres[k, 2] = max(points[1, 2] - 1.9 * radii[0], 0.4 * points[1, 2])
    for k in range(1, len(points) - 1):
        along = points[k + 1] - points[k]
        gap = float(along @ directions[k])
        if abs(gap) > 2.0 * radii[k]:
            centres[k] = points[k] + directions[k] * (0.45 * gap)
    return centres


def _drum(centre: Array, direction: Array, radius: float, width: float) -> Array:
    """Points of a rounded drum along any direction."""
    cloud = solids.disc((0.0, 0.0, 0.0), Z, radius, width, 0.35 * radius, AROUND, 3)
    return cloud @ _towards(direction).T + centre


def _tube(
    here: Array, axis: Array, radius: float, there: Array, next_axis: Array, next_radius: float
) -> list[Body]:
    own = _drum(here, axis, radius, WIDE * radius)
    carried = _drum(there, next_axis, 0.97 * next_radius, 1.7 * next_radius)
    way = there - here
    length = float(np.linalg.norm(way))
    bodies = [hull(LIGHT, own), hull(LIGHT, carried)]
    if length > 1e-6:
        ends = [
            solids.ball((float(p[0]), float(p[1]), float(p[2])), r)
            for p, r in ((here, 0.86 * radius), (there, 0.86 * next_radius))
        ]
        bodies.append(hull(LIGHT, *ends))
    lid = _drum(here + axis * (0.5 * WIDE * radius), axis, 0.82 * radius, 0.14 * radius)
    other = _drum(here - axis * (0.5 * WIDE * radius), axis, 0.82 * radius, 0.14 * radius)
    return [*bodies, hull(GRAPHITE, lid), hull(GRAPHITE, other)]


def _end(centre: Array, flange: Array, out: Array, radius: float) -> list[Body]:
    """The last drum and the plate that tools are bolted to."""
    thick = 0.35 * radius
    body = hull(
        LIGHT,
        _drum(centre, out, 0.95 * radius, 1.2 * radius),
        _drum(flange - out * 1.2 * thick, out, 0.8 * radius, 0.4 * thick),
    )
    rim = [(0.62 * radius, -thick), (0.70 * radius, -0.9 * thick), (0.70 * radius, 0.0)]
    plate = lathe(STEEL, rim, (0.0, 0.0, 0.0), Z, around=AROUND)
    return [body, solids.moved(plate, _towards(out), flange)]


def _between_foot(first: Array, radius: float) -> list[Body]:
    plate = solids.disc((0.0, 0.0, 0.1 * radius), Z, 1.45 * radius, 0.2 * radius, 0.05 * radius, 40)
    cone = hull(
        LIGHT,
        solids.disc((0.0, 0.0, 0.3 * radius), Z, 1.35 * radius, 0.3 * radius, 0.08 * radius, 40),
        solids.disc((0.0, 0.0, float(first[2])), Z, 0.98 * radius, 0.4 * radius, 0.1 * radius, 40),
    )
    plug = solids.disc(
        (-1.3 * radius, 0.0, 0.5 * radius), 0, 0.25 * radius, 0.4 * radius, 0.05 * radius
    )
    return [hull(GRAPHITE, plate), cone, hull(DARK, plug)]


def _towards(direction: Array) -> Array:
    """A rotation (3, 3) that takes z to a direction."""
    up = np.array([0.0, 0.0, 1.0])
    axis = np.cross(up, direction)
    sine, cosine = float(np.linalg.norm(axis)), float(direction[2])
    if sine < 1e-9:
        return np.eye(3) if cosine > 0.0 else np.diag([1.0, -1.0, -1.0])
    turned: Array = rotation_from_vector(axis / sine * np.arctan2(sine, cosine))
    return turned
