"""The catalogue on the command line: by maker, what is unknown, and what follows from that."""

import json
from pathlib import Path

import numpy as np
import pytest
from cli_helper import rapidsim
from laws import some

from rapidsim.motion.robot.robot import Robot, load_robot, robot_names

MOVE = """MODULE Small
  PROC main()
    MoveAbsJ [[20,-80,80,0,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v200, fine, tool0;
  ENDPROC
ENDMODULE
"""
SPEEDS = "axis_speed = [100, 90, 90, 150, 120, 190]"


@pytest.fixture
def program(tmp_path: Path) -> Path:
    file = tmp_path / "small.mod"
    file.write_text(MOVE)
    return file


def test_the_table_goes_by_maker_and_explains_its_question_marks() -> None:
    lines = [line.rstrip() for line in rapidsim("robots").out.splitlines()]
    makers = [lines.index(maker) for maker in ("ABB", "KUKA", "Mitsubishi")]
    assert makers == sorted(makers)
    assert any(line.split()[:2] == ["kr10-r1100-sixx", "kr10"] for line in lines[makers[1] :])
    (teaching_arm,) = (line.split() for line in lines if "rv-m1" in line)
    assert teaching_arm == ["rv-m1", "rvm1", "?", "482", "mm", "5", "?"]
    assert any(line.startswith("? is not known") for line in lines)


def test_the_table_holds_arms_of_every_kind_without_notes_beside_it() -> None:
    """How an arm is solved is told where it is used."""
    listed = rapidsim("robots")
    assert listed.err == ""
    rows = [line for line in listed.out.splitlines() if line.startswith("  ") and line.strip()]
    axes = {line.split()[0]: line for line in rows}
    assert axes["irb460-110-2.4"].split()[-2:] == ["4", "~130-300°/s"]
    assert axes["irb660-180-3.15"].split()[-2:] == ["4", "130-300°/s"]
    text = " ".join(listed.out.split())
    assert "those of irb660-180-3.15: irb260-30-1.5, irb460-110-2.4, irb660-250-3.15" in text
    assert axes["irb14000-0.5-0.5"].split()[-2] == "7"
    assert axes["crb15000-5-0.95"].split()[-2] == "6"
    assert "found by a numerical search" in rapidsim("robots", "gofa").err


def test_json_says_null_where_nothing_is_known() -> None:
    listed = json.loads(rapidsim("robots", "--format", "json").out)["robots"]
    robots = {robot["name"]: robot for robot in listed}
    assert len(robots) == len(listed) > 50
    unknown = robots["rv-m1"]
    assert {joint["max_speed_deg_s"] for joint in unknown["joints"]} == {None}
    assert unknown["payload_kg"] is None
    assert unknown["axis_speeds_from"] is None
    assert robots["kr120-r2500-pro"]["axis_speeds_from"] == "kr120-r2700-2"
    assert robots["irb2400-16-1.55"]["not_modelled"]
    assert {robot["maker"] for robot in listed} == {"ABB", "KUKA", "Mitsubishi"}
    assert all(robot["sources"] and robot["checks"] for robot in listed)


def test_an_arm_of_unknown_speed_is_refused_with_the_remedy(program: Path) -> None:
    done = rapidsim("run", program, "--robot", "rv-m1", "--no-record")
    assert done.code == 2
    assert done.err.startswith("error: rv-m1: no axis speed is known for joint_1, ")
    assert "[motion] axis_speed" in done.err
    assert not done.out


def test_speeds_of_the_station_file_time_it_and_are_named(program: Path) -> None:
    program.with_name("rapidsim.toml").write_text(f"[motion]\n{SPEEDS}\n")
    arguments = ("run", program, "--robot", "kr120-r2500-pro", "--no-record")
    done = rapidsim(*arguments, "--format", "json")
    assert done.code == 0, done.err
    models = json.loads(done.out)["models"]
    assert models["axis_speed"].startswith("axis speeds 100, 90, 90, 150, 120, 190 deg/s")
    assert "from the station file" in " ".join(rapidsim(*arguments).out.split())


@pytest.mark.parametrize(
    ("motion", "complaint"),
    [
        ("axis_speed = [1, 2]", "6 axes, but 2 axis speeds"),
        ("axis_speed = [1, 2, 3, 4, 5, 0]", "axis speeds must be above 0"),
        ("acceleration = [1, 2]", "6 axes, but 2 accelerations"),
    ],
)
def test_wrong_speeds_are_a_mistake_of_the_user(program: Path, motion: str, complaint: str) -> None:
    program.with_name("rapidsim.toml").write_text(f"[motion]\n{motion}\n")
    done = rapidsim("run", program, "--robot", "kr16", "--no-record")
    assert done.code == 2
    assert complaint in done.err


