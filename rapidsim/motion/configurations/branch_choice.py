"""Choice of branches and turns along a sequence of poses for the least joint motion.

The choice at one pose affects the cost of the next, so it is made for the whole sequence at once,
by dynamic programming: the cheapest path to each solution of a pose goes through some solution of
the previous pose, and only the cheapest path to each is kept.
"""

from __future__ import annotations

from itertools import pairwise, product

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.reachability import limit_excess, turns_within_limits
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import value_class

_BATCH = 1024


@value_class(frozen=True, slots=True, eq=False)
class LeastMotion:
    """Joints with the least motion along a sequence of poses."""

    joints: Array
    """Shape (k, n) [rad], within the limits."""
    branch: npt.NDArray[np.int64]
    """Shape (k,): branch at each pose."""
    travel: float
    """Sum [rad] of the rotations of all joints from the first pose to the last."""


def least_motion(
    robot: Robot, base_from_flange: Transform, start: Array | None = None
) -> LeastMotion | int:
    """Choose joints for poses (k,), k at least 1.

    Args:
        robot: The arm.
        base_from_flange: The poses in order.
        start: Initial joints (n,) [rad]; without them the first pose is free.

    Returns:
        The joints with the least total motion, or the index of the first pose that no branch
        reaches within the limits. Whether the arm can change branches between two poses without
        leaving the path is not checked: with poses close together, a change is not worthwhile.
    """
    count = len(base_from_flange)
    candidates = []
    for first in range(0, count, _BATCH):
        joints, possible = _candidates(robot, base_from_flange[first : first + _BATCH])
        empty = np.flatnonzero(~possible.any(axis=-1))
        if empty.size:
            return first + int(empty[0])
        candidates += [row[at] for row, at in zip(joints, possible, strict=True)]

    cost = np.zeros(len(candidates[0]))
    if start is not None:
        cost = np.abs(candidates[0] - start).sum(axis=-1)
    came_from = [np.zeros(len(cost), dtype=np.int64)]
    for before, now in pairwise(candidates):
        total = cost + np.abs(now[:, None] - before).sum(axis=-1)
        best = total.argmin(axis=-1)
        cost = total[np.arange(len(now)), best]
        came_from.append(best)

    chosen = int(cost.argmin())
    travel = float(cost[chosen])
    row = np.empty((count, len(robot.joints)))
    for index in range(count - 1, -1, -1):
        row[index] = candidates[index][chosen]
        chosen = int(came_from[index][chosen])
    return LeastMotion(row, robot.kinematics.branch_of(row), travel)


def _candidates(robot: Robot, base_from_flange: Transform) -> tuple[Array, Mask]:
    """Return every branch of poses (k,) in every turn within the limits.

    Returns:
        Joint vectors (k, c, n) [rad], and a mask (k, c) of solutions.
    """
    branches = robot.inverse(base_from_flange)
    middle = turns_within_limits(robot, branches.joints)
    turns = _other_turns(robot)
    joints = (middle[:, :, None] + turns).reshape(len(middle), -1, turns.shape[-1])
    exists = np.repeat(branches.exists, len(turns), axis=-1)
    return joints, exists & ~limit_excess(robot, joints).any(axis=-1)


def _other_turns(robot: Robot) -> Array:
    """Return whole turns (t, n) [rad] by which a joint vector mid-range may be shifted."""
    turns = robot.kinematics.turns
    ranges = [
        range(-round(half), round(half) + 1) if np.isfinite(half) else range(1)
        for half in (0.5 * (robot.upper - robot.lower) / turns).tolist()
    ]
    shifts: Array = turns * np.array(list(product(*ranges)), dtype=np.float64)
    return shifts
