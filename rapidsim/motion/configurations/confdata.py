"""ABB's confdata, which selects one of the many joint vectors of a pose.

cf1, cf4 and cf6 are the quarter turns that axes 1, 4 and 6 are in: 0 from 0 to 90 deg, -1 from -90
to 0, and so on through all turns. cfx is the branch of inverse kinematics. Together they identify
one joint vector, except where axis 5 is 0 and only the sum of axes 4 and 6 matters.

Source: Technical reference manual RAPID Instructions, Functions and Data types, confdata, for
robots with a serial wrist. For other kinds of arm cfx is the branch of their own solver; YuMi's
digits, which represent its arm angle, are not modelled.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product
from math import ceil, floor, isinf, pi

import numpy as np
import numpy.typing as npt

from rapidsim.frames import rigid
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.reachability import (
    limit_tolerance,
    pose_tolerance,
    turns_within_limits,
)
from rapidsim.motion.kinematics.arm import Kinematics, Mask
from rapidsim.motion.kinematics.numerical.solver import Numerical
from rapidsim.motion.kinematics.unwrapping import TURN
from rapidsim.motion.kinematics.unwrapping import whole_turns as nearest_turns
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import value_class

Integers = npt.NDArray[np.int64]

QUARTER = pi / 2.0
SNAP = 2e-8
"""Distance [rad] below a quarter turn up to which a joint counts as on it (a computed 90 deg)."""
BORDER = pi / 1800.0
"""Distance [rad] from the border of a quarter turn within which an axis is on both sides."""
UNDETERMINED_WRIST = 1e-7
"""Largest angle [rad] of axis 5 at which confdata may redistribute the sum of axes 4 and 6."""
NO_CONFIGURATION = 1_000_000
"""Number of quarter turns that no arm has; larger numbers and NaN are replaced by it."""
SAME = 1e-9
"""Difference [rad] below which joint vectors of two branches are the same solution."""


@value_class(frozen=True, slots=True, eq=False)
class Configuration:
    """A joint vector of a pose, with its confdata."""

    joints: Array
    """Shape (n,) [rad]."""
    confdata: tuple[int, int, int, int]
    """cf1, cf4, cf6, cfx."""


@value_class(frozen=True, slots=True, eq=False)
class SelectedConfigurations:
    """Joint vectors that confdata selects for a sequence of poses."""

    joints: Array
    """Shape (k, n) [rad]; 0 where the branch does not reach the pose. Limits are ignored."""
    exists: Mask
    """Shape (k,): False where the branch does not reach the pose or cfx is not 0 to 7."""
    quarters_off: Integers
    """Shape (k, 3): number of quarter turns between axes 1, 4 and 6 and their confdata."""


def has_branches(kinematics: Kinematics) -> bool:
    """Whether confdata distinguishes an arm's solutions, which it does if they have branches."""
    return not isinstance(kinematics, Numerical)


def confdata_of(kinematics: Kinematics, joints: Array) -> Integers:
    """Return cf1, cf4, cf6 and cfx, shape (..., 4), of joint vectors (..., n) [rad]."""
    joints = np.asarray(joints, dtype=np.float64)
    branch = kinematics.branch_of(joints)
    if joints.ndim == 1:
        counted = [0 if a is None else joints.item(a) for a in counted_axes(kinematics)]
        return np.array([*(floor((angle + SNAP) / QUARTER) for angle in counted), int(branch)])
    return np.concatenate([counted_quarters(kinematics, joints), branch[..., None]], axis=-1)


def configuration(kinematics: Kinematics, joints: Array) -> Configuration:
    """Return a joint vector (n,) [rad] with its confdata."""
    return Configuration(joints, _four(confdata_of(kinematics, joints)))