def test_a_run_says_what_of_the_arm_is_not_modelled(tmp_path: Path) -> None:
    file = tmp_path / "small.mod"
    file.write_text(MOVE.replace("-80,80", "10,10"))
    done = rapidsim("run", file, "--robot", "irb2400", "--no-record")
    assert done.code == 0, done.err
    assert "Not modelled: the rod of axis 3" in " ".join(done.out.split())


THREE_MOVES = """MODULE three
  PROC main()
    MoveAbsJ [[10,{second},{third},0,{fifth},0],[{eax},9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
    MoveAbsJ [[-10,{second},{third},0,{fifth},0],[{eax},9E9,9E9,9E9,9E9,9E9]],v500,z10,tool0;
    MoveAbsJ [[0,{second},{third},0,{fifth},0],[{eax},9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
  ENDPROC
ENDMODULE
"""


def three_moves(robot: Robot) -> str:
    """A program of three joint moves within the limits of an arm."""
    seven = len(robot.joints) == 7
    zero = np.degrees(np.clip(np.zeros(len(robot.joints)), robot.lower, robot.upper))
    return THREE_MOVES.format(
        second=f"{zero[1]:.3f}",
        third=0 if seven else f"{zero[2]:.3f}",
        fifth=30 if len(robot.joints) > 4 else 0,
        eax=0 if seven else "9E9",
    )


@pytest.mark.parametrize("name", [*some(robot_names(), 8), "irb920-6-0.55", "irb14000-0.5-0.5"])
def test_every_arm_runs_and_names_the_arm_that_lends_its_speeds(tmp_path: Path, name: str) -> None:
    robot = load_robot(name)
    file = tmp_path / "three.mod"
    file.write_text(three_moves(robot))
    done = rapidsim("run", file, "--robot", name, "--no-record", "--format", "json")
    if name == "rv-m1":
        # No arm of its kind has speeds.
        assert done.code == 2
        return
    assert done.code == 0, done.err
    run = json.loads(done.out)
    assert len(run["moves"]) == 3
    lent = f"axis speeds of {robot.axis_speeds_from}, no source gives those of {name}"
    assert run["models"].get("axis_speed") == (lent if robot.axis_speeds_from else None)


def test_the_page_of_an_arm_names_the_arm_that_lends_its_speeds() -> None:
    page = rapidsim("robots", "crb1300").out
    assert "speed of irb1300-10-1.15" in page
    assert "speed of" not in rapidsim("robots", "irb1300").out


def test_an_arm_of_unknown_speed_has_the_speeds_of_its_family(tmp_path: Path) -> None:
    file = tmp_path / "turn.mod"
    file.write_text(
        "MODULE turn\n  PROC main()\n"
        "    MoveAbsJ [[30,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;\n"
        "  ENDPROC\nENDMODULE\n"
    )
    arguments = ("run", file, "--no-record", "--robot")
    lent = rapidsim(*arguments, "irb1300-11-0.9")
    assert lent.code == 0, lent.err
    assert "no source gives the axis speeds of irb1300-11-0.9: those of irb1300-10-1.15" in lent.err
    variant = rapidsim(*arguments, "irb2600id-8-2.0")
    assert variant.code == 0, variant.err
    assert "those of irb2600-12-1.65 are used" in variant.err
    own = rapidsim(*arguments, "irb1300-10-1.15")
    assert own.code == 0, own.err
    assert "axis speeds of" not in own.err


def test_the_picking_cycle_of_an_arm_stands_beside_a_published_figure() -> None:
    shown = " ".join(rapidsim("robots", "irb910sc-3-0.65", "--cycle").out.split())
    assert "25 mm up, 300 mm across, 25 mm down, and back, 1 kg" in shown
    assert "(15 % either way)" in shown
    assert "0.385 s, the maker's product specification, as quoted publicly" in shown
    assert "no figure is known" in rapidsim("robots", "irb1600", "--cycle").out
    assert "not from a source" in rapidsim("robots", "irb120", "--cycle").out


def test_an_arm_that_cannot_make_the_picking_cycle_says_so() -> None:
    done = rapidsim("robots", "irb14000-0.5-0.5", "--cycle")
    assert done.code == 2
    assert "no picking cycle, the arm cannot make its lines" in done.err
    assert rapidsim("robots", "--cycle").code == 2
