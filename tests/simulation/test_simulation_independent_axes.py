"""Axes on their own time: they go where they are sent, no faster than asked, without a jump."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rapidsim.controller.independent_axes import IndependentAxisState

ACCELERATION = 100.0
STEP_S = 0.01

PLACES = st.floats(-400.0, 400.0)
SPEEDS = st.floats(1.0, 200.0)


@given(begin=PLACES, first=SPEEDS, target=PLACES, speed=SPEEDS, after_s=st.floats(0.0, 5.0))
def test_it_reaches_its_target_steadily_from_any_motion(
    begin: float, first: float, target: float, speed: float, after_s: float
) -> None:
    axis = IndependentAxisState(ACCELERATION)
    axis.take(begin, 0.0)
    axis.move_at(first, ACCELERATION, 0.0)
    assert not axis.is_at_target(after_s)
    before = axis.position(after_s), axis.speed(after_s)
    axis.move_to(target, speed, ACCELERATION, after_s)
    assert (axis.position(after_s), axis.speed(after_s)) == pytest.approx(before, abs=1e-6)
    now_s, seen = after_s, before
    while not axis.is_at_target(now_s):
        now_s += STEP_S
        there = axis.position(now_s), axis.speed(now_s)
        assert abs(there[0] - seen[0]) <= (max(speed, first) + 1.0) * STEP_S
        assert abs(there[1] - seen[1]) <= ACCELERATION * STEP_S + 1e-6
        # Within a step its acceleration may change its sign once, to one side at most.
        mean = 0.5 * (there[1] + seen[1])
        aside = 0.25 * ACCELERATION * STEP_S**2
        assert there[0] - seen[0] == pytest.approx(mean * STEP_S, abs=aside + 1e-6)
        seen = there
    assert seen == pytest.approx((target, 0.0), abs=1e-6)


def test_it_turns_on_and_on_until_it_is_stopped() -> None:
    axis = IndependentAxisState(ACCELERATION)
    axis.take(10.0, 1.0)
    axis.move_at(-50.0, ACCELERATION, 1.0)
    assert not axis.has_speed(1.2)
    assert axis.has_speed(1.5)
    assert axis.position(2.5) == pytest.approx(10.0 - 12.5 - 50.0)
    axis.move_at(0.0, ACCELERATION, 2.5)
    assert axis.speed(3.0) == 0.0
    assert axis.position(9.0) == pytest.approx(10.0 - 12.5 - 50.0 - 12.5)
