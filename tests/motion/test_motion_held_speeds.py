"""A command that keeps the held speeds keeps the largest speeds where it is smoothed, too."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from motion_programs import LIMITS, Programmer, path_of, zone

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.segments import Speed
from rapidsim.motion.model import MotionModel, Smoothing
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.timing.smoothed_speed_limits import (
    _decide_by_lines,
    deciding_points,
    held_speeds,
)
from rapidsim.motion.timing.smoothed_speed_loops import decide_by_lines

WINDOW_S = 0.08
PLACES = np.linspace(0.0, 0.6, 1201)
EVERYWHERE = np.ones(len(PLACES), dtype=bool)


def smoothed(held: Array, averages: int) -> tuple[Array, Array]:
    """Places (k,) [m] and speeds (k,) [m/s] of the arm behind a command as fast as it may be."""
    steps = np.diff(PLACES) * 2.0 / (held[1:] + held[:-1])
    at = np.concatenate([[0.0], np.cumsum(steps)])
    times = np.arange(0.0, at[-1], 1e-4)
    place = np.interp(times, at, PLACES)
    width = round(WINDOW_S / 1e-4 / averages)
    for _ in range(averages):
        place = np.convolve(place, np.ones(width) / width, mode="valid")
    return place, np.gradient(place, 1e-4)


@given(
    knots=st.lists(st.floats(0.05, 1.0), min_size=2, max_size=9), averages=st.sampled_from([1, 2])
)
def test_the_smoothed_motion_keeps_the_largest_speeds(knots: list[float], averages: int) -> None:
    speeds = np.interp(PLACES, np.linspace(0.0, 0.6, len(knots)), knots)
    held = held_speeds(PLACES, speeds, EVERYWHERE, WINDOW_S)
    assert (held <= speeds).all()
    place, speed = smoothed(held, averages)
    assert (speed <= np.interp(place, PLACES, speeds) * 1.01).all()


@given(knots=st.lists(st.floats(0.05, 1.0), min_size=2, max_size=9))
def test_the_deciding_point_is_slow_where_the_held_speed_is_low(knots: list[float]) -> None:
    speeds = np.interp(PLACES, np.linspace(0.0, 0.6, len(knots)), knots)
    held = held_speeds(PLACES, speeds, EVERYWHERE, WINDOW_S)
    deciding = deciding_points(PLACES, speeds, np.arange(len(PLACES)), WINDOW_S)
    # A line changes by its speed over the window at most, which is shifted by a twelfth of that.
    near_m = (0.5 + 1.0 / 12.0) * WINDOW_S * speeds[deciding] + 2.0 * PLACES[1]
    assert (np.abs(PLACES[deciding] - PLACES) <= near_m).all()
    assert (deciding[held >= speeds] == np.flatnonzero(held >= speeds)).all()
    assert (0.4 * speeds[deciding] <= held).all()


@given(
    knots=st.lists(st.floats(0.05, 1.0), min_size=2, max_size=9),
    wanted=st.sets(st.integers(0, len(PLACES) - 1), min_size=1, max_size=20),
)
def test_what_decides_at_a_point_depends_on_no_other_wanted_one(
    knots: list[float], wanted: set[int]
) -> None:
    speeds = np.interp(PLACES, np.linspace(0.0, 0.6, len(knots)), knots)
    some, everywhere = np.array(sorted(wanted)), np.arange(len(PLACES))
    deciding = deciding_points(PLACES, speeds, some, WINDOW_S)
    assert (deciding == deciding_points(PLACES, speeds, everywhere, WINDOW_S)[some]).all()


@given(knots=st.lists(st.floats(0.05, 1.0), min_size=2, max_size=9))
def test_the_loop_over_lines_decides_as_the_columns_do(knots: list[float]) -> None:
    speeds = np.interp(PLACES, np.linspace(0.0, 0.6, len(knots)), knots)
    found = []
    for decide in (decide_by_lines, _decide_by_lines):
        deciding, lowest = np.arange(20), np.full(20, 0.7)
        at, wanted = np.arange(1, 21), np.arange(100, 120)
        slopes, first = np.resize([1.0, -2.0, 0.5], 20), np.resize([0, 3, 5], 20)
        decide(deciding, lowest, PLACES, speeds, slopes, at, wanted, first, first + 9)
        found.append((deciding.tolist(), lowest.tolist()))
    assert found[0] == found[1]


def test_of_two_equal_dips_the_first_decides() -> None:
    speeds = np.ones(len(PLACES))
    dips = np.searchsorted(PLACES, [0.298, 0.302])
    speeds[dips] = 0.1
    between = np.arange(dips[0] + 1, dips[1])
    assert (deciding_points(PLACES, speeds, between, WINDOW_S) == dips[0]).all()
    speeds[dips[1]] = 0.099
    assert (deciding_points(PLACES, speeds, between, WINDOW_S) == dips[1]).all()


def test_a_dip_is_held_as_long_as_the_window_and_no_longer() -> None:
    speeds = np.where(np.abs(PLACES - 0.3) < 0.005, 0.1, 1.0)
    held = held_speeds(PLACES, speeds, EVERYWHERE, WINDOW_S)
    slow = PLACES[held < 0.2]
    # In half the window the command goes 4 mm at 0.1 m/s, from 5 mm beside the middle of the dip.
    assert slow[0] == pytest.approx(0.3 - 0.009, abs=0.001)
    assert slow[-1] == pytest.approx(0.3 + 0.009, abs=0.001)


def test_an_even_rise_costs_nothing() -> None:
    speeds = 0.2 + 0.5 * PLACES
    assert held_speeds(PLACES, speeds, EVERYWHERE, WINDOW_S) == pytest.approx(speeds, rel=1e-3)


@pytest.mark.parametrize("smoothing", ["axes", "path"])
def test_a_slow_move_behind_a_zone_costs_at_most_the_smoothing(smoothing: Smoothing) -> None:
    """The command is slow as far ahead as it goes at the low speed, not at the full one."""
    model = MotionModel(smoothing=smoothing)
    fast, slow = Speed(5.0, np.radians(500.0)), Speed(0.05, np.radians(500.0))
    alone = path_of(Programmer(speed=fast).line((0.0, 0.4, 0.0)), model)
    program = Programmer(speed=fast).line((0.0, 0.4, 0.0), z=zone(10))
    path = path_of(program.line((0.0, 0.0, -0.06), speed=slow), model)
    passed_s = plan(path, LIMITS).time_at(float(path.segment_starts[1]))
    stopped_s = plan(alone, LIMITS).duration
    assert stopped_s - model.window < passed_s < stopped_s + model.window
