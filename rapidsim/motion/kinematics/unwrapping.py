"""Unwrapping of joints: a pose determines angles, the path to it determines whole turns.

A sliding joint has no turns: its turn is `ENDLESS`, so nothing is ever added to it.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array

TURN = 2.0 * np.pi
HALF_TURN = np.pi
ENDLESS = 1e300
"""Turn of a sliding joint: finite, so that zero turns are 0 and not NaN, and longer than any
displacement, so that zero turns are always nearest."""


def whole_turns(arc_length: Array, turn: float | Array = TURN) -> Array:
    """Return the multiples of a whole turn [rad] closest to joint displacements (..., n) [rad].

    Args:
        arc_length: Displacement between two values of a joint.
        turn: Turn of all joints, or of each (n,): see `Kinematics.turns`.
    """
    return turn * np.round(arc_length / turn)


def turning(steps: Array, turn: Array) -> Array:
    """Return steps (..., n) [rad] of joints, 0 for sliding ones, which are smooth on all poses.

    Args:
        steps: Differences of successive joint vectors.
        turn: Turn of each joint (n,): see `Kinematics.turns`.
    """
    return np.where(turn == ENDLESS, 0.0, steps)


def principal(joints: Array, turn: float | Array = TURN) -> Array:
    """Return joint vectors (..., n) [rad], each joint in its principal turn -180..180 deg."""
    return joints - whole_turns(joints, turn)


def in_turn_of(
    joints: Array, exists: npt.NDArray[np.bool_], near: Array, turn: float | Array = TURN
) -> Array:
    """Return joint vectors (k, n) [rad], each joint in the closest whole turn.

    Args:
        joints: Shape (k, n) [rad].
        exists: Shape (k,): rows with valid joints; the others are returned as 0.
        near: Shape (k, n) [rad], a row for each, or (n,), which precedes the first row.
        turn: Turn of all joints, or of each (n,): see `Kinematics.turns`.
    """
    turned = np.zeros_like(joints)
    if near.ndim == 1:
        # Unreachable rows have no joints; the row after them is unwrapped against the row before.
        row = np.concatenate([near[None], joints[exists]])
        turned[exists] = _unwrapped(row, turn)[1:]
    else:
        # The other rows may contain anything.
        found = joints[exists]
        turned[exists] = found + whole_turns(near[exists] - found, turn)
    return turned


def _unwrapped(row: Array, turn: float | Array) -> Array:
    """Return a row (k, n) [rad] without steps above half a turn; sliding joints are unchanged."""
    unwrapped: Array = np.unwrap(row, axis=0)
    return unwrapped if isinstance(turn, float) else np.where(turn == ENDLESS, row, unwrapped)


def turned_towards(before: float, angle: float) -> float:
    """Return an angle [rad] in the whole turn closest to another; unchanged at half a turn."""
    away = angle - before
    if -HALF_TURN < away < HALF_TURN:
        return angle
    short = (away + HALF_TURN) % TURN - HALF_TURN
    if short == -HALF_TURN and away > 0.0:
        short = HALF_TURN
    return angle + (short - away)
