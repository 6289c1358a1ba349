"""How far convex parts are from each other, for many pairs at once.

The difference of two convex bodies is convex, and its point nearest to the origin is the shortest
way from one to the other. It is approached by simplices of points of the difference; each step also
tells how near the bodies can be at most, so a search may stop where that is all one wants to know.

Source:
    Gilbert, Johnson, Keerthi (1988), A fast procedure for computing the distance between complex
    objects in three-dimensional space.
"""

from __future__ import annotations

import numpy as np

from rapidsim.collisions.convex import Index, Parts
from rapidsim.frames.rotation_vectors import cross
from rapidsim.frames.transform import Array, Transform
from rapidsim.values import dataclass

CLOSE_M = 1e-10
"""Between what is known to be possible and what was found."""
_OVERLAP_M = 1e-9
"""Hulls nearer than this overlap."""
_MOST_STEPS = 100
_FLAT = 1e-12
_AFTER, _BEFORE = np.array([1, 2, 0]), np.array([2, 0, 1])
_CORNERS = ((0,), (1,), (2,), (0, 1), (0, 2), (1, 2))
"""Which of the three edges from the newest point span a side."""


@dataclass(frozen=True, slots=True, eq=False)
class Distances:
    """Of pairs (k,)."""

    least: Array
    """[m]: the bodies are no nearer; -inf where their hulls overlap."""
    found: Array
    """[m]: between two points that were found; equal to `least` but where the search stopped early.
    Below 0 where the bodies overlap by no more than their radii; -inf where their hulls do."""
    direction: Array
    """Shape (k, 3): a unit vector from the second body to the first, in the frame they are in; zero
    where the hulls overlap."""
    first: Array
    """Shape (k, 3): the point of the first body's surface that is nearest."""
    second: Array
    """Shape (k, 3)"""


def distances(
    parts: Parts,
    first: Index,
    second: Index,
    second_from_first: Transform,
    enough: Array | float = np.inf,
    close: float = CLOSE_M,
) -> Distances:
    """Distances of pairs of parts.

    Args:
        parts: All parts.
        first: Which of them (k,).
        second: Which of them (k,); all that is found is in its frame.
        second_from_first: Where the first ones are (k,).
        enough: From which distance [m] on the exact one does not matter.
        close: How exact [m] it is.
    """
    count = len(first)
    enough = np.broadcast_to(np.asarray(enough, dtype=np.float64), (count,))
    round_off = parts.radius[first] + parts.radius[second]
    rotation, translation = second_from_first.rotation, second_from_first.translation
    least, found = np.full(count, -np.inf), np.full(count, np.inf)
    points_of_first, points_of_second = np.zeros((count, 3)), np.zeros((count, 3))
    nearest = np.einsum("kij,kj->ki", rotation, parts.centre[first]) + translation
    nearest -= parts.centre[second]
    nearest[np.abs(nearest).max(axis=1) < _FLAT] = (1.0, 0.0, 0.0)
    direction = nearest / np.linalg.norm(nearest, axis=1)[:, None]
    # The newest point of a simplex stands first; points that are not there are copies of it.
    corners_first, corners_second = np.zeros((count, 4, 3)), np.zeros((count, 4, 3))
    size = np.zeros(count, dtype=np.int64)
    rows: Index = np.arange(count)
    for _ in range(_MOST_STEPS):
        ahead = direction[rows]
        turned = np.einsum("kji,kj->ki", rotation[rows], -ahead)
        a = parts.farthest(first[rows], turned)
        a = np.einsum("kij,kj->ki", rotation[rows], a) + translation[rows]
        b = parts.farthest(second[rows], ahead)
        beyond = np.einsum("kj,kj->k", a - b, ahead)
        least[rows] = np.maximum(least[rows], beyond)
        going = (found[rows] - least[rows] > close) & (least[rows] - round_off[rows] < enough[rows])
        started = size[rows] > 0
        rows, a, b = rows[going | ~started], a[going | ~started], b[going | ~started]
        if not len(rows):
            break
        corners_first[rows, 1:] = corners_first[rows, :3]
        corners_second[rows, 1:] = corners_second[rows, :3]
        corners_first[rows, 0], corners_second[rows, 0] = a, b
        shares = _nearest_of_simplices(
            corners_first[rows] - corners_second[rows], np.minimum(size[rows], 3)
        )
        pa = np.einsum("ki,kij->kj", shares, corners_first[rows])
        pb = np.einsum("ki,kij->kj", shares, corners_second[rows])
        way = pa - pb
        length = np.linalg.norm(way, axis=1)
        # Where rounding lets nothing come nearer, what was found is as good as it gets.
        better = length < found[rows] - 1e-14
        kept = rows[better]
        found[kept], points_of_first[kept], points_of_second[kept] = (
            length[better], pa[better], pb[better],
        )  # fmt: skip
        stuck = rows[~better]
        least[stuck] = np.maximum(least[stuck], found[stuck] - close)
        over = length <= _OVERLAP_M
        found[rows[over]], least[rows[over]] = -np.inf, -np.inf
        go = better & ~over
        rows, shares, way, length = rows[go], shares[go], way[go], length[go]
        if not len(rows):
            break
        direction[rows] = way / length[:, None]
        # Points that have no share are left out; those that have stand in front.
        order = np.argsort(shares <= 0.0, axis=1, kind="stable")
        size[rows] = (shares > 0.0).sum(axis=1)
        corners_first[rows] = corners_first[rows[:, None], order]
        corners_second[rows] = corners_second[rows[:, None], order]
    overlap = np.isneginf(found)
    way = np.where(overlap[:, None], 0.0, points_of_first - points_of_second)
    unit = way / np.where(overlap, 1.0, np.linalg.norm(way, axis=1))[:, None]
    return Distances(
        least=np.where(overlap, -np.inf, least - round_off),
        found=np.where(overlap, -np.inf, found - round_off),
        direction=unit,
        first=points_of_first - parts.radius[first][:, None] * unit,
        second=points_of_second + parts.radius[second][:, None] * unit,
    )


