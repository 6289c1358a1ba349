r"""CirPathMode \Wrist45, \Wrist46, \Wrist56 in programs: a run and a check say the same of them."""

from __future__ import annotations

from math import radians

import numpy as np
import pytest
from simulation_program import arm, ran
from simulation_reach import checked
from simulation_tasks import ran as together_ran

from rapidsim.controller.journal.failed_moves import FailedMove
from rapidsim.files import SourceFile
from rapidsim.frames.transform import Transform
from rapidsim.jobs.checking.checked_program import load
from rapidsim.motion.robot.external_axes import ExternalAxis
from rapidsim.motion.robot.robot import load_robot
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.simulate import simulate

HEAD = """MODULE cell
  PERS tooldata nozzle:=[TRUE,[[50,0,150],[0.9914449,0,0.1305262,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
  CONST robtarget p:=[[900,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
"""


def program(*lines: str, data: str = "") -> str:
    """The nozzle stands on p; what follows begins on line 6."""
    body = "\n".join(f"    {line}" for line in lines)
    return f"{HEAD}{data}  PROC main()\n    MoveJ p,v500,fine,nozzle;\n{body}\n  ENDPROC\nENDMODULE"


def quarters(count: int, radius: float) -> tuple[str, ...]:
    """Quarters of one circle, one after the other."""
    middle = [radius, 0.0]
    moves = []
    for k in range(count):
        points = []
        for eighth in (2 * k + 1, 2 * k + 2):
            angle = np.pi - eighth * np.pi / 4
            x, y = middle + radius * np.array([np.cos(angle), np.sin(angle)])
            points.append(f"Offs(p,{x:.6f},{y:.6f},0)")
        moves.append(f"MoveC {points[0]},{points[1]},v20,z1,nozzle;")
    return tuple(moves)


FAR_BENT = r"RelTool(p,0,0,0\Ry:=40)"
PROGRAMS = {
    "a hole": (
        r"CirPathMode \Wrist45;",
        "MoveC Offs(p,5,5,0),Offs(p,10,0,0),v20,z1,nozzle;",
        "MoveC Offs(p,5,-5,0),p,v20,fine,nozzle;",
        "MoveL Offs(p,0,0,30),v100,fine,nozzle;",
    ),
    "too large": (
        r"CirPathMode \Wrist56;",
        "MoveC Offs(p,200,200,0),Offs(p,400,0,0),v20,z1,nozzle;",
        "MoveC Offs(p,200,-200,0),p,v20,fine,nozzle;",
    ),
    "singular": (
        r"CirPathMode \Wrist46;",
        "MoveC Offs(p,5,5,0),Offs(p,10,0,0),v20,fine,nozzle;",
    ),
    "leaning": (
        r"MoveJ RelTool(p,0,0,0\Ry:=12),v100,fine,nozzle;",
        r"CirPathMode \Wrist45;",
        "MoveC Offs(p,5,5,0),Offs(p,10,0,0),v20,fine,nozzle;",
    ),
    "an axis past its limit": (
        f"MoveJ {FAR_BENT},v100,fine,nozzle;",
        r"CirPathMode \Wrist45;",
        f"MoveC RelTool({FAR_BENT},20,20,0),RelTool({FAR_BENT},40,0,0),v20,fine,nozzle;",
    ),
}


@pytest.mark.parametrize("name", PROGRAMS)
def test_a_check_by_value_says_what_a_run_says(name: str) -> None:
    text = program(*PROGRAMS[name])
    told = [
        (found.violation.code, found.span.line if found.span else 0, found.violation.message)
        for found in ran(text).run.diagnostics
    ]
    by_value = checked(text, run=False)
    assert told
    assert [(one.code, one.line, one.message) for one in by_value.findings] == told
    assert by_value.counts[1:] == (0, 0)


def test_the_findings_of_each_program() -> None:
    codes = {name: ran(program(*lines)).findings for name, lines in PROGRAMS.items()}
    assert codes == {
        "a hole": [("K618", 7), ("K618", 8)],
        "too large": [("K616", 7)],
        "singular": [("K616", 7)],
        "leaning": [("K617", 8), ("K618", 8)],
        "an axis past its limit": [("K616", 8)],
    }


