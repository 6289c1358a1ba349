"""Trajectories: the command in pieces, smoothed without leaving the path."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples
from motion_programs import (
    LIMITS,
    ROBOT,
    TOOL,
    Programmer,
    path_of,
    path_or_fault,
    programs,
    zone,
)

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.segments import Speed, Waypoint
from rapidsim.motion.model import Averages, BlendShape, MotionModel
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.path.path import Path
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.timing.time_scaling import TimeScaling
from rapidsim.motion.trajectory.command import Index, MotionCommand, Piece
from rapidsim.motion.trajectory.guided_section import GuidedSection
from rapidsim.motion.trajectory.trajectory import Trajectory

FILTER = 0.08


def square() -> Programmer:
    """Four sides of 100 mm with small zones, back to where it began."""
    program = Programmer().line((0.1, 0, 0), z=zone(10)).line((0, 0.1, 0), z=zone(5))
    return program.line((-0.1, 0, 0), z=zone(10)).line((0, -0.1, 0))


PROGRAM = square()
START = PROGRAM.segments[0].start
PATH = path_of(PROGRAM)
TIMING = plan(PATH, LIMITS)


def whole(start_time: float, path: Path = PATH, timing: TimeScaling = TIMING) -> Piece:
    return Piece(start_time, path, timing, 0.0, path.length)


def run(*pauses: float, filter_time: float = FILTER) -> Trajectory:
    """The square once after each pause [s]."""
    trajectory = Trajectory(START, filter_time)
    for pause in pauses:
        trajectory.append(whole(trajectory.command_end + pause))
    return trajectory


def mean_command(trajectory: Trajectory, time: float) -> float:
    """The mean over the filter's width, by brute force."""
    raw = Trajectory(START, 0.0)
    for piece in trajectory.pieces:
        raw.append(piece)
    t = np.linspace(time - FILTER, time, 20001)
    return float(np.trapezoid(raw.place_at(t), t)) / FILTER


def test_without_pieces_the_arm_stands_at_its_start() -> None:
    start = replace(START, external=np.array([0.3, 0.4, 0.5]))
    trajectory = Trajectory(start, FILTER)
    samples = trajectory.at(np.array([0.0, 1.0]))
    assert samples.joints == pytest.approx(np.tile(START.joints, (2, 1)))
    assert samples.external == pytest.approx(np.tile([0.3, 0.4, 0.5], (2, 1)))
    pose = samples.base_from_tcp
    assert pose.rotation == pytest.approx(np.tile(START.base_from_tcp.rotation, (2, 1, 1)))
    assert pose.translation == pytest.approx(np.tile(START.base_from_tcp.translation, (2, 1)))
    assert samples.tcp_speed == pytest.approx([0.0, 0.0])
    assert samples.move.tolist() == [0, 0]
    assert trajectory.duration == trajectory.length == trajectory.travelled_m == 0.0
    assert trajectory.time_at_place(0.0) == pytest.approx(0.0, abs=1e-12)


@examples(30)
@given(
    pauses=st.lists(st.floats(0.0, 0.3), min_size=1, max_size=3),
    share=st.floats(0.0, 1.0),
)
def test_the_visible_place_is_the_mean_of_the_commanded(pauses: list[float], share: float) -> None:
    trajectory = run(*pauses)
    time = share * trajectory.duration
    place = float(trajectory.place_at(np.array([time]))[0])
    assert place == pytest.approx(mean_command(trajectory, time), abs=1e-8)


