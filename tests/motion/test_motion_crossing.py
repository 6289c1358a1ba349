"""First crossings: those that halving would find, in a few steps."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rapidsim.frames.transform import Array
from rapidsim.motion.trajectory.command import Index
from rapidsim.motion.trajectory.zero_crossings import first_crossing, first_crossing_by_slope

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


LEVELS = st.integers(-20, 120).filter(bool).map(lambda percent: percent / 100.0)


@given(st.lists(LEVELS, min_size=1, max_size=20), st.integers(1, 4))
def test_slopes_find_the_same_quickly(levels: list[float], power: int) -> None:
    level, looks = np.array(levels), []

    def way(x: Array) -> tuple[Array, Array]:
        # From rest to rest, and before and after that at rest, as an arm.
        looks.append(len(x))
        share = np.clip(x, 0.0, 1.0)
        left = np.minimum(share, 1.0 - share)
        half = 2.0 ** (power - 1) * left**power
        rate = power * 2.0 ** (power - 1) * left ** (power - 1)
        return np.where(share < 0.5, half, 1.0 - half), np.where(share == x, rate, 0.0)

    ends = np.full(len(level), -0.5), np.full(len(level), 1.5)
    found = first_crossing_by_slope(way, level, *ends, within=1e-10)
    quick, inner = sum(looks), (level > 0.2) & (level < 0.8)
    slowly = first_crossing(lambda x, row: way(x)[0] - level[row], *ends, within=1e-10)
    assert found == pytest.approx(slowly, abs=2e-10)
    assert quick <= 6 * len(level) or not inner.all()
