r"""Robots that move together leave their path and come back to it: StorePath \KeepSync."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples
from simulation_tasks import Ran, ran
from test_simulation_team_refusals import DATA, point

from rapidsim.controller.moves.executed_move import ExecutedMove

TASKS = ("T_ROB1", "T_ROB2")
STOPS = "StopMove;\nStorePath{keep};\nhere:=CRobT(\\Tool:=tool0\\WObj:=wobj0);"
GOES_ON = "RestoPath;\nStartMove;"
TOGETHER = """MoveL Offs(here,0,0,50)\\ID:=111,v200,z10,tool0;
  MoveL Offs(here,20,0,60)\\ID:=112,v200,fine,tool0;
  {alone}
  MoveL here\\ID:=113,v200,fine,tool0;"""
ALONE = 'SyncMoveSuspend;\n  TPWrite "alone "+ValToStr(IsSyncMoveOn());\n  {own}\n  SyncMoveResume;'
AWAY = "MoveL Offs(here,0,{side}*80,90),v100,fine,tool0;\nMoveL Offs(here,20,0,60),v100,fine,tool0;"


def program(side: int, handler: str, *, after_s: float = 1.5, zone: str = "z20") -> str:
    """Three moves together; `handler` is executed as a trap on the second, if it is not empty."""
    here, there = point(800, side * 300, 700), point(800, side * 200, 900)
    last = point(900, side * 250, 900)
    watch = f"CONNECT soon WITH aside;\n  ITimer\\Single,{after_s},soon;" if handler else ""
    return f"""{DATA}
VAR robtarget here;
PROC main()
  ConfL\\Off;
  ConfJ\\Off;
  MoveJ {here},v500,fine,tool0;
  SyncMoveOn on,both;
  {watch}
  MoveL {there}\\ID:=10,v200,{zone},tool0;
  MoveL {last}\\ID:=20,v100,{zone},tool0;
  MoveL {here}\\ID:=30,v200,fine,tool0;
  SyncMoveOff off;
  TPWrite "done";
ENDPROC
TRAP aside
  {handler.format(side=side, keep="", own="", alone="")}
