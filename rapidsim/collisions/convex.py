"""Convex parts, between which distances are computed.

A part is the hull of some points, or a disc swept along an axis, plus a rounding radius; so a
sphere is one point, a capsule two, a box eight. Faces are not needed: the only query is for the
farthest point in a direction (support mapping). The triangles of surfaces, of which a casting has
tens of thousands, are parts as well; they are stored in one array.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array
from rapidsim.values import value_class

Index = npt.NDArray[np.int64]
Mask = npt.NDArray[np.bool_]
NO_TRIANGLES: Array = np.zeros((0, 3, 3))
_BOX = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
_REPEATED = np.arange(len(_BOX)) % 3
_FEW = 8
"""Number of points up to which parts are processed in one array, others one by one."""
_AT_ONCE = 60_000
"""Number of products of points and directions at once: more do not fit the processor's cache."""


@value_class(frozen=True, slots=True, eq=False)
class ConvexPart:
    """Convex part [m] in the frame of its body."""

    points: Array
    """Shape (k, 3); for a swept disc the centres of its two ends."""
    radius: float = 0.0
    """Distance [m] of the surface from the hull of the points."""
    disc: float = 0.0
    """Radius [m] of a disc at each point, normal to the line through both; 0 for none."""
    normals: Array = field(default_factory=lambda: np.zeros((0, 3)))
    """Shape (n, 3): normals of its largest faces, on which other bodies come to rest."""

    @property
    def centre(self) -> Array:
        """Centre (3,) of a bounding sphere."""
        middle: Array = 0.5 * (self.points.min(axis=0) + self.points.max(axis=0))
        return middle

    @property
    def bound(self) -> float:
        """Radius [m] of the bounding sphere around `centre`."""
        far = float(np.linalg.norm(self.points - self.centre, axis=1).max())
        return float(np.hypot(far, self.disc)) + self.radius


