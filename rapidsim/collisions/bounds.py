"""Cheap lower bounds of distances between bodies, from their bounding spheres and boxes.

Each body has a box along the axes of its frame, and a sphere around the centre of the box.
"""

from __future__ import annotations

import numpy as np

from rapidsim.collisions.convex import Index
from rapidsim.frames.transform import Array, Transform


class Bounds:
    """Bounding boxes and spheres, each in the frame of its body."""

    def __init__(self, low: Array, high: Array, bound: Array) -> None:
        """Store boxes by their corners (n, 3) [m], and radii (n,) [m] of spheres."""
        self.low, self.high = low, high
        self.centre: Array = 0.5 * (low + high)
        self._half: Array = 0.5 * (high - low)
        self.bound: Array = np.minimum(bound, np.linalg.norm(self._half, axis=1))

    def gaps(self, first: Index, second: Index, second_from_first: Transform) -> Array:
        """Return lower bounds of the distances [m] of pairs (k,); negative if undecided.

        Args:
            first: Indices of the first bodies (k,).
            second: Indices of the second bodies (k,).
            second_from_first: Poses of the first bodies (k,).
        """
        turn = second_from_first.rotation
        half_a, half_b = self._half[first], self._half[second]
        here = np.einsum("kij,kj->ki", turn, self.centre[first]) + second_from_first.translation
        here -= self.centre[second]
        gap: Array = np.sqrt(np.einsum("ki,ki->k", here, here))
        gap -= self.bound[first] + self.bound[second]
        there = np.einsum("kij,ki->kj", turn, here)
        width = np.abs(turn)
        of_a, of_b = (
            np.einsum("kij,kj->ki", width, half_a),
            np.einsum("kij,ki->kj", width, half_b),
        )
        for apart, box, other, ball in (
            (here, half_b, of_a, self.bound[first]),
            (there, half_a, of_b, self.bound[second]),
        ):
            outside = np.abs(apart) - box
            to_ball = np.maximum(outside, 0.0)
            np.maximum(gap, np.sqrt(np.einsum("ki,ki->k", to_ball, to_ball)) - ball, out=gap)
            to_box = np.maximum(outside - other, 0.0)
            length = np.sqrt(np.einsum("ki,ki->k", to_box, to_box))
            np.maximum(gap, length, out=gap, where=length > 0.0)
        return gap
