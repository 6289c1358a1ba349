"""Timing of paths: limits kept, no time lost, against closed forms and an independent solver."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples
from motion_programs import LIMITS, MODEL, ROBOT, Programmer, path_of, path_or_fault, programs, zone

from rapidsim.frames.transform import Transform
from rapidsim.motion.geometry.segments import Speed
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.path.path import Path
from rapidsim.motion.robot.robot import RobotError
from rapidsim.motion.timing.active_constraints import limiters_of_segments
from rapidsim.motion.timing.axis_limits import limits_of
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.timing.smallest_line import sweep
from rapidsim.motion.timing.time_scaling import TimeScaling

PARABOLA = MotionModel(corner="parabola", parabola_acceleration=1.0, filter_time=0.0)
RAPID = Speed(7.0, math.radians(5000.0))


def excess(path: Path, timing: TimeScaling) -> tuple[float, float]:
    """Largest joint speed and acceleration over their limits, by differences over 1 ms."""
    dt = 1e-3
    t = np.arange(-2 * dt, timing.duration + 2 * dt, dt)
    joints = path.evaluate(timing.s_at(t)).joints
    speed = np.diff(joints, axis=0) / dt
    acceleration = np.diff(speed, axis=0) / dt
    return (
        float((np.abs(speed) / LIMITS.max_speed).max()),
        float((np.abs(acceleration) / LIMITS.max_acceleration).max()),
    )


def trapezoid(way: float, speed: float, acceleration: float) -> float:
    """Shortest time from rest to rest."""
    if way < speed**2 / acceleration:
        return 2.0 * math.sqrt(way / acceleration)
    return way / speed + speed / acceleration


@pytest.mark.parametrize("way", [1e-4, 0.01, 0.2, 1.0, 2.5])
def test_a_joint_move_takes_a_trapezoid(way: float) -> None:
    program = Programmer(speed=RAPID).move((way, 0.1 * way, 0, 0, 0, 0))
    timing = plan(path_of(program), LIMITS)
    expected = trapezoid(way, LIMITS.max_speed[0], LIMITS.max_acceleration[0])
    assert timing.duration == pytest.approx(expected, rel=1e-4)


def test_a_long_line_takes_its_length_by_its_speed_and_two_ramps() -> None:
    program = Programmer(speed=Speed(0.1, math.radians(500))).line((0.3, 0.0, 0.0))
    path = path_of(program)
    timing = plan(path, LIMITS)
    assert timing.duration == pytest.approx(3.0, rel=0.01)
    assert timing.speed_at(1.5) == pytest.approx(0.1, rel=1e-6)
    assert str(limiters_of_segments(path, timing)[0]) == "TCP speed"


def test_every_stop_is_a_standstill() -> None:
    program = Programmer().line((0.1, 0, 0), z=zone(10)).line((0, 0.1, 0)).line((0.1, 0, 0))
    path = path_of(program)
    timing = plan(path, LIMITS)
    at = timing.time_at(np.array([0.0, *path.stops, path.length]))
    assert len(at) == 3
    assert timing.speed_at(at) == pytest.approx([0.0, 0.0, 0.0], abs=1e-6)
    assert timing.speed[0] == timing.speed[-1] == 0.0


@examples(30)
@given(
    program=programs(),
    model=st.sampled_from([MODEL, PARABOLA]),
    speed=st.sampled_from([0.1, 0.5, 7.0]),
)
def test_limits_are_kept(program: Programmer, model: MotionModel, speed: float) -> None:
    segments = [
        replace(segment, speed=Speed(speed, math.radians(500.0))) for segment in program.segments
    ]
    path = path_or_fault(segments, model)
    if isinstance(path, PathFault):
        return
    timing = plan(path, LIMITS)
    assert math.isfinite(timing.duration)
    over_speed, over_acceleration = excess(path, timing)
    assert over_speed < 1.001
    assert over_acceleration < 1.01
    t = np.linspace(0.0, timing.duration, 3001)
    points = path.evaluate(timing.s_at(t))
    assert (points.tcp_rate * timing.speed_at(t)).max() < speed * 1.001


@examples(20)
@given(program=programs())
def test_the_way_back_takes_as_long(program: Programmer) -> None:
    segments = [replace(segment, zone=zone(5)) for segment in program.segments]
    back = [
        replace(segment, start=segment.end, end=segment.start) for segment in reversed(segments)
    ]
    there_path, back_path = path_or_fault(segments), path_or_fault(back)
    if isinstance(there_path, PathFault) or isinstance(back_path, PathFault):
        return
    there, again = plan(there_path, LIMITS), plan(back_path, LIMITS)
    assert again.duration == pytest.approx(there.duration, rel=2e-3)


@examples(20)
@given(program=programs(), share=st.floats(0.3, 0.95))
def test_stronger_axes_are_never_slower(program: Programmer, share: float) -> None:
    path = path_or_fault(program)
    if isinstance(path, PathFault):
        return
    weak = replace(LIMITS, max_acceleration=share * LIMITS.max_acceleration)
    assert plan(path, LIMITS).duration <= plan(path, weak).duration * 1.001


@pytest.mark.parametrize(("angle", "millimetres"), [(30.0, 100.0), (90.0, 50.0)])
def test_a_wide_corner_keeps_most_of_its_speed(angle: float, millimetres: float) -> None:
    a = math.radians(angle)
    program = Programmer().line((0.2, 0, 0), z=zone(millimetres))
    program.line((0.2 * math.cos(a), 0.2 * math.sin(a), 0))
    path = path_of(program)
    timing = plan(path, LIMITS)
    s = np.linspace(0.2 - millimetres / 1e3, 0.2 + millimetres / 1e3, 501)
    speed = path.evaluate(s).tcp_rate * timing.speed_at(timing.time_at(s))
    assert speed.min() > 0.85 * 0.5


@pytest.mark.parametrize("model", [MODEL, PARABOLA])
def test_a_reversal_takes_finite_time(model: MotionModel) -> None:
    program = Programmer().line((0.2, 0, 0), z=zone(10)).line((-0.2, 0, 0))
    path = path_of(program, model)
    timing = plan(path, LIMITS)
    assert 0.8 < timing.duration < 2.0
    assert excess(path, timing)[1] < 1.01


@pytest.mark.parametrize("length", [0.0, 1e-9, 1e-7, 1e-4])
def test_tiny_moves_neither_fail_nor_take_long(length: float) -> None:
    program = Programmer().line((0.1, 0, 0), z=zone(10)).line((length, 0, 0), z=zone(10))
    program.line((0, length, 0), z=zone(1)).line((0, 0.1, 0), z=zone(10)).line((0, 0, 0))
    path = path_of(program)
    timing = plan(path, LIMITS)
    assert np.isfinite(timing.times).all()
    assert 0.4 < timing.duration < 1.5
    assert len(limiters_of_segments(path, timing)) == 5


def test_moves_without_length_take_no_time() -> None:
    timing = plan(path_of(Programmer().line().line()), LIMITS)
    assert timing.duration == 0.0
    assert timing.s_at(np.array([0.0, 1.0])) == pytest.approx([0.0, 0.0])
    assert timing.time_at(0.0) == 0.0


def test_speed_changes_at_the_middle_of_the_corner() -> None:
    slow = Speed(0.1, math.radians(500))
    program = Programmer().line((0.2, 0, 0), z=zone(50)).line((0.2, 0, 0), speed=slow)
    path = path_of(program)
    timing = plan(path, LIMITS)
    speed = timing.speed_at(timing.time_at(np.array([0.1, 0.2, 0.25])))
    assert speed[0] == pytest.approx(0.5, rel=1e-3)
    assert speed[1:] == pytest.approx([0.1, 0.1], rel=1e-3)


@pytest.mark.parametrize("seconds", [0.9, 2.0, 10.0])
def test_a_programmed_time_is_kept(seconds: float) -> None:
    program = Programmer().line((0.2, 0, 0), z=zone(10)).line((0, 0.2, 0), z=zone(10))
    program.segments[1] = replace(program.segments[1], duration=seconds)
    path = path_of(program.line((0, 0, 0.1)))
    timing = plan(path, LIMITS)
    start, end = timing.time_at(path.segment_starts[1:])
    assert end - start == pytest.approx(seconds, rel=0.01)
    assert str(limiters_of_segments(path, timing)[1]) == "programmed time"


def test_programmed_times_of_neighbours_are_all_kept() -> None:
    program = Programmer()
    for seconds in (0.6, 0.4, 1.0, 0.5):
        program.line((0.1, 0, 0), z=zone(10), duration=seconds)
    path = path_of(program)
    timing = plan(path, LIMITS)
    ends = np.append(path.segment_starts, path.length)
    assert np.diff(timing.time_at(ends)) == pytest.approx([0.6, 0.4, 1.0, 0.5], rel=0.01)


def test_a_time_too_short_is_driven_as_fast_as_possible() -> None:
    hasty = plan(path_of(Programmer().line((0.3, 0, 0), duration=0.01)), LIMITS)
    fastest = plan(path_of(Programmer(speed=RAPID).line((0.3, 0, 0))), LIMITS)
    assert hasty.duration == pytest.approx(fastest.duration, rel=1e-3)


def test_less_acceleration_takes_longer_ramps() -> None:
    full = plan(path_of(Programmer(speed=RAPID).move((0.01, 0, 0, 0, 0, 0))), LIMITS)
    half = plan(
        path_of(Programmer(speed=RAPID).move((0.01, 0, 0, 0, 0, 0), acceleration_share=0.5)),
        LIMITS,
    )
    assert half.duration == pytest.approx(full.duration * math.sqrt(2.0), rel=1e-6)


@examples(20)
@given(program=programs(), share=st.floats(0.05, 0.95), snap=st.booleans())
def test_a_start_on_the_way_goes_on_as_planned(
    program: Programmer, share: float, snap: bool
) -> None:
    path = path_or_fault(program)
    if isinstance(path, PathFault):
        return
    whole = plan(path, LIMITS)
    cut = share * path.length
    if snap:
        cut = float(path.segment_starts[int(share * len(path.segments))])
    time = whole.time_at(cut)
    rest = plan(path, LIMITS, start=cut, start_speed=whole.speed_at(time))
    assert rest.s[0] == cut
    assert rest.duration == pytest.approx(whole.duration - time, rel=2e-3, abs=5e-4)
    assert rest.start_excess <= 0.01 * whole.speed.max()
    s = np.linspace(cut, path.length, 50)
    assert rest.time_at(s) + time == pytest.approx(whole.time_at(s), rel=2e-3, abs=1e-3)


def test_a_start_too_fast_to_brake_says_so() -> None:
    path = path_of(Programmer(speed=RAPID).line((0.3, 0, 0)))
    timing = plan(path, LIMITS, start=0.29, start_speed=2.0)
    assert timing.start_excess > 1.0
    assert timing.speed[0] == 2.0
    assert timing.duration > 0.0


@pytest.mark.parametrize(("degrees", "shortest", "longest"), [(0.05, 3.2, 5.0), (2.0, 3.0, 3.4)])
def test_passing_close_to_the_wrist_singularity_keeps_the_limits(
    degrees: float, shortest: float, longest: float
) -> None:
    # Half way, axis 5 is at its smallest and axis 4 swings round.
    nearest = np.radians([0.0, -10.0, 20.0, 90.0, degrees, 0.0])
    flange = ROBOT.kinematics.forward(nearest)
    down = np.linspace(0.0, -0.15, 4001)[:, None] * np.array([0.0, 0.0, 1.0])
    way_down = Transform(np.tile(flange.rotation, (4001, 1, 1)), flange.translation + down)
    start = ROBOT.kinematics.inverse_on_branch(way_down, 0, nearest).joints[-1]
    program = Programmer(
        joints=start, tool=Transform.identity(), speed=Speed(0.1, math.radians(500.0))
    )
    path = path_of(program.line((0.0, 0.0, 0.3)))
    timing = plan(path, LIMITS)
    assert shortest < timing.duration < longest
    over_speed, over_acceleration = excess(path, timing)
    assert over_speed < 1.02
    assert over_acceleration < 1.02


@examples(10)
@given(seed=st.integers(0, 2**32 - 1))
def test_lanes_give_what_one_row_gives(seed: int) -> None:
    random = np.random.default_rng(seed)
    count = 3000
    slopes = random.uniform(0.9, 1.1, (count, 4))
    offsets = random.uniform(0.0, 0.05, (count, 4))
    caps = random.uniform(0.5, 1.0, count + 1)
    caps[random.integers(0, count, 5)] = 0.0
    whole = sweep(0.3, slopes, offsets, caps)
    parts = [0.3]
    for begin in range(0, count, 500):
        part = slice(begin, begin + 500)
        parts.extend(sweep(parts[-1], slopes[part], offsets[part], caps[begin : begin + 501])[1:])
    assert np.array_equal(whole, np.array(parts))


def test_limits_come_from_the_robot_and_the_model() -> None:
    limits = limits_of(ROBOT, replace(MODEL, own_accelerations=False))
    assert limits.max_acceleration == pytest.approx(limits.max_speed / 0.16)
    given_model = replace(MODEL, acceleration=(1.0, 2.0, 3.0, 4.0, 5.0, 6.0))
    assert limits_of(ROBOT, given_model).max_acceleration == pytest.approx([1, 2, 3, 4, 5, 6])
    with pytest.raises(RobotError, match="6 axes, but 1 accelerations"):
        limits_of(ROBOT, replace(MODEL, acceleration=(1.0,)))
    nameless = replace(ROBOT, joints=(replace(ROBOT.joints[0], max_speed=None),))
    with pytest.raises(RobotError, match="no axis speed is known for joint_1"):
        limits_of(nameless, MODEL)


@examples(15)
@given(program=programs(), share=st.floats(0.2, 0.9))
def test_slower_programs_are_never_quicker(program: Programmer, share: float) -> None:
    path = path_or_fault(program)
    slower = [
        replace(s, speed=Speed(share * s.speed.tcp, share * s.speed.reorientation))
        for s in program.segments
    ]
    slow_path = path_or_fault(slower)
    if isinstance(path, PathFault) or isinstance(slow_path, PathFault):
        return
    assert plan(path, LIMITS).duration <= plan(slow_path, LIMITS).duration * 1.001


@pytest.mark.parametrize("speed", [0.5, 2.0])
def test_larger_zones_are_never_slower(speed: float) -> None:
    durations = []
    for millimetres in (1.0, 5.0, 10.0, 30.0, 80.0):
        program = Programmer(speed=Speed(speed, math.radians(500.0)))
        for way in ((0.2, 0, 0), (0, 0.2, 0), (-0.2, 0, 0), (0, 0, 0.2)):
            program.line(way, z=zone(millimetres))
        durations.append(plan(path_of(program), LIMITS).duration)
    assert all(b <= a * 1.005 for a, b in pairwise(durations))
