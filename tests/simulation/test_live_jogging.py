"""Robots jogged by an operator: where they get, how fast, and when not at all."""

from __future__ import annotations

import numpy as np
import pytest
from live_controller import Live, module

from rapidsim.motion.configurations.jog_steps import JogFrame
from rapidsim.motion.trajectory.trajectory import Trajectory
from rapidsim.simulation.live.jogging import jog, jog_arm, reason_against_jogging, step_of
from rapidsim.simulation.live.live_task import LiveTask
from rapidsim.simulation.live.position import position_snapshot
from rapidsim.simulation.live.states import Motors, OperatingMode, RequestRefused, StopMode

MOVES = module(
    """MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v200, fine, tool0;
    MoveAbsJ [[60,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v200, fine, tool0;
    n := n + 1;""",
    "PERS num n := 0;",
)


def manual() -> tuple[Live, LiveTask]:
    live = Live(MOVES)
    live.controller.panel.set_mode(OperatingMode.REDUCED)
    live.controller.panel.set_motors(Motors.ON)
    return live, live.controller.task("T_ROB1")


def joints(task: LiveTask) -> np.ndarray:
    return np.array(position_snapshot(task).joints.robax)


def test_an_axis_turns_by_its_step_no_faster_than_manual_mode_permits() -> None:
    live, task = manual()
    before, began_s = joints(task), live.controller.now_s
    jog(live.controller, task, JogFrame.JOINTS, 1, 10.0)
    live.after(0.2)
    assert before[1] < joints(task)[1] < before[1] + 10.0
    live.after(5.0)
    assert np.allclose(joints(task) - before, [0, 10, 0, 0, 0, 0], atol=1e-6)
    assert fastest(task.unit.trajectory, began_s, live.controller.now_s) < 0.26


def fastest(trajectory: Trajectory, start_s: float, end_s: float) -> float:
    """Largest speed [m/s] of the flange."""
    (section,) = (one for one in trajectory.guided if one.start_s >= start_s)
    times = np.arange(section.start_s, min(end_s, section.end_s), 0.004)
    places = section.tcp_at(section.joints_at(times)).translation
    return float(np.linalg.norm(np.diff(places, axis=0), axis=1).max() / 0.004)


@pytest.mark.parametrize("frame", [JogFrame.BASE, JogFrame.WORLD, JogFrame.WOBJ])
def test_the_tcp_moves_straight_along_a_frame_and_turns_about_itself(frame: JogFrame) -> None:
    live, task = manual()
    jog(live.controller, task, JogFrame.JOINTS, 4, 30.0)
    live.after(5.0)
    before = position_snapshot(task).target
    jog(live.controller, task, frame, 1, -50.0)
    live.after(0.3)
    half = position_snapshot(task).target
    assert np.allclose([half.trans.x, half.trans.z], [before.trans.x, before.trans.z], atol=0.01)
    live.after(5.0)
    after = position_snapshot(task).target
    assert np.allclose(np.subtract(after.trans, before.trans), (0, -50, 0), atol=1e-3)
    assert np.allclose(after.rot, before.rot, atol=1e-6)
    jog(live.controller, task, frame, 5, 15.0)
    live.after(5.0)
    turned = position_snapshot(task).target
    assert np.allclose(turned.trans, after.trans, atol=1e-3)
    assert 2 * np.degrees(np.arccos(abs(np.dot(turned.rot, after.rot)))) == pytest.approx(15.0)


def test_a_step_out_of_reach_or_beyond_a_limit_is_refused_with_its_reason() -> None:
    live, task = manual()
    arm = jog_arm(task)
    reason = arm.reason_against(step_of(task, arm, JogFrame.BASE, 0, 200.0))
    assert reason is None
    for _ in range(9):
        if arm.reason_against(step_of(task, arm, JogFrame.BASE, 0, 200.0)) is not None:
            break
        jog(live.controller, task, JogFrame.BASE, 0, 200.0)
        live.after(10.0)
        arm = jog_arm(task)
    reason = arm.reason_against(step_of(task, arm, JogFrame.BASE, 0, 200.0))
    assert reason is not None
    before = joints(task)
    with pytest.raises(RequestRefused, match=r"beyond reach|limit|singular"):
        jog(live.controller, task, JogFrame.BASE, 0, 200.0)
    for _ in range(20):
        arm = jog_arm(task)
        if arm.reason_against(step_of(task, arm, JogFrame.JOINTS, 0, 30.0)) is not None:
            break
        jog(live.controller, task, JogFrame.JOINTS, 0, 30.0)
        live.after(10.0)
    with pytest.raises(RequestRefused, match=r"joint 1 over by .* deg at its upper limit"):
        jog(live.controller, task, JogFrame.JOINTS, 0, 30.0)
    assert joints(task)[1] == pytest.approx(before[1])
    with pytest.raises(RequestRefused, match="at most"):
        jog(live.controller, task, JogFrame.JOINTS, 0, 31.0)
    with pytest.raises(RequestRefused, match="no axis 7"):
        jog(live.controller, task, JogFrame.JOINTS, 6, 1.0)


def test_a_robot_is_jogged_in_manual_mode_at_rest_off_any_path() -> None:
    live = Live(MOVES)
    controller, task = live.controller, live.controller.task("T_ROB1")
    assert reason_against_jogging(controller, task) == "jogging needs manual mode"
    controller.panel.set_mode(OperatingMode.REDUCED)
    assert reason_against_jogging(controller, task) == "the motors are off"
    controller.panel.set_motors(Motors.ON)
    controller.start()
    assert reason_against_jogging(controller, task) == "the program executes"
    live.after(0.8)
    controller.stop(StopMode.STOP)
    assert "stopped on its path" in str(reason_against_jogging(controller, task))
    controller.reset_pointers()
    live.after(1.0)
    assert reason_against_jogging(controller, task) is None


