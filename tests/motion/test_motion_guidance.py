"""How joints follow a goal that comes every few milliseconds."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from laws import examples

from rapidsim.motion.guidance.goals import Band, JointGoal
from rapidsim.motion.guidance.guided_execution import EndConditions, EndReason, GuidedExecution
from rapidsim.motion.guidance.joint_law import CYCLE_S, GuidedAxes, JointMotion, Tuning
from rapidsim.motion.guidance.sensor import SensorAnswer

AXES = GuidedAxes(
    np.array([-3.0, -1.0]), np.array([3.0, 1.0]), np.array([3.0, 2.0]), np.array([10.0, 20.0])
)
NEAR = np.radians(0.01)


def guided(
    gain: float = 20.0, *, filters: tuple[float, ...] = (20.0,), goes_back: bool = False
) -> GuidedExecution:
    start = np.zeros(2)
    band = Band(np.ones(2, dtype=bool), np.full(2, -NEAR), np.full(2, NEAR))
    return GuidedExecution(
        JointMotion(AXES, start, np.zeros(2)),
        JointGoal(band, filters, start),
        Tuning(gain),
        EndConditions(0.1, 0.5, 1.0, goes_back, 0.5),
    )


def followed(run: GuidedExecution, goals: list[tuple[float, float]], cycles: int) -> np.ndarray:
    """Joints and speeds of all cycles; each goal [rad] holds for as many of them."""
    rows = [(run.motion.joints, run.motion.speed)]
    for cycle in range(cycles):
        goal = goals[cycle * len(goals) // cycles]
        run.step(SensorAnswer(joints=tuple(np.degrees(goal).tolist())))
        rows.append((run.motion.joints, run.motion.speed))
    return np.array(rows)


_GOALS = st.lists(st.tuples(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3)), min_size=1, max_size=4)


@examples(40)
@given(_GOALS, st.floats(0.0, 200.0))
def test_axes_keep_their_limits_whatever_is_wanted(
    goals: list[tuple[float, float]], gain: float
) -> None:
    rows = followed(guided(gain), goals, 400)
    joints, speed = rows[:, 0], rows[:, 1]
    assert (joints >= AXES.lower).all()
    assert (joints <= AXES.upper).all()
    assert (np.abs(speed) <= AXES.max_speed + 1e-12).all()
    jumps = np.abs(np.diff(speed, axis=0)) / CYCLE_S
    # An axis that comes to its end in the middle of a cycle stands at the end of it.
    at_end = (joints[1:] == AXES.lower) | (joints[1:] == AXES.upper)
    assert (jumps <= AXES.max_acceleration + 1e-9)[~at_end].all()


@examples(30)
@given(st.tuples(st.floats(-2.5, 2.5), st.floats(-0.9, 0.9)), st.floats(5.0, 100.0))
def test_a_goal_is_reached_and_hardly_passed(goal: tuple[float, float], gain: float) -> None:
    run = guided(gain, filters=())
    rows = followed(run, [goal], 2000)
    assert run.ended is EndReason.CONVERGED
    assert run.is_over
    assert np.abs(run.motion.joints - goal).max() <= 2 * NEAR
    past = (rows[:, 0] - goal) * np.sign(goal)
    assert past.max() < np.radians(0.5)


def test_the_goal_of_the_start_is_no_answer() -> None:
    # A robot that stands where it is wanted before anybody has said so is not there yet.
    run = guided()
    for _ in range(200):
        run.step(None)
    assert run.ended is None
    for _ in range(60):
        run.step(None)
    assert run.ended is EndReason.SILENT


def test_a_robot_goes_back_to_where_it_began() -> None:
    run = guided(goes_back=True)
    followed(run, [(0.5, -0.2)], 4000)
    assert run.ended is EndReason.CONVERGED
    assert run.is_over
    assert np.array_equal(run.motion.joints, run.start)


def test_answers_that_hold_no_goal_are_silence() -> None:
    run = guided()
    for _ in range(260):
        run.step(SensorAnswer(joints=(1.0,)))
    assert run.ended is EndReason.SILENT


RECORDED = {200: 0.015413, 300: 0.058847, 625: 0.423257, 1000: 0.903201, 1200: 0.993696}
"""Share of its distance that every axis had covered at these frames of 4 ms.

Source: rparak/ABB_EGM_Python, IRB 120 with RobotWare 6.15 in RobotStudio, configuration `default`,
LpFilter 100, goals on a polynomial of fifth degree over 1250 frames; IRB 14000 the same to 1e-4.
"""


def test_the_lag_behind_the_goal_is_that_of_a_recorded_run() -> None:
    # Of the longest distance, 80 degrees, 0.05 degrees are 6e-4.
    wide = np.full(1, 1e3)
    run = GuidedExecution(
        JointMotion(GuidedAxes(-wide, wide, wide, wide), np.zeros(1), np.zeros(1)),
        JointGoal(Band(np.ones(1, dtype=bool), -wide, wide), (100.0,), np.zeros(1)),
        Tuning(5.0, bandwidth=20.0),
        EndConditions(math.inf, 0.1, math.inf, False, 0.0),
    )
    covered, answer = {}, None
    for frame in range(1251):
        covered[frame] = float(np.degrees(run.motion.joints[0])) / 80.0
        run.step(answer)
        u = frame / 1250
        answer = SensorAnswer(joints=(80.0 * u**3 * (10.0 - 15.0 * u + 6.0 * u**2),))
    for frame, share in RECORDED.items():
        assert abs(covered[frame] - share) < 6e-4, frame


def test_the_fastest_axis_slows_the_others_down() -> None:
    # A limit of the speed changes the pace, not the direction.
    run = guided(filters=())
    run.tuning = Tuning(5.0, max_speed=0.1)
    rows = followed(run, [(0.3, 0.15)], 200)
    assert np.abs(rows[:, 1]).max() <= 0.1 + 1e-12
    assert np.allclose(rows[60:, 1, 0], 2.0 * rows[60:, 1, 1], rtol=0.0, atol=1e-9)


def test_a_large_gain_overshoots_as_on_a_controller() -> None:
    # Users see none at the default gain of 5, and some at 12.
    past = []
    for gain in (5.0, 12.0):
        run = guided(gain, filters=(20.0,))
        run.tuning = Tuning(gain, bandwidth=20.0)
        rows = followed(run, [(0.1, 0.1)], 500)
        past.append(float(rows[:, 0].max()) - 0.1)
    assert past[0] < 0.003
    assert past[1] > 0.003
