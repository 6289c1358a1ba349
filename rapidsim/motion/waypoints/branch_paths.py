"""Following of a TCP path in each configuration separately, over its whole length.

An arm cannot change its configuration on a path without passing a singularity. Each configuration
either works throughout, or has a joint past its limit, an unreachable pose, or a jump; the worst
over the whole path is reported.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.confdata import confdata_of
from rapidsim.motion.configurations.reachability import (
    Unreachable,
    limit_excess,
    turns_within_limits,
)
from rapidsim.motion.kinematics.unwrapping import turning, whole_turns
from rapidsim.motion.robot.external_axes import amount_text
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.waypoints.branch_jumps import too_fast
from rapidsim.values import value_class

Mask = npt.NDArray[np.bool_]
_EXACT = 1e-9
"""Distance [m] beyond reach of a wrist centre that is only rounding."""


@value_class(frozen=True, slots=True, eq=False)
class BranchPath:
    """Joints of one configuration along a path."""

    confdata: tuple[int, ...]
    """Values at the first pose: cf1, cf4, cf6, cfx."""
    joints: Array
    """Shape (k, n) [rad]; 0 where it does not reach the pose."""
    exists: Mask
    """Shape (k,): the poses that it reaches."""
    message: str | None
    """Reason why the whole path is infeasible in it; None if it is feasible."""
    row: int
    """First affected pose; 0 if feasible."""
    severity: tuple[int, float]
    """Sort key of configurations: the smaller, the closer to feasible."""

    @property
    def travel(self) -> float:
        """Total joint motion [rad]."""
        return float(np.abs(np.diff(self.joints, axis=0)).sum())


def branch_paths(
    robot: Robot, times: Array, base_from_flange: Transform, first: Array | None = None
) -> tuple[BranchPath, ...]:
    """Follow poses in every configuration that reaches the first one.

    Args:
        robot: An arm whose solutions confdata distinguishes.
        times: Times (k,) [s].
        base_from_flange: Poses (k,), close to one another.
        first: Joints (n,) [rad] at the first pose: their configuration uses their whole turns.
            The other configurations use turns within the limits, if possible.

    Returns:
        Paths, the closest to feasible first; empty if the first pose is out of reach.
    """
    arm = robot.kinematics
    own = None if first is None else int(arm.branch_of(first))
    begin = robot.inverse(base_from_flange[:1])
    found = []
    for branch in np.flatnonzero(begin.exists[0]).tolist():
        given = first is not None and branch == own
        near = first if first is not None and given else begin.joints[0, branch]
        followed = arm.inverse_on_branch(base_from_flange, branch, near)
        joints, exists = followed.joints, followed.exists
        if not given:
            joints = joints + _shift(robot, joints[exists])
        found.append(_branch_path(robot, times, base_from_flange, joints, exists))
    return tuple(sorted(found, key=lambda way: way.severity))


def steps_of_branches(robot: Robot, paths: Sequence[BranchPath]) -> Array:
    """Return the largest steps (k - 1,) [rad] between the poses of paths in any configuration."""
    found = []
    for one in paths:
        steps = np.abs(turning(np.diff(one.joints, axis=0), robot.kinematics.turns)).max(axis=1)
        found.append(np.where(one.exists[1:] & one.exists[:-1], steps, 0.0))
    largest: Array = np.max(found, axis=0, initial=0.0)
    return largest


def _shift(robot: Robot, joints: Array) -> Array:
    """Whole turns (n,) [rad] that shift the middle of each joint's travel nearest to its range."""
    middle = 0.5 * (joints.min(axis=0) + joints.max(axis=0))
    return whole_turns(turns_within_limits(robot, middle) - middle, robot.kinematics.turns)


def _branch_path(
    robot: Robot,
    times: Array,
    base_from_flange: Transform,
    joints: Array,
    exists: Mask,
) -> BranchPath:
    conf = tuple(confdata_of(robot.kinematics, joints[0]).tolist())
    excess = limit_excess(robot, joints)
    excess[~exists] = 0.0
    if not exists.all():
        row = int(np.argmin(exists))
        off = robot.inverse(base_from_flange[np.flatnonzero(~exists)]).shortfall.max()
        why = (
            Unreachable(float(off)).message
            if off > _EXACT
            else "this configuration does not reach it"
        )
        share = float(np.mean(~exists))
        return BranchPath(conf, joints, exists, why, row, (2, share))
    if (jump := too_fast(robot, times, joints, exists)) is not None:
        row, joint, size = jump
        why = f"joint {joint + 1} would have to jump by {degrees(size):.0f} deg, at a singularity"
        return BranchPath(conf, joints, exists, why, row, (3, size))
    if excess.any():
        row, joint = (int(i) for i in np.unravel_index(np.argmax(np.abs(excess)), excess.shape))
        over = float(excess[row, joint])
        limit = robot.upper[joint] if over > 0.0 else robot.lower[joint]
        side = "upper" if over > 0.0 else "lower"
        measure = robot.joints[joint].measure
        why = (
            f"joint {joint + 1} goes to {degrees(joints[row, joint]):.1f} {measure}, "
            f"{amount_text(degrees(abs(over)))} {measure} beyond its {side} limit of "
            f"{degrees(limit):.0f} {measure}"
        )
        first = int(np.argmax(np.abs(excess).max(axis=1) > 0.0))
        return BranchPath(conf, joints, exists, why, first, (1, abs(over)))
    return BranchPath(conf, joints, exists, None, 0, (0, 0.0))
