"""How deep bodies are in each other: the shortest way that would part them.

The way is looked for among directions: those of faces that others lie flat on, and some all around,
the best of which is turned until it gets no better. It is therefore never shorter than the true
one, and equal to it where a face says the way.
"""

from __future__ import annotations

import numpy as np

from rapidsim.collisions.convex import Index, Parts
from rapidsim.frames.transform import Array, Transform

TOUCH_M = 1e-5
"""Bodies that overlap by no more touch: a part that lies on a table is no collision."""
_ALL_AROUND = 60
_ROUNDS = 14


def flat_overlap(
    parts: Parts, first: int, second: int, second_from_first: Transform
) -> tuple[float, Array]:
    """How far [m] parts overlap square to the faces others lie flat on, and the way out (3,).

    Infinite where they have no such faces.
    """
    own = parts.normals[first] @ second_from_first.rotation.T
    flat = np.concatenate([own, -own, parts.normals[second], -parts.normals[second]])
    if not len(flat):
        return np.inf, np.array([0.0, 0.0, 1.0])
    overlap = _overlaps(parts, first, second, second_from_first, flat)
    return float(overlap.min()), flat[overlap.argmin()]


def depth(
    parts: Parts, first: int, second: int, second_from_first: Transform, beyond: float
) -> float:
    """How far [m] the first part must go to be out of the second.

    Args:
        parts: All parts.
        first: One of them.
        second: Another.
        second_from_first: Where the first one is, a single transform.
        beyond: Only more [m] than that counts; of less, no more is found out.
    """
    least, best = flat_overlap(parts, first, second, second_from_first)
    apart = second_from_first.apply(parts.centre[first]) - parts.centre[second]
    length = float(np.linalg.norm(apart))
    toward = [apart[None] / length] if length > 1e-12 else []
    ways = np.concatenate([best[None], *toward, _around()])
    overlap = _overlaps(parts, first, second, second_from_first, ways)
    best, least = ways[overlap.argmin()], float(overlap.min())
    width = 0.35
    for _ in range(_ROUNDS):
        if least <= beyond:
            break
        tried = best + width * _around()
        tried /= np.linalg.norm(tried, axis=1)[:, None]
        overlap = _overlaps(parts, first, second, second_from_first, tried)
        if overlap.min() < least:
            best, least = tried[overlap.argmin()], float(overlap.min())
        else:
            width *= 0.4
    return least


def _overlaps(
    parts: Parts, first: int, second: int, second_from_first: Transform, ways: Array
) -> Array:
    """How far the first part must go in directions (k, 3) to be out of the second."""
    count = len(ways)
    of_first: Index = np.full(count, first)
    of_second: Index = np.full(count, second)
    a = parts.farthest(of_first, -ways @ second_from_first.rotation)
    a = second_from_first.apply(a)
    b = parts.farthest(of_second, ways)
    overlaps: Array = np.einsum("kj,kj->k", b - a, ways)
    overlaps += parts.radius[first] + parts.radius[second]
    return overlaps


def _around() -> Array:
    """Unit vectors (k, 3) all around, evenly."""
    number = np.arange(_ALL_AROUND) + 0.5
    height = 1.0 - 2.0 * number / _ALL_AROUND
    angle = np.pi * (1.0 + 5.0**0.5) * number
    out = np.sqrt(1.0 - height**2)
    return np.column_stack([out * np.cos(angle), out * np.sin(angle), height])
