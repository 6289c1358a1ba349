"""Compliance of joints with a stored configuration: the only module that decides it.

A configuration is met if cfx is equal and cf1, cf4 and cf6 each differ by at most one quarter turn.
Source: RobotStudio API, `ConfigurationMode.Compliant`; docs/configurations.md has the evidence.
"""

from __future__ import annotations

from enum import IntEnum

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.confdata import (
    BORDER,
    Integers,
    counted_axes,
    counted_quarters,
    quarters_of,
    select,
)
from rapidsim.motion.configurations.reachability import pose_excess, pose_tolerance
from rapidsim.motion.kinematics.arm import Kinematics, Mask
from rapidsim.motion.kinematics.unwrapping import TURN
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import value_class

TOLERATED_QUARTERS = 1
"""Quarter turns by which each of cf1, cf4 and cf6 may differ."""
_SHIFTS = TURN * np.array([0.0, -1.0, 1.0])


class Match(IntEnum):
    """Degree to which joints match a stored configuration."""

    EXACT = 0
    COMPLIANT = 1
    """cf1, cf4 or cf6 differ by one quarter turn."""
    TURNED = 2
    """cf1, cf4 or cf6 differ by two quarter turns or more."""
    OTHER = 3
    """cfx differs."""

    def meets(self, *, exact: bool) -> bool:
        """Whether the configuration is matched; `exact` tolerates no quarter turn."""
        return self is Match.EXACT or (self is Match.COMPLIANT and not exact)


@value_class(frozen=True, slots=True, eq=False)
class HeldConfigurations:
    """Joints that best match the configurations stored for a sequence of poses."""

    joints: Array
    """Shape (k, n) [rad]; 0 where the branch of cfx does not reach the pose."""
    match: Integers
    """Shape (k,): a `Match`; OTHER where the branch of cfx does not reach the pose."""
    excess: Array
    """Shape (k, n) [rad]: excess of the joints over their limits, see `pose_excess`."""

    @property
    def possible(self) -> Mask:
        """Shape (k,): whether the arm can take the joints."""
        possible: Mask = (self.match < Match.OTHER) & ~self.excess.any(axis=-1)
        return possible


def match(kinematics: Kinematics, joints: Array, confdata: Array | Integers) -> Integers:
    """Degree to which joint vectors (..., n) [rad] match confdata (..., 4): a `Match` (...).

    The border of a quarter turn belongs to both sides; otherwise rounding of a target would decide.
    """
    stored = np.asarray(confdata, dtype=np.float64)
    branch = kinematics.branch_of(np.asarray(joints)) == stored[..., 3]
    below = counted_quarters(kinematics, joints - BORDER)
    above = counted_quarters(kinematics, joints + BORDER)
    most = _quarters_off(below, above, stored[..., :3]).max(axis=-1)
    found: Integers = np.where(
        branch,
        np.select(
            [most <= 0, most <= TOLERATED_QUARTERS], [Match.EXACT, Match.COMPLIANT], Match.TURNED
        ),
        Match.OTHER,
    )
    return found


def hold(
    robot: Robot, base_from_flange: Transform, confdata: Array | Integers, near: Array
) -> HeldConfigurations:
    """Return joints of poses (k,) on the branch of cfx, closest to their stored configurations.

    Axes 1, 4 and 6 take the turn that is the fewest quarters off; of two turns that are equally far
    off, the one within the limits; then the one nearer to the previous joints. A turn outside the
    limits is kept: another would be a whole turn off.

    Args:
        robot: The arm.
        base_from_flange: Poses (k,).
        confdata: cf1, cf4, cf6, cfx of each, shape (k, 4).
        near: Previous joints (k, n) or (n,) [rad].
    """
    selected = select(robot, base_from_flange, confdata, near)
    joints, stored = selected.joints, np.asarray(confdata, dtype=np.float64)
    before = np.broadcast_to(np.asarray(near, dtype=np.float64), joints.shape)
    for column, axis in enumerate(counted_axes(robot.kinematics)):
        if axis is not None:
            turns = joints[:, axis, None] + _SHIFTS
            best = _best_turn(robot, turns, before[:, axis], stored[:, column], axis)
            joints[:, axis] = turns[np.arange(len(turns)), best]
    found = np.where(selected.exists, match(robot.kinematics, joints, stored), Match.OTHER)
    return HeldConfigurations(joints, found, pose_excess(robot, joints))


def _best_turn(robot: Robot, angles: Array, near: Array, stored: Array, axis: int) -> Integers:
    """Index (k,) of the best of an axis's angles (k, t) [rad]; see `hold`."""
    below, above = quarters_of(angles - BORDER), quarters_of(angles + BORDER)
    off = _quarters_off(below, above, stored[:, None])
    tolerance = pose_tolerance(robot)[axis]
    past = (angles < robot.lower[axis] - tolerance) | (angles > robot.upper[axis] + tolerance)
    away = np.abs(angles - near[:, None]).round(9)
    best: Integers = np.lexsort((away, past, off), axis=-1)[:, 0]
    return best


def _quarters_off(below: Integers, above: Integers, stored: Array) -> Array:
    """Quarter turns (...) between stored ones and the range `below` to `above`."""
    off: Array = np.maximum(np.maximum(below - stored, stored - above), 0)
    return off
