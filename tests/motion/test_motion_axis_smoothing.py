"""Each axis smoothed by itself: the mean of its command, at the same times, near the path."""

from __future__ import annotations

from dataclasses import replace
from unittest.mock import patch

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples
from motion_law import STEP, command_of, excess_of, off_curve
from motion_programs import LIMITS, Programmer, path_or_fault, programs, zone

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.segments import Speed
from rapidsim.motion.model import Averages, MotionModel
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.trajectory.command import MotionCommand, Piece
from rapidsim.motion.trajectory.trajectory import Trajectory

FILTER = MotionModel().window
AXES = MotionModel(smoothing="axes")
QUICK_RAD = 1e-6


def driven(
    program: Programmer, speed: float, *, pause: float = 0.1, averages: Averages = 2
) -> Trajectory | None:
    """A program at one speed, after a pause; None where the arm cannot follow it."""
    segments = [replace(s, speed=Speed(speed, np.radians(500.0))) for s in program.segments]
    path = path_or_fault(segments, AXES)
    if isinstance(path, PathFault):
        return None
    trajectory = Trajectory(segments[0].start, FILTER, "axes", averages)
    trajectory.append(Piece(pause, path, plan(path, LIMITS), 0.0, path.length))
    return trajectory


def corner(speed: float, millimetres: float) -> Trajectory:
    """A right angle between two lines of 300 mm."""
    program = Programmer().line((0.15, 0, 0), z=zone(millimetres)).line((0, 0.15, 0))
    trajectory = driven(program, speed)
    assert trajectory is not None
    return trajectory


def on_the_path(trajectory: Trajectory) -> Trajectory:
    """The same command, smoothed along the path."""
    other = Trajectory(trajectory._start, FILTER, averages=trajectory._windows.averages)
    for piece in trajectory.pieces:
        other.append(piece)
    return other


def mean_command(trajectory: Trajectory, time: float) -> Array:
    """The mean of the commanded joints over the window, or over two of half its width."""
    share = np.linspace(0.0, 1.0, 20_001)
    joints = command_of(trajectory).at(time - FILTER * share).joints
    of_two = trajectory._windows.averages == 2
    weights = 2.0 - 4.0 * np.abs(share - 0.5) if of_two else np.ones_like(share)
    return np.asarray(np.trapezoid(weights[:, None] * joints, share, axis=0))


@examples(15)
@given(
    program=programs(),
    speed=st.sampled_from([0.1, 0.5, 2.0]),
    averages=st.sampled_from([1, 2]),
)
def test_postures_are_those_of_samples_but_for_little(
    program: Programmer, speed: float, averages: Averages
) -> None:
    """What is looked at for contacts is quicker, and some microns off."""
    trajectory = driven(program, speed, averages=averages)
    if trajectory is None:
        return
    times = np.random.default_rng(3).uniform(-0.1, trajectory.duration + 0.1, 300)
    exact, quick = trajectory.at(times), trajectory.postures(times)
    np.testing.assert_allclose(quick.joints, exact.joints, rtol=0.0, atol=QUICK_RAD)
    np.testing.assert_array_equal(quick.move, exact.move)
    assert quick.external.shape == exact.external.shape


@examples(15)
@given(
    program=programs(),
    speed=st.sampled_from([0.1, 0.5, 2.0]),
    share=st.floats(0.0, 1.0),
    averages=st.sampled_from([1, 2]),
)
def test_each_joint_is_the_mean_of_its_command(
    program: Programmer, speed: float, share: float, averages: Averages
) -> None:
    trajectory = driven(program, speed, averages=averages)
    if trajectory is None:
        return
    time = share * trajectory.duration
    seen = trajectory.at(np.array([time])).joints[0]
    assert seen == pytest.approx(mean_command(trajectory, time), abs=2e-8)


@examples(12)
@given(
    program=programs(),
    speed=st.sampled_from([0.1, 0.5, 2.0, 7.0]),
    averages=st.sampled_from([1, 2]),
)
def test_it_keeps_limits_ends_and_times(
    program: Programmer, speed: float, averages: Averages
) -> None:
    """What is seen keeps what the command keeps; blocks end exactly at their point."""
    trajectory = driven(program, speed, averages=averages)
    if trajectory is None:
        return
    seen = excess_of(trajectory, LIMITS)
    assert seen.axis_speed < 1.001
    assert seen.axis_acceleration < 1.01
    assert seen.tcp_speed < 1.05
    times = np.arange(-STEP, trajectory.duration + STEP, 5e-3)
    samples, other = trajectory.at(times), on_the_path(trajectory).at(times)
    assert samples.move.tolist() == other.move.tolist()
    assert trajectory.duration == on_the_path(trajectory).duration
    rest = trajectory.at(np.array([-1.0, 0.1, trajectory.duration, 99.0]))
    ends = [trajectory._start.joints] * 2 + [program.joints] * 2
    assert rest.joints == pytest.approx(np.array(ends), abs=1e-9)
    assert rest.tcp_speed.tolist() == [0.0] * 4


