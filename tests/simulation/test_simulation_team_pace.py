"""Pace of robots that move together: each move takes as long as the robot that is slowest in it."""

from functools import cache

import numpy as np
import pytest
from simulation_tasks import JOINTS, Ran, ran

from rapidsim.simulation.results.active_limits import active_limits
from rapidsim.simulation.results.slow_sections import slow_sections

DATA = """
PERS tasks both{2}:=[["T_ROB1"],["T_ROB2"]];
VAR syncident on;
VAR syncident off;
"""
STEPS_MM = (5.0, 10.0, 20.0, 40.0, 20.0, 10.0) * 4
"""Steps of the second robot, whose speeds make each last 50 ms."""
NOMINAL_S = 0.05


def program(y_mm: float, steps_mm: tuple[float, ...], speeds: tuple[str, ...], zone: str) -> str:
    """Moves to and fro, step by step, between SyncMoveOn and SyncMoveOff."""
    turn = -1 if y_mm < 0 else 0
    conf = f"[{turn},0,{turn},0]"
    at, lines = 0.0, []
    for number, (step, speed) in enumerate(zip(steps_mm, speeds, strict=True), 1):
        at += step
        corner = "fine" if number == len(steps_mm) else zone
        to = f"[[{550.0 + at},{y_mm},700],[0,0,1,0],{conf},{JOINTS}]"
        lines.append(f"MoveL {to}\\ID:={number},{speed},{corner},tool0;")
    moves = "\n".join(lines)
    return f"""{DATA}
PROC main()
  ConfL\\Off;
  ConfJ\\Off;
  MoveJ [[550,{y_mm},700],[0,0,1,0],{conf},{JOINTS}],v500,fine,tool0;
  SyncMoveOn on,both;
  {moves}
  SyncMoveOff off;
ENDPROC
"""


def tcp_speed(mm_s: float) -> str:
    return f"[{mm_s:g},500,5000,1000]"


@cache
def jumping() -> Ran:
    """The lengths of one robot jump from move to move, the time of a move does not."""
    even, speeds = (20.0,) * len(STEPS_MM), tuple(tcp_speed(mm / NOMINAL_S) for mm in STEPS_MM)
    fast = (tcp_speed(7000.0),) * len(even)
    return ran(
        {
            "T_ROB1": program(-200.0, even, fast, "z50"),
            "T_ROB2": program(200.0, STEPS_MM, speeds, "z50"),
        }
    )


@pytest.mark.parametrize("task", ["T_ROB1", "T_ROB2"])
def test_moves_of_one_nominal_time_take_one_time(task: str) -> None:
    moves = jumping().moves(task)[1:]
    took_ms = np.array([1000.0 * (move.end_s - move.start_s) for move in moves])
    assert jumping().end == "ended"
    # The first and the last also speed up and brake.
    assert took_ms[4:-4] == pytest.approx(50.0, abs=1.0)


def test_what_sets_the_pace_is_named() -> None:
    run = jumping().run
    for robot in run.robots:
        texts = active_limits(run, robot).of_moves
        assert texts[0] == "TCP speed"
        assert set(texts[5:-4]) == {
            f"TCP speed of T_ROB2, {speed} mm/s" for speed in (100, 200, 400, 800)
        }
    found = [one for one in slow_sections(run) if one.task == "T_ROB1" and one.moves > 2]
    assert any(one.limit.startswith("TCP speed of T_ROB2, ") for one in found)


def test_the_slowest_of_each_move_sets_its_time() -> None:
    """One robot turns, the other has a programmed time, and in between they travel."""
    lengths = (60.0, 60.0, 60.0)
    slow, fast = tcp_speed(100.0), tcp_speed(1000.0)
    it = ran(
        {
            "T_ROB1": program(-200.0, lengths, (slow, fast, fast), "fine"),
            "T_ROB2": program(200.0, lengths, (fast, slow, fast + "\\T:=0.8"), "fine"),
        }
    )
    left, right = (it.moves(task)[1:] for task in ("T_ROB1", "T_ROB2"))
    assert [(m.start_s, m.end_s) for m in left] == [(m.start_s, m.end_s) for m in right]
    assert [round(m.end_s - m.start_s, 1) for m in left] == [0.7, 0.7, 0.9]
    setters = [active_limits(it.run, robot).of_moves[1:] for robot in it.run.robots]
    assert setters[0] == setters[1]
    assert setters[0] == (
        "TCP speed of T_ROB1, 100 mm/s",
        "TCP speed of T_ROB2, 100 mm/s",
        "programmed time of T_ROB2, 0.8 s",
    )


@pytest.mark.parametrize("task", ["T_ROB1", "T_ROB2"])
@pytest.mark.parametrize("text", ["stands", "stopped"])
def test_a_task_goes_on_when_its_arm_stands(task: str, text: str) -> None:
    """The command of the arm with the shorter smoothing is later, so that both are in step."""
    it = two_models()
    (robot,) = [one for one in it.run.robots if one.task == task]
    (at_s,) = [e.time_s for e in it.run.events if e.task == task and e.message == text]
    before, there, later = robot.trajectory.at(np.array([at_s - 0.015, at_s, at_s + 0.2])).joints
    assert np.abs(later - there).max() < 1e-10
    assert np.abs(there - before).max() > 1e-9


@cache
def two_models() -> Ran:
    to = ("MoveAbsJ [[{},0,0,0,30,0],", JOINTS, "]{},v100,{},tool0;")
    moves = [
        "".join(to).format(*one)
        for one in ((0, "", "fine"), (10, "\\ID:=1", "z50"), (20, "\\ID:=2", "fine"))
    ]
    moves.insert(1, "SyncMoveOn on,both;")
    text = "\n".join([DATA, "PROC main()", *moves, 'TPWrite "stands";', "WaitTime 0.5;"])
    stops = ["StopMove;", 'TPWrite "stopped";', "WaitTime 0.5;", "StartMove;", "SyncMoveOff off;"]
    text = "\n".join([text, "".join(to).format(30, "\\ID:=3", "z50"), "WaitTime 0.6;", *stops])
    text += "\nENDPROC\n"
    return ran(
        {"T_ROB1": text, "T_ROB2": text},
        arms={"T_ROB1": "irb1200-5-0.9", "T_ROB2": "irb6640-180-2.55"},
    )
