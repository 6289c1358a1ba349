"""Triangles of a shape, and the repair of common defects in files."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from rapidsim.files import InputError
from rapidsim.frames.transform import Array
from rapidsim.repeated_rows import Index
from rapidsim.values import value_class

Faces = npt.NDArray[np.int64]

MOST_TRIANGLES = 100_000
_NO_CORNER = "{} is damaged: a triangle refers to a corner that does not exist"
_MANY = 5000
"""Number of faces of a piece above which its edges are checked before all its points."""
_LEVEL = 1e-7
"""Height of a point above a face next to it, as a share of the size, up to which it is level."""
_FLAT = 1e-14
"""Ratio of a triangle's double area to the square of its longest edge below which it is flat."""
_AT_ONCE = 50_000
"""Number of points times faces at once: more do not fit the processor's cache."""


@value_class(frozen=True, slots=True, eq=False)
class Triangles:
    """A surface of triangles."""

    vertices: Array
    """Shape (k, 3) [m], each position once."""
    faces: Faces
    """Shape (f, 3)."""
    closed: bool
    """Whether each edge has a face on either side, so that there is an inside."""


def checked_triangles(name: str, vertices: Array, faces: Faces) -> Triangles:
    """Return the triangles of a file that have an area, with coincident vertices merged.

    Args:
        name: File name, for messages.
        vertices: Shape (k, 3), in any unit.
        faces: Shape (f, 3).

    Raises:
        InputError: If there are no triangles, too many, or if coordinates are not finite.
    """
    require_few(name, len(faces))
    if not len(faces):
        raise InputError(f"{name} has no triangles")
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise InputError(_NO_CORNER.format(name))
    if len(vertices) > 3 * len(faces):
        named, back = np.unique(faces, return_inverse=True)
        vertices, faces = vertices[named], back.reshape(-1, 3)
    used = vertices[corners_of(faces)]
    if not np.isfinite(used).all() or np.abs(used).max() > 1e9:
        raise InputError(f"{name} is damaged: a corner has no finite position")
    size = float(np.ptp(used, axis=0).max())
    if size <= 0.0:
        raise InputError(f"{name}: all corners are in one place")
    # Files without shared corners repeat each of them, with equal rounding.
    first, merged = _distinct(np.round(vertices / (size * 1e-7)))
    vertices, faces = vertices[first], merged[faces]
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    edges = np.stack([b - a, c - b, a - c])
    area = np.linalg.norm(np.cross(edges[0], edges[1]), axis=1)
    longest = np.einsum("eij,eij->ei", edges, edges).max(axis=0)
    faces = faces[area > _FLAT * longest]
    if not len(faces):
        raise InputError(f"{name}: no triangle has an area")
    return Triangles(vertices, faces, _is_closed(faces, len(vertices)))


def face_array(name: str, faces: Sequence[tuple[int, int, int]]) -> Faces:
    """Return the faces (f, 3) of a list.

    Raises:
        InputError: If an index of a corner is beyond all numbers of an array.
    """
    try:
        return np.array(faces, dtype=np.int64).reshape(-1, 3)
    except OverflowError:
        raise InputError(_NO_CORNER.format(name)) from None


def corners_of(faces: Faces) -> Index:
    """Return the indices (k,) of the corners of faces, each once, in increasing order.

    `np.unique` hashes them, for several times the cost.
    """
    ends = np.sort(faces, axis=None)
    corners: Index = ends[np.flatnonzero(np.diff(ends, prepend=-1))]
    return corners


def _distinct(rows: Array) -> tuple[Index, Index]:
    """Return the first (m,) of equal rows (k, 3), in increasing order, and the number (k,) of each.

    `np.unique` along an axis compares rows one by one, for several times the cost.
    """
    order = np.lexsort(rows.T[::-1])
    is_new = np.append(True, (np.diff(rows[order], axis=0) != 0.0).any(axis=1))
    number = np.empty(len(rows), dtype=np.int64)
    number[order] = np.cumsum(is_new) - 1
    return order[is_new], number


