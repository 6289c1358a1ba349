"""First crossings: those that halving would find, in a few steps."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rapidsim.frames.transform import Array
from rapidsim.motion.trajectory.command import Index
from rapidsim.motion.trajectory.zero_crossings import first_crossing

zeros = st.lists(st.floats(0.001, 0.999), min_size=1, max_size=20)


@given(zeros, st.sampled_from([0.5, 1.0, 3.0, 7.0]), st.floats(0.0, 100.0))
def test_a_zero_is_found_however_steep_it_is(where: list[float], power: float, far: float) -> None:
    zero, asked = far + np.array(where), []

    def function(x: Array, row: Index) -> Array:
        asked.append(len(x))
        value: Array = np.sign(x - zero[row]) * np.abs(x - zero[row]) ** power
        return value

    begin = np.full(len(zero), far)
    found = first_crossing(function, begin, begin + 1.0)
    assert found == pytest.approx(zero, abs=1e-9 if power > 1.0 else 1e-13)
    assert (function(found, np.arange(len(zero))) >= 0.0).all()
    assert len(asked) < 80


def test_of_a_stretch_of_zeros_it_is_the_first() -> None:
    def stands(x: Array, _: Index) -> Array:
        value: Array = np.minimum(x - 0.3, 0.0)
        return value

    assert first_crossing(stands, np.zeros(1), np.ones(1)) == pytest.approx(0.3, abs=1e-15)


def test_what_is_passed_before_or_never_ends_the_search() -> None:
    def line(x: Array, row: Index) -> Array:
        value: Array = x + np.array([1.0, -9.0])[row]
        return value

    assert first_crossing(line, np.zeros(2), np.ones(2)).tolist() == [0.0, 1.0]
    nothing = np.zeros(0)
    assert first_crossing(line, nothing, nothing).shape == (0,)
