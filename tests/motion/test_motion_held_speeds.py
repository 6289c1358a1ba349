"""A command that keeps the held speeds keeps the largest speeds where it is smoothed, too."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rapidsim.frames.transform import Array
from rapidsim.motion.timing.smoothed_speed_limits import held_speeds

WINDOW_S = 0.08
PLACES = np.linspace(0.0, 0.6, 1201)
EVERYWHERE = np.ones(len(PLACES), dtype=bool)


def smoothed(held: Array) -> tuple[Array, Array]:
    """Places (k,) [m] and speeds (k,) [m/s] of the arm behind a command as fast as it may be."""
    steps = np.diff(PLACES) * 2.0 / (held[1:] + held[:-1])
    at = np.concatenate([[0.0], np.cumsum(steps)])
    times = np.arange(0.0, at[-1], 1e-4)
    place = np.interp(times, at, PLACES)
    width = round(WINDOW_S / 1e-4)
    mean = np.convolve(place, np.ones(width) / width, mode="valid")
    return mean, (place[width - 1 :] - place[: len(mean)]) / ((width - 1) * 1e-4)


@given(knots=st.lists(st.floats(0.05, 1.0), min_size=2, max_size=9))
def test_the_smoothed_motion_keeps_the_largest_speeds(knots: list[float]) -> None:
    speeds = np.interp(PLACES, np.linspace(0.0, 0.6, len(knots)), knots)
    held = held_speeds(PLACES, speeds, EVERYWHERE, WINDOW_S)
    assert (held <= speeds).all()
    place, speed = smoothed(held)
    assert (speed <= np.interp(place, PLACES, speeds) * 1.01).all()


def test_a_dip_is_held_as_long_as_the_window_and_no_longer() -> None:
    speeds = np.where(np.abs(PLACES - 0.3) < 0.005, 0.1, 1.0)
    held = held_speeds(PLACES, speeds, EVERYWHERE, WINDOW_S)
    slow = PLACES[held < 0.2]
    # At the full speed of 1 m/s half the window is 40 mm to either side.
    assert slow[0] == pytest.approx(0.3 - 0.045, abs=0.005)
    assert slow[-1] == pytest.approx(0.3 + 0.045, abs=0.005)


def test_an_even_rise_costs_nothing() -> None:
    speeds = 0.2 + 0.5 * PLACES
    assert held_speeds(PLACES, speeds, EVERYWHERE, WINDOW_S) == pytest.approx(speeds, rel=1e-3)
