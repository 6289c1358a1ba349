"""Distances between convex parts, for many pairs at once.

The Minkowski difference of two convex bodies is convex, and its point nearest to the origin is the
shortest vector from one to the other. It is approached by simplices of points of the difference;
each step also gives a lower bound of the distance, so the search may stop early if that suffices.

Source:
    Gilbert, Johnson, Keerthi (1988), A fast procedure for computing the distance between complex
    objects in three-dimensional space.
"""

from __future__ import annotations

from dataclasses import fields
from itertools import combinations

import numpy as np
import numpy.typing as npt

from rapidsim.collisions.convex import ConvexParts, Index
from rapidsim.frames.rotation_vectors import cross
from rapidsim.frames.transform import Array, Transform
from rapidsim.values import value_class

CLOSE_M = 1e-10
"""Tolerance [m] between the lower bound and the distance found."""
_OVERLAP_M = 1e-9
"""Distance [m] of hulls below which they overlap."""
_MOST_STEPS = 100
_FLAT = 1e-12
_AFTER, _BEFORE = np.array([1, 2, 0]), np.array([2, 0, 1])


@value_class(frozen=True, slots=True, eq=False)
class Distances:
    """Distances of pairs (k,)."""

    least: Array
    """[m]: lower bounds of the distances; -inf if the hulls overlap."""
    distances_found: Array
    """[m]: distance between two points; equal to `least` unless the search stopped early. Negative
    if the bodies overlap by at most their radii; -inf if their hulls overlap."""
    direction: Array
    """Shape (k, 3): unit vector from the second body to the first, in the frame of the second; zero
    if the hulls overlap."""
    first: Array
    """Shape (k, 3): nearest point on the surface of the first body."""
    second: Array
    """Shape (k, 3): nearest point on the surface of the second body."""


def distances(
    parts: ConvexParts,
    first: Index,
    second: Index,
    second_from_first: Transform,
    enough: Array | float = np.inf,
    close: Array | float = CLOSE_M,
    share: float = 0.0,
) -> Distances:
    """Return the distances of pairs of parts.

    Args:
        parts: All parts.
        first: Indices of the first parts (k,).
        second: Indices of the second parts (k,); all results are in their frames.
        second_from_first: Poses of the first parts (k,).
        enough: Distance [m] above which a lower bound suffices.
        close: Absolute tolerances [m] of all or each (k,).
        share: Relative tolerance; the larger of both applies.
    """
    count = len(first)
    enough = np.broadcast_to(np.asarray(enough, dtype=np.float64), (count,))
    close = np.broadcast_to(np.asarray(close, dtype=np.float64), (count,))
    round_off = parts.radius[first] + parts.radius[second]
    rotation, translation = second_from_first.rotation, second_from_first.translation
    apart = np.einsum("kij,kj->ki", rotation, parts.centre[first]) + translation
    apart -= parts.centre[second]
    # From the box around the second body: for distant bodies close to the final direction.
    outside = np.sign(apart) * np.maximum(np.abs(apart) - parts.half[second], 0.0)
    apart = np.where((outside != 0.0).any(axis=1)[:, None], outside, apart)
    apart[np.abs(apart).max(axis=1) < _FLAT] = (1.0, 0.0, 0.0)
    least, found = np.full(count, -np.inf), np.full(count, np.inf)
    ends = np.zeros((count, 2, 3))
    # Open pairs, row by row. The newest point of a simplex is first, as a point of the first body
    # and one of the second; missing points are copies of it.
    rows: Index = np.arange(count)
    some = _UndecidedPairs(
        first,
        second,
        rotation,
        translation,
        round_off,
        enough,
        close,
        apart / np.sqrt(np.einsum("ki,ki->k", apart, apart))[:, None],
        np.zeros((count, 4, 2, 3)),
        np.zeros(count, dtype=np.int64),
    )
    for _ in range(_MOST_STEPS):
        ahead = some.direction
        turned = np.einsum("kji,kj->ki", some.rotation, -ahead)
        a = parts.farthest(some.first, turned)
        a = np.einsum("kij,kj->ki", some.rotation, a) + some.translation
        b = parts.farthest(some.second, ahead)
        reached = np.maximum(least[rows], np.einsum("kj,kj->k", a - b, ahead))
        least[rows], so_far = reached, found[rows]
        going = so_far - reached > np.maximum(
            some.close, share * np.maximum(reached - some.round_off, 0.0)
        )
        going &= reached - some.round_off < some.enough
        going |= some.size == 0
        if not going.all():
            rows, some, a, b = rows[going], some.rows(going), a[going], b[going]
            if not len(rows):
                break
        some.corners[:, 1:] = some.corners[:, :3]
        some.corners[:, 0, 0], some.corners[:, 0, 1] = a, b
        shares = _nearest_of_simplices(
            some.corners[:, :, 0] - some.corners[:, :, 1], np.minimum(some.size, 3)
        )
        nearest = np.einsum("ki,kinj->knj", shares, some.corners)
        way = nearest[:, 0] - nearest[:, 1]
        length = np.sqrt(np.einsum("ki,ki->k", way, way))
        # If rounding prevents a smaller distance, the result cannot be improved.
        before = found[rows]
        better = length < before - 1e-14
        over = length <= _OVERLAP_M
        ends[rows[better]] = nearest[better]
        found[rows] = np.where(over, -np.inf, np.where(better, length, before))
        stuck = ~better
        least[rows[stuck]] = np.maximum(least[rows[stuck]], found[rows[stuck]] - some.close[stuck])
        least[rows[over]] = -np.inf
        # Points without a share are dropped; the others are moved to the front.
        order = np.argsort(shares <= 0.0, axis=1, kind="stable")
        some.corners[:] = some.corners[np.arange(len(rows))[:, None], order]
        some.size[:] = (shares > 0.0).sum(axis=1)
        some.direction[:] = way / np.maximum(length, _OVERLAP_M)[:, None]
        go = better & ~over
        if not go.all():
            rows, some = rows[go], some.rows(go)
            if not len(rows):
                break
    overlap = np.isneginf(found)
    way = np.where(overlap[:, None], 0.0, ends[:, 0] - ends[:, 1])
    unit = way / np.where(overlap, 1.0, np.linalg.norm(way, axis=1))[:, None]
    return Distances(
        least=np.where(overlap, -np.inf, least - round_off),
        distances_found=np.where(overlap, -np.inf, found - round_off),
        direction=unit,
        first=ends[:, 0] - parts.radius[first][:, None] * unit,
        second=ends[:, 1] + parts.radius[second][:, None] * unit,
    )


