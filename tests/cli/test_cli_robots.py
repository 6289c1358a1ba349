"""The catalogue on the command line: by maker, what is unknown, and what follows from that."""

import json
from pathlib import Path

import pytest
from cli_helper import rapidsim

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
    assert axes["irb460-110-2.4"].split()[-2:] == ["4", "?"]
    assert axes["irb14000-0.5-0.5"].split()[-2] == "7"
    assert axes["crb15000-5-0.95"].split()[-2] == "6"
    assert "found by a numerical search" in rapidsim("robots", "gofa").err


def test_json_says_null_where_nothing_is_known() -> None:
    listed = json.loads(rapidsim("robots", "--format", "json").out)["robots"]
    robots = {robot["name"]: robot for robot in listed}
    assert len(robots) == len(listed) > 50
    unknown = robots["kr120-r2500-pro"]
    assert {joint["max_speed_deg_s"] for joint in unknown["joints"]} == {None}
    assert robots["rv-m1"]["payload_kg"] is None
    assert robots["irb2400-16-1.55"]["not_modelled"]
    assert {robot["maker"] for robot in listed} == {"ABB", "KUKA", "Mitsubishi"}
    assert all(robot["sources"] and robot["checks"] for robot in listed)


def test_an_arm_of_unknown_speed_is_refused_with_the_remedy(program: Path) -> None:
    done = rapidsim("run", program, "--robot", "kr120-r2500-pro", "--no-record")
    assert done.code == 2
    assert done.err.startswith("error: kr120-r2500-pro: no axis speed is known for joint_1, ")
    assert "[motion] axis_speed" in done.err
    assert not done.out


def test_speeds_of_the_station_file_time_it_and_are_named(program: Path) -> None:
    program.with_name("rapidsim.toml").write_text(f"[motion]\n{SPEEDS}\n")
    arguments = ("run", program, "--robot", "kr120-r2500-pro", "--no-record")
    done = rapidsim(*arguments, "--format", "json")
    assert done.code == 0, done.err
    models = json.loads(done.out)["models"]
    assert models["axis_speed"].startswith("axis speeds 100, 90, 90, 150, 120, 190 deg/s")
    assert "as the station file says" in " ".join(rapidsim(*arguments).out.split())


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