def test_messages_say_how_much_and_what_to_do() -> None:
    large = ran(program(*PROGRAMS["too large"])).only("K616").violation
    assert large.message == (
        "the wrist cannot lead the circle to `Offs(p,400,0,0)` at 8 % (52.2 mm): the circle goes "
        "up to 121.9 mm (22.1 deg) beyond where axes 5 and 6 take the tool's z axis"
    )
    assert large.help == (
        "make the circle smaller, take another pair of wrist axes, or use all axes, with "
        r"CirPathMode \PathFrame"
    )
    limit = ran(program(*PROGRAMS["an axis past its limit"])).only("K616").violation
    assert limit.message == (
        rf"the wrist cannot lead the circle to `RelTool({FAR_BENT},40,0,0)` at 72 % (45.3 mm): "
        "axis 5 goes to 117.0 deg, 2.0 deg past its limit of 115.0 deg"
    )
    assert "nearer to the middle of its range" in (limit.help or "")
    leaning = ran(program(*PROGRAMS["leaning"]))
    assert leaning.only("K617").violation.message == (
        "the tool is 12.0 deg from perpendicular to the circle to `Offs(p,10,0,0)`, which "
        "axes 4 and 5 lead"
    )
    assert leaning.only("K618").violation.message == (
        "on the circle to `Offs(p,10,0,0)` axes 4 and 5 take the TCP up to 1.51 mm out of the "
        "plane and turn the tool by up to 9.4 deg; it ends 1.53 mm from the point"
    )


def test_where_it_fails_is_marked_on_the_circle() -> None:
    (failed,) = ran(program(*PROGRAMS["too large"])).run.only.failed_moves
    assert isinstance(failed, FailedMove)
    assert np.linalg.norm(failed.fails_at - [1.1, 0.0, 0.6]) == pytest.approx(0.2, abs=1e-3)
    assert failed.fails_at[0] < 1.0


def test_no_clause_is_called_for_an_arc_that_cannot_be_led() -> None:
    stopped = ran(
        program(
            *PROGRAMS["singular"],
            "ERROR",
            "  IF ERRNO=ERR_OUTSIDE_REACH THEN",
            r"    CirPathMode \ObjectFrame;",
            "    RETRY;",
            "  ENDIF",
        )
    )
    assert stopped.end == "error"
    assert len(stopped.run.moves) == 1


def test_many_arcs_in_a_row_are_followed_by_value() -> None:
    text = program(r"CirPathMode \Wrist45;", *quarters(12, 8.0))
    by_value = checked(text, run=False)
    assert {found.code for found in by_value.findings} == {"K618"}
    assert by_value.counts == (13, 0, 0)
    moves = ran(text).run.moves
    # Three times around: every fourth quarter ends as it began, within the digits of targets.
    joints = np.array([move.joints for move in moves])
    assert joints[[4, 8, 12]] == pytest.approx(np.tile(joints[0], (3, 1)), abs=1e-5)
    assert joints[1:13, :3] == pytest.approx(np.tile(joints[0, :3], (12, 1)), abs=1e-12)


def test_an_arc_from_nobody_knows_where_is_left_to_a_run() -> None:
    text = f"""{HEAD}  PROC main()
    MoveAbsJ [[0,0,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,nozzle;
    MoveJ p,v500,fine,nozzle;
    hole;
  ENDPROC
  PROC spare()
    hole;
  ENDPROC
  PROC hole()
    CirPathMode \\Wrist45;
    MoveC Offs(p,0.2,0.2,0),Offs(p,0.4,0,0),v20,fine,nozzle;
  ENDPROC
ENDMODULE"""
    both = checked(text)
    assert both.findings == []
    assert both.counts == (2, 1, 0)


def test_the_next_line_starts_where_the_arm_stands() -> None:
    it = ran(
        program(
            r"CirPathMode \Wrist45;",
            "MoveC Offs(p,5,5,0),Offs(p,10,0,0),v20,fine,nozzle;",
            "MoveL p,v100,fine,nozzle;",
        )
    )
    _, arc, line = it.run.moves
    stands = arm().forward(arc.joints) @ arc.tcp_from_flange.inverse()
    ahead = line.base_from_tcp.translation - stands.translation
    assert line.length_m == pytest.approx(np.linalg.norm(ahead), abs=1e-9)
    # Not from the programmed end of the arc, which is 10 mm away.
    assert abs(line.length_m - 0.01) > 5e-6


def test_one_robot_of_two_that_move_together_may_be_led_by_its_wrist() -> None:
    data = """
PERS tasks both{2}:=[["T_ROB1"],["T_ROB2"]];
VAR syncident on;
VAR syncident off;
CONST robtarget p:=[[900,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
PROC main()
  ConfL\\Off;
  MoveJ p,v500,fine,tool0;
  CirPathMode \\Wrist45;
  SyncMoveOn on,both;
"""
    left = "  MoveC Offs(p,3,3,0),Offs(p,6,0,0)\\ID:=10,v20,fine,tool0;\n"
    right = "  MoveL Offs(p,0,0,50)\\ID:=10,v20,fine,tool0;\n"
    end = "  SyncMoveOff off;\nENDPROC\n"
    together = together_ran({"T_ROB1": data + left + end, "T_ROB2": data + right + end})
    assert together.end == "ended"
    robots = together.run.robots
    arc, line = (robot.moves[1] for robot in robots)
    assert (arc.start_s, arc.end_s) == (line.start_s, line.end_s)
    joints = robots[0].trajectory.at(np.linspace(arc.start_s, arc.end_s, 50)).joints
    assert np.ptp(joints, axis=0)[[0, 1, 2, 5]] == pytest.approx(np.zeros(4), abs=1e-12)
    alone = ran(
        f"MODULE cell\n{data}{left}{end}ENDMODULE".replace("SyncMove", "! ").replace("\\ID:=10", "")
    )
    assert arc.joints == pytest.approx(alone.run.moves[1].joints, abs=1e-12)