@examples(40)
@given(
    program=programs(),
    corner=st.sampled_from(["c2", "parabola"]),
    speed=st.sampled_from([0.1, 0.5, 1.5]),
)
def test_smoothing_keeps_programmed_and_axis_speeds(
    program: Programmer, corner: BlendShape, speed: float
) -> None:
    segments = [
        replace(segment, speed=Speed(speed, np.radians(500.0))) for segment in program.segments
    ]
    path = path_or_fault(segments, MotionModel(corner=corner, filter_time=FILTER))
    if isinstance(path, PathFault):
        return
    trajectory = Trajectory(segments[0].start, FILTER)
    trajectory.append(whole(0.0, path, plan(path, LIMITS)))
    samples = trajectory.at(np.arange(0.0, trajectory.duration, 1e-3))
    assert samples.tcp_speed.max(initial=0.0) < speed * 1.005
    rates = np.abs(np.diff(samples.joints, axis=0)) / 1e-3
    assert (rates / LIMITS.max_speed).max(initial=0.0) < 1.005


def test_smoothing_keeps_the_path() -> None:
    trajectory = run(0.5)
    samples = trajectory.at(np.linspace(0.0, 3.0, 4001))
    tcp = (ROBOT.kinematics.forward(samples.joints) @ TOOL).translation
    assert np.abs(tcp - samples.base_from_tcp.translation).max() < 1e-9
    s = trajectory.place_at(samples.times)
    assert np.abs(PATH.evaluate(s).joints - samples.joints).max() < 1e-12
    before_first_zone = s < 0.09
    straight = samples.base_from_tcp.translation[before_first_zone, 1:]
    assert np.abs(straight - START.base_from_tcp.translation[1:]).max() < 1e-9


def test_smoothing_adds_its_width_to_the_time_and_lags_half_of_it() -> None:
    program = Programmer().line((0.3, 0, 0))
    path = path_of(program)
    timing = plan(path, LIMITS)
    trajectory = Trajectory(program.segments[0].start, FILTER)
    trajectory.append(whole(1.0, path, timing))
    assert trajectory.command_end == pytest.approx(1.0 + timing.duration)
    assert trajectory.duration == pytest.approx(1.0 + timing.duration + FILTER)
    middle = timing.time_at(0.15)
    assert trajectory.time_at_place(0.15) == pytest.approx(1.0 + middle + FILTER / 2, abs=1e-4)
    last = trajectory.at(np.array([trajectory.duration, trajectory.duration + 9.0]))
    assert last.joints == pytest.approx(np.tile(program.joints, (2, 1)), abs=1e-9)
    assert last.tcp_speed == pytest.approx([0.0, 0.0], abs=1e-9)


def test_without_smoothing_the_arm_is_where_the_command_is() -> None:
    trajectory = run(0.25, filter_time=0.0)
    times = np.linspace(0.25, 0.25 + TIMING.duration, 101)
    assert trajectory.place_at(times) == pytest.approx(TIMING.s_at(times - 0.25), abs=1e-12)
    assert trajectory.time_at_place(PATH.length) == pytest.approx(trajectory.duration)


@examples(25)
@given(cuts=st.lists(st.floats(0.0, 1.0), min_size=1, max_size=12), pause=st.floats(0.0, 0.2))
def test_cutting_a_command_into_pieces_changes_nothing(cuts: list[float], pause: float) -> None:
    at_once = run(pause)
    in_pieces = Trajectory(START, FILTER)
    places = np.array([0.0, *sorted(cuts), 1.0]) * PATH.length
    for begin, end in pairwise(places):
        in_pieces.append(
            Piece(pause + TIMING.time_at(float(begin)), PATH, TIMING, float(begin), float(end))
        )
    times = np.linspace(-0.1, at_once.duration + 0.1, 301)
    a, b = at_once.at(times), in_pieces.at(times)
    assert np.abs(a.joints - b.joints).max() < 1e-9
    assert a.tcp_speed == pytest.approx(b.tcp_speed, abs=1e-6)