class ConvexParts:
    """Many parts, queried together for their farthest points."""

    def __init__(self, parts: Sequence[ConvexPart], triangles: Array = NO_TRIANGLES) -> None:
        """Store parts in arrays, followed by triangles (t, 3, 3) [m]."""
        count, more = len(parts), len(triangles)
        no = np.zeros(more)
        self.triangles = triangles
        self.first_triangle = count
        """Number of the part that is the first triangle."""
        self.radius = np.append([part.radius for part in parts], no)
        low = np.array([part.points.min(axis=0) for part in parts]).reshape(-1, 3)
        low = np.concatenate([low, np.minimum.reduce(np.swapaxes(triangles, 0, 1))])
        high = np.array([part.points.max(axis=0) for part in parts]).reshape(-1, 3)
        high = np.concatenate([high, np.maximum.reduce(np.swapaxes(triangles, 0, 1))])
        self.centre: Array = 0.5 * (low + high)
        self.bound = np.array([part.bound for part in parts])
        """Radii (n,) [m] of bounding spheres of the parts that are no triangles."""
        self._normals = np.concatenate([np.zeros((0, 3)), *(part.normals for part in parts)])
        self._normal_counts: Index = np.array([len(part.normals) for part in parts], dtype=np.int64)
        self._normal_ends: Index = np.cumsum(self._normal_counts)
        self._disc = np.append([part.disc for part in parts], no)
        self._has_discs = bool(self._disc.any())
        self._few = np.zeros((count, _FEW, 3))
        self._axis = np.zeros((count + more, 3))
        self._clouds: dict[int, Array] = {}
        """Points (3, k) of parts with many points."""
        for number, part in enumerate(parts):
            if len(part.points) > _FEW:
                self._clouds[number] = np.ascontiguousarray(part.points.T)
                continue
            padded = np.arange(_FEW) % len(part.points)
            self._few[number] = part.points[padded]
            if part.disc:
                along = part.points[1] - part.points[0]
                self._axis[number] = along / np.linalg.norm(along)
        wide = self._disc[:count, None] * np.sqrt(np.maximum(1.0 - self._axis[:count] ** 2, 0.0))
        wide += self.radius[:count, None]
        self.half: Array = 0.5 * (high - low)
        self.half[:count] += wide
        """Half the edges (n, 3) of the bounding boxes, whose middles are the centres."""
        points = np.append([len(part.points) for part in parts], no).astype(np.int64)
        self._is_cloud = points > _FEW
        sizes = np.where(self._is_cloud, points, 0)
        self._cloud_start: Index = np.cumsum(sizes) - sizes
        self._cloud_points = np.concatenate(
            [np.zeros((0, 3)), *(cloud.T for cloud in self._clouds.values())]
        )

    def corners(self, part: Index) -> Array:
        """Return points (k, 8, 3) whose hulls contain parts (k,): of a triangle they repeat."""
        is_triangle = part >= self.first_triangle
        found = np.empty((len(part), len(_BOX), 3))
        found[is_triangle] = self.corners_of_triangles(part[is_triangle])[:, _REPEATED]
        of_parts = part[~is_triangle]
        found[~is_triangle] = self.centre[of_parts][:, None] + self.half[of_parts][:, None] * _BOX
        return found

    def corners_of_triangles(self, part: Index) -> Array:
        """Return the corners (k, 3, 3) of parts (k,) that are triangles."""
        corners: Array = self.triangles[part - self.first_triangle]
        return corners

    def normals(self, part: Index) -> tuple[Array, Mask]:
        """Return the normals (k, m, 3) of parts (k,), and a mask (k, m) of valid ones."""
        is_triangle = part >= self.first_triangle
        solid = np.flatnonzero(~is_triangle)
        count: Index = np.ones(len(part), dtype=np.int64)
        count[solid] = self._normal_counts[part[solid]]
        number = np.arange(count.max(initial=0))
        there = number < count[:, None]
        normals = np.zeros((len(part), len(number), 3))
        row, at = np.nonzero(there[solid])
        first = (self._normal_ends - self._normal_counts)[part[solid]]
        normals[solid[row], at] = self._normals[first[row] + at]
        if is_triangle.any():
            some = self.corners_of_triangles(part[is_triangle])
            across = np.cross(some[:, 1] - some[:, 0], some[:, 2] - some[:, 0])
            normals[is_triangle, 0] = across / np.linalg.norm(across, axis=1)[:, None]
        return normals, there

    def farthest(self, part: Index, direction: Array) -> Array:
        """Return the farthest points (k, 3) of parts (k,) in directions (k, 3).

        The radius of a part is ignored: it is equal in all directions.
        """
        points = np.empty((len(part), 3))
        is_triangle = part >= self.first_triangle
        for rows, corners, first in (
            (np.flatnonzero(is_triangle), self.triangles, self.first_triangle),
            (np.flatnonzero(~is_triangle), self._few, 0),
        ):
            if len(rows):
                some = corners[part[rows] - first]
                reach = np.einsum("kij,kj->ki", some, direction[rows])
                points[rows] = some[np.arange(len(rows)), reach.argmax(axis=1)]
        if self._has_discs:
            disc, axis = self._disc[part], self._axis[part]
            across = direction - np.einsum("kj,kj->k", direction, axis)[:, None] * axis
            length = np.linalg.norm(across, axis=1)
            turned = length > 1e-12
            points = points + np.where(
                turned[:, None], across * (disc / np.where(turned, length, 1.0))[:, None], 0.0
            )
        rows = np.flatnonzero(self._is_cloud[part])
        if len(rows):
            rows = rows[np.argsort(part[rows], kind="stable")]
            of_row, ahead = part[rows], direction[rows]
            edges = [0, *(np.flatnonzero(np.diff(of_row)) + 1).tolist(), len(rows)]
            best = np.empty(len(rows), dtype=np.int64)
            for start, end in pairwise(edges):
                cloud = self._clouds[of_row[start]]
                some = 1 + _AT_ONCE // cloud.shape[1]
                for begin in range(start, end, some):
                    few = slice(begin, min(begin + some, end))
                    (ahead[few] @ cloud).argmax(axis=1, out=best[few])
            points[rows] = self._cloud_points[self._cloud_start[of_row] + best]
        return points