def require_few(name: str, count: int) -> None:
    """Raise if there are more triangles than a shape may have.

    Raises:
        InputError: If there are more than `MOST_TRIANGLES`.
    """
    if count > MOST_TRIANGLES:
        raise InputError(
            f"{name} holds more than {MOST_TRIANGLES} triangles",
            "export it with less detail: half a millimetre is fine enough for a robot",
        )


def _is_closed(faces: Faces, count: int) -> bool:
    ends = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    forth = np.sort(ends[:, 0] * count + ends[:, 1])
    back = np.sort(ends[:, 1] * count + ends[:, 0])
    return bool((forth == back).all())


def components(faces: Faces, count: int) -> list[Faces]:
    """Return the faces of each piece connected by edges.

    Bodies that only touch are separate pieces: an edge with more than two faces joins none.

    Args:
        faces: Shape (f, 3).
        count: Number of vertices.
    """
    ends = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    edge = ends[:, 0] * count + ends[:, 1]
    order = np.argsort(edge, kind="stable")
    starts = np.flatnonzero(np.diff(edge[order], prepend=-1))
    paired = starts[np.diff(starts, append=len(edge)) == 2]
    one, other = order[paired] % len(faces), order[paired + 1] % len(faces)
    label = np.arange(len(faces))
    while True:
        lower = label.copy()
        lowest = np.minimum(label[one], label[other])
        np.minimum.at(lower, one, lowest)
        np.minimum.at(lower, other, lowest)
        np.minimum.at(lower, label[one], lowest)
        np.minimum.at(lower, label[other], lowest)
        lower = lower[lower]
        if (lower == label).all():
            break
        label = lower
    order = np.argsort(label, kind="stable")
    starts = np.flatnonzero(np.diff(label[order], prepend=-1))
    return np.split(faces[order], starts[1:])


def hollowness(vertices: Array, faces: Faces, enough_m: float = np.inf) -> float:
    """Distance [m] by which a piece protrudes beyond the plane of one of its faces: 0 if convex.

    The hull of a piece fills no cavity deeper than this.

    Args:
        vertices: Shape (k, 3) [m].
        faces: Shape (f, 3).
        enough_m: Depth [m] above which a smaller one than the deepest may be returned.
    """
    used = vertices[corners_of(faces)]
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    # Faces in files may have any orientation: out is the side with fewer points beyond.
    deepest = 0.0
    count = max(1, len(faces) * len(used) // _AT_ONCE)
    for part in range(count):
        # A few faces often show that a piece is not convex; that it is, only its edges do for less.
        if part == 1 and len(faces) > _MANY and _is_convex_at_edges(vertices, faces, normals):
            return 0.0
        # Faces all over the piece, so that a cavity is found soon.
        heights = used @ normals[part::count].T
        heights -= np.einsum("kj,kj->k", normals[part::count], a[part::count])
        beyond = np.minimum(heights.max(axis=0), -heights.min(axis=0))
        deepest = max(deepest, float(beyond.max(initial=0.0)))
        if deepest > enough_m:
            break
    return deepest


def _is_convex_at_edges(vertices: Array, faces: Faces, normals: Array) -> bool:
    """Whether a connected piece is closed and bends outward at each edge: then it is convex.

    Source:
        van Heijenoort (1952), On locally convex manifolds.
    """
    count = len(vertices)
    if not _is_closed(faces, count):
        return False
    start, end = (np.concatenate([faces[:, i] for i in order]) for order in ((0, 1, 2), (1, 2, 0)))
    face = np.tile(np.arange(len(faces)), 3)
    forth = np.argsort(start * count + end, kind="stable")
    back = np.argsort(end * count + start, kind="stable")
    # The same edge in both directions: the faces on either side.
    here, there = face[forth], face[back]
    corners = vertices[faces[there]] - vertices[start[forth]][:, None]
    heights = np.einsum("kij,kj->ki", corners, normals[here])
    size = float(np.ptp(vertices[corners_of(faces)], axis=0).max())
    level = _LEVEL * size
    return bool((heights.max(axis=1) <= level).all() or (heights.min(axis=1) >= -level).all())
