"""Position on a path over time: each query against numerical integration of the speed."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from rapidsim.frames.transform import Array
from rapidsim.motion.timing.time_scaling import TimeScaling

FINE_S = 1e-4


def scaling(seed: int) -> TimeScaling:
    """A motion of some seconds that does not begin at 0, nor from rest."""
    random = np.random.default_rng(seed)
    s = 0.7 + np.concatenate([[0.0], np.cumsum(random.uniform(0.02, 0.3, 12))])
    return TimeScaling(s, np.append(random.uniform(0.2, 0.6, 12), 0.0), 0.0)


SCALINGS = [scaling(seed) for seed in (1, 2)]
each = pytest.mark.parametrize("motion", SCALINGS)


def place(motion: TimeScaling, times: Array) -> Array:
    """Positions (k,) [m]: with the first speed before the motion, at rest after it."""
    found: Array = motion.s_at(times) + motion.speed[0] * np.minimum(times, 0.0)
    return found


def integral(motion: TimeScaling, begin: float, end: float) -> float:
    """Integral of s - s[0] [m s], numerically."""
    t = np.linspace(begin, end, 2 + int((end - begin) / FINE_S))
    return float(np.trapezoid(place(motion, t) - motion.s[0], t))


@each
def test_position_is_the_integral_of_a_speed_that_is_linear_between_nodes(
    motion: TimeScaling,
) -> None:
    times = motion.times
    assert motion.s_at(times) == pytest.approx(motion.s, abs=1e-12)
    assert motion.speed_at(times) == pytest.approx(motion.speed, abs=1e-12)
    for a, b in pairwise(times):
        t = np.linspace(a, b, 9)
        assert motion.speed_at(t) == pytest.approx(np.interp(t, times, motion.speed), abs=1e-12)
    t = np.linspace(0.0, motion.duration, 50_000)
    speed = motion.speed_at(t)
    gone = np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(t))])
    assert np.abs(motion.s_at(t) - motion.s[0] - gone).max() < 1e-7
    assert motion.acceleration == pytest.approx(np.diff(motion.speed) / np.diff(times))


@each
def test_the_time_at_a_place_is_when_it_is_there(motion: TimeScaling) -> None:
    t = np.linspace(0.0, motion.duration, 301)
    assert motion.time_at(motion.s_at(t)) == pytest.approx(t, abs=1e-6)
    assert motion.time_at(float(motion.s[3])) == pytest.approx(motion.times[3])
    # Elsewhere it rests.
    assert motion.time_at(motion.s[0] - 1.0) == 0.0
    assert motion.time_at(motion.s[-1] + 1.0) == pytest.approx(motion.duration)
    assert motion.s_at(-1.0) == motion.s[0]
    assert motion.s_at(motion.duration + 1.0) == motion.s[-1]
    assert motion.speed_at(motion.duration + 1.0) == pytest.approx(0.0, abs=1e-12)


@each
def test_integrals_are_those_of_the_distance(motion: TimeScaling) -> None:
    times = np.array([0.3, 1.1, motion.duration])
    wanted = [integral(motion, 0.0, end) for end in times]
    assert motion.parameter_integral(times) == pytest.approx(wanted, abs=1e-7)
    assert motion.integrals == pytest.approx(motion.parameter_integral(motion.times), abs=1e-12)


@each
def test_a_mean_over_a_window_knows_what_was_before_and_what_comes_after(
    motion: TimeScaling,
) -> None:
    window = 0.25
    end = motion.duration
    times = np.array([0.1, 0.6, end - 0.01, end + 0.1, end + 0.3])
    mean, speed = motion.smoothed(window, times)
    wanted = [motion.s[0] + integral(motion, t - window, t) / window for t in times]
    assert mean == pytest.approx(wanted, abs=1e-7)
    old, now = place(motion, times - window), place(motion, times)
    assert speed == pytest.approx((now - old) / window)
    at_nodes = motion.smoothed(window)
    for one, other in zip(at_nodes, motion.smoothed(window, motion.times), strict=True):
        assert one == pytest.approx(other, abs=1e-12)


@each
def test_sums_restart_every_second(motion: TimeScaling) -> None:
    times, marks = motion.times, motion.marks.tolist()
    seconds = np.floor(times[:-1]).tolist()
    assert marks == [k for k, at in enumerate(seconds) if k == 0 or at != seconds[k - 1]]
    way, once, twice = motion.since_marks
    for first, last in pairwise([*marks, len(times) - 1]):
        for k in range(first, last):
            assert way[k] == pytest.approx(motion.s[k] - motion.s[first])
            t = np.linspace(times[first], times[k], 20_001)
            gone = motion.s_at(t) - motion.s[first]
            parts = 0.5 * (gone[1:] + gone[:-1]) * np.diff(t)
            sums = np.concatenate([[0.0], np.cumsum(parts)])
            assert once[k] == pytest.approx(sums[-1], abs=1e-8)
            assert twice[k] == pytest.approx(float(np.trapezoid(sums, t)), abs=1e-8)
    assert motion.since_marks[:, -1].tolist() == [0.0, 0.0, 0.0]


def test_braking_begins_where_the_speed_last_rises() -> None:
    s = np.array([0.5, 0.6, 0.8, 1.0, 1.1])
    motion = TimeScaling(s, np.array([0.2, 0.1, 0.4, 0.2, 0.0]), 0.0)
    assert motion.braking_s == pytest.approx(0.2 / 0.3 + 0.1 / 0.1)
    only = TimeScaling(s, np.array([0.5, 0.4, 0.3, 0.2, 0.0]), 0.0)
    assert only.braking_s == only.duration


def test_a_rest_within_the_motion_takes_its_time() -> None:
    s, speed = np.array([0.0, 0.1, 0.1, 0.3]), np.array([0.2, 0.0, 0.0, 0.4])
    motion = TimeScaling(s, speed, 0.0, standing=np.array([0.0, 0.5, 0.0]))
    assert motion.times == pytest.approx([0.0, 1.0, 1.5, 2.5])
    assert motion.s_at(np.array([1.1, 1.4])) == pytest.approx([0.1, 0.1])
    assert motion.speed_at(1.25) == 0.0
    assert motion.speed_at(2.0) == pytest.approx(0.2)
