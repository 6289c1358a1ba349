"""Limits of an arm that follows a belt, from samples of its motion: how much of them it uses."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.kinematics.arm import Kinematics
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.timing.axis_limits import Limits
from rapidsim.motion.trajectory.samples import Samples

_LIMIT = 1e-6
_OUT_OF_REACH = "the object on the belt is out of its reach"


def limit_shares(
    samples: Samples, kinematics: Kinematics, limits: Limits, load: Array, allowed: Array
) -> tuple[Array, Array]:
    """Return the largest shares of axis speeds (k,), and of accelerations or torques (k,).

    Args:
        samples: At least three, at equal intervals of a few milliseconds.
        kinematics: The arm.
        limits: Of its joints and external axes.
        load: Load (k,) at the wrist, as a share of the rated payload.
        allowed: Share (k,) of the accelerations and torques that may be used.
    """
    step_s = float(samples.times[1] - samples.times[0])
    joints = np.concatenate([samples.joints, samples.external], axis=1)
    ahead = np.pad(np.diff(joints, axis=0), ((1, 1), (0, 0)))
    rates, changes = (ahead[1:] + ahead[:-1]) / (2.0 * step_s), np.diff(ahead, axis=0) / step_s**2
    used = np.abs(changes) / limits.max_acceleration
    for arm in limits.arms:
        stance = kinematics.stance(samples.joints)
        used[:, arm.axes] = np.abs(arm.shares(stance, rates, changes, load))
    # The first and the last sample have one neighbour only.
    used[[0, -1]], rates[[0, -1]] = 0.0, 0.0
    near = np.maximum(np.maximum(allowed, np.roll(allowed, 1)), np.roll(allowed, -1))
    return (np.abs(rates) / limits.max_speed).max(axis=1), used.max(axis=1) / near


def reasons_lost(samples: Samples, robot: Robot) -> Mapping[int, str]:
    """Return the samples in which the arm cannot be where a belt takes it, with the reasons."""
    if samples.lost is None:
        return {}
    beyond = np.maximum(robot.lower - samples.joints, samples.joints - robot.upper)
    reasons = {}
    for at in np.flatnonzero(samples.lost | (beyond.max(axis=1) > _LIMIT)).tolist():
        axis = int(beyond[at].argmax())
        over = robot.axes.text(axis, float(beyond[at, axis]))
        past = f"axis {axis + 1} is {over} past its limit"
        reasons[at] = _OUT_OF_REACH if samples.lost[at] else past
    return reasons