@value_class(frozen=True, slots=True, eq=False)
class _UndecidedPairs:
    """Pairs (k,) whose distance is not known yet."""

    first: Index
    second: Index
    rotation: Array
    translation: Array
    round_off: Array
    """[m]: sum of both radii."""
    enough: Array
    close: Array
    """[m]: absolute tolerances."""
    direction: Array
    """Shape (k, 3)"""
    corners: Array
    """Shape (k, 4, 2, 3): corners of the simplex, on the first body and on the second."""
    size: Index
    """Number of valid corners."""

    def rows(self, at: npt.NDArray[np.bool_]) -> _UndecidedPairs:
        """Return a subset of the pairs."""
        return _UndecidedPairs(*(getattr(self, name)[at] for name in _NAMES))


_NAMES = tuple(one.name for one in fields(_UndecidedPairs))


def _nearest_of_simplices(corners: Array, other_rows: Index) -> Array:
    """Return shares (k, 4) of corners (k, 4, 3) in the point of each simplex nearest to the origin.

    Args:
        corners: Corners of the simplices, the newest first.
        other_rows: Number (k,) of other valid corners, up to three; further corners are ignored.

    Returns:
        Exact zeros for corners without a share. The newest has one: the previous point was the
        nearest of all others.
    """
    count, most = len(corners), int(other_rows.max(initial=0))
    found = np.zeros((count, 4))
    if not most:
        found[:, 0] = 1.0
        return found
    most = max(2, most)  # The product of one edge with itself would be rounded differently.
    newest = corners[:, 0]
    edges = corners[:, 1 : 1 + most] - newest[:, None]
    there = np.arange(most) < other_rows[:, None]
    gram = edges @ np.swapaxes(edges, 1, 2)
    toward = -np.einsum("kij,kj->ki", edges, newest)
    # In order: the newest alone, with one edge, with two, with all three.
    shares = np.zeros((count, 2**most, most))
    fits = np.ones((count, 2**most), dtype=np.bool_)
    edge = np.arange(most)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        squares = gram[:, edge, edge]
        shares[:, 1 + edge, edge] = toward / squares
        fits[:, 1 : 1 + most] = there & (squares > 0.0)
        for number, (a, b) in enumerate(combinations(range(most), 2), 1 + most):
            both, one, other = gram[:, a, b], squares[:, a], squares[:, b]
            area = one * other - both**2
            shares[:, number, a] = (toward[:, a] * other - toward[:, b] * both) / area
            shares[:, number, b] = (toward[:, b] * one - toward[:, a] * both) / area
            fits[:, number] = there[:, a] & there[:, b] & (area > _FLAT * one * other)
        if most == len(_AFTER):
            across = cross(edges[:, _AFTER], edges[:, _BEFORE])
            volume = np.einsum("kj,kj->k", edges[:, 0], across[:, 0])
            shares[:, 7] = -np.einsum("kij,kj->ki", across, newest) / volume[:, None]
            fits[:, 7] = there[:, 2] & (volume**2 > _FLAT * squares.prod(axis=1))
        shares[~fits] = 0.0
        own = 1.0 - shares.sum(axis=2)
        # NaN is not a valid share either.
        fits &= (shares >= 0.0).all(axis=2) & (own >= 0.0)
    places = newest[:, None] + shares @ edges
    squares = np.where(fits, np.einsum("kij,kij->ki", places, places), np.inf)
    best = squares.argmin(axis=1)
    row = np.arange(count)
    found[:, 0], found[:, 1 : 1 + most] = own[row, best], shares[row, best]
    return found