def select(
    robot: Robot, base_from_flange: Transform, confdata: Array | Integers, near: Array
) -> SelectedConfigurations:
    """Return the joint vectors of poses with confdata.

    Args:
        robot: The arm.
        base_from_flange: Poses (k,).
        confdata: cf1, cf4, cf6, cfx of each, shape (k, 4).
        near: Joint vectors (k, n) or (n,) [rad]: axes that the pose does not determine stay as
            close to them as confdata allows.

    Returns:
        Axes 1, 4 and 6 in the turn closest to confdata, the others in the turn closest to their
        range.
    """
    asked = np.asarray(confdata, dtype=np.float64)
    asked = np.where(np.abs(asked) < NO_CONFIGURATION, asked, NO_CONFIGURATION)
    wanted = np.rint(asked).astype(np.int64)
    joints = np.zeros((len(wanted), robot.kinematics.joint_count))
    held = np.broadcast_to(np.asarray(near, dtype=np.float64), joints.shape).copy()
    # A pose that does not determine axis 1 allows it the requested quarter turn.
    lowest = QUARTER * wanted[:, 0]
    held[:, 0] = np.clip(held[:, 0], lowest, lowest + QUARTER - 2.0 * SNAP)
    exists = np.zeros(len(wanted), dtype=np.bool_)
    for branch in range(robot.kinematics.branch_count):
        rows = np.flatnonzero(wanted[:, 3] == branch)
        if rows.size:
            found = robot.kinematics.inverse_on_branch(base_from_flange[rows], branch, held[rows])
            joints[rows], exists[rows] = found.joints, found.exists
    joints = turns_within_limits(robot, joints)
    turns = np.round((wanted[:, :3] - counted_quarters(robot.kinematics, joints)) / 4.0)
    for column, axis in enumerate(counted_axes(robot.kinematics)):
        if axis is not None:
            joints[:, axis] += TURN * turns[:, column]
    if robot.kinematics.spherical_wrist:
        undetermined = exists & (np.abs(joints[:, 4]) < UNDETERMINED_WRIST)
        joints[undetermined] = _distribute(
            joints[undetermined], wanted[undetermined], held[undetermined]
        )
    joints[~exists] = 0.0
    return SelectedConfigurations(
        joints, exists, counted_quarters(robot.kinematics, joints) - wanted[:, :3]
    )


def configurations(robot: Robot, base_from_flange: Transform) -> tuple[Configuration, ...]:
    """Return all joint vectors for one pose within the joint limits: all branches, all whole turns.

    If there are none, joint vectors that exceed a limit by no more than the rounding of poses in
    programs are returned. Joint vectors where branches meet are listed once. Where axis 5 is 0 the
    sum of axes 4 and 6 can be split in infinitely many combinations; only those with axis 4 at
    multiples of a half turn are listed.
    """
    branches = robot.kinematics.inverse(base_from_flange)
    unturned = distinct(branches.joints[branches.exists], robot.kinematics.turns)
    vectors = [turned for joints in unturned for turned in within_limits(robot, joints)]
    if not vectors:
        tolerance = pose_tolerance(robot)
        vectors = [
            turned for joints in unturned for turned in within_limits(robot, joints, tolerance)
        ]
    if not vectors:
        return ()
    found = np.array(vectors)
    named = confdata_of(robot.kinematics, found)
    return tuple(
        Configuration(joints, _four(confdata))
        for joints, confdata in zip(found, named, strict=True)
    )


def named(
    robot: Robot,
    base_from_flange: Transform,
    confdata: tuple[int, int, int, int],
    tolerated: int = 0,
) -> Configuration | None:
    """Return the element of `configurations` that confdata selects, without computing the others.

    None if no element matches, or if all of them are needed to decide: for arms without closed
    formulas for one pose, and where the pose does not determine an axis.

    Args:
        robot: The arm.
        base_from_flange: One pose.
        confdata: cf1, cf4, cf6, cfx.
        tolerated: Quarter turns by which each of the first three may be off, 0 or 1.
    """
    arm, branch = robot.kinematics, confdata[3]
    if branch not in range(arm.branch_count):
        return None
    found = arm.single.inverse_on_branch(rigid.from_transform(base_from_flange), branch, None)
    if found is None:
        return None
    quarters = dict(zip(counted_axes(arm), confdata, strict=False))
    joints, off = [], 0
    for axis, turns in enumerate(_turns_of_each(robot, found, limit_tolerance(robot))):
        quarter = quarters.get(axis)
        for turned in turns:
            away = 0 if quarter is None else abs(quarter - floor((turned + SNAP) / QUARTER))
            if away <= tolerated:
                joints.append(turned)
                off += away
                break
        else:
            return None
    # On a border of branches confdata has the front branch, the positive one.
    if arm.single.branch_of(joints) != branch:
        return None
    if not off:
        return Configuration(np.array(joints), confdata)
    if arm.spherical_wrist and abs(joints[4]) < UNDETERMINED_WRIST:
        # Axes 4 and 6 share their sum: another split may match the stored one.
        return None
    return configuration(arm, np.array(joints))


