"""The law of motion: on its curves exactly, within its limits, whatever is programmed.

In `test_simulation_every_program` all programs of the repository.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from laws import examples
from motion_law import Excess, command_of, excess_of, off_curve
from motion_programs import LIMITS, Programmer, path_or_fault, programs, zone

from rapidsim.motion.geometry.segments import Speed
from rapidsim.motion.model import MODELS, Keeper, MotionModel
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.trajectory.command import Piece
from rapidsim.motion.trajectory.trajectory import Trajectory


def driven(program: Programmer, speed: float, model: MotionModel) -> Trajectory | None:
    """A program without stops in between, at one speed."""
    segments = [
        replace(segment, speed=Speed(speed, np.radians(500.0)), zone=segment.zone or zone(2.0))
        for segment in program.segments
    ]
    path = path_or_fault(segments, model)
    if isinstance(path, PathFault):
        return None
    trajectory = Trajectory(segments[0].start, model.window, model.smoothing, model.filter_averages)
    trajectory.append(Piece(0.0, path, plan(path, LIMITS), 0.0, path.length))
    return trajectory


@examples(60)
@given(
    program=programs(),
    speed=st.sampled_from([0.1, 0.5, 2.0, 7.0]),
    keeper=st.sampled_from(["command", "motion"]),
)
def test_random_programs_keep_curves_and_limits(
    program: Programmer, speed: float, keeper: Keeper
) -> None:
    """With `motion` the smoothed motion keeps the accelerations, too."""
    trajectory = driven(program, speed, MotionModel(smoothing="path", accelerations_kept_by=keeper))
    if trajectory is None:
        return
    command = excess_of(command_of(trajectory), LIMITS)
    seen, off = excess_of(trajectory, LIMITS), off_curve(trajectory)
    keeps = seen if keeper == "motion" else Excess(0.0, 0.0, 0.0)
    assert max(command.axis_speed, command.tcp_speed, seen.axis_speed, seen.tcp_speed) < 1.001
    assert command.axis_acceleration < 1.01
    # The torque of a mean is not quite the mean of torques, as above.
    assert keeps.axis_acceleration < 1.03
    assert off < 1e-6


def test_smoothing_along_the_path_takes_speed_into_a_tight_corner_unless_it_must_not() -> None:
    """What that does not keep, and what keeping it costs: a right angle with z1 at v500."""
    program = Programmer().line((0.15, 0, 0), z=zone(1)).line((0, 0.15, 0))
    fast = driven(program, 0.5, MODELS["1"])
    kept = driven(program, 0.5, replace(MODELS["1"], accelerations_kept_by="motion"))
    assert fast is not None
    assert kept is not None
    assert excess_of(fast, LIMITS).axis_acceleration > 2.0
    assert excess_of(kept, LIMITS).axis_acceleration < 1.01
    assert 1.1 * fast.duration < kept.duration < 2.5 * fast.duration


def test_a_kink_without_a_corner_is_a_standstill_also_when_smoothed() -> None:
    program = Programmer().line((0.1, 0, 0), z=zone(10)).line((0, 0, 0), (0, 0, 0.3), z=zone(10))
    trajectory = driven(program.line((0, 0.1, 0)), 0.5, MODELS["1"])
    assert trajectory is not None
    (piece,) = trajectory.pieces
    stops = piece.path.stops
    assert len(stops) == 2
    times = trajectory.time_at_place(stops)
    speeds = trajectory.at(np.concatenate([times - 1e-3, times, times + 1e-3])).joints
    moved = np.abs(np.diff(speeds.reshape(3, 2, -1), axis=0)).max()
    assert moved < 1e-4
    assert excess_of(trajectory, LIMITS).axis_acceleration < 1.01
