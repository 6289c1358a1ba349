"""How joints are compared with recorded ones."""

import numpy as np

from rapidsim.frames.transform import Array

TURN = 2.0 * np.pi


def turns_aside(difference: Array) -> Array:
    """Differences of angles [rad] without whole turns."""
    return difference - TURN * np.round(difference / TURN)


def assert_same_set(ours: Array, theirs: Array, tolerance: float) -> None:
    """Rows of joints (k, n) [rad] that are the same in any order, whole turns aside."""
    assert len(ours) == len(theirs)
    gap = np.abs(turns_aside(ours[:, None] - theirs)).max(axis=-1)
    assert gap.min(axis=0).max() < tolerance
    assert gap.min(axis=1).max() < tolerance
