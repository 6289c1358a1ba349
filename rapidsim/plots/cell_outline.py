"""Objects of the cell around a path: outlines as seen from a side, and contact points.

A body is outlined as in technical drawings: along its silhouette, and along sharp edges on the near
side.
"""

from __future__ import annotations

from dataclasses import field

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from mpl_toolkits.mplot3d.art3d import Line3DCollection
from mpl_toolkits.mplot3d.axes3d import Axes3D

from rapidsim.colours import Colours
from rapidsim.frames.transform import Array
from rapidsim.plots.sampled_run import MM, number_of
from rapidsim.simulation.results.relative_motion import is_on_track, shown_from_world
from rapidsim.simulation.results.sampling import SampledRun
from rapidsim.values import value_class

_AIR = 0.3
"""Margin around the path, relative to its size, in which objects are drawn."""
_SHARP = np.cos(np.radians(30.0))
"""Cosine of the angle between faces above which their common edge is sharp."""
_MOST_FACES = 2000
"""Number of faces above which only the outline is drawn."""
_MOVED_M = 1e-3
_SEEN_FROM = np.array([0.58, -0.69, 0.44])
"""Direction towards the eye of the 3D view."""


@value_class(frozen=True, slots=True, eq=False)
class BodyOutline:
    """A body of the cell in the frame of the picture."""

    colour: str
    vertices: Array
    """Shape (k, 3) [mm]"""
    faces: npt.NDArray[np.int64]
    """Shape (f, 3), each counterclockwise from outside."""
    normals: Array
    """Shape (f, 3); zero for a face without area."""
    edges: npt.NDArray[np.int64]
    """Shape (e, 2): vertices at the ends of each edge."""
    neighbours: npt.NDArray[np.int64]
    """Shape (e, 2): faces on both sides of each edge; equal at the border of an open surface."""
    is_sharp: npt.NDArray[np.bool_]
    """Shape (e,): whether the edge is drawn wherever it is visible: sharp edges and borders."""
    is_later: bool
    """Whether this is the pose at the end of the run, which differs from that at the start."""


@value_class(frozen=True, slots=True, eq=False)
class CellOutline:
    """Contents of a cell that are drawn in addition to the path."""

    bodies: tuple[BodyOutline, ...] = ()
    contacts: Array = field(default_factory=lambda: np.zeros((0, 3)))
    """Points (c, 3) [mm] at which bodies begin to touch."""


def cell_of(run: SampledRun, theme: Colours) -> CellOutline:
    """Return the station's objects in the picture frame of a robot, and its contacts."""
    collisions = run.simulation.collisions
    if collisions is None:
        return CellOutline()
    number = number_of(run)
    hits = [one for one in collisions.hits if one.robot == number]
    hit = {name for one in hits for name in (one.first, one.second)}
    picture_from_world = shown_from_world(run.robot_run, in_world=is_on_track(run.robot_run.robot))
    poses = collisions.scene.poses(np.array([0.0, run.end_s]))
    bodies: list[BodyOutline] = []
    for index, one, body in collisions.drawn_objects():
        colour = theme.error if body.label in hit else one.hex_colour
        stands = picture_from_world @ poses.of(index)
        first, last = (MM * stands[at].apply(body.shape.vertices) for at in (0, 1))
        if body.exists(0.0):
            bodies.append(outlined(colour, first, body.shape.faces))
        is_new = not body.exists(0.0) or np.abs(last - first).max() > MM * _MOVED_M
        if is_new and body.exists(run.end_s):
            bodies.append(outlined(colour, last, body.shape.faces, is_later=True))
    points = np.array([one.point for one in hits]).reshape(-1, 3)
    return CellOutline(tuple(bodies), MM * picture_from_world.apply(points))