def _nearest_of_simplices(corners: Array, others: Index) -> Array:
    """The shares (k, 4) of corners (k, 4, 3) in the point of each simplex nearest to the origin.

    Args:
        corners: The newest one first.
        others: How many stand behind it (k,), up to three; what is behind these does not count.

    Returns:
        Exact zeros for corners without a share. The newest has one: the point before it was the
        nearest of all others.
    """
    count = len(corners)
    newest = corners[:, 0]
    edges = corners[:, 1:] - newest[:, None]
    there = np.arange(3) < others[:, None]
    gram = edges @ np.swapaxes(edges, 1, 2)
    toward = -np.einsum("kij,kj->ki", edges, newest)
    shares = np.zeros((count, 8, 3))
    fits = np.zeros((count, 8), dtype=np.bool_)
    fits[:, 0] = True
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        for number, used in enumerate(_CORNERS, start=1):
            if len(used) == 1:
                (i,) = used
                shares[:, number, i] = toward[:, i] / gram[:, i, i]
                fits[:, number] = there[:, i] & (gram[:, i, i] > 0.0)
            else:
                i, j = used
                square = gram[:, i, i] * gram[:, j, j]
                area = square - gram[:, i, j] ** 2
                shares[:, number, i] = (
                    toward[:, i] * gram[:, j, j] - toward[:, j] * gram[:, i, j]
                ) / area
                shares[:, number, j] = (
                    toward[:, j] * gram[:, i, i] - toward[:, i] * gram[:, i, j]
                ) / area
                fits[:, number] = there[:, i] & there[:, j] & (area > _FLAT * square)
        across = cross(edges[:, _AFTER], edges[:, _BEFORE])
        volume = np.einsum("kj,kj->k", edges[:, 0], across[:, 0])
        shares[:, 7] = -np.einsum("kij,kj->ki", across, newest) / volume[:, None]
        size = np.einsum("kij,kij->ki", edges, edges).prod(axis=1)
        fits[:, 7] = there.all(axis=1) & (volume**2 > _FLAT * size)
    fits &= np.isfinite(shares).all(axis=2)
    shares = np.where(fits[..., None], shares, 0.0)
    own = 1.0 - shares.sum(axis=2)
    fits &= (shares >= 0.0).all(axis=2) & (own >= 0.0)
    places = newest[:, None] + shares @ edges
    squares = np.where(fits, np.einsum("kij,kij->ki", places, places), np.inf)
    best = squares.argmin(axis=1)
    row = np.arange(count)
    return np.concatenate([own[row, best][:, None], shares[row, best]], axis=1)