def test_planning_again_on_a_longer_path_goes_on_without_a_jump() -> None:
    program = square()
    known = path_of(program.segments[:2])
    first = plan(known, LIMITS)
    cut = float(known.segment_starts[1])
    trajectory = Trajectory(START, 0.0)
    time = first.time_at(cut)
    trajectory.append(Piece(0.0, known, first, 0.0, cut))
    rest = plan(PATH, LIMITS, start=cut, start_speed=first.speed_at(time))
    assert rest.start_excess < 0.01 * 0.5
    trajectory.append(Piece(time, PATH, rest, cut, PATH.length))
    times = np.arange(0.0, trajectory.duration, 1e-3)
    joints = trajectory.at(times).joints
    acceleration = np.diff(joints, n=2, axis=0) / 1e-6
    assert (np.abs(acceleration) / LIMITS.max_acceleration).max() < 1.01
    assert trajectory.duration == pytest.approx(TIMING.duration, rel=1e-3)


def test_moves_are_counted_by_the_middle_of_their_corners() -> None:
    trajectory = run(0.2)
    starts = np.array([trajectory.time_at_place(float(s)) for s in PATH.segment_starts[1:]])
    assert trajectory.at(starts - 1e-6).move.tolist() == [0, 1, 2]
    assert trajectory.at(starts + 1e-6).move.tolist() == [1, 2, 3]
    assert trajectory.at(np.array([0.0, 99.0])).move.tolist() == [0, 3]


def test_standing_between_two_blocks_the_last_move_counts() -> None:
    second = Programmer(joints=PROGRAM.joints).line((0.1, 0, 0)).segments[0]
    later = Waypoint(second.start.joints, second.start.base_from_tcp)
    path = path_of([replace(second, start=later)])
    trajectory = run(0.0)
    later_piece = whole(trajectory.command_end + 1.0, path, plan(path, LIMITS))
    trajectory.append(replace(later_piece, first=4))
    still = trajectory.command_end - plan(path, LIMITS).duration - 0.5
    samples = trajectory.at(np.array([still, trajectory.duration]))
    assert samples.move.tolist() == [3, 4]
    assert samples.tcp_speed[0] == pytest.approx(0.0, abs=1e-9)


def test_speed_is_that_of_the_tcp() -> None:
    trajectory = run(0.1, 0.1)
    times = np.arange(0.0, trajectory.duration, 5e-4)
    samples = trajectory.at(times)
    steps = np.linalg.norm(np.diff(samples.base_from_tcp.translation, axis=0), axis=1) / 5e-4
    mean: Array = 0.5 * (samples.tcp_speed[1:] + samples.tcp_speed[:-1])
    assert steps == pytest.approx(mean, abs=2e-3)
    assert samples.tcp_speed.max() <= 0.5 * 1.001


@examples(25)
@given(share=st.floats(0.0, 1.0), pauses=st.lists(st.floats(0.0, 0.2), min_size=1, max_size=3))
def test_the_time_at_a_place_is_when_the_arm_is_there(share: float, pauses: list[float]) -> None:
    trajectory = run(*pauses)
    place = share * trajectory.length
    time = trajectory.time_at_place(place)
    assert 0.0 <= time <= trajectory.duration + 1e-9
    assert float(trajectory.place_at(np.array([time]))[0]) == pytest.approx(place, abs=1e-9)


def test_travel_is_shorter_than_the_programmed_path() -> None:
    trajectory = run(0.0, 0.1)
    samples = trajectory.at(np.linspace(0.0, trajectory.duration, 8001))
    steps = np.diff(samples.base_from_tcp.translation, axis=0)
    assert trajectory.travelled_m == pytest.approx(np.linalg.norm(steps, axis=1).sum(), rel=1e-4)
    assert trajectory.travelled_m < trajectory.length == pytest.approx(0.8)


def test_many_pieces_give_the_same_as_few() -> None:
    trajectory = Trajectory(START, FILTER)
    for _ in range(400):
        trajectory.append(whole(trajectory.command_end + 0.105))
    few = run(0.105)
    late = trajectory.command_end - TIMING.duration - 0.105
    # At first the end of the run before is still to be seen.
    times = np.linspace(FILTER, few.duration, 50)
    assert np.abs(trajectory.at(times + late).joints - few.at(times).joints).max() < 1e-9


