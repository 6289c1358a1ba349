"""ABB's confdata: which of the many joint vectors of a pose is meant.

cf1, cf4 and cf6 are the quarter turns that axes 1, 4 and 6 stand in: 0 from 0 to 90 deg, -1 from
-90 to 0, and so on through all turns. cfx is the branch of inverse kinematics. Together they name
one joint vector, but where axis 5 is 0 and only the sum of axes 4 and 6 matters.

Source: Technical reference manual RAPID Instructions, Functions and Data types, confdata, for
robots with a serial wrist.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from math import ceil, floor, isinf, pi

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics import Kinematics, Mask
from rapidsim.motion.reach import LIMIT_TOLERANCE, turns_within_limits
from rapidsim.motion.robot import Robot

Integers = npt.NDArray[np.int64]

QUARTER = pi / 2.0
TURN = 2.0 * pi
SNAP = 2e-8
"""A joint this close [rad] below a quarter counts as standing on it: 90 deg computed."""
COUNTED = [0, 3, 5]
"""The axes whose quarter turns confdata counts: 1, 4 and 6."""
UNDETERMINED_WRIST = 1e-7
"""Axis 5 up to which [rad] confdata may share out the sum of axes 4 and 6."""
SAME = 1e-9
"""Joint vectors that differ by less [rad] are one, met by two branches."""


@dataclass(frozen=True, slots=True, eq=False)
class Configuration:
    """One way to reach a pose."""

    joints: Array
    """Shape (6,) [rad]."""
    confdata: tuple[int, int, int, int]
    """cf1, cf4, cf6, cfx."""


@dataclass(frozen=True, slots=True, eq=False)
class Selected:
    """What confdata selects for a row of poses."""

    joints: Array
    """Shape (k, 6) [rad]; 0 where the branch does not reach the pose. Limits are not heeded."""
    exists: Mask
    """Shape (k,): False where the branch does not reach the pose or cfx is not 0 to 7."""
    quarters_off: Integers
    """Shape (k, 3): how many quarter turns axes 1, 4 and 6 are from what confdata says."""


def confdata_of(kinematics: Kinematics, joints: Array) -> Integers:
    """cf1, cf4, cf6 and cfx, shape (..., 4), of joint vectors (..., 6) [rad]."""
    joints = np.asarray(joints, dtype=np.float64)
    branch = kinematics.branch_of(joints)
    return np.concatenate([_quarters(joints[..., COUNTED]), branch[..., None]], axis=-1)


def select(
    robot: Robot, base_from_flange: Transform, confdata: Array | Integers, near: Array
) -> Selected:
    """Joint vectors of poses with confdata.

    Args:
        robot: An arm with a spherical wrist.
        base_from_flange: Poses (k,).
        confdata: cf1, cf4, cf6, cfx of each, shape (k, 4).
        near: Joint vectors (k, 6) or (6,) [rad]: axes that the pose leaves undetermined stay as
            near to them as confdata allows.

    Returns:
        Axes 1, 4 and 6 in the turn that comes nearest to confdata, the others in the turn that
        is nearest to their range.
    """
    wanted = np.rint(np.asarray(confdata)).astype(np.int64)
    held = np.broadcast_to(np.asarray(near, dtype=np.float64), (len(wanted), 6))
    joints = np.zeros((len(wanted), 6))
    exists = np.zeros(len(wanted), dtype=np.bool_)
    for branch in range(robot.kinematics.branch_count):
        rows = np.flatnonzero(wanted[:, 3] == branch)
        if rows.size:
            found = robot.kinematics.inverse_on_branch(base_from_flange[rows], branch, held[rows])
            joints[rows], exists[rows] = found.joints, found.exists
    joints = turns_within_limits(robot, joints)
    joints[:, COUNTED] += TURN * np.round((wanted[:, :3] - _quarters(joints[:, COUNTED])) / 4.0)
    undetermined = exists & (np.abs(joints[:, 4]) < UNDETERMINED_WRIST)
    joints[undetermined] = _share_out(
        joints[undetermined], wanted[undetermined], held[undetermined]
    )
    joints[~exists] = 0.0
    return Selected(joints, exists, _quarters(joints[:, COUNTED]) - wanted[:, :3])


def configurations(robot: Robot, base_from_flange: Transform) -> tuple[Configuration, ...]:
    """Every way to reach one pose within the joint limits: all branches, all whole turns.

    Joint vectors where branches meet are listed once. Where axis 5 is 0 the sum of axes 4 and 6 can
    be shared out in endless ways; only those with axis 4 at whole half turns are listed.
    """
    branches = robot.kinematics.inverse(base_from_flange)
    vectors = [
        turned
        for joints in _distinct(branches.joints[branches.exists])
        for turned in product(*map(_turns, joints, robot.lower, robot.upper))
    ]
    if not vectors:
        return ()
    found = np.array(vectors)
    named = confdata_of(robot.kinematics, found)
    return tuple(
        Configuration(joints, _four(confdata))
        for joints, confdata in zip(found, named, strict=True)
    )


def _distinct(joints: Array) -> list[Array]:
    """Joint vectors (k, 6) [rad] without those that an earlier one is but for whole turns."""
    difference = joints[:, None] - joints
    difference -= TURN * np.round(difference / TURN)
    alike = np.max(np.abs(difference), axis=-1, initial=0.0) < SAME
    first = np.argmax(alike, axis=-1) if len(joints) else []
    return [row for index, row in enumerate(joints) if first[index] == index]


def _quarters(angles: Array) -> Integers:
    return np.floor((angles + SNAP) / QUARTER).astype(np.int64)


def _turns(angle: float, lower: float, upper: float) -> tuple[float, ...]:
    """The angle in every whole turn that lies within a range [rad], from below; one if endless."""
    if isinf(lower) or isinf(upper):
        return (float(angle),)
    first = ceil((lower - LIMIT_TOLERANCE - angle) / TURN)
    last = floor((upper + LIMIT_TOLERANCE - angle) / TURN)
    return tuple(float(angle) + TURN * turn for turn in range(first, last + 1))


def _share_out(joints: Array, wanted: Integers, near: Array) -> Array:
    """Share out the sum of axes 4 and 6 (axis 5 is 0) so that each comes into its quarter turn.

    Args:
        joints: Joint vectors (k, 6) [rad].
        wanted: cf1, cf4, cf6, cfx of each, shape (k, 4).
        near: Joint vectors (k, 6) [rad]; axis 4 comes as near to theirs as the quarters allow.
    """
    lower_4, lower_6 = QUARTER * wanted[:, 1], QUARTER * wanted[:, 2]
    within = QUARTER - 2.0 * SNAP
    total = joints[:, 3] + joints[:, 5]
    middle = lower_4 + lower_6 + QUARTER
    total = total + TURN * np.round((middle - total) / TURN)
    lowest = np.maximum(lower_4, total - lower_6 - within)
    highest = np.minimum(lower_4 + within, total - lower_6)
    # Quarters that no split of this sum can meet keep axis 4; `quarters_off` tells.
    feasible = lowest <= highest
    shared = joints.copy()
    axis_4 = np.clip(near[:, 3], lowest, np.maximum(lowest, highest))
    shared[:, 3] = np.where(feasible, axis_4, joints[:, 3])
    shared[:, 5] = np.where(feasible, total - axis_4, joints[:, 5])
    return shared


def _four(confdata: Integers) -> tuple[int, int, int, int]:
    cf1, cf4, cf6, cfx = (int(value) for value in confdata)
    return cf1, cf4, cf6, cfx