def test_a_program_begins_where_the_robot_was_jogged_to() -> None:
    live, task = manual()
    jog(live.controller, task, JogFrame.JOINTS, 0, -20.0)
    with pytest.raises(RequestRefused, match="still moves"):
        jog(live.controller, task, JogFrame.JOINTS, 0, -20.0)
    live.controller.start()
    live.after(0.05)
    # It waits for the end of the step.
    assert joints(task)[0] > -2.0
    live.after(30.0)
    assert int(live.value("n")) >= 1


def test_the_arm_says_how_it_stands() -> None:
    _, task = manual()
    arm = jog_arm(task)
    stands = arm.standing()
    assert stands["singularities"] == []
    assert stands["configuration"] == [0, 0, 0, 0]
    room = stands["room"]
    assert isinstance(room, list)
    span = np.degrees(arm.robot.upper - arm.robot.lower)
    assert np.allclose(np.array(room).sum(axis=1), span, atol=0.02)


def test_a_released_button_halts_the_robot_on_its_line() -> None:
    live, task = manual()
    jog(live.controller, task, JogFrame.JOINTS, 4, 30.0)
    live.after(5.0)
    before, began_s = position_snapshot(task).target, live.controller.now_s
    jog(live.controller, task, JogFrame.BASE, 1, 200.0, is_pressed=True)
    live.after(0.4)
    released = position_snapshot(task).target
    task.halt_jogging()
    live.after(0.5)
    stands = position_snapshot(task).target
    assert released.trans.y < stands.trans.y < released.trans.y + 20.0 < before.trans.y + 150.0
    assert np.allclose([stands.trans.x, stands.trans.z], [before.trans.x, before.trans.z], atol=0.1)
    live.after(2.0)
    assert position_snapshot(task).target == stands
    section = task.unit.trajectory.guided[-1]
    times = np.arange(began_s, section.end_s, 0.004)
    turns = np.diff(section.joints_at(times), n=2, axis=0) / 0.004**2
    assert np.abs(turns).max() < task.unit.member.limits.max_acceleration.max()
    # The next step begins where it stands, and nothing is left to halt.
    task.halt_jogging()
    jog(live.controller, task, JogFrame.BASE, 1, -10.0)
    live.after(5.0)
    after = position_snapshot(task).target
    assert np.isclose(after.trans.y, stands.trans.y - 10.0, atol=1e-3)


def test_a_held_button_moves_as_far_as_the_arm_can_and_an_emergency_stop_ends_it() -> None:
    live, task = manual()
    for _ in range(20):
        jog(live.controller, task, JogFrame.JOINTS, 0, 30.0, is_pressed=True)
        live.after(5.0)
        if joints(task)[0] > 179.0:
            break
    with pytest.raises(RequestRefused):
        jog(live.controller, task, JogFrame.JOINTS, 0, 30.0, is_pressed=True)
    jog(live.controller, task, JogFrame.JOINTS, 0, -30.0, is_pressed=True)
    live.after(0.3)
    live.controller.panel.press_emergency_stop(is_pressed=True)
    pressed = joints(task)[0]
    live.after(5.0)
    assert pressed - 15.0 < joints(task)[0] < pressed - 0.01


def test_a_halt_stops_the_step_that_is_made_and_discards_those_after_it() -> None:
    live, task = manual()
    for _ in range(3):
        jog(live.controller, task, JogFrame.JOINTS, 0, 2.0)
    live.after(0.1)
    released = joints(task)
    task.halt_jogging()
    live.after(0.3)
    stands = joints(task)
    assert released[0] < stands[0] < released[0] + 0.8 < 1.7
    assert np.allclose(stands[1:], released[1:])
    live.after(3.0)
    assert np.array_equal(joints(task), stands)
    # A step that has not begun leaves no trace, and a program does not wait for what was discarded.
    jog(live.controller, task, JogFrame.JOINTS, 0, -30.0)
    task.halt_jogging()
    live.after(0.1)
    assert np.array_equal(joints(task), stands)
    began_s = live.controller.now_s
    live.controller.start()
    live.after(5.0)
    moved = task.unit.seen(live.controller.now_s, np.array([began_s + 0.2])).joints[0]
    assert not np.allclose(np.degrees(moved), stands)
    assert int(live.value("n")) >= 1


def test_a_stop_halts_the_second_of_two_steps_and_keeps_the_first() -> None:
    live, task = manual()
    jog(live.controller, task, JogFrame.JOINTS, 0, 2.0)
    jog(live.controller, task, JogFrame.JOINTS, 1, 2.0)
    live.after(0.1)
    while joints(task)[1] < 0.3:
        live.after(0.01)
    live.controller.panel.press_emergency_stop(is_pressed=True)
    live.after(3.0)
    assert np.isclose(joints(task)[0], 2.0)
    assert 0.3 < joints(task)[1] < 1.0


def test_a_move_is_shown_while_the_robot_makes_it_and_not_while_it_is_jogged() -> None:
    target = "[[60,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
    live = Live(module(f"MoveAbsJ {target}, v200, fine, tool0;\nWaitTime 1000;"))
    task = live.controller.task("T_ROB1")
    assert position_snapshot(task).move is None
    live.controller.start()
    live.after(1.0)
    move = position_snapshot(task).move
    assert move is not None
    assert move.span.line == 4
    live.after(20.0)
    assert position_snapshot(task).move is None
    live.controller.panel.set_mode(OperatingMode.REDUCED)
    live.controller.panel.set_motors(Motors.ON)
    live.controller.reset_pointers()
    jog(live.controller, task, JogFrame.JOINTS, 1, 10.0)
    live.after(0.2)
    assert position_snapshot(task).move is None