def test_pieces_without_length_change_nothing_and_cost_no_steps(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    plain, crowded = run(0.01, 0.01), Trajectory(START, FILTER)
    for _ in range(2):
        crowded.append(whole(crowded.command_end + 0.01))
        for _ in range(300):
            crowded.append(Piece(crowded.command_end, PATH, TIMING, PATH.length, PATH.length))
    asked: list[int] = []
    state = MotionCommand.state

    def counted(command: MotionCommand, row: Index, times: Array) -> Array:
        asked.append(len(times))
        return state(command, row, times)

    monkeypatch.setattr(MotionCommand, "state", counted)
    times, steps = np.linspace(0.0, plain.duration, 400), []
    for one in (plain, crowded):
        asked.clear()
        one.place_at(times)
        steps.append(len(asked))
    assert steps[0] == steps[1]
    assert np.abs(crowded.place_at(times) - plain.place_at(times)).max() < 1e-12
    assert np.abs(crowded.speed_at(times) - plain.speed_at(times)).max() < 1e-9
    assert np.abs(crowded.at(times).joints - plain.at(times).joints).max() < 1e-9


def test_pieces_come_in_the_order_of_time() -> None:
    trajectory = run(0.5)
    with pytest.raises(ValueError, match="before the last ends"):
        trajectory.append(whole(0.0))
    with pytest.raises(ValueError, match="runs backwards"):
        trajectory.append(Piece(10.0, PATH, TIMING, 0.2, 0.1))


def test_travel_between_marks_is_the_way_of_the_tcp() -> None:
    trajectory = run(0.3, 0.2)
    ends = trajectory.mark(0.0), trajectory.mark(trajectory.duration)
    assert trajectory.travelled_between(*ends) == pytest.approx(trajectory.travelled_m)
    instants = [0.0, 0.45, 0.46, 0.9, 1.6, trajectory.duration]
    marks = [trajectory.mark(at) for at in instants]
    for first, last in pairwise(marks):
        times = np.linspace(first.time_s, last.time_s, 20_001)
        tcp = trajectory.at(times).base_from_tcp.translation
        way = float(np.linalg.norm(np.diff(tcp, axis=0), axis=1).sum())
        assert trajectory.travelled_between(first, last) == pytest.approx(way, abs=1e-6)
    assert trajectory.travelled_between(marks[3], marks[2]) == 0.0
    assert Trajectory(START).mark(2.0) == (2.0, 0.0)


def test_directions_are_those_of_the_motion() -> None:
    trajectory = run(0.1)
    times = np.linspace(0.15, trajectory.duration - 0.05, 40)
    step = 1e-6
    tcp = [trajectory.at(times + sign * step).base_from_tcp.translation for sign in (-1.0, 1.0)]
    way = tcp[1] - tcp[0]
    unit = way / np.linalg.norm(way, axis=1, keepdims=True)
    assert trajectory.directions(times) == pytest.approx(unit, abs=1e-4)
    # At rest: that of the path which begins, or has ended there.
    rest = trajectory.directions(np.array([0.0, trajectory.duration + 1.0]))
    assert rest == pytest.approx(np.array([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0]]), abs=1e-9)
    assert not Trajectory(START).directions(times).any()
    turn = path_of(Programmer().line((0.0, 0.0, 0.0), (0.0, 0.4, 0.0)))
    only = Trajectory(START)
    only.append(whole(0.0, turn, plan(turn, LIMITS)))
    assert not only.directions(np.array([0.1, 0.2])).any()


