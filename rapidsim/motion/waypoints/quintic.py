"""Joint polynomials of degree 5 through joint vectors, with speeds and accelerations at each.

Between two points six conditions determine a polynomial of degree 5. It passes through the points
at the requested times and speeds, and is not restricted in between: it overshoots if a speed at a
point is too high for the time to the next. `overshoot` computes the amount.
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.waypoints.piecewise_polynomials import Piecewise


def quintics(times: Array, joints: Array, speeds: Array, accelerations: Array) -> Piecewise:
    """Join points by polynomials of degree 5.

    Args:
        times: Shape (k,) [s], ascending.
        joints: Shape (k, n) [rad].
        speeds: Shape (k, n) [rad/s].
        accelerations: Shape (k, n) [rad/s2].

    Returns:
        A function of time with n components, twice continuously differentiable.
    """
    t = np.diff(times)[:, None]
    step = np.diff(joints, axis=0)
    v0, v1 = speeds[:-1], speeds[1:]
    a0, a1 = accelerations[:-1], accelerations[1:]
    coefficients = [
        joints[:-1],
        v0,
        0.5 * a0,
        (20.0 * step - (8.0 * v1 + 12.0 * v0) * t - (3.0 * a0 - a1) * t**2) / (2.0 * t**3),
        (-30.0 * step + (14.0 * v1 + 16.0 * v0) * t + (3.0 * a0 - 2.0 * a1) * t**2) / (2.0 * t**4),
        (12.0 * step - 6.0 * (v1 + v0) * t - (a0 - a1) * t**2) / (2.0 * t**5),
    ]
    return Piecewise(np.asarray(times, dtype=np.float64), np.stack(coefficients, axis=1))


def overshoot(trajectory: Piecewise, joints: Array) -> Array:
    """Return the distance (n,) [rad] of a trajectory outside the range between adjacent points.

    Args:
        trajectory: One polynomial between each two points.
        joints: The points (k, n) [rad].
    """
    low, high = trajectory.extremes()
    above = high - np.maximum(joints[:-1], joints[1:])
    below = np.minimum(joints[:-1], joints[1:]) - low
    furthest: Array = np.maximum(np.maximum(above, below), 0.0).max(axis=0)
    return furthest
