"""`rapidsim check` and the moves of a program: what it says of them."""

import json
from pathlib import Path

import pytest
from cli_helper import rapidsim

from rapidsim.reach import trial_run

FAR = """MODULE cell
  PERS wobjdata table:=[FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget pDrop:=[[1300,0,300],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num height;
  PROC main()
    MoveJ pDrop,v500,fine,tool0\\WObj:=table;
    TPReadNum height, "How high?";
    MoveJ Offs(pDrop,-500,0,height),v500,fine,tool0\\WObj:=table;
  ENDPROC
ENDMODULE
"""
STALE = """MODULE cell
  ! Taught elsewhere.
  CONST robtarget p:=[[700,-100,600],[0,0,1,0],
    [0,0,0,4], [9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p,v500,fine,tool0;
  ENDPROC
ENDMODULE
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The working directory, with a program whose target is out of reach."""
    (tmp_path / "cell.mod").write_text(FAR)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_a_finding_says_how_far_why_and_what_cures_it(folder: Path) -> None:
    done = rapidsim("check", "cell.mod", "--robot", "irb1600", cwd=folder)
    assert done.code == 1
    text = " ".join(done.out.split())
    assert "error[K601] unreachable-target: `pDrop` cannot be reached by ABB IRB 1600-6/1.2" in text
    assert "cell.mod:6:11 in main" in text
    assert "cell.mod:2" in text or "2 | PERS wobjdata table" in text
    assert "with `table` moved 82 mm toward the base" in text
    assert "Reach checked for 1 of 2 moves on irb1600." in text
    assert "not checked: cell.mod:8: `height` comes from `TPReadNum`" in text


def test_an_arm_that_nobody_named_is_said(folder: Path) -> None:
    done = rapidsim("check", "cell.mod", cwd=folder)
    assert "moves on irb1600-6-1.2" not in done.out
    assert "(best of the catalogue: 1 of 1 targets reached, 1 as stored; next irb" in done.out
    assert "; --robot names another)." in done.out
    # No arm reaches so far.
    (folder / "cell.mod").write_text(FAR.replace("[[1300", "[[9300"))
    done = rapidsim("check", "cell.mod", cwd=folder)
    assert "for 1 of 2 moves on irb1600-6-1.2 (by default; --robot names another)." in done.out


def test_targets_out_of_reach_of_an_arm_that_nobody_named_are_one_finding(folder: Path) -> None:
    far = FAR.replace('TPReadNum height, "How high?"', "MoveL Offs(pDrop,0,0,50),v500,fine,tool0")
    (folder / "cell.mod").write_text(far.replace("[[1300", "[[9300"))
    done = rapidsim("check", "cell.mod", cwd=folder)
    text = " ".join(done.out.split())
    assert text.count("K601") == 1
    assert "`pDrop` and 2 more targets cannot be reached by ABB IRB 1600-6/1.2" in text
    assert "name yours with --robot or as `model` under [robot] in rapidsim.toml" in text
    told = json.loads(rapidsim("check", "cell.mod", "--output-format", "json", cwd=folder).out)
    assert [one["line"] for one in told["diagnostics"] if one["code"] == "K601"] == [6, 7, 8]
    named = rapidsim("check", "cell.mod", "--robot", "irb1600", cwd=folder)
    assert named.out.count("K601") == 3


def test_a_wait_at_which_the_run_ends_is_one_finding(folder: Path) -> None:
    waits = "WaitDI diPart,1;\n    WaitDI diDoor,1\\MaxTime:=9;\n    MoveJ p"
    (folder / "cell.mod").write_text(STALE.replace("MoveJ p", waits))
    signals = '[signals]\ndiPart = { type = "di" }\ndiDoor = { type = "di" }\n'
    (folder / "rapidsim.toml").write_text(signals)

    def told(ignored: str) -> list[tuple[str, int]]:
        arguments = ("check", "cell.mod", "--ignore", ignored, "--output-format", "json")
        report = json.loads(rapidsim(*arguments, cwd=folder).out)
        return [(one["code"], one["line"]) for one in report["diagnostics"]]

    # The run ends in line 6, and does not come to line 7.
    assert told("K603") == [("I802", 6), ("R106", 6), ("I803", 7)]
    assert told("K603,R106") == [("I802", 6), ("I803", 6), ("I803", 7)]


