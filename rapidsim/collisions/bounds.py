"""Cheap lower bounds of distances between bodies, from their bounding spheres and boxes.

Each body has a box, along axes of its own, and a sphere around the centre of the box.
"""

from __future__ import annotations

import numpy as np

from rapidsim.collisions.convex import Index
from rapidsim.frames.transform import Array, Transform


class Bounds:
    """Bounding boxes and spheres, each in the frame of its body."""

    def __init__(self, centre: Array, half: Array, bound: Array, axes: Array | None = None) -> None:
        """Store boxes and spheres.

        Args:
            centre: Centres (n, 3) [m] of both.
            half: Half the edges (n, 3) [m] of the boxes.
            bound: Radii (n,) [m] of the spheres.
            axes: Rotations body_from_box (n, 3, 3); None for boxes along the axes of the bodies.
        """
        self.centre, self.half, self.axes = centre, half, axes
        self.bound: Array = np.minimum(bound, np.linalg.norm(half, axis=1))

    @classmethod
    def unknown(cls, count: int, *, turned: bool) -> Bounds:
        """Return bounds of bodies that `put` replaces; `turned` if boxes may have own axes."""
        axes = np.tile(np.eye(3), (count, 1, 1)) if turned else None
        return cls(np.zeros((count, 3)), np.zeros((count, 3)), np.zeros(count), axes)

    def put(self, at: Index, some: Bounds) -> None:
        """Replace the bounds of bodies (k,)."""
        self.centre[at], self.half[at], self.bound[at] = some.centre, some.half, some.bound
        if self.axes is not None and some.axes is not None:
            self.axes[at] = some.axes

    def rows(self, at: Index) -> Bounds:
        """Return the bounds of some bodies."""
        axes = None if self.axes is None else self.axes[at]
        return Bounds(self.centre[at], self.half[at], self.bound[at], axes)

    def from_points(self, at: Index, points: Array) -> Array:
        """Return the distances (k,) [m] of boxes (k,) from points (k, 3) in their frames."""
        local = points - self.centre[at]
        if self.axes is not None:
            local = np.einsum("kji,kj->ki", self.axes[at], local)
        beyond = np.maximum(np.abs(local) - self.half[at], 0.0)
        distance: Array = np.sqrt(np.einsum("ki,ki->k", beyond, beyond))
        return distance

    def gaps(
        self,
        first: Index,
        second: Index,
        second_from_first: Transform,
        enough: Array | None = None,
    ) -> Array:
        """Return lower bounds of the distances [m] of pairs (k,); negative if undecided.

        Args:
            first: Indices of the first bodies (k,).
            second: Indices of the second bodies (k,).
            second_from_first: Poses of the first bodies (k,).
            enough: Bounds [m] above which a smaller one than the largest known suffices; None if it
                never does.
        """
        here = np.einsum("kij,kj->ki", second_from_first.rotation, self.centre[first])
        here += second_from_first.translation - self.centre[second]
        gap: Array = np.sqrt(np.einsum("ki,ki->k", here, here))
        gap -= self.bound[first] + self.bound[second]
        if enough is None:
            return self._gaps_of_boxes(first, second, second_from_first.rotation, here, gap)
        rows = np.flatnonzero(gap < enough)
        gap[rows] = np.maximum(
            gap[rows],
            self._along_centres(
                first[rows], second[rows], second_from_first.rotation[rows], here[rows]
            ),
        )
        rows = rows[gap[rows] < enough[rows]]
        gap[rows] = self._gaps_of_boxes(
            first[rows], second[rows], second_from_first.rotation[rows], here[rows], gap[rows]
        )
        return gap

    def _along_centres(self, first: Index, second: Index, turn: Array, between: Array) -> Array:
        """Return the gaps (k,) [m] of boxes seen along the lines between their centres."""
        length: Array = np.sqrt(np.einsum("ki,ki->k", between, between))
        along = between / np.maximum(length, 1e-12)[:, None]
        for body, ahead in ((second, along), (first, np.einsum("kij,ki->kj", turn, along))):
            if self.axes is not None:
                ahead = np.einsum("kij,ki->kj", self.axes[body], ahead)
            length = length - np.einsum("kj,kj->k", np.abs(ahead), self.half[body])
        return length

    def _gaps_of_boxes(
        self, first: Index, second: Index, turn: Array, between: Array, gap: Array
    ) -> Array:
        """Return the bounds (k,) [m] of boxes, or those of their spheres if they are larger.

        Args:
            first: Indices of the first bodies (k,).
            second: Indices of the second bodies (k,).
            turn: Rotations second_from_first (k, 3, 3).
            between: Centres (k, 3) [m] of the first, from those of the second.
            gap: Bounds (k,) [m] of the spheres.
        """
        half_a, half_b = self.half[first], self.half[second]
        if self.axes is not None:
            back = np.swapaxes(self.axes[second], 1, 2)
            turn = back @ turn @ self.axes[first]
            between = np.einsum("kij,kj->ki", back, between)
        there = np.einsum("kij,ki->kj", turn, between)
        width = np.abs(turn)
        of_a, of_b = (
            np.einsum("kij,kj->ki", width, half_a),
            np.einsum("kij,ki->kj", width, half_b),
        )
        for apart, box, other, ball in (
            (between, half_b, of_a, self.bound[first]),
            (there, half_a, of_b, self.bound[second]),
        ):
            outside = np.abs(apart) - box
            to_ball = np.maximum(outside, 0.0)
            np.maximum(gap, np.sqrt(np.einsum("ki,ki->k", to_ball, to_ball)) - ball, out=gap)
            to_box = np.maximum(outside - other, 0.0)
            length = np.sqrt(np.einsum("ki,ki->k", to_box, to_box))
            np.maximum(gap, length, out=gap, where=length > 0.0)
        return gap


