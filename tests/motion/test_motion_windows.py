"""AccSet's ramps: how wide the window of the smoothing is, and what the arm does with it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples
from motion_law import STEP, command_of, excess_of, off_curve, ramped_command_of
from motion_programs import LIMITS, Programmer, path_of, path_or_fault, programs, zone

from rapidsim.motion.geometry.segments import Segment, Speed
from rapidsim.motion.model import Keeper, MotionModel
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.trajectory.command import Piece
from rapidsim.motion.trajectory.filter_windows import Windows
from rapidsim.motion.trajectory.trajectory import Trajectory

MODEL = MotionModel(smoothing="path", filter_time=0.08, filter_averages=1)
FILTER = MODEL.window


def driven(segments: list[Segment], model: MotionModel, *, start: float = 0.0) -> Trajectory | None:
    """Segments planned as one block; None where the arm cannot follow them."""
    path = path_or_fault(segments, model)
    if isinstance(path, PathFault):
        return None
    trajectory = Trajectory(segments[0].start, model.window, model.smoothing)
    trajectory.append(Piece(start, path, plan(path, LIMITS), 0.0, path.length))
    return trajectory


def line(length: float, **ramps: float) -> Trajectory:
    """One straight move [m] at 0.5 m/s."""
    segments = Programmer().line((0.0, length, 0.0)).segments
    trajectory = driven([replace(segments[0], **ramps)], MODEL)  # type: ignore[arg-type]
    assert trajectory is not None
    return trajectory


@st.composite
def ramped(draw: st.DrawFn) -> list[Segment]:
    """A block of moves whose ramps fall, at several speeds, with a ramp of its own at the stop."""
    moves = draw(programs()).segments
    ramp, segments = 1.0, []
    for number, segment in enumerate(moves):
        ramp = min(ramp, draw(st.sampled_from([1.0, 0.9, 0.5, 0.1])))
        last = number == len(moves) - 1
        segments.append(
            replace(
                segment,
                speed=Speed(draw(st.sampled_from([0.1, 0.5, 2.0, 7.0])), np.radians(500.0)),
                zone=None if last else segment.zone or zone(2.0),
                ramp=ramp,
                stop_ramp=max(0.1, ramp * draw(st.sampled_from([1.0, 0.5, 0.2]))),
            )
        )
    return segments


@examples(40)
@given(segments=ramped(), keeper=st.sampled_from(["command", "motion"]))
def test_ramps_keep_the_path_and_the_limits(segments: list[Segment], keeper: Keeper) -> None:
    """It goes forward only, from rest to rest, on its curves; speeds are kept as without ramps."""
    trajectory = driven(segments, replace(MODEL, accelerations_kept_by=keeper))
    if trajectory is None or trajectory.length == 0.0:
        return
    seen = excess_of(trajectory, LIMITS)
    assert max(seen.axis_speed, seen.tcp_speed) < 1.001
    assert keeper == "command" or seen.axis_acceleration < 1.01
    assert off_curve(trajectory) < 1e-6
    times = np.arange(-STEP, trajectory.duration + 2.0 * STEP, STEP)
    places = trajectory.place_at(times)
    assert np.diff(places).min() > -1e-12
    assert places[[0, -1]] == pytest.approx([0.0, trajectory.length], abs=1e-12)
    assert places[times < trajectory.duration - 0.01][-1] < trajectory.length
    ends = trajectory.at(np.array([0.0, trajectory.duration]))
    assert ends.joints[1] == pytest.approx(segments[-1].end.joints, abs=1e-9)
    assert ends.tcp_speed == pytest.approx([0.0, 0.0], abs=1e-6)


@examples(30)
@given(segments=ramped(), share=st.floats(0.0, 1.0))
def test_a_ramp_averages_the_place_of_the_command(segments: list[Segment], share: float) -> None:
    trajectory = driven(segments, MODEL)
    if trajectory is None:
        return
    ramped, time = trajectory._ramped, share * trajectory.duration
    width = float(ramped._windows.at(np.array([time]))[0][0])
    least = min(min(s.ramp, s.stop_ramp) for s in segments)
    assert 0.0 <= width <= FILTER * (1.0 / least - 1.0) + 1e-12
    instants = np.linspace(time - width, time, 20_001)
    place = ramped.planned.place_at(instants)
    mean = float(np.trapezoid(place, instants)) / width if width > 0.0 else float(place[-1])
    assert ramped.command.place_at(np.array([time]))[0] == pytest.approx(mean, abs=5e-6)
    seen_s = trajectory.seen_s(time)
    wide = ramped._windows.at(np.array([seen_s - FILTER]))[0][0]
    assert seen_s == pytest.approx(time + wide + FILTER, abs=1e-9)


def with_ramp(segments: list[Segment], ramp: float) -> Trajectory | None:
    """The block with one ramp for all of its moves."""
    return driven([replace(one, ramp=ramp, stop_ramp=ramp) for one in segments], MODEL)


@examples(30)
@given(segments=ramped(), ramp=st.sampled_from([0.8, 0.5, 0.2, 0.1, None]))
def test_ramps_need_no_more_torque(segments: list[Segment], ramp: float | None) -> None:
    gentle = driven(segments, MODEL) if ramp is None else with_ramp(segments, ramp)
    plain = with_ramp(segments, 1.0)
    if gentle is None or plain is None or gentle.length == 0.0:
        return
    limit = max(1.0, excess_of(command_of(plain), LIMITS).axis_acceleration)
    assert excess_of(ramped_command_of(gentle), LIMITS).axis_acceleration < 1.05 * limit


@examples(20)
@given(segments=ramped(), ramp=st.sampled_from([0.8, 0.5, 0.2]))
def test_a_lower_ramp_takes_no_less_time(segments: list[Segment], ramp: float) -> None:
    higher, lower = with_ramp(segments, ramp), with_ramp(segments, 0.5 * ramp)
    if higher is not None and lower is not None:
        assert lower.duration > higher.duration - 1e-6


@pytest.mark.parametrize(("ramp", "more"), [(1.0, 0.0), (0.5, 0.08), (0.25, 0.24), (0.1, 0.72)])
def test_a_ramp_adds_its_width_to_a_move_between_stop_points(ramp: float, more: float) -> None:
    assert line(0.3, ramp=ramp).duration - line(0.3).duration == pytest.approx(more, abs=1e-9)


def test_a_ramp_at_the_stop_leaves_the_start_as_it_is() -> None:
    plain, gentle = line(0.7), line(0.7, stop_ramp=0.5)
    assert gentle.duration - plain.duration == pytest.approx(0.08, abs=1e-9)
    early = np.linspace(0.0, 0.3, 61)
    assert gentle.place_at(early) == pytest.approx(plain.place_at(early), abs=2e-6)
    # A move that is over before the window is as wide gets less of it.
    assert 0.0 < line(0.1, stop_ramp=0.5).duration - line(0.1).duration < 0.08


def test_a_window_never_reaches_over_a_stop_with_another_width() -> None:
    """Each block is seen as if there were nothing before it, whatever ramps the others have."""
    ramps = (0.2, 1.0, 0.5, 1.0)
    joints = Programmer().joints
    together: Trajectory | None = None
    for number, ramp in enumerate(ramps):
        block = Programmer(joints=joints).line((0.0, 0.2 * (-1.0) ** number, 0.0))
        joints = block.joints
        (segment,) = block.segments
        path = path_of([replace(segment, ramp=ramp)], MODEL)
        together = together or Trajectory(segment.start, FILTER)
        start = together.seen_s(together.command_end) + 0.025
        piece = Piece(start, path, plan(path, LIMITS), 0.0, path.length)
        alone = Trajectory(segment.start, FILTER)
        alone.append(piece)
        before = together.length
        together.append(piece)
        assert together.duration == pytest.approx(alone.duration, abs=1e-12)
        times = np.linspace(start, together.duration, 101)
        assert together.place_at(times) - before == pytest.approx(alone.place_at(times), abs=1e-12)


def test_what_is_taken_back_takes_its_ramps_along() -> None:
    segments = Programmer().line((0.0, 0.3, 0.0), z=zone(10)).line((0.0, 0.0, 0.3)).segments
    path = path_of([segments[0], replace(segments[1], ramp=0.3)], MODEL)
    timing = plan(path, LIMITS)
    trajectory = Trajectory(segments[0].start, FILTER)
    trajectory.append(Piece(0.0, path, timing, 0.0, path.length))
    assert trajectory.has_ramps
    begins = timing.time_at(float(path.segment_starts[1]))
    trajectory.cut(begins - 0.1)
    assert not trajectory.has_ramps
    assert trajectory.duration == pytest.approx(begins - 0.1 + FILTER)


def test_windows_forget_the_past_and_are_as_wide_as_before() -> None:
    forgets, keeps = Windows(0.08), Windows(0.08)
    for one in (forgets, keeps):
        for begin_s in (1.0, 5.0, 9.0, 13.0):
            one.begin(begin_s, 0.08, elsewhere=False)
            one.widen(begin_s + 0.2, 0.3 + 0.01 * begin_s)
    forgets.forget(9.5)
    times = np.linspace(9.5, 20.0, 200)
    for now, before in zip(forgets.at(times), keeps.at(times), strict=True):
        assert np.array_equal(now, before)
    assert [forgets.lag(at) for at in (9.6, 13.5, 19.0)] == [
        keeps.lag(at) for at in (9.6, 13.5, 19.0)
    ]
    assert len(forgets._steps) < len(keeps._steps)
    assert forgets.widens
    forgets.forget(0.0)
    assert np.array_equal(forgets.at(times)[0], keeps.at(times)[0])