@pytest.mark.parametrize("averages", [1, 2])
def test_smoothed_by_axes_the_arm_is_off_its_path_by_what_lies_between(averages: Averages) -> None:
    by_axes, on_path = (
        Trajectory(START, FILTER, smoothing, averages) for smoothing in ("axes", "path")
    )
    for one in (by_axes, on_path):
        one.append(whole(0.0))
        assert not one.off_path(Trajectory(START).at(np.zeros(1))).any() or one is by_axes
    times = np.linspace(0.0, by_axes.duration, 60)
    samples, other = by_axes.at(times), on_path.at(times)
    between = samples.base_from_tcp.translation - other.base_from_tcp.translation
    off = by_axes.off_path(samples)
    assert off == pytest.approx(np.linalg.norm(between, axis=1), abs=1e-9)
    assert off.max() > 1e-4
    assert not on_path.off_path(other).any()
    assert not Trajectory(START, FILTER, "axes").off_path(other).any()
    quick = by_axes.postures(times)
    assert quick.joints == pytest.approx(samples.joints, abs=1e-6)
    assert np.array_equal(quick.move, samples.move)
    assert quick.external.shape == samples.external.shape == (60, 0)


def guided(start_s: float, joints: Array, cycles: int) -> GuidedSection:
    """Axis 1 is guided at 0.2 rad/s from rest, in cycles of 4 ms."""
    section = GuidedSection(
        start_s, 0.004, ROBOT.kinematics.forward, TOOL.inverse(), np.zeros(0), joints
    )
    speed = np.zeros(6)
    for cycle in range(1, cycles + 1):
        faster = np.array([min(0.2, 0.02 * cycle), 0, 0, 0, 0, 0])
        joints = joints + 0.5 * 0.004 * (speed + faster)
        speed = faster
        section.append(joints, speed)
    return section


def test_a_guided_section_holds_until_the_next_move() -> None:
    trajectory = run(0.0, filter_time=0.0)
    end_s = trajectory.duration
    section = guided(end_s + 0.5, PROGRAM.joints, 100)
    trajectory.guide(section)
    assert trajectory.guided == (section,)
    assert trajectory.duration == pytest.approx(end_s + 0.9)
    times = end_s + np.array([0.4, 0.7, 0.9, 5.0])
    samples = trajectory.at(times)
    turned = samples.joints[:, 0] - PROGRAM.joints[0]
    assert turned == pytest.approx([0.0, 0.036, 0.076, 0.076], abs=1e-9)
    assert samples.joints[:, 1:] == pytest.approx(np.tile(PROGRAM.joints[1:], (4, 1)), abs=1e-9)
    tcp = ROBOT.kinematics.forward(samples.joints) @ TOOL
    assert samples.base_from_tcp.translation == pytest.approx(tcp.translation, abs=1e-9)
    radius = float(np.hypot(*tcp.translation[1, :2]))
    assert samples.tcp_speed == pytest.approx([0.0, 0.2 * radius, 0.1 * radius, 0.0], abs=1e-6)
    first, last = trajectory.mark(end_s + 0.1), trajectory.mark(end_s + 0.9)
    assert trajectory.travelled_between(first, last) == pytest.approx(0.076 * radius, rel=1e-4)
    # The next move begins where it ends, and what begins after it counts.
    program = Programmer(joints=section.end).line((0.05, 0, 0))
    path = path_of(program)
    piece = whole(end_s + 1.0, path, plan(path, LIMITS))
    longer = trajectory.extended(piece)
    assert len(trajectory.pieces) == 1
    assert longer.at(np.array([end_s + 9.0])).joints[0] == pytest.approx(program.joints, abs=1e-9)
    assert longer.at(times[:3]).joints == pytest.approx(samples.joints[:3], abs=1e-9)
    longer.cut(end_s + 0.95)
    assert longer.at(times).joints == pytest.approx(samples.joints, abs=1e-9)
    trajectory.withdraw_guidance()
    assert trajectory.at(times).joints == pytest.approx(np.tile(PROGRAM.joints, (4, 1)), abs=1e-9)
    assert trajectory.duration == pytest.approx(end_s)
