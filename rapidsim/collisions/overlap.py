"""Penetration depth of bodies: the shortest translation that separates them.

The search tries directions: the normals of faces on which others lie flat, and some all around, the
best of which is refined until it stops improving. The result is therefore never shorter than the
true translation, and equal to it if that is along a face normal.
"""

from __future__ import annotations

import numpy as np

from rapidsim.collisions.convex import ConvexParts, Index
from rapidsim.frames.rotation_vectors import cross
from rapidsim.frames.transform import Array, Transform

TOUCH_M = 1e-5
"""Overlap [m] up to which bodies only touch: a part lying on a table is not a collision."""
_ALL_AROUND = 60
_ROUNDS = 14
_ROUNDED_M = 1e-12
"""Error [m] by rounding, at most, of heights of triangles."""
_AT_ONCE = 500
"""Number of pairs for which all directions are tried at once."""


def directions_around(count: int) -> Array:
    """Return unit vectors (count, 3) distributed evenly over the sphere."""
    number = np.arange(count) + 0.5
    height = 1.0 - 2.0 * number / count
    angle = np.pi * (1.0 + 5.0**0.5) * number
    out = np.sqrt(1.0 - height**2)
    return np.column_stack([out * np.cos(angle), out * np.sin(angle), height])


_AROUND = directions_around(_ALL_AROUND)


def flat_overlaps(
    parts: ConvexParts, first: Index, second: Index, second_from_first: Transform
) -> tuple[Array, Array]:
    """Return overlaps [m] of parts along normals of flat faces, and directions (k, 3).

    Infinite for parts without such faces.

    Args:
        parts: All parts.
        first: Indices of the first parts (k,).
        second: Indices of the second parts (k,).
        second_from_first: Poses of the first parts (k,).
    """
    own, of_own = parts.normals(first)
    own = np.einsum("kij,knj->kni", second_from_first.rotation, own)
    other, of_other = parts.normals(second)
    ways = np.concatenate([own, -own, other, -other], axis=1)
    there = np.concatenate([of_own, of_own, of_other, of_other], axis=1)
    if not ways.shape[1]:
        return np.full(len(first), np.inf), np.tile([0.0, 0.0, 1.0], (len(first), 1))
    return _best(parts, first, second, second_from_first, ways, there)


def most_overlaps(
    parts: ConvexParts, first: Index, second: Index, second_from_first: Transform
) -> Array:
    """Return upper bounds [m] of the overlaps of parts; of two triangles from their planes.

    Parameters as for `flat_overlaps`.
    """
    most = np.empty(len(first))
    both = np.minimum(first, second) >= parts.first_triangle
    rest = ~both
    most[rest], _ = flat_overlaps(parts, first[rest], second[rest], second_from_first[rest])
    pose = second_from_first[both]
    own = np.einsum("kij,knj->kni", pose.rotation, parts.corners_of_triangles(first[both]))
    own += pose.translation[:, None]
    other = parts.corners_of_triangles(second[both])
    most[both] = np.minimum(_beyond_planes(own, other), _beyond_planes(other, own)) + _ROUNDED_M
    return most


def _beyond_planes(triangles: Array, bases: Array) -> Array:
    """Return the lesser heights [m] of triangles (k, 3, 3) above and below the planes of bases."""
    normal = cross(bases[:, 1] - bases[:, 0], bases[:, 2] - bases[:, 0])
    heights = np.einsum("knj,kj->kn", triangles - bases[:, :1], normal)
    lesser = np.minimum(heights.max(axis=1), -heights.min(axis=1))
    beyond: Array = lesser / np.sqrt(np.einsum("kj,kj->k", normal, normal))
    return beyond


def depths(
    parts: ConvexParts, first: Index, second: Index, second_from_first: Transform
) -> tuple[Array, Array]:
    """Return upper bounds [m] of the separating translations of the first parts, and directions.

    Parameters as for `flat_overlaps`; directions have shape (k, 3).
    """
    found = []
    for begin in range(0, len(first), _AT_ONCE):
        some = slice(begin, begin + _AT_ONCE)
        a, b, pose = first[some], second[some], second_from_first[some]
        flat, out = flat_overlaps(parts, a, b, pose)
        apart = pose.apply(parts.centre[a]) - parts.centre[b]
        length = np.linalg.norm(apart, axis=1)[:, None]
        apart = np.where(length > 1e-12, apart / np.maximum(length, 1e-12), out)
        around = np.broadcast_to(_AROUND, (len(a), *_AROUND.shape))
        ways = np.concatenate([out[:, None], apart[:, None], around], axis=1)
        least, best = _best(parts, a, b, pose, ways)
        found.append((np.minimum(least, flat), np.where((flat <= least)[:, None], out, best)))
    return (
        np.concatenate([least for least, _ in found]) if found else np.zeros(0),
        np.concatenate([way for _, way in found]) if found else np.zeros((0, 3)),
    )


def shortest(
    parts: ConvexParts, first: Index, second: Index, second_from_first: Transform
) -> Array:
    """Return separating translations (k,) [m], refined from those of `depths`."""
    least, best = depths(parts, first, second, second_from_first)
    width = np.full(len(first), 0.35)
    for _ in range(_ROUNDS if len(first) else 0):
        tried = best[:, None] + width[:, None, None] * _AROUND
        tried /= np.linalg.norm(tried, axis=2)[..., None]
        found, way = _best(parts, first, second, second_from_first, tried)
        better = found < least
        least, best = np.where(better, found, least), np.where(better[:, None], way, best)
        width[~better] *= 0.4
    return least


def _best(
    parts: ConvexParts,
    first: Index,
    second: Index,
    second_from_first: Transform,
    offsets: Array,
    offset: Array | None = None,
) -> tuple[Array, Array]:
    """Return the least overlap of pairs (k,) in valid directions (k, n, 3), and the direction."""
    count, number, _ = offsets.shape
    every = np.repeat(np.arange(count), number)
    turned = np.einsum("kji,knj->kni", second_from_first.rotation, offsets)
    a = parts.farthest(first[every], -turned.reshape(-1, 3)).reshape(count, number, 3)
    b = parts.farthest(second[every], offsets.reshape(-1, 3)).reshape(count, number, 3)
    overlap = np.einsum("kni,kni->kn", b, offsets) - np.einsum("kni,kni->kn", a, turned)
    overlap -= np.einsum("ki,kni->kn", second_from_first.translation, offsets)
    overlap += (parts.radius[first] + parts.radius[second])[:, None]
    if offset is not None:
        overlap = np.where(offset, overlap, np.inf)
    best = overlap.argmin(axis=1)
    row = np.arange(count)
    return overlap[row, best], offsets[row, best]