ENDTRAP
"""


def handler(middle: str, *, keep: str = r"\KeepSync") -> str:
    stops = STOPS.replace("{keep}", keep)
    return f"{stops}\n  {middle}\n  {GOES_ON}"


@cache
def recovered(left: str, right: str, after_s: float = 1.5, zone: str = "z20") -> Ran:
    texts = (
        program(side, one, after_s=after_s, zone=zone) for side, one in ((-1, left), (1, right))
    )
    it = ran(dict(zip(TASKS, texts, strict=True)), max_time_s=60.0)
    assert it.end == "ended", [d.violation.message for d in it.run.diagnostics]
    return it


def by_id(it: Ran, task: str) -> dict[float, ExecutedMove]:
    return {m.move.sync_id: m for m in it.moves(task) if m.move.sync_id is not None}


def assert_in_step(it: Ran) -> None:
    left, right = (by_id(it, task) for task in TASKS)
    assert left.keys() == right.keys()
    for number, one in left.items():
        other = right[number]
        assert one.start_s == pytest.approx(other.start_s, abs=1e-6), number
        assert one.end_s == pytest.approx(other.end_s, abs=1e-6), number


def assert_back_where_it_left(it: Ran) -> None:
    """Both arms stop on the second move, and continue from there, without a jump."""
    plain = recovered("", "")
    for robot, other in zip(it.run.robots, plain.run.robots, strict=True):
        times = np.arange(0.0, robot.trajectory.duration, 0.004)
        samples = robot.trajectory.at(times)
        assert np.max(np.abs(np.diff(samples.joints, axis=0))) < 0.02
        # What is travelled on the path of the program is what is travelled without the trap.
        ends = robot.trajectory.at(np.array([robot.trajectory.duration])).joints[0]
        as_planned = other.trajectory.at(np.array([other.trajectory.duration])).joints[0]
        assert ends == pytest.approx(as_planned, abs=1e-9)
        (second,) = (m for m in robot.moves if m.move.sync_id == 20)
        assert second.start_s < second.end_s


NOTHING = "WaitTime 1;"
KEPT = TOGETHER.replace("{alone}", "")
SUSPENDED = TOGETHER.replace("{alone}", ALONE.replace("{own}", AWAY))


@pytest.mark.parametrize("middle", [NOTHING, KEPT, SUSPENDED], ids=["wait", "kept", "suspended"])
def test_both_resume_where_they_stopped(middle: str) -> None:
    it = recovered(handler(middle), handler(middle))
    assert_in_step(it)
    assert_back_where_it_left(it)


OWN = "MoveL Offs(here,0,{side}*80,90),v100,fine,tool0;\nMoveL here,v100,fine,tool0;"


def test_stopmove_of_each_waits_until_both_are_at_rest() -> None:
    says = handler(NOTHING).replace("StorePath", 'TPWrite "at rest";\nStorePath')
    it = recovered(says, says)
    first, second = (time_s for time_s, text in it.texts if text == "at rest")
    assert first == second
    stands = np.array([first + 0.001, first + 0.9])
    for robot in it.run.robots:
        before, after = robot.trajectory.at(stands).joints
        assert np.array_equal(before, after)


@pytest.mark.parametrize("sides", ["both", "left", "right"])
def test_without_keepsync_each_moves_alone_until_restopath(sides: str) -> None:
    alone = handler('TPWrite "alone "+ValToStr(IsSyncMoveOn());\n' + OWN, keep="")
    it = recovered(*("" if sides not in ("both", one) else alone for one in ("left", "right")))
    assert_in_step(it)
    assert_back_where_it_left(it)
    said = {text for _, text in it.texts if text.startswith("alone")}
    assert said == {"alone FALSE"}


@pytest.mark.parametrize("sides", ["left", "right"])
@pytest.mark.parametrize("keep", ["", r"\KeepSync"])
def test_one_task_alone_stores_the_path_of_both(sides: str, keep: str) -> None:
    waits = handler("WaitTime 1;", keep=keep)
    it = recovered(*(waits if sides == one else "" for one in ("left", "right")))
    assert_in_step(it)
    assert_back_where_it_left(it)
    stands = np.array([2.8, 3.6])
    for robot in it.run.robots:
        before, after = robot.trajectory.at(stands).joints
        assert np.array_equal(before, after)


@pytest.mark.parametrize("keep", ["", r"\KeepSync"])
def test_arms_that_are_near_go_back_by_themselves(keep: str) -> None:
    move = "MoveL Offs(here,0,0,{side}*3+4){number},v20,fine,tool0;"
    near = handler(move.replace("{number}", r"\ID:=111" if keep else ""), keep=keep)
    it = recovered(near, near)
    assert_in_step(it)
    assert_back_where_it_left(it)


@pytest.mark.parametrize("keep", ["", r"\KeepSync"])
def test_arms_that_are_far_are_not_let_go(keep: str) -> None:
    move = "MoveL Offs(here,0,0,60){number},v20,fine,tool0;"
    far = handler(move.replace("{number}", r"\ID:=111" if keep else ""), keep=keep)
    texts = (program(side, far) for side in (-1, 1))
    it = ran(dict(zip(TASKS, texts, strict=True)), max_time_s=60.0)
    assert it.end == "error"
    assert "60.0 mm" in it.only("R101").violation.message


@pytest.mark.parametrize("leaves", ["StorePath;", "SyncMoveSuspend;"])
def test_a_move_in_step_after_leaving_the_team_says_what_left_it(leaves: str) -> None:
    text = handler("MoveL here\\ID:=111,v200,fine,tool0;").replace("StorePath\\KeepSync;", leaves)
    texts = (program(side, text) for side in (-1, 1))
    it = ran(dict(zip(TASKS, texts, strict=True)), max_time_s=60.0)
    assert "after SyncMoveSuspend, or after StorePath" in it.only("R101").violation.message


def test_an_error_clause_of_both_leaves_the_path_and_retries() -> None:
    """Both are told of a fault at a stop point, go aside together and do the move again."""
    texts = {}
    for task, side in zip(TASKS, (-1, 1), strict=True):
        text = program(side, "", zone="fine").replace("here;", "here;\nVAR bool seen;", 1)
        text = text.replace("  MoveL", "  fault;\n  MoveL")
        text += "PROC fault()\nIF NOT seen THEN\nseen:=TRUE;\nRAISE 1;\nENDIF\nENDPROC\n"
        clause = "StorePath\\KeepSync;\nTPWrite ValToStr(PathLevel());\n"
        moves = KEPT.replace("Offs(here", "Offs(there")
        moves = moves.replace("MoveL here", "MoveL there")
        ends = "here:=CRobT(\\Tool:=tool0\\WObj:=wobj0);\nthere:=here;"
        clause += f"{ends}\n{moves}\nRestoPath;\nStartMove;\nRETRY;"
        text = text.replace("VAR bool", "VAR robtarget there;\nVAR bool")
        texts[task] = text.replace("ENDPROC", f"ERROR\n{clause}\nENDPROC", 1)
    it = ran(texts, max_time_s=60.0)
    assert it.end == "ended", [d.violation.message for d in it.run.diagnostics]
    assert_in_step(it)
    assert sorted(by_id(it, "T_ROB1")) == [10, 20, 30, 111, 112, 113]
    assert [text for _, text in it.texts if text == "2"] == ["2", "2"]


@given(
    st.floats(0.05, 3.0),
    st.sampled_from(["z20", "fine", "z1"]),
    st.sampled_from([NOTHING, KEPT, SUSPENDED]),
)
@examples(20)
def test_whenever_they_leave_their_path_both_come_back_to_it(
    after_s: float, zone: str, middle: str
) -> None:
    it = recovered(handler(middle), handler(middle), after_s, zone)
    assert_in_step(it)
    plain = recovered("", "", zone=zone)
    for task in TASKS:
        (robot,) = (one for one in it.run.robots if one.task == task)
        (other,) = (one for one in plain.run.robots if one.task == task)
        ends = (one.trajectory.at(np.array([one.trajectory.duration])) for one in (robot, other))
        here, there = (one.joints[0] for one in ends)
        assert here == pytest.approx(there, abs=1e-9)
        assert it.run.time_s > plain.run.time_s
