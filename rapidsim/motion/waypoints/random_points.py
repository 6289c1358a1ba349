"""Points anywhere in a shell around the base: practice material for an arm."""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array


def shell_points(inner: float, outer: float, count: int, seed: int) -> Array:
    """Points (count, 3) [m] between two spheres around the origin, evenly in the volume.

    Args:
        inner: Radius [m] of the inner sphere.
        outer: Radius [m] of the outer one.
        count: How many points.
        seed: The same seed gives the same points.
    """
    rng = np.random.default_rng(seed)
    share, height, turn = rng.random((3, count))
    # The volume inside grows with the cube of the radius, the area of a cap with its height.
    radius = np.cbrt(inner**3 + share * (outer**3 - inner**3))
    z = 2.0 * height - 1.0
    aside = np.sqrt(1.0 - z**2)
    angle = 2.0 * np.pi * turn
    points: Array = radius[:, None] * np.stack(
        [aside * np.cos(angle), aside * np.sin(angle), z], axis=1
    )
    return points