def within_limits(
    robot: Robot, joints: Array, tolerance: Array | None = None
) -> Iterator[tuple[float, ...]]:
    """Return a joint vector (n,) [rad] in all turns within the limits plus a tolerance."""
    tolerance = limit_tolerance(robot) if tolerance is None else tolerance
    return product(*_turns_of_each(robot, joints.tolist(), tolerance))


def distinct(joints: Array, turns: Array) -> list[Array]:
    """Return joint vectors (k, n) [rad] that differ from all earlier ones, up to turns (n,)."""
    difference = joints[:, None] - joints
    difference -= nearest_turns(difference, turns)
    alike = np.max(np.abs(difference), axis=-1, initial=0.0) < SAME
    first: list[int] = np.argmax(alike, axis=-1).tolist() if len(joints) else []
    return [row for index, row in enumerate(joints) if first[index] == index]


def counted_axes(kinematics: Kinematics) -> tuple[int | None, ...]:
    """Joints, counted from 0, that are RAPID's axes 1, 4 and 6; None for an axis the arm lacks.

    Palletizers have no axis 4, SCARAs no axis 6; the last joint of five-axis arms is their roll.
    """
    axes = kinematics.rapid_axes
    axis_4 = axes.index(3) if 3 in axes else None
    last = len(axes) - 1
    return 0, axis_4, None if last == axis_4 else last


def counted_quarters(kinematics: Kinematics, joints: Array) -> Integers:
    """Quarter turns (..., 3) of axes 1, 4 and 6 in joint vectors (..., n) [rad]."""
    axes = counted_axes(kinematics)
    columns = [
        np.zeros(joints.shape[:-1], np.int64) if axis is None else quarters_of(joints[..., axis])
        for axis in axes
    ]
    return np.stack(columns, axis=-1)


def quarters_of(angles: Array) -> Integers:
    """Quarter turns (...) of angles (...) [rad]."""
    return np.floor((angles + SNAP) / QUARTER).astype(np.int64)


def _turns_of_each(
    robot: Robot, joints: Sequence[float], tolerance: Array
) -> Iterator[tuple[float, ...]]:
    """Each joint [rad] of a vector in the whole turns that lie within its limits, in rising order.

    A joint with an infinite limit has only its own value.
    """
    turns, tolerances = robot.kinematics.turns.tolist(), tolerance.tolist()
    for value, limits, turn, rounded in zip(joints, robot.joints, turns, tolerances, strict=True):
        if isinf(limits.lower) or isinf(limits.upper):
            yield (value,)
            continue
        first = ceil((limits.lower - rounded - value) / turn)
        last = floor((limits.upper + rounded - value) / turn)
        yield tuple(value + turn * number for number in range(first, last + 1))


def _distribute(joints: Array, wanted: Integers, near: Array) -> Array:
    """Split the sum of axes 4 and 6 (axis 5 is 0) so that each is in its quarter turn.

    Args:
        joints: Joint vectors (k, 6) [rad].
        wanted: cf1, cf4, cf6, cfx of each, shape (k, 4).
        near: Joint vectors (k, 6) [rad]; axis 4 is as near to theirs as the quarters allow.
    """
    lower_4, lower_6 = QUARTER * wanted[:, 1], QUARTER * wanted[:, 2]
    within = QUARTER - 2.0 * SNAP
    total = joints[:, 3] + joints[:, 5]
    middle = lower_4 + lower_6 + QUARTER
    total = total + TURN * np.round((middle - total) / TURN)
    lowest = np.maximum(lower_4, total - lower_6 - within)
    highest = np.minimum(lower_4 + within, total - lower_6)
    # If no split of this sum is in both quarters, axis 4 keeps its value; see `quarters_off`.
    feasible = lowest <= highest
    shared = joints.copy()
    axis_4 = np.clip(near[:, 3], lowest, np.maximum(lowest, highest))
    shared[:, 3] = np.where(feasible, axis_4, joints[:, 3])
    shared[:, 5] = np.where(feasible, total - axis_4, joints[:, 5])
    return shared


def _four(confdata: Integers) -> tuple[int, int, int, int]:
    cf1, cf4, cf6, cfx = (int(value) for value in confdata)
    return cf1, cf4, cf6, cfx