def test_samples_do_not_depend_on_each_other() -> None:
    """One at a time, in any order, far apart: each is the same, and so is a run in many pieces."""
    trajectory = corner(0.5, 10)
    times = np.linspace(-0.1, trajectory.duration + 0.1, 71)
    at_once = trajectory.at(times).joints
    alone = np.array([trajectory.at(times[k : k + 1]).joints[0] for k in range(len(times))])
    assert np.abs(at_once - alone).max() < 1e-12
    assert np.abs(at_once[::-1] - trajectory.at(times[::-1]).joints).max() < 1e-12
    (whole,) = trajectory.pieces
    parts = Trajectory(trajectory._start, FILTER, "axes", 2)
    for begin, end in ((0.0, 0.1), (0.1, 0.149), (0.149, whole.path.length)):
        start = whole.start_time + whole.timing.time_at(begin)
        parts.append(Piece(start, whole.path, whole.timing, begin, end))
    assert np.abs(at_once - parts.at(times).joints).max() < 1e-9


def test_a_sample_of_a_long_move_needs_what_its_window_covers() -> None:
    """At 0.1 mm/s the corner takes hours, and most of them pass at one acceleration."""
    trajectory = corner(1e-4, 10)
    times = np.linspace(0.0, trajectory.duration, 9)
    seen, at_once = [0], MotionCommand.joints_at

    def counted(command: MotionCommand, instants: Array) -> Array:
        seen[0] += len(instants)
        return at_once(command, instants)

    with patch.object(MotionCommand, "joints_at", counted):
        joints = trajectory.at(times).joints
    assert seen[0] < 1000
    assert np.abs(joints - on_the_path(trajectory).at(times).joints).max() < 1e-5


def test_speed_is_that_of_the_tcp() -> None:
    trajectory = corner(0.5, 10)
    samples = trajectory.at(np.arange(0.0, trajectory.duration, 5e-4))
    tcp = samples.base_from_tcp.translation
    mean = 0.5 * (samples.tcp_speed[1:] + samples.tcp_speed[:-1])
    assert np.linalg.norm(np.diff(tcp, axis=0), axis=1) / 5e-4 == pytest.approx(mean, abs=3e-3)


@pytest.mark.parametrize(("speed", "off_mm"), [(0.25, 0.03), (1.0, 0.4)])
def test_a_line_is_left_by_little_away_from_corners(speed: float, off_mm: float) -> None:
    """The square of the way within the window counts: a quarter of the speed, a sixteenth."""
    line = driven(Programmer().line((0.0, 0.5, 0.0)), speed)
    assert line is not None
    off = 1e3 * off_curve(line)
    assert 0.5 * off_mm < off < off_mm
    assert 1e3 * off_curve(on_the_path(line)) < 1e-3


@pytest.mark.parametrize("millimetres", [1.0, 10.0])
def test_it_rounds_a_corner_more_and_needs_no_more_acceleration(millimetres: float) -> None:
    axes = corner(0.5, millimetres)
    path = on_the_path(axes)
    times = np.arange(0.0, axes.duration, STEP)
    vertex = Programmer().line((0.15, 0, 0)).pose.translation
    nearest = [
        1e3 * np.linalg.norm(one.at(times).base_from_tcp.translation - vertex, axis=1).min()
        for one in (axes, path)
    ]
    assert nearest[0] > nearest[1] + 1.0
    # In a tight one the arm would be asked for more than it has if it stayed on the path.
    assert millimetres > 5.0 or excess_of(path, LIMITS).axis_acceleration > 1.1
    assert excess_of(axes, LIMITS).axis_acceleration < 1.01


def test_smoothing_each_axis_needs_no_slower_bends() -> None:
    program = Programmer().line((0.15, 0, 0), z=zone(1)).line((0, 0.15, 0))
    kept = path_or_fault(program, replace(AXES, accelerations_kept_by="motion"))
    plain = path_or_fault(program, AXES)
    assert not isinstance(kept, PathFault)
    assert not isinstance(plain, PathFault)
    assert plan(kept, LIMITS).duration == plan(plain, LIMITS).duration


def test_coarse_samples_follow_a_command_that_changes() -> None:
    trajectory = corner(0.2, 10.0)
    times = np.linspace(-0.1, trajectory.duration + 0.5, 300)

    def off() -> float:
        quick, exact = trajectory.at(times, coarse=True), trajectory.at(times)
        return float(np.abs(quick.joints - exact.joints).max())

    assert off() < QUICK_RAD
    trajectory.cut(0.5 * trajectory.duration)
    # The command now stops at once, which the quick way shows less exactly.
    assert off() < 10.0 * QUICK_RAD
    (piece,) = trajectory.pieces
    start_s = trajectory.duration + 0.1
    trajectory.append(replace(piece, start_time=start_s, from_s=piece.to_s, to_s=piece.path.length))
    assert off() < 10.0 * QUICK_RAD
