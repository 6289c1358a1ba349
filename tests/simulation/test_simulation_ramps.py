"""AccSet's ramps in whole runs: stops on the way, teams, and what a run says of them."""

from __future__ import annotations

import numpy as np
import pytest
import simulation_tasks
from simulation_program import arm, ran

from rapidsim.diagnostics import Severity
from rapidsim.motion.model import MotionModel
from rapidsim.motion.timing.axis_limits import model_of
from rapidsim.report.run.run_models import models

JOINTS = simulation_tasks.JOINTS


def target(x: float, y: float, z: float) -> str:
    return f"[[{x},{y},{z}],[0,0,1,0],[0,0,0,0],{JOINTS}]"


def program(*lines: str, data: str = "", rest: str = "") -> str:
    body = "\n".join(f"    {line}" for line in lines)
    free = "    ConfJ\\Off;\n    ConfL\\Off;"
    return f"MODULE cell\n{data}  PROC main()\n{free}\n{body}\n  ENDPROC\n{rest}ENDMODULE"


def test_stop_move_waits_until_a_wide_window_has_run_empty() -> None:
    """The program goes on when the arm is seen to stand, and the arm goes on as it was told."""
    stop = """  TRAP halt
    VAR robtarget first;
    VAR robtarget later;
    StopMove;
    first:=CRobT();
    TPWrite "stopped";
    WaitTime 0.5;
    later:=CRobT();
    TPWrite "stands: "\\Bool:=Distance(first.trans,later.trans)<0.001;
    StartMove;
  ENDTRAP
"""
    run = ran(
        program(
            f"MoveJ {target(800, -200, 700)},v500,fine,tool0;",
            "AccSet 100,20;",
            "CONNECT now WITH halt;",
            "ITimer\\Single,1,now;",
            f"MoveL {target(800, 200, 700)},v200,fine,tool0;",
            data="  VAR intnum now;\n",
            rest=stop,
        )
    )
    assert (run.end, run.texts) == ("ended", ["stopped", "stands: TRUE"])
    told = next(event.time_s for event in run.run.events if event.message == "stopped")
    before, after = run.run.only.sample(np.array([told - 0.05, told])).tcp_speed
    assert before > 1e-4
    assert after == pytest.approx(0.0, abs=1e-9)
    end = run.run.only.sample(run.run.time_s)
    assert end.base_from_tcp.translation[0] == pytest.approx([0.8, 0.2, 0.7], abs=1e-9)


def test_a_run_says_what_it_assumes_and_once_that_a_higher_ramp_waits() -> None:
    run = ran(
        program(
            f"MoveJ {target(800, -200, 700)},v500,fine,tool0;",
            "AccSet 100,50;",
            f"MoveL {target(800, 0, 700)},v500,z10,tool0;",
            "AccSet 100,80;",
            f"MoveL {target(800, 200, 700)},v500,z10,tool0;",
            "AccSet 100,100;",
            f"MoveL {target(800, 200, 800)},v500,fine,tool0;",
            f"MoveL {target(800, 0, 800)},v500,fine,tool0;",
        )
    )
    found = run.only("R113")
    assert found.violation.severity is Severity.NOTE
    assert "ramp of 80 %, but this move still has 50 %" in found.violation.message
    assert run.findings == [("R113", 9)]
    assert "assumed" in str(models(run.run).ramp)
    plain = ran(program(f"MoveJ {target(800, -200, 700)},v500,fine,tool0;"))
    assert models(plain.run).ramp is None


def test_robots_of_a_team_share_the_lowest_ramp() -> None:
    def moves(y: float, ramp: int) -> str:
        first, second, third = (target(x, y, 700) for x in (700, 900, 800))
        return f"""
PERS tasks both{{2}}:=[["T_ROB1"],["T_ROB2"]];
VAR syncident on;
VAR syncident off;
PROC main()
  ConfL\\Off;
  ConfJ\\Off;
  MoveJ {first},v500,fine,tool0;
  AccSet 100,{ramp};
  SyncMoveOn on,both;
  MoveL {second}\\ID:=10,v500,z20,tool0;
  MoveL {third}\\ID:=20,v500,fine,tool0;
  SyncMoveOff off;
ENDPROC
"""

    run = simulation_tasks.ran({"T_ROB1": moves(0, 100), "T_ROB2": moves(100, 30)})
    plain = simulation_tasks.ran({"T_ROB1": moves(0, 100), "T_ROB2": moves(100, 100)})
    assert run.end == "ended"
    window = model_of(arm(), MotionModel()).window
    wide = window / 0.3 - window
    longer = {
        round(one.trajectory.duration - without.trajectory.duration, 6)
        for one, without in zip(run.run.robots, plain.run.robots, strict=True)
    }
    # The corner of the team is passed slowly for as long as the ramp averages the speed.
    assert len(longer) == 1
    assert wide < longer.pop() < 2.0 * wide
    left, right = (run.moves(task)[1:] for task in ("T_ROB1", "T_ROB2"))
    for ours, theirs in zip(left, right, strict=True):
        assert (ours.start_s, ours.end_s) == pytest.approx((theirs.start_s, theirs.end_s))
    assert [one.treated_as for one in run.run.unsimulated] == [
        "the lowest ramp since the last stop point counts for all"
    ]


def test_places_at_rest_that_differ_by_their_rounding_are_no_motion() -> None:
    """The last cell of the average has no duration, and its ends were not bit for bit equal."""
    oriented = "[0.0251475,-0.403085,-0.91479,0.00704516],[-1,0,0,0]"
    ends = [f"[[317.18,-19.96,{z}],{oriented},{JOINTS}]" for z in (470.65, 370.65)]
    lines = [f"MoveL {end},v1000,fine,tool0;" for end in ends]
    run = ran(program("AccSet 30,30;", *lines), robot="irb120")
    assert run.end == "ended"
    end = run.run.only.sample(run.run.time_s)
    assert end.base_from_tcp.translation[0] == pytest.approx([0.31718, -0.01996, 0.37065], abs=1e-8)
