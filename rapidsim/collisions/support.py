"""The body on which a part rests: the first that it would meet if it moved straight down."""

from __future__ import annotations

import numpy as np

from rapidsim.collisions.body_distance import Bodies
from rapidsim.collisions.convex import Index, Mask
from rapidsim.collisions.overlap import TOUCH_M
from rapidsim.frames.transform import Array, Transform
from rapidsim.values import value_class

RESTS_M = 5e-3
"""Drop [m] up to which a part rests on a body."""
DEEPEST_M = 2.0
"""Drop [m] up to which a body below a part is sought."""
_STEP_M, _STEP = 5e-4, 0.02
"""Step down past a body at the side, the larger of a length [m] and a share of the drop."""
_CARRIES_M = 1e-3
"""A body that carries a part is overlapped by this much more [m] after the drop of a resting part;
one that only touches its side is not."""


@value_class(frozen=True, slots=True)
class Support:
    """A body below a part."""

    body: int
    drop_m: float
    """Height [m] of the part above it."""


def support(
    bodies: Bodies,
    part: int,
    below: Index,
    world_from_part: Transform,
    world_from_below: Transform,
    deepest_m: float = RESTS_M,
) -> Support | None:
    """Return the first body that a part meets on its way down; None if there is none.

    Args:
        bodies: All bodies.
        part: Index of the part.
        below: Indices of the bodies (k,) that may be below it.
        world_from_part: Its pose.
        world_from_below: Poses (k,) of the bodies.
        deepest_m: Largest drop [m].
    """
    drops, free = np.zeros((2, len(below)))
    open_ones = np.arange(len(below))
    met: list[int] = []
    while len(open_ones):
        gaps = bodies.gaps(
            np.full(len(open_ones), part),
            below[open_ones],
            _seen(world_from_part, world_from_below[open_ones], drops[open_ones]),
            deepest_m - drops[open_ones] + _STEP_M,
        ).distances_found
        touches = gaps < -TOUCH_M
        met += open_ones[touches].tolist()
        step = np.maximum(_STEP_M, _STEP * drops[open_ones])
        free[open_ones] = np.where(touches, free[open_ones], drops[open_ones] + gaps)
        drops[open_ones] += np.where(touches, 0.0, np.maximum(gaps, step))
        open_ones = open_ones[~touches & (drops[open_ones] <= deepest_m + _STEP_M)]
    if not met:
        return None
    rows = np.array(met)
    grows: Mask = np.ones(len(rows), dtype=np.bool_)
    if len(rows) > 1:
        grows = _carries(bodies, part, below[rows], world_from_part, world_from_below[rows])
    best = rows[np.lexsort((below[rows], drops[rows], ~grows))[0]]
    return Support(int(below[best]), max(0.0, float(free[best])))


def _carries(
    bodies: Bodies,
    part: int,
    below: Index,
    world_from_part: Transform,
    world_from_below: Transform,
) -> Mask:
    """Mask (k,) of the bodies that hinder a part on its way down, not only at its side."""
    first = np.full(len(below), part)
    deep = [
        bodies.depths(
            first,
            below,
            _seen(world_from_part, world_from_below, np.full(len(below), drop_m)),
            exact=True,
        )
        for drop_m in (0.0, RESTS_M)
    ]
    grows: Mask = deep[1] - deep[0] > _CARRIES_M
    return grows


def _seen(world_from_part: Transform, world_from_below: Transform, drops: Array) -> Transform:
    """Return below_from_part (k,) of a part that has moved down by some drops (k,) [m]."""
    down = world_from_part.translation - drops[:, None] * np.array([0.0, 0.0, 1.0])
    turned = np.broadcast_to(world_from_part.rotation, (len(drops), 3, 3))
    return world_from_below.inverse() @ Transform(turned, down)
