"""Joints at places of parts of equal width: each is computed once."""

import math

import numpy as np
import pytest

from rapidsim.frames.transform import Array
from rapidsim.motion.trajectory.even_joints import PART_S, PLACES, EvenJoints


def test_places_are_those_of_gauss_with_three_points() -> None:
    places = [0.5 * (1.0 + x) for x in (-math.sqrt(0.6), 0.0, math.sqrt(0.6))]
    assert places == pytest.approx(PLACES.tolist())


def test_joints_are_computed_once_and_those_outside_each_time() -> None:
    asked: list[float] = []

    def joints_at(times: Array) -> Array:
        asked.extend(times.tolist())
        return np.stack([times, 2.0 * times], axis=1)

    even = EvenJoints(10.0 * PART_S)
    for parts, new in (([3, 4], 2), ([4, 3, 5], 1), ([-1, 3], 1), ([-1, 40], 2), ([5, 4], 0)):
        asked.clear()
        found = even.at(np.array(parts), joints_at)
        times = PART_S * (np.array(parts)[:, None] + PLACES)
        assert found == pytest.approx(np.stack([times, 2.0 * times], axis=-1))
        assert len(asked) == 3 * new
