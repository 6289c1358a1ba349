"""Belts over time, as robots follow them."""

import math

import numpy as np
import pytest

from rapidsim.motion.geometry.belts import CATCH_UP_S, BeltCourse


def test_a_belt_that_changes_its_speed_is_followed_smoothly() -> None:
    course = BeltCourse("CNV1", 0.2)
    course.change(1.0, 0.2)
    assert course.speeds == ((0.0, 0.0, 0.2),)
    course.change(1.0, 0.0)
    course.change(1.1, 0.3)
    course.change(3.0, 0.1)
    assert [row[0] for row in course.speeds] == [0.0, 1.0, 1.1, 3.0]
    assert [row[1] for row in course.speeds] == pytest.approx([0.0, 0.2, 0.2, 0.77])
    assert [row[2] for row in course.speeds] == [0.2, 0.0, 0.3, 0.1]
    assert course.belt_at(0.5) == pytest.approx(0.1)
    assert course.belt_at(1.05) == pytest.approx(0.2)
    assert course.belt_at(4.0) == pytest.approx(0.87)
    for travel in (0.05, 0.19, 0.3, 0.9):
        assert course.belt_at(course.time_at(travel)) == pytest.approx(travel)
    assert BeltCourse("", 0.0).time_at(1.0) == math.inf
    # Robots move with the belt once they have caught up.
    settled = np.array([0.0, 0.5, 1.1 + CATCH_UP_S, 2.0, 3.0 + CATCH_UP_S, 9.0])
    wanted = [course.belt_at(float(at)) for at in settled]
    assert course.at(settled) == pytest.approx(wanted, abs=1e-12)
    # Place, speed and acceleration have no jump where the belt has one.
    step = 1e-4
    for change_s in (1.0, 1.1, 1.1 + CATCH_UP_S, 3.0):
        t = change_s + step * np.arange(-4.0, 5.0)
        speed = np.diff(course.at(t)) / step
        acceleration = np.diff(speed) / step
        assert np.ptp(speed) < 20.0 * step
        assert np.ptp(acceleration) < 0.2
    t = np.linspace(0.0, 4.0, 401)
    assert np.abs(course.at(t) - [course.belt_at(float(at)) for at in t]).max() < 0.03
