"""Convex parts, between which distances are computed.

A part is the hull of some points, or a disc swept along an axis, plus a rounding radius; so a
sphere is one point, a capsule two, a box eight. Faces are not needed: the only query is for the
farthest point in a direction (support mapping).
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
_FEW = 8
"""Number of points up to which parts are processed in one array, others one by one."""


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

    def __init__(self, parts: Sequence[ConvexPart]) -> None:
        """Store the parts in arrays."""
        self.count = len(parts)
        self.radius = np.array([part.radius for part in parts])
        low = np.array([part.points.min(axis=0) for part in parts]).reshape(-1, 3)
        high = np.array([part.points.max(axis=0) for part in parts]).reshape(-1, 3)
        self.centre: Array = 0.5 * (low + high)
        self.bound = np.array([part.bound for part in parts])
        self._normals = np.concatenate([np.zeros((0, 3)), *(part.normals for part in parts)])
        counts = np.array([len(part.normals) for part in parts], dtype=np.int64)
        self._normal_ends: Index = np.cumsum(counts)
        self._normal_counts = counts
        self._disc = np.array([part.disc for part in parts])
        self._has_discs = bool(self._disc.any())
        self._few = np.zeros((self.count, _FEW, 3))
        self._axis = np.zeros((self.count, 3))
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
        wide = self._disc[:, None] * np.sqrt(np.maximum(1.0 - self._axis**2, 0.0))
        wide += self.radius[:, None]
        self.low, self.high = low - wide, high + wide
        """Corners (n, 3) of the bounding boxes of all parts."""
        self.half: Array = 0.5 * (self.high - self.low)
        """Half the edges (n, 3) of these boxes, whose middles are the centres."""
        self._is_cloud = np.array([len(part.points) > _FEW for part in parts], dtype=np.bool_)
        sizes = np.where(self._is_cloud, [len(part.points) for part in parts], 0)
        self._cloud_start: Index = np.cumsum(sizes) - sizes
        self._cloud_points = np.concatenate(
            [np.zeros((0, 3)), *(cloud.T for cloud in self._clouds.values())]
        )

    def normals(self, part: Index) -> tuple[Array, npt.NDArray[np.bool_]]:
        """Return the normals (k, m, 3) of parts (k,), and a mask (k, m) of valid ones."""
        count, end = self._normal_counts[part], self._normal_ends[part]
        number = np.arange(count.max(initial=0))
        there = number < count[:, None]
        row = np.where(there, (end - count)[:, None] + number, 0)
        if not len(number):
            return np.zeros((len(part), 0, 3)), there
        return self._normals[row], there

    def farthest(self, part: Index, direction: Array) -> Array:
        """Return the farthest points (k, 3) of parts (k,) in directions (k, 3).

        The radius of a part is ignored: it is equal in all directions.
        """
        few = self._few[part]
        reach = np.einsum("kij,kj->ki", few, direction)
        points: Array = few[np.arange(len(part)), reach.argmax(axis=1)]
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
            for begin, end in pairwise(edges):
                cloud = self._clouds[of_row[begin]]
                (ahead[begin:end] @ cloud).argmax(axis=1, out=best[begin:end])
            points[rows] = self._cloud_points[self._cloud_start[of_row] + best]
        return points
