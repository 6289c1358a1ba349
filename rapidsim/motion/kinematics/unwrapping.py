"""Whole turns of joints: a pose tells angles, the way to it tells how often they went round."""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.kinematics.arm import Mask

TURN = 2.0 * np.pi
HALF_TURN = np.pi


def principal(joints: Array) -> Array:
    """Joint vectors (..., n) [rad], each joint in its principal turn -180..180 deg."""
    return joints - TURN * np.round(joints / TURN)


def in_turn_of(joints: Array, exists: Mask, near: Array) -> Array:
    """Joint vectors (k, n) [rad], each joint in the whole turn that is nearest.

    Args:
        joints: Shape (k, n) [rad].
        exists: Shape (k,): rows that are joints at all; the others come out as 0.
        near: Shape (k, n) [rad], a row for each, or (n,), which stands before the first row.
    """
    turned = np.zeros_like(joints)
    if near.ndim == 1:
        # Rows out of reach have no joints; what follows them is near to what came before.
        row = np.concatenate([near[None], joints[exists]])
        turned[exists] = np.unwrap(row, axis=0)[1:]
    else:
        # What the other rows hold may be anything.
        found = joints[exists]
        turned[exists] = found + TURN * np.round((near[exists] - found) / TURN)
    return turned


def turned_towards(before: float, angle: float) -> float:
    """An angle [rad] in the whole turn that is nearest to another; half a turn stays as it is."""
    away = angle - before
    if -HALF_TURN < away < HALF_TURN:
        return angle
    short = (away + HALF_TURN) % TURN - HALF_TURN
    if short == -HALF_TURN and away > 0.0:
        short = HALF_TURN
    return angle + (short - away)