def test_a_routine_that_nobody_knows_writes_no_constants(folder: Path) -> None:
    misspelt = "MovL pDrop,v500,fine,tool0;\n    MoveJ Offs(pDrop,0,0,-2000),v500,fine,tool0;"
    (folder / "cell.mod").write_text(FAR.replace('TPReadNum height, "How high?";', misspelt))
    out = rapidsim("check", "cell.mod", "--robot", "irb1600", cwd=folder).out
    assert "cell.mod:8:11" in out
    assert "`v500`" not in out


def test_without_reach_only_the_text_is_checked(folder: Path) -> None:
    done = rapidsim("check", "cell.mod", "--no-reach", cwd=folder)
    assert "K601" not in done.out
    assert "Reach" not in done.out


def test_json_counts_moves_and_says_why_some_are_left(folder: Path) -> None:
    done = rapidsim("check", "cell.mod", "--output-format", "json", cwd=folder)
    coverage = json.loads(done.out)["coverage"]
    (unchecked,) = coverage.pop("unchecked")
    assert coverage.pop("unchecked_paths") == []
    paths = {"paths": 0, "paths_checked": 0}
    assert coverage == {"moves": 2, "checked": 1, "by_value": 1, "by_run": 0, **paths}
    assert (unchecked["file"], unchecked["line"]) == ("cell.mod", 8)
    assert "a run of main does not tell" in unchecked["reason"]
    alone = rapidsim("check", "cell.mod", "--output-format", "json", "--no-run", cwd=folder)
    (unchecked,) = json.loads(alone.out)["coverage"]["unchecked"]
    assert unchecked["reason"] == "`height` comes from `TPReadNum`"


def test_a_larger_arm_and_a_robot_that_stands_nearer_reach_it(folder: Path) -> None:
    larger = rapidsim("check", "cell.mod", "--robot", "irb4600-20-2.5", cwd=folder)
    assert "K601" not in larger.out
    station = '[robot]\nmodel = "irb1600"\nbase = { position = [300, 0, 0] }\n'
    (folder / "rapidsim.toml").write_text(station)
    nearer = rapidsim("check", "cell.mod", cwd=folder)
    assert "K601" not in nearer.out


def test_an_unsafe_fix_stores_the_configuration_and_touches_nothing_else(folder: Path) -> None:
    (folder / "cell.mod").write_text(STALE)
    done = rapidsim("check", "cell.mod", "--fix", "--unsafe-fixes", cwd=folder)
    assert done.code == 0, done.out
    cured = STALE.replace("[0,0,0,4], [9E9", "[-1,0,-1,0], [9E9")
    assert (folder / "cell.mod").read_text() == cured


def test_a_cycle_over_its_budget_is_found(folder: Path) -> None:
    waits = "MODULE cell\n  PROC main()\n    WaitTime 3;\n  ENDPROC\nENDMODULE\n"
    (folder / "cell.mod").write_text(waits)
    (folder / "rapidsim.toml").write_text("[check]\ncycle-budget = 2.5\n")
    done = rapidsim("check", "cell.mod", "--output-format", "concise", cwd=folder)
    assert "cell.mod:2:8: warning[D701] one cycle takes 3.00 s; the budget is 2.5 s" in done.out
    full = rapidsim("check", "cell.mod", cwd=folder).out
    assert "this is the time of motion model 3" in full


