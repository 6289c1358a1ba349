"""Random points in a shell around the base, or within reach of an arm: practice material."""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array, Transform, matrix_from_quaternion
from rapidsim.motion.configurations.reachability import limit_excess, turns_within_limits
from rapidsim.motion.robot.robot import Robot

DOWN = (0.0, 1.0, 0.0, 0.0)
"""Tool orientation straight down, with its x axis forward."""
_TRIES = 400
"""Number of tries per requested point."""
_BATCH = 512


def shell_points(inner: float, outer: float, count: int, seed: int) -> Array:
    """Return points (count, 3) [m] between two spheres, uniformly distributed in the volume.

    Args:
        inner: Radius [m] of the inner sphere.
        outer: Radius [m] of the outer sphere.
        count: Number of points.
        seed: Equal seeds produce equal points.
    """
    return _in_shell(np.random.default_rng(seed), inner, outer, count)


def reached_points(
    robot: Robot,
    flange_from_tcp: Transform,
    shell: tuple[float, float],
    count: int,
    seed: int,
    *,
    any_attitude: bool,
) -> tuple[Array, Array, int]:
    """Return points in a shell that the arm reaches within its limits, each tested separately.

    Args:
        robot: The arm.
        flange_from_tcp: The tool.
        shell: Radii [m] around the base.
        count: Number of points to find.
        seed: Equal seeds produce equal points.
        any_attitude: Uniformly distributed attitudes; otherwise straight down.

    Returns:
        Positions (k, 3) [m] and quaternions (k, 4), k at most `count`, and the number of tries.
    """
    rng = np.random.default_rng(seed)
    positions, quaternions, drawn, kept = [np.empty((0, 3))], [np.empty((0, 4))], 0, 0
    while kept < count and drawn < _TRIES * count:
        places = _in_shell(rng, *shell, _BATCH)
        turned = _attitudes(rng, _BATCH) if any_attitude else np.tile(DOWN, (_BATCH, 1))
        poses = Transform(matrix_from_quaternion(turned), places) @ flange_from_tcp.inverse()
        branches = robot.inverse(poses)
        excess = limit_excess(robot, turns_within_limits(robot, branches.joints)).any(axis=-1)
        good = np.flatnonzero((branches.exists & ~excess).any(axis=-1))[: count - kept]
        positions.append(places[good])
        quaternions.append(turned[good])
        kept += len(good)
        drawn += _BATCH
    return np.concatenate(positions), np.concatenate(quaternions), drawn


def posture_points(
    robot: Robot, flange_from_tcp: Transform, count: int, seed: int
) -> tuple[Array, Transform]:
    """Uniformly distributed joints (count, n) [rad] within limits, and TCP poses (count,)."""
    lower, upper = robot.lower.copy(), robot.upper.copy()
    endless = ~np.isfinite(lower) | ~np.isfinite(upper)
    lower[endless], upper[endless] = -np.pi, np.pi
    joints = np.random.default_rng(seed).uniform(lower, upper, (count, len(lower)))
    return joints, robot.forward(joints) @ flange_from_tcp


def _attitudes(rng: np.random.Generator, count: int) -> Array:
    """Return uniformly distributed rotations as quaternions (count, 4)."""
    drawn = rng.normal(size=(count, 4))
    drawn *= np.where(drawn[:, :1] < 0.0, -1.0, 1.0)
    unit: Array = drawn / np.linalg.norm(drawn, axis=1, keepdims=True)
    return unit


def _in_shell(rng: np.random.Generator, inner: float, outer: float, count: int) -> Array:
    share, height, turn = rng.random((3, count))
    # The enclosed volume grows with the cube of the radius, the area of a cap with its height.
    radius = np.cbrt(inner**3 + share * (outer**3 - inner**3))
    z = 2.0 * height - 1.0
    aside = np.sqrt(1.0 - z**2)
    angle = 2.0 * np.pi * turn
    points: Array = radius[:, None] * np.stack(
        [aside * np.cos(angle), aside * np.sin(angle), z], axis=1
    )
    return points