def around(corners: Array, starts: Index, *, turned: bool) -> Bounds:
    """Return bounds of groups of consecutive parts.

    Args:
        corners: Corners (n, p, 3) [m] of all parts.
        starts: First part (g,) of each group.
        turned: Whether boxes are turned along the principal axes of all corners if that makes their
            surface smaller: the box of a piece of a surface is thin.
    """
    size, each = np.diff(starts, append=len(corners)), corners.shape[1]
    points, first, count = corners.reshape(-1, 3), each * starts, each * size
    low = np.minimum.reduceat(points, first, axis=0)
    high = np.maximum.reduceat(points, first, axis=0)
    centre, half, axes = 0.5 * (low + high), 0.5 * (high - low), None
    if turned:
        apart = points - np.repeat(centre, count, axis=0)
        mean = np.add.reduceat(apart, first, axis=0) / count[:, None]
        from_mean = (apart - np.repeat(mean, count, axis=0)).reshape(corners.shape)
        spread = np.add.reduceat(np.swapaxes(from_mean, 1, 2) @ from_mean, starts, axis=0)
        _, axes = np.linalg.eigh(spread)
        along = apart.reshape(corners.shape) @ np.repeat(axes, size, axis=0)
        low = np.minimum.reduceat(along.reshape(-1, 3), first, axis=0)
        high = np.maximum.reduceat(along.reshape(-1, 3), first, axis=0)
        better = _surface(0.5 * (high - low)) < _surface(half)
        axes[~better] = np.eye(3)
        half = np.where(better[:, None], 0.5 * (high - low), half)
        middle = np.einsum("gij,gj->gi", axes, 0.5 * (low + high))
        centre = np.where(better[:, None], centre + middle, centre)
    from_centre = points - np.repeat(centre, count, axis=0)
    far = np.sqrt(np.einsum("ki,ki->k", from_centre, from_centre))
    return Bounds(centre, half, np.maximum.reduceat(far, first), axes)


def around_triangles(triangles: Array) -> Bounds:
    """Return bounds of triangles (k, 3, 3) [m]: flat boxes along their longest edges."""
    edges = np.roll(triangles, -1, axis=1) - triangles
    squares, row = np.einsum("kij,kij->ki", edges, edges), np.arange(len(triangles))
    longest = squares.argmax(axis=1)
    along = edges[row, longest] / np.sqrt(squares[row, longest])[:, None]
    up = edges[row, (longest + 1) % 3]
    for _ in range(2):  # Of a thin triangle the first is not normal to its edge, but for rounding.
        up = up - np.einsum("kj,kj->k", up, along)[:, None] * along
        up /= np.linalg.norm(up, axis=1)[:, None]
    axes = np.stack([along, up, np.cross(along, up)], axis=2)
    places = triangles @ axes
    low, high = places.min(axis=1), places.max(axis=1)
    half = 0.5 * (high - low)
    centre = np.einsum("kij,kj->ki", axes, 0.5 * (low + high))
    return Bounds(centre, half, np.linalg.norm(half, axis=1), axes)


def _surface(half: Array) -> Array:
    """Return numbers (k,) proportional to the surfaces of boxes with half edges (k, 3)."""
    surface: Array = (half * np.roll(half, 1, axis=1)).sum(axis=1)
    return surface


def turned(first: Array, other: Array) -> Array:
    """Upper bound of the displacement of a point at distance 1 between two rotations (...)."""
    apart = first - other
    moved: Array = np.sqrt(0.5 * np.einsum("...ij,...ij->...", apart, apart))
    return moved


def straight(bounds: Bounds, first: Index, start: Transform, end: Transform) -> Array:
    """Upper bounds (k,) [m] of point displacements on the straight path between two poses."""
    centre = bounds.centre[first]
    shift = np.linalg.norm(
        np.einsum("kij,kj->ki", end.rotation - start.rotation, centre)
        + end.translation
        - start.translation,
        axis=1,
    )
    moved: Array = shift + turned(end.rotation, start.rotation) * bounds.bound[first]
    return moved
