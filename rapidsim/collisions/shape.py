"""Shapes of a cell: convex parts for checking, and surfaces for drawing.

A non-convex shape is checked by its triangles, each a part, or by the convex hull of each piece;
`hollow_m` bounds the distance of such a hull from the body.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field, replace
from enum import StrEnum

import numpy as np

from rapidsim.collisions.convex import NO_TRIANGLES, ConvexPart
from rapidsim.collisions.meshes.triangles import (
    Faces,
    Triangles,
    components,
    corners_of,
    hollowness,
)
from rapidsim.frames.transform import Array, Transform
from rapidsim.values import value_class

_CONVEX_M = 1e-4
"""Protrusion [m] beyond its faces up to which a piece is convex."""
_NORMALS = 24
"""Number of faces of a piece on which other bodies may come to rest."""
_AROUND = 48
_ASKEW = np.array([0.5377, 0.3119, 0.7834])
_HALF_SPACE_M = 100.0
_DEEP_M = 10.0
_CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
_BOX_FACES = np.array(
    [
        [0, 1, 3],
        [0, 3, 2],
        [4, 6, 7],
        [4, 7, 5],
        [0, 4, 5],
        [0, 5, 1],
        [2, 3, 7],
        [2, 7, 6],
        [0, 2, 6],
        [0, 6, 4],
        [1, 5, 7],
        [1, 7, 3],
    ]
)


class Filling(StrEnum):
    """Parts of a mesh that are checked."""

    SOLID = "solid"
    """A closed surface: the body that it bounds."""
    SURFACE = "surface"
    """Only the triangles, with nothing between them."""
    HULL = "hull"
    """Hull of all corners."""


@value_class(frozen=True, slots=True, eq=False)
class Shape:
    """A body [m] in its own frame."""

    parts: tuple[ConvexPart, ...]
    vertices: Array
    """Shape (k, 3): vertices of the drawn surface."""
    faces: Faces
    """Shape (f, 3)"""
    hollow_m: float = 0.0
    """Depth [m] by which the checked shape may exceed the body."""
    triangles: Array = field(default_factory=lambda: NO_TRIANGLES)
    """Shape (t, 3, 3): triangles that are checked in addition to the parts."""
    solid: Triangles | None = None
    """Closed surface of these triangles, which leave its inside empty; else None."""

    def moved(self, a_from_b: Transform) -> Shape:
        """Return the body in frame a."""
        solid = self.solid
        return replace(
            self,
            parts=tuple(
                replace(
                    one,
                    points=a_from_b.apply(one.points),
                    normals=one.normals @ a_from_b.rotation.T,
                )
                for one in self.parts
            ),
            vertices=a_from_b.apply(self.vertices),
            triangles=a_from_b.apply(self.triangles.reshape(-1, 3)).reshape(-1, 3, 3),
            solid=solid and replace(solid, vertices=a_from_b.apply(solid.vertices)),
        )


def union(shapes: Sequence[Shape]) -> Shape:
    """Return several bodies as one."""
    starts = np.cumsum([0, *(len(one.vertices) for one in shapes)])
    return Shape(
        tuple(part for one in shapes for part in one.parts),
        np.concatenate([one.vertices for one in shapes]),
        np.concatenate([one.faces + start for one, start in zip(shapes, starts, strict=False)]),
        max(one.hollow_m for one in shapes),
        np.concatenate([one.triangles for one in shapes]),
    )


def box(size: Array) -> Shape:
    """Return a box of size (3,) around the origin."""
    corners = _CORNERS * (0.5 * np.asarray(size))
    return Shape((ConvexPart(corners, normals=np.eye(3)),), corners, _BOX_FACES)


def half_space() -> Shape:
    """Return the half-space below z = 0, limited to the extent of a cell."""
    size = np.array([2.0 * _HALF_SPACE_M, 2.0 * _HALF_SPACE_M, _DEEP_M])
    return box(size).moved(Transform(np.eye(3), np.array([0.0, 0.0, -0.5 * _DEEP_M])))


def sphere(radius: float) -> Shape:
    """Return a sphere around the origin."""
    bow = np.linspace(-0.5 * np.pi, 0.5 * np.pi, _AROUND // 2 + 1)
    surface = _turned(radius * np.column_stack([np.cos(bow), np.sin(bow)]))
    return Shape((ConvexPart(np.zeros((1, 3)), radius=radius),), *surface)


def cylinder(radius: float, length: float) -> Shape:
    """Return a cylinder along z, centred at the origin."""
    ends = _ends(0.5 * length)
    half = 0.5 * length
    surface = _turned(np.array([[0.0, -half], [radius, -half], [radius, half], [0.0, half]]))
    along = np.array([[0.0, 0.0, 1.0]])
    return Shape((ConvexPart(ends, disc=radius, normals=along),), *surface)


def capsule(radius: float, length: float) -> Shape:
    """Return a cylinder along z with a hemisphere at either end, centred at the origin."""
    bow = np.linspace(0.0, 0.5 * np.pi, _AROUND // 4 + 1)
    cap = radius * np.column_stack([np.cos(bow), np.sin(bow)])
    upper = cap + np.array([0.0, 0.5 * length])
    outline = np.concatenate([(upper * (1, -1))[::-1], upper])
    return Shape((ConvexPart(_ends(0.5 * length), radius=radius),), *_turned(outline))


def is_inside(solid: Triangles, point: Array) -> bool:
    """Whether a point (3,) is inside a closed surface, by the parity of a ray's crossings.

    The ray is skew, so that it does not meet edges of typical drawings.
    """
    a, b, c = (solid.vertices[solid.faces[:, i]] for i in range(3))
    edge, other = b - a, c - a
    across = np.cross(_ASKEW, other)
    scale = np.einsum("kj,kj->k", edge, across)
    there = np.abs(scale) > 1e-300
    scale = np.where(there, scale, 1.0)
    apart = point - a
    u = np.einsum("kj,kj->k", apart, across) / scale
    turned = np.cross(apart, edge)
    v = turned @ _ASKEW / scale
    ahead = np.einsum("kj,kj->k", other, turned) / scale > 0.0
    met = there & (u >= 0.0) & (v >= 0.0) & (u + v <= 1.0) & ahead
    return bool(met.sum() % 2)


def of_mesh(mesh: Triangles, filling: Filling) -> Shape:
    """Return the body that a mesh represents.

    A convex piece is one part; for other pieces each triangle is a part.
    """
    if filling is Filling.HULL:
        return _hulls(mesh, [mesh.faces])
    pieces = components(mesh.faces, len(mesh.vertices))
    depths = [hollowness(mesh.vertices, faces, _CONVEX_M) for faces in pieces]
    solid = filling is Filling.SOLID
    parts: list[ConvexPart] = []
    hollow: list[Faces] = []
    for faces, depth in zip(pieces, depths, strict=True):
        if solid and depth <= _CONVEX_M:
            parts.append(_convex(mesh.vertices, faces))
        else:
            hollow.append(faces)
    inside, triangles = None, NO_TRIANGLES
    if hollow:
        surface = np.concatenate(hollow)
        triangles = mesh.vertices[surface]
        inside = Triangles(mesh.vertices, surface, closed=True) if solid else None
    return Shape(tuple(parts), mesh.vertices, mesh.faces, triangles=triangles, solid=inside)


def hull_of_each_piece(mesh: Triangles) -> Shape:
    """Return the convex hulls of the pieces of a mesh, without those inside another: for arms."""
    return _hulls(mesh, components(mesh.faces, len(mesh.vertices)))


def _hulls(mesh: Triangles, pieces: Sequence[Faces]) -> Shape:
    hollow = max(hollowness(mesh.vertices, faces) for faces in pieces)
    bodies = [_convex(mesh.vertices, faces) for faces in pieces]
    clouds = [one.points for one in bodies]
    boxes = np.array([(cloud.min(axis=0), cloud.max(axis=0)) for cloud in clouds])
    outer = tuple(
        body
        for number, body in enumerate(bodies)
        if not any(
            other != number
            and (boxes[other, 0] <= boxes[number, 0]).all()
            and (boxes[other, 1] >= boxes[number, 1]).all()
            and _is_in_hull(body.points, mesh.vertices, faces)
            for other, faces in enumerate(pieces)
        )
    )
    return Shape(outer, mesh.vertices, mesh.faces, hollow if hollow > _CONVEX_M else 0.0)


def _convex(vertices: Array, faces: Faces) -> ConvexPart:
    """Return the hull of a piece, with the normals of its largest faces."""
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    across = np.cross(b - a, c - a)
    largest = np.argsort(-np.linalg.norm(across, axis=1), kind="stable")[:_NORMALS]
    normals = across[largest] / np.linalg.norm(across[largest], axis=1)[:, None]
    return ConvexPart(vertices[corners_of(faces)], normals=normals)


def _is_in_hull(points: Array, vertices: Array, faces: Faces) -> bool:
    """Whether points (k, 3) are well inside a convex piece, so that no two contain each other."""
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    middle = vertices[corners_of(faces)].mean(axis=0)
    outward = np.where(np.einsum("kj,kj->k", a - middle, normals)[:, None] < 0.0, -1.0, 1.0)
    normals = normals * outward
    heights = points @ normals.T - np.einsum("kj,kj->k", a, normals)
    return bool((heights < -1e-6).all())


def _ends(half: float) -> Array:
    return np.array([[0.0, 0.0, -half], [0.0, 0.0, half]])


def _turned(outline: Array) -> tuple[Array, Faces]:
    """Return the surface of revolution around z of a line (k, 2) of radii and heights."""
    angles = np.linspace(0.0, 2.0 * np.pi, _AROUND, endpoint=False)
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    rings = len(outline)
    points = np.empty((_AROUND, rings, 3))
    points[..., :2] = circle[:, None] * outline[None, :, :1]
    points[..., 2] = outline[:, 1]
    here = (np.arange(_AROUND)[:, None] * rings + np.arange(rings - 1)).reshape(-1)
    there = (here + rings) % (_AROUND * rings)
    faces = np.concatenate(
        [np.column_stack([here, there, there + 1]), np.column_stack([here, there + 1, here + 1])]
    )
    return points.reshape(-1, 3), faces
