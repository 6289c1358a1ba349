"""Stopping on the path: as hard as the axes can, on the path, from wherever the arm is."""

from __future__ import annotations

from dataclasses import replace
from unittest.mock import patch

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples
from motion_law import excess_of
from motion_programs import LIMITS, Programmer, path_of, path_or_fault, programs, zone

from rapidsim.motion.geometry.segments import Speed
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.timing import braking as braking_module
from rapidsim.motion.timing.braking import PATH_STOP_S, stop_at
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.trajectory.command import Piece
from rapidsim.motion.trajectory.trajectory import Trajectory


def test_a_joint_move_stops_within_its_braking_distance() -> None:
    path = path_of(Programmer(speed=Speed(7.0, 10.0)).move((1.5, 0, 0, 0, 0, 0)))
    timing = plan(path, LIMITS)
    time = 0.5 * timing.duration
    s, speed = timing.s_at(time), timing.speed_at(time)
    braking = stop_at(path, LIMITS, timing, time)
    per_metre = 1.5 / path.length
    axis_speed, axis_acceleration = speed * per_metre, LIMITS.max_acceleration[0]
    way = (float(braking.s[-1]) - s) * per_metre
    assert way == pytest.approx(axis_speed**2 / (2.0 * axis_acceleration), rel=1e-6)
    assert braking.duration == pytest.approx(axis_speed / axis_acceleration, rel=1e-6)


def test_an_arm_that_has_time_brakes_evenly() -> None:
    path = path_of(Programmer(speed=Speed(0.5, 10.0)).move((1.5, 0, 0, 0, 0, 0)))
    timing = plan(path, LIMITS)
    time = 0.3 * timing.duration
    s, speed = timing.s_at(time), timing.speed_at(time)
    braking = stop_at(path, LIMITS, timing, time, PATH_STOP_S)
    assert braking.duration == pytest.approx(PATH_STOP_S, rel=1e-6)
    assert float(braking.s[-1]) - s == pytest.approx(0.5 * speed * PATH_STOP_S, rel=1e-6)


@examples(40)
@given(
    program=programs(),
    share=st.floats(0.02, 0.98),
    speed=st.sampled_from([0.1, 0.5, 2.0]),
    in_s=st.sampled_from([0.0, PATH_STOP_S]),
)
def test_braking_keeps_the_accelerations_and_ends_before_the_plan(
    program: Programmer, share: float, speed: float, in_s: float
) -> None:
    segments = [
        replace(segment, speed=Speed(speed, np.radians(500.0)), zone=segment.zone or zone(3.0))
        for segment in program.segments
    ]
    path = path_or_fault(segments)
    if isinstance(path, PathFault):
        return
    timing = plan(path, LIMITS)
    time = share * timing.duration
    s = timing.s_at(time)
    braking = stop_at(path, LIMITS, timing, time, in_s)
    stands = float(braking.s[-1])
    assert s <= stands <= path.length
    assert braking.speed[-1] == 0.0
    if in_s:
        assert stands >= float(stop_at(path, LIMITS, timing, time).s[-1])
    else:
        assert braking.duration <= timing.duration - time + 1e-3
    trajectory = Trajectory(segments[0].start, 0.0)
    trajectory.append(Piece(0.0, path, timing, 0.0, s))
    trajectory.append(Piece(trajectory.command_end, path, braking, s, stands))
    # Where the plan is at a limit, its speed may be a per cent too fast for other nodes.
    assert excess_of(trajectory, LIMITS).axis_acceleration < 1.05


@examples(40)
@given(
    program=programs(),
    share=st.floats(0.02, 0.98),
    in_s=st.sampled_from([0.0, PATH_STOP_S]),
)
def test_what_lies_far_away_says_nothing_about_braking(
    program: Programmer, share: float, in_s: float
) -> None:
    slow = Speed(0.05, np.radians(20.0))
    path = path_or_fault([replace(one, speed=slow) for one in program.segments])
    if isinstance(path, PathFault):
        return
    timing = plan(path, LIMITS)
    time = share * timing.duration
    near = stop_at(path, LIMITS, timing, time, in_s)
    with patch.multiple(braking_module, _BEFORE_S=np.inf, _AFTER_S=np.inf):
        whole = stop_at(path, LIMITS, timing, time, in_s)
    assert near.s[-1] - near.s[0] == pytest.approx(whole.s[-1] - whole.s[0], rel=1e-3, abs=1e-9)
    assert near.duration == pytest.approx(whole.duration, rel=1e-3, abs=1e-9)
