"""Recorded numbers that our kinematics are compared with, where they lie beside the checkout."""

import json
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rapidsim.frames.transform import Array

GROUND_TRUTH = Path(__file__).parents[2].parent / "shared" / "reference" / "ground_truth.json"
TURN = 2.0 * np.pi


def recorded(chapter: str) -> dict[str, Any]:
    """A chapter of the recorded numbers; skips the test if they are not here."""
    if not GROUND_TRUTH.is_file():
        pytest.skip(f"{GROUND_TRUTH.name} is not beside this checkout")
    found: dict[str, Any] = _everything()[chapter]
    return found


def turns_aside(difference: Array) -> Array:
    """Differences of angles [rad] without whole turns."""
    return difference - TURN * np.round(difference / TURN)


def assert_same_set(ours: Array, theirs: Array, tolerance: float) -> None:
    """Rows of joints (k, n) [rad] that are the same in any order, whole turns aside."""
    assert len(ours) == len(theirs)
    gap = np.abs(turns_aside(ours[:, None] - theirs)).max(axis=-1)
    assert gap.min(axis=0).max() < tolerance
    assert gap.min(axis=1).max() < tolerance


@cache
def _everything() -> dict[str, Any]:
    loaded: dict[str, Any] = json.loads(GROUND_TRUTH.read_text(encoding="utf-8"))
    return loaded