UNLED = {
    "the tool is stationary": (
        """  PERS tooldata torch:=[FALSE,[[900,0,700],[0,1,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
  PERS wobjdata part:=[TRUE,TRUE,"",[[0,0,50],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
""",
        r"torch\WObj:=part",
        (),
    ),
    "external axes move robot or work object": (
        "",
        "nozzle",
        (
            ExternalAxis(
                "TRACK", "a", True, -0.5, 3.0, 1.0, 4.0, carries="robot", direction=(0.0, 1.0, 0.0)
            ),
        ),
    ),
}


@pytest.mark.parametrize("why", UNLED)
def test_what_cannot_be_led_says_so_and_turns_with_the_path(why: str) -> None:
    data, with_what, external = UNLED[why]
    axes = "0,9E9,9E9,9E9,9E9,9E9" if external else "9E9,9E9,9E9,9E9,9E9,9E9"
    place = "[0,0,0],[1,0,0,0]" if data else "[900,0,600],[0,0,1,0]"
    data += f"  CONST robtarget a:=[{place},[0,0,0,0],[{axes}]];\n"
    text = f"""MODULE cell
{HEAD.splitlines()[1]}
{data}
  PROC main()
    ConfJ \\Off; ConfL \\Off;
    MoveJ a,v500,fine,{with_what};
    CirPathMode \\Wrist45;
    MoveC Offs(a,5,5,0),Offs(a,10,0,0),v20,fine,{with_what};
  ENDPROC
ENDMODULE"""
    it = ran(text, external_axes=external)
    assert it.end == "ended"
    (left_out,) = it.run.unsimulated
    assert left_out.name == rf"CirPathMode \Wrist45 where {why}"
    assert left_out.treated_as == r"the tool turns as with CirPathMode \PathFrame"


def test_an_external_axis_that_carries_nothing_moves_along() -> None:
    axis = ExternalAxis(
        "STN1",
        "a",
        False,
        radians(-90.0),
        radians(90.0),
        1.0,
        4.0,
        world_from_user=Transform.identity(),
    )
    at = {
        k: HEAD.splitlines()[2].replace(" p:=", f" {k}:=").replace("[9E9", f"[{v}")
        for k, v in (("a", 0), ("b", 40))
    }
    text = f"""MODULE cell
{HEAD.splitlines()[1]}
{at["a"]}
{at["b"]}
  PROC main()
    MoveJ a,v500,fine,nozzle;
    CirPathMode \\Wrist45;
    MoveC Offs(b,5,5,0),Offs(b,10,0,0),v20,fine,nozzle;
  ENDPROC
ENDMODULE"""
    it = ran(text, external_axes=(axis,))
    assert it.run.unsimulated == ()
    alone = ran(
        program(r"CirPathMode \Wrist45;", "MoveC Offs(p,5,5,0),Offs(p,10,0,0),v20,fine,nozzle;")
    )
    assert it.run.moves[1].joints == pytest.approx(alone.run.moves[1].joints, abs=1e-12)
    assert np.degrees(it.run.moves[1].external) == pytest.approx([40.0])


def test_an_arm_whose_wrist_axes_do_not_meet_says_so() -> None:
    text = r"""MODULE cell
  VAR robtarget here;
  PROC main()
    MoveAbsJ [[0,0,0,10,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;
    here:=CRobT(\Tool:=tool0\WObj:=wobj0);
    CirPathMode \Wrist45;
    MoveC RelTool(here,1,1,0),RelTool(here,2,0,0),v20,fine,tool0;
  ENDPROC
ENDMODULE"""
    loaded = load([SourceFile("cell.mod", text, "utf-8")])
    assert loaded.program is not None
    run = simulate(loaded.program, load_robot("crb15000-5-0.95"), options=RunOptions())
    (left_out,) = run.unsimulated
    assert left_out.name == (
        r"CirPathMode \Wrist45 where this arm has no six axes of which 4, 5 and 6 meet in one point"
    )