UNRUN = """MODULE cell
  CONST robtarget p:=[[900,0,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num zero:=0;
  PROC main()
    MoveJ p,v500,fine,tool0;
    {statement}
    zero:=1/zero;
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize(
    ("statement", "why"),
    [
        ("MoveJ Offs(p,0,0,50),v500,fine,tool0;", "more than 1 moves"),
        ('IF IsFile("HOME:/a.txt") TPWrite "there";', "which a check does not have"),
    ],
)
def test_a_check_that_leaves_out_the_run_of_main_says_so(
    folder: Path, monkeypatch: pytest.MonkeyPatch, statement: str, why: str
) -> None:
    monkeypatch.setattr(trial_run, "MOST_MOVES_FOR_ERRORS", 1)
    (folder / "cell.mod").write_text(UNRUN.format(statement=statement))
    done = rapidsim("check", "cell.mod", "--robot", "irb1600", cwd=folder)
    assert done.code == 0
    assert "No whole trial run: " in done.out
    assert why in " ".join(done.out.split())
    told = rapidsim("check", "cell.mod", "--output-format", "json", cwd=folder)
    assert why in json.loads(told.out)["coverage"]["main_left_out"]
    rapidsim_run = rapidsim("run", "cell.mod", "--robot", "irb1600", "--no-record", cwd=folder)
    assert "R101" in rapidsim_run.out + rapidsim_run.err


@pytest.mark.parametrize("target", ["p", "Offs(p,0,0,zero)"])
def test_a_check_whose_run_of_main_takes_too_long_says_so(
    folder: Path, monkeypatch: pytest.MonkeyPatch, target: str
) -> None:
    # A loaded computer gets less far in the time that a run may take, perhaps not to the error.
    for limit in ("LONGEST_WORK_S", "LONGEST_WORK_FOR_ERRORS_S"):
        monkeypatch.setattr(trial_run, limit, 0.05)
    statement = f"WHILE zero<1E9 DO Incr zero; ENDWHILE MoveJ {target},v500,fine,tool0;"
    (folder / "cell.mod").write_text(UNRUN.format(statement=statement))
    done = rapidsim("check", "cell.mod", "--robot", "irb1600", cwd=folder)
    why = "it was cut off after 0.05 s of processor time; `rapidsim run` makes it"
    assert f"No whole trial run: {why}" in " ".join(done.out.split())


def test_nothing_is_said_of_a_run_that_was_made(folder: Path) -> None:
    (folder / "cell.mod").write_text(UNRUN.format(statement=""))
    done = rapidsim("check", "cell.mod", "--robot", "irb1600", cwd=folder)
    assert done.code == 1
    assert "No whole trial run" not in done.out


def test_a_work_object_that_something_unknown_moves_is_not_judged_by_its_text(
    folder: Path,
) -> None:
    text = FAR.replace('FALSE,TRUE,""', 'FALSE,FALSE,"CNV9"').replace("1300", "800")
    (folder / "cell.mod").write_text(text)
    done = rapidsim("check", "cell.mod", "--robot", "irb1600", "--no-run", cwd=folder)
    assert "not checked: cell.mod:6: `CNV9` moves its work object" in " ".join(done.out.split())


def test_what_an_error_clause_answers_is_no_error(tmp_path: Path) -> None:
    # Two quarter turns off: CalcJointT refuses it, and the clause takes that for an answer. The
    # move from where the robot is makes the check run main.
    (tmp_path / "a.mod").write_text(
        "MODULE a\n  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        "  PROC main()\n    MoveAbsJ home,v200,fine,tool0;\n    try;\n"
        "    MoveL Offs(CRobT(),0,0,1),v200,fine,tool0;\n  ENDPROC\n"
        "  PROC try()\n    VAR robtarget target;\n    VAR jointtarget joints;\n"
        "    target:=CalcRobT(home,tool0);\n    target.robconf.cf1:=2;\n"
        "    joints:=CalcJointT(target,tool0);\n"
        "  ERROR\n    IF ERRNO=ERR_ROBLIMIT RETURN;\n    RAISE;\n  ENDPROC\nENDMODULE\n"
    )
    checked = rapidsim("check", "a.mod", "--robot", "irb1600", cwd=tmp_path)
    assert "K603" not in checked.out
    assert checked.code == 0, checked.out


def test_the_arms_of_all_robots_are_named(tmp_path: Path) -> None:
    for name in "left", "right":
        (tmp_path / f"{name}.mod").write_text(STALE.replace("MODULE cell", f"MODULE {name}"))
    (tmp_path / "rapidsim.toml").write_text(
        """[[robot]]
name = "left"
model = "irb1600"
[[robot]]
name = "right"
model = "irb2600-12-1.65"
[[task]]
name = "T_LEFT"
robot = "left"
modules = ["left.mod"]
[[task]]
name = "T_RIGHT"
robot = "right"
modules = ["right.mod"]
"""
    )
    text = rapidsim("check", ".", cwd=tmp_path).out
    assert "Reach checked for all 2 moves on irb1600 (from rapidsim.toml), irb2600-12-1.65." in text
