"""Convex parts: what distances are measured between.

A part is the hull of some points, or a disc swept along an axis, rounded by a radius; so a sphere
is one point, a capsule two, a box eight. Nothing needs faces: all that is asked of a part is its
farthest point in a direction.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array
from rapidsim.values import dataclass

Index = npt.NDArray[np.int64]
_FEW = 8
"""Points of parts that are looked at in one array; those with more are looked at one by one."""


@dataclass(frozen=True, slots=True, eq=False)
class ConvexPart:
    """A convex body [m] in the frame of what it belongs to."""

    points: Array
    """Shape (k, 3); of a disc swept along an axis, the middles of its two ends."""
    radius: float = 0.0
    """How far the surface is from the hull of the points."""
    disc: float = 0.0
    """Radius of a disc at each point, square to the line through the two; 0 for none."""
    normals: Array = field(default_factory=lambda: np.zeros((0, 3)))
    """Shape (n, 3): directions square to its largest faces, where others come to lie flat."""

    @property
    def centre(self) -> Array:
        """The middle (3,) of a sphere that holds the part."""
        middle: Array = 0.5 * (self.points.min(axis=0) + self.points.max(axis=0))
        return middle

    @property
    def bound(self) -> float:
        """The radius of that sphere."""
        far = float(np.linalg.norm(self.points - self.centre, axis=1).max())
        return float(np.hypot(far, self.disc)) + self.radius


class Parts:
    """Many parts, asked together for their farthest points."""

    def __init__(self, parts: Sequence[ConvexPart]) -> None:
        """Lay the parts out in arrays."""
        self.count = len(parts)
        self.radius = np.array([part.radius for part in parts])
        self.centre = np.array([part.centre for part in parts]).reshape(-1, 3)
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
        for number, part in enumerate(parts):
            if len(part.points) > _FEW:
                self._clouds[number] = np.ascontiguousarray(part.points)
                continue
            padded = np.arange(_FEW) % len(part.points)
            self._few[number] = part.points[padded]
            if part.disc:
                along = part.points[1] - part.points[0]
                self._axis[number] = along / np.linalg.norm(along)
        self._is_cloud = np.isin(np.arange(self.count), list(self._clouds))

    def normals(self, part: Index) -> tuple[Array, npt.NDArray[np.bool_]]:
        """The normals (k, m, 3) of parts (k,) and which of them are there (k, m)."""
        count, end = self._normal_counts[part], self._normal_ends[part]
        number = np.arange(count.max(initial=0))
        there = number < count[:, None]
        row = np.where(there, (end - count)[:, None] + number, 0)
        if not len(number):
            return np.zeros((len(part), 0, 3)), there
        return self._normals[row], there

    def boxes(self) -> tuple[Array, Array]:
        """The lower and upper corners (n, 3) of the boxes around all parts."""
        every: Index = np.arange(self.count)
        low, high = np.empty((self.count, 3)), np.empty((self.count, 3))
        for axis in range(3):
            for sign, corner in ((-1.0, low), (1.0, high)):
                way = np.zeros((self.count, 3))
                way[:, axis] = sign
                corner[:, axis] = self.farthest(every, way)[:, axis] + sign * self.radius
        return low, high

    def farthest(self, part: Index, direction: Array) -> Array:
        """Points (k, 3) of the hulls of parts (k,) that are farthest in directions (k, 3).

        The radius of a part is left out: it is the same in all directions.
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
        for number in np.unique(part[self._is_cloud[part]]).tolist():
            rows = np.flatnonzero(part == number)
            cloud = self._clouds[number]
            points[rows] = cloud[(direction[rows] @ cloud.T).argmax(axis=1)]
        return points
