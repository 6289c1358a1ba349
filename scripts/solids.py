"""Rounded bodies to build robot links from: discs, tubes, hulls and lathed parts, with paint.

Lengths are metres, in the frame of the link that the body belongs to. A body is a convex cloud of
points with rounded edges, or the hull of several; bodies may overlap, which no viewer minds.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
import trimesh
from trimesh.visual.material import PBRMaterial
from trimesh.visual.texture import TextureVisuals

Array = npt.NDArray[np.float64]
Point = tuple[float, float, float]

AROUND = 40
"""Points around a disc."""
FILLET_STEPS = 4
"""Points along a rounded edge."""

GRID = 2.0**-16
"""Step of the positions in a file [m]: 15 um."""

UNSIGNED_SHORT, UNSIGNED_INT = 5123, 5125
"""How glTF names its types of numbers."""

X, Y, Z = 0, 1, 2


@dataclass(frozen=True)
class Paint:
    """A colour, linear RGB, and how it shines."""

    name: str
    rgb: tuple[float, float, float]
    roughness: float
    metallic: float = 0.0


ORANGE = Paint("orange", (1.0, 0.175, 0.012), 0.55)
GRAPHITE = Paint("graphite", (0.035, 0.037, 0.042), 0.6)
DARK = Paint("dark", (0.012, 0.012, 0.014), 0.5)
KUKA_ORANGE = Paint("kuka-orange", (1.0, 0.13, 0.004), 0.5)
IVORY = Paint("ivory", (0.62, 0.60, 0.54), 0.6)
LIGHT = Paint("light", (0.78, 0.79, 0.80), 0.5)
STEEL = Paint("steel", (0.42, 0.43, 0.45), 0.4, 0.3)


@dataclass(frozen=True)
class Body:
    """A painted surface."""

    mesh: trimesh.Trimesh
    paint: Paint


def disc(
    centre: Point,
    axis: int,
    radius: float,
    width: float,
    edge: float,
    around: int = AROUND,
    fillet_steps: int = FILLET_STEPS,
) -> Array:
    """Points of a disc with rounded edges.

    Args:
        centre: Its middle.
        axis: X, Y or Z, along which it is `width` wide.
        radius: Outer radius.
        width: Overall width.
        edge: Radius of the rounded edges.
        around: Points around.
        fillet_steps: Points along a rounded edge.
    """
    bow = np.linspace(0.0, np.pi / 2.0, fillet_steps + 1)
    radii = radius - edge + edge * np.cos(bow)
    heights = width / 2.0 - edge + edge * np.sin(bow)
    profile = np.concatenate(
        [np.column_stack([radii, heights]), np.column_stack([radii, -heights])[::-1]]
    )
    return _turn(profile, centre, axis, around)


def ball(centre: Point, radius: float) -> Array:
    """Points of a sphere."""
    bow = np.linspace(-np.pi / 2.0, np.pi / 2.0, 4 * FILLET_STEPS + 1)
    profile = radius * np.column_stack([np.cos(bow), np.sin(bow)])
    return _turn(profile, centre, Z, AROUND // 2)


def block(centre: Point, size: Point, edge: float, fillet_steps: int = FILLET_STEPS) -> Array:
    """Points of a box with rounded edges."""
    half = np.array(size) / 2.0 - edge
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * half
    centres = corners + np.array(centre)
    return np.concatenate([_small_ball(corner, edge, fillet_steps) for corner in centres])


def hull(paint: Paint, *clouds: Array) -> Body:
    """The tightest convex skin around clouds of points."""
    return Body(trimesh.convex.convex_hull(np.concatenate(clouds)), paint)


def lathe(
    paint: Paint,
    profile: list[tuple[float, float]],
    centre: Point,
    axis: int,
    around: int = AROUND,
) -> Body:
    """A body of revolution.

    Args:
        paint: Its colour.
        profile: (radius, height) from the lower to the upper end; both ends are closed.
        centre: Where height 0 is.
        axis: X, Y or Z.
        around: Points around.
    """
    points = np.array([(0.0, profile[0][1]), *profile, (0.0, profile[-1][1])])
    vertices = _turn(points, centre, axis, around)
    rings = len(points)
    faces = []
    for step in range(around):
        here, there = step * rings, ((step + 1) % around) * rings
        for ring in range(rings - 1):
            a, b = here + ring, here + ring + 1
            c, d = there + ring, there + ring + 1
            faces += [(a, c, b), (c, d, b)]
    mesh = trimesh.Trimesh(vertices, np.array(faces), process=False)
    mesh.merge_vertices()
    mesh.update_faces(mesh.nondegenerate_faces())
    if mesh.volume < 0.0:
        mesh.invert()
    return Body(mesh, paint)


def moved(body: Body, rotation: Array, translation: Array) -> Body:
    """The same body, turned by a matrix (3, 3) and then shifted [m]."""
    mesh = body.mesh.copy()
    mesh.vertices = mesh.vertices @ rotation.T + translation
    return Body(mesh, body.paint)


def mirrored(body: Body) -> Body:
    """The same body on the other side of the plane y = 0."""
    mesh = body.mesh.copy()
    mesh.vertices = mesh.vertices * np.array([1.0, -1.0, 1.0])
    mesh.invert()
    return Body(mesh, body.paint)


def glb(bodies: list[Body]) -> bytes:
    """Bodies as binary glTF, one mesh a paint: positions and faces, from which normals follow.

    Positions lie on a grid and faces are sorted: such numbers take less room in an archive.
    """
    scene = trimesh.Scene()
    for paint in sorted({body.paint.name: body.paint for body in bodies}.values(), key=_name):
        painted = [body.mesh for body in bodies if body.paint is paint]
        starts = np.cumsum([0, *(len(mesh.vertices) for mesh in painted)])
        mesh = trimesh.Trimesh(
            vertices=np.round(np.concatenate([mesh.vertices for mesh in painted]) / GRID) * GRID,
            faces=_in_order(
                np.concatenate(
                    [mesh.faces + start for mesh, start in zip(painted, starts, strict=False)]
                )
            ),
            process=False,
            visual=TextureVisuals(
                material=PBRMaterial(
                    name=paint.name,
                    baseColorFactor=np.array([*(round(255 * c) for c in paint.rgb), 255], np.uint8),
                    metallicFactor=paint.metallic,
                    roughnessFactor=paint.roughness,
                )
            ),
        )
        scene.add_geometry(mesh, geom_name=paint.name, node_name=paint.name)
    data = trimesh.exchange.gltf.export_glb(
        scene, include_normals=False, buffer_postprocessor=_shorten
    )
    assert isinstance(data, bytes)
    return data


def _in_order(faces: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    """Faces (f, 3) that begin with their last vertex, sorted."""
    last = faces.argmax(axis=1)
    turned = np.take_along_axis(faces, (last[:, None] + np.arange(3)) % 3, axis=1)
    return turned[np.lexsort(turned.T[::-1])]


def _shorten(buffers: dict[str, bytes], tree: dict[str, Any]) -> None:
    """Write vertex numbers in two bytes where they fit, and bounds with the digits they have."""
    names = list(buffers)
    for accessor in tree["accessors"].values():
        if accessor["componentType"] == UNSIGNED_INT and np.max(accessor["max"]) < 2**16 - 1:
            name = names[accessor["bufferView"]]
            numbers = np.frombuffer(buffers[name], "<u4", accessor["count"]).astype("<u2")
            data = numbers.tobytes()
            buffers[name] = data + bytes(-len(data) % 4)
            accessor["componentType"] = UNSIGNED_SHORT
        bounds = {key: accessor.pop(key) for key in ("min", "max")}
        if accessor["type"] != "SCALAR":
            for key, values in bounds.items():
                accessor[key] = [float(str(np.float32(value))) for value in values]


def _name(paint: Paint) -> str:
    return paint.name


def _small_ball(centre: Array, radius: float, fillet_steps: int) -> Array:
    bow = np.linspace(-np.pi / 2.0, np.pi / 2.0, 2 * fillet_steps + 1)
    profile = radius * np.column_stack([np.cos(bow), np.sin(bow)])
    return _turn(profile, tuple(centre), Z, 4 * fillet_steps)


def _turn(profile: Array, centre: Point, axis: int, around: int) -> Array:
    """Points (around * k, 3) of a profile (k, 2) of radii and heights, turned about an axis."""
    angles = np.arange(around) * (2.0 * np.pi / around)
    radii, heights = profile[None, :, 0], profile[None, :, 1]
    points = np.empty((around, len(profile), 3))
    points[..., axis] = heights
    points[..., (axis + 1) % 3] = radii * np.cos(angles)[:, None]
    points[..., (axis + 2) % 3] = radii * np.sin(angles)[:, None]
    return points.reshape(-1, 3) + np.array(centre)