def outlined(
    colour: str, vertices: Array, faces: npt.NDArray[np.int64], *, is_later: bool = False
) -> BodyOutline:
    """Return a body with the data for its outline from any side, computed once for all views."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    across = np.cross(b - a, c - a)
    normals = across / np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-12)
    # Coincident vertices are one corner.
    corner = np.unique(np.rint(1e3 * vertices), axis=0, return_inverse=True)[1].ravel()
    sides = np.concatenate([faces[:, (k, (k + 1) % 3)] for k in range(3)])
    _, first, edge, count = np.unique(
        np.sort(corner[sides], axis=1),
        axis=0,
        return_index=True,
        return_inverse=True,
        return_counts=True,
    )
    of_face = np.tile(np.arange(len(faces)), 3)[np.argsort(edge.ravel(), kind="stable")]
    starts = np.concatenate([[0], np.cumsum(count)[:-1]])
    beside = np.stack([of_face[starts], of_face[starts + count - 1]], axis=1)
    bend = np.einsum("ij,ij->i", *(normals[beside[:, k]] for k in (0, 1)))
    is_sharp = (bend < _SHARP) | (count == 1)
    return BodyOutline(colour, vertices, faces, normals, sides[first], beside, is_sharp, is_later)


def draw_cell(axes: Axes, cell: CellOutline, theme: Colours, view: tuple[int, int]) -> None:
    """Draw a cell from a side, without changing the limits of the view."""
    towards = np.cross(np.eye(3)[view[0]], np.eye(3)[view[1]])
    for body in cell.bodies:
        near = _near_faces(body, towards)
        if len(body.faces) <= _MOST_FACES:
            triangles = body.vertices[body.faces[near]][..., view]
            # One path, whose triangles all have one orientation, is filled without seams between
            # them.
            surface = Path.make_compound_path(*map(Path, triangles))
            filling = PathPatch(surface, facecolor=body.colour, alpha=0.16, edgecolor="none")
            axes.add_artist(filling)
        edges = _outline(body, near)[..., view]
        axes.add_collection(LineCollection(list(edges), **_style(body), zorder=0.8), autolim=False)
    if cell.bodies:
        axes.margins(_AIR)
    _mark_contacts(axes, cell.contacts[:, view], theme)


def draw_cell_in_space(axes: Axes3D, cell: CellOutline, theme: Colours) -> None:
    """Draw the parts within the limits of the axes, as 3D axes do not clip."""
    box = np.array([axes.get_xlim(), axes.get_ylim(), axes.get_zlim()]).T
    for body in cell.bodies:
        edges = _clipped(_outline(body, _near_faces(body, _SEEN_FROM)), box)
        if len(edges):
            axes.add_collection3d(Line3DCollection(edges, **_style(body)), autolim=False)
    inside = np.all((cell.contacts >= box[0]) & (cell.contacts <= box[1]), axis=1)
    _mark_contacts(axes, cell.contacts[inside], theme)


def grown(points: Array) -> Array:
    """Return the box (2, 3) around points (k, 3) with a margin for the cell."""
    low, high = points.min(axis=0), points.max(axis=0)
    air = _AIR * float(np.max(high - low))
    return np.stack([low - air, high + air])


def _mark_contacts(axes: Axes, places: Array, theme: Colours) -> None:
    if len(places):
        axes.plot(
            *places.T,
            linestyle="none",
            marker="X",
            markersize=7,
            color=theme.error,
            markeredgecolor=theme.panel,
            label="contact",
            zorder=5,
        )


def _style(body: BodyOutline) -> dict[str, object]:
    return {
        "colors": body.colour,
        "linewidths": 0.9,
        "alpha": 0.45 if body.is_later else 0.85,
        "linestyles": "dotted" if body.is_later else "solid",
    }


def _near_faces(body: BodyOutline, towards: Array) -> npt.NDArray[np.bool_]:
    """Mask of the faces (f,) that face the eye."""
    near: npt.NDArray[np.bool_] = body.normals @ towards > 0.0
    return near


def _outline(body: BodyOutline, near: npt.NDArray[np.bool_]) -> Array:
    """Return the edges (e, 2, 3) to draw for a mask of near faces."""
    one, other = near[body.neighbours].T
    drawn: Array = body.vertices[body.edges[(one != other) | (body.is_sharp & one)]]
    return drawn


def _clipped(edges: Array, box: Array) -> Array:
    """Return the parts of edges (e, 2, 3) within a box (2, 3)."""
    begin, way = edges[:, 0], edges[:, 1] - edges[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        shares = (box[:, None] - begin) / way
    # An edge parallel to a plane of the box is on one side of it from end to end.
    beside = way == 0.0
    outside = beside & ((begin < box[0]) | (begin > box[1]))
    enters = np.where(beside, 0.0, np.min(shares, axis=0)).max(axis=1).clip(min=0.0)
    leaves = np.where(beside, 1.0, np.max(shares, axis=0)).min(axis=1).clip(max=1.0)
    kept = (enters < leaves) & ~outside.any(axis=1)
    ends = np.stack([enters, leaves], axis=1)[kept]
    found: Array = begin[kept, None] + ends[..., None] * way[kept, None]
    return found
