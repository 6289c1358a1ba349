"""`rapidsim run --assert`, the cycle budget and what the exit code says of them."""

import json
import re
from pathlib import Path

import pytest
from cli_helper import rapidsim

from rapidsim.report.run.assertion_figures import ASKED_FIGURES

DOCS = Path(__file__).parents[2] / "docs"
CELL = """MODULE cell
  CONST jointtarget a:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget b:=[[20,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS num parts := 0;
  VAR num count := 3;
  VAR num moves := 7;
  LOCAL VAR num hidden := 4;
  LOCAL VAR num list{3} := [1, 2, 3];
  VAR pos place;
  FUNC num pick()
    RETURN 1;
  ENDFUNC
  FUNC num doubled(num n)
    RETURN n * 2 * pick();
  ENDFUNC
  FUNC num goes()
    MoveAbsJ a,v100,fine,tool0;
    RETURN 1;
  ENDFUNC
  LOCAL PROC pause()
    WaitTime 1;
  ENDPROC
  FUNC num waits()
    pause;
    RETURN 1;
  ENDFUNC
  PROC main()
    count := count + pick();
    Incr parts;
    place := [1, 2, count];
    SetDO doGrip, 1;
    MoveAbsJ b,v100,fine,tool0;
    MoveAbsJ a,v100,fine,tool0;
    WaitTime 0.5;
  ENDPROC
  PROC half()
    WaitTime 0.5;
    Stop;
  ENDPROC
  PROC broken()
    count := list{count + 1};
  ENDPROC
  PROC endless()
    WHILE TRUE DO
      WaitTime 1;
    ENDWHILE
  ENDPROC
ENDMODULE
"""
STATION = """[signals]
doGrip = { type = "do" }
diPart = { type = "di", value = 1 }
"""


@pytest.fixture
def cell(tmp_path: Path) -> Path:
    (tmp_path / "cell.mod").write_text(CELL)
    (tmp_path / "rapidsim.toml").write_text(STATION)
    return tmp_path


def asserting(folder: Path, *expressions: str, options: tuple[str, ...] = ()) -> list[str]:
    asked = [part for one in expressions for part in ("--assert", one)]
    return ["run", str(folder / "cell.mod"), "--no-record", *options, *asked]


def test_what_holds_ends_with_0(cell: Path) -> None:
    holding = (
        "time_s < 10 AND motion_s + 0.5 < time_s",
        "count = 4 AND hidden = 4 AND list{2} = 2 AND place.z = count",
        "parts = 1",
        "doGrip = 1 AND DOutput(doGrip) = 1 AND diPart = 1 AND DInput(diPart) = 1",
        "Abs(-count) = 4 AND Dim(list, 1) = 3",
        "warnings = 0 AND unsimulated = 0 AND corner_path_failures = 0",
        "margin_deg > 5 AND smallest_singular_value > 0.01 AND path_mm > 100",
        "t_rob1: count = 4",
        "pick() = 1 AND doubled(count) = 8",
    )
    ended = rapidsim(*asserting(cell, *holding), cwd=cell)
    assert ended.code == 0, ended.out
    assert ended.out.count("assertion holds: ") == len(holding)


def test_what_fails_ends_with_4_and_shows_its_values(cell: Path) -> None:
    ended = rapidsim(
        *asserting(
            cell, "count = 5 OR hidden > count", "Abs(count - list{1}) > 3", "list{count}=1"
        ),
        cwd=cell,
    )
    assert ended.code == 4
    assert "assertion failed: count = 5 OR hidden > count, count is 4, hidden is 4\n" in ended.out
    assert (
        "assertion failed: Abs(count - list{1}) > 3, Abs(count - list{1}) is 3, "
        "count is 4, list{1} is 1\n" in ended.out
    )
    assert "assertion failed: list{count}=1, index 4 is outside the array" in ended.out


def test_json_tells_each_assertion_and_keeps_standard_output_clean(cell: Path) -> None:
    options = ("--format", "json")
    ended = rapidsim(*asserting(cell, "time_s < 1", "parts = 1", options=options), cwd=cell)
    assert ended.code == 4
    report = json.loads(ended.out)
    failed, held = report["assertions"]
    assert (failed["expression"], failed["task"], failed["holds"]) == (
        "time_s < 1",
        "T_ROB1",
        False,
    )
    assert float(failed["values"]["time_s"]) == pytest.approx(report["time_s"], rel=1e-5)
    assert (held["holds"], held["values"], held["reason"]) == (True, {"parts": "1"}, None)
    assert report["cycle_budget"] is None
    assert ended.err.startswith("assertion failed: time_s < 1, time_s is ")
    plain = rapidsim(*asserting(cell, "time_s < 1", options=("--format", "none")), cwd=cell)
    assert (plain.code, plain.out) == (4, "")
    assert plain.err.startswith("assertion failed: ")


@pytest.mark.parametrize(
    ("expression", "caret", "message", "cure"),
    [
        ("tme_s < 3", "^^^^^", "`tme_s` is not declared", "did you mean `time_s`?"),
        ("cuont = 4", "^^^^^", "`cuont` is not declared", "did you mean `count`?"),
        ("zebra = 4", "^^^^^", "`zebra` is not declared", "path_mm"),
        ("Absx(count) = 4", "^^^^", "`Absx` is not declared", "`Abs`"),
        ("DOutput(doGrp) = 1", "        ^^^^^", "no signal|has a signal `doGrp`", "`doGrip`"),
        ("count + 1", "^^^^^^^^^", "takes bool, not num", ""),
        ("count =", "      ^", "an expression is missing", ""),
        ("count = 4 count", "         ^", "is missing after", ""),
        ("TRUE; count := 9", "", "one expression is expected", ""),
        ("TRUE; ENDFUNC PROC x() Stop", "", "", ""),
        ("", "", "one expression is expected", ""),
        ("goes() = 1", "", "`goes` has effects: it reaches `MoveAbsJ`", ""),
        ("waits() = 1", "", "`waits` has effects: it reaches `WaitTime`", ""),
        ("UINumEntry() = 1", "", "`UINumEntry` does more than look", ""),
        ("T_ROB2: count = 4", "", "there is no task `T_ROB2`", "T_ROB1"),
    ],
)
def test_a_mistake_is_told_before_the_run(
    cell: Path, expression: str, caret: str, message: str, cure: str
) -> None:
    ended = rapidsim(*asserting(cell, expression), "--trace", "t.csv", cwd=cell)
    assert (ended.code, ended.out) == (2, "")
    assert re.search(message, ended.err.partition("error: --assert")[2])
    assert not caret or f"  | {caret}\n" in ended.err
    assert cure in ended.err
    assert not (cell / "t.csv").exists()


def test_a_name_of_the_program_hides_the_figure_and_the_run_says_so(cell: Path) -> None:
    ended = rapidsim(*asserting(cell, "moves = 7"), cwd=cell)
    assert ended.code == 0
    assert "note: --assert: `moves` is the program's own here" in ended.err


@pytest.mark.parametrize(
    ("options", "code", "reason"),
    [
        (("--proc", "endless", "--max-time", "3"), 3, "the run was cut off"),
        (("--proc", "broken"), 1, "the run stopped with an error"),
    ],
)
def test_a_run_without_its_end_is_not_judged(
    cell: Path, options: tuple[str, ...], code: int, reason: str
) -> None:
    json_too = (*options, "--format", "json")
    ended = rapidsim(*asserting(cell, "count = 99", options=json_too), cwd=cell)
    assert ended.code == code
    (verdict,) = json.loads(ended.out)["assertions"]
    assert (verdict["holds"], verdict["reason"]) == (None, reason)
    assert ended.err == f"assertion not evaluated: count = 99, {reason}\n"


def test_what_the_program_stopped_itself_at_is_judged(cell: Path) -> None:
    asked = asserting(cell, "time_s = 0.5", "count = 99", options=("--proc", "half"))
    assert rapidsim(*asked[:-2], cwd=cell).code == 0
    assert rapidsim(*asked, cwd=cell).code == 4


def test_the_cycles_asked_for_are_an_end_and_a_limit_before_them_is_none(cell: Path) -> None:
    options = ("--cycles", "3", "--format", "json")
    ended = rapidsim(*asserting(cell, "count = 6 AND parts = 3", options=options), cwd=cell)
    report = json.loads(ended.out)
    assert (ended.code, report["end"], report["assertions"][0]["holds"]) == (0, "cycle_limit", True)
    once = rapidsim(*asserting(cell, options=("--cycles", "1", "--format", "json")), cwd=cell)
    assert (once.code, json.loads(once.out)["end"]) == (0, "ended")
    cut = (*options, "--max-time", f"{report['time_s'] - 0.1}")
    ended = rapidsim(*asserting(cell, "count = 6", options=cut), cwd=cell)
    report = json.loads(ended.out)
    assert (ended.code, report["end"], report["assertions"][0]["holds"]) == (3, "time_limit", None)


@pytest.mark.parametrize(
    ("options", "over_s", "code", "holds", "said"),
    [
        ((), -0.001, 0, True, "cycle budget kept: the cycle takes"),
        ((), 0.25, 4, False, "0.25 s over it"),
        (("--cycles", "2"), 0.25, 4, False, "each of 2 cycles takes"),
        (("--proc", "half"), 0.25, 0, None, "cycle budget not checked: it is about `main`"),
        (("--max-time", "1"), 0.25, 3, None, "cycle budget not checked: the run was cut off"),
    ],
)
def test_a_run_holds_the_cycle_budget(
    cell: Path, options: tuple[str, ...], over_s: float, code: int, holds: bool | None, said: str
) -> None:
    one = json.loads(rapidsim(*asserting(cell, options=("--format", "json")), cwd=cell).out)
    budget = f"[check]\ncycle-budget = {one['time_s'] - over_s!r}\n"
    (cell / "rapidsim.toml").write_text(STATION + budget)
    ended = rapidsim(*asserting(cell, options=options), cwd=cell)
    assert ended.code == code
    assert said in ended.out
    report = json.loads(
        rapidsim(*asserting(cell, options=(*options, "--format", "json")), cwd=cell).out
    )
    assert report["cycle_budget"]["holds"] is holds


LEFT = """MODULE Left
  VAR num n := 3;
  VAR num left_only := 5;
  PERS num shared := 1;
  PROC main()
    n := 7;
    shared := 9;
    SetDO doA, 1;
    WaitTime 2;
  ENDPROC
ENDMODULE
"""
WATCH = """MODULE Watch
  VAR num n := 3;
  VAR num turns := 0;
  PERS num shared := 1;
  PROC main()
    WHILE TRUE DO
      Incr turns;
      WaitTime 0.5;
    ENDWHILE
  ENDPROC
ENDMODULE
"""
TASKS = """[[task]]
name = "T_LEFT"
modules = ["Left.mod"]
[[task]]
name = "T_WATCH"
modules = ["Watch.mod"]
type = "semistatic"
motion = false
"""


def test_tasks_are_asked_for_what_they_know(tmp_path: Path) -> None:
    files = {"Left.mod": LEFT, "Watch.mod": WATCH, "rapidsim.toml": TASKS}
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    run = ["run", ".", "--no-record", "--format", "none"]

    def asked(*expressions: str) -> tuple[int, str]:
        options = [part for one in expressions for part in ("--assert", one)]
        ended = rapidsim(*run, *options, cwd=tmp_path)
        return ended.code, ended.err

    known = ("left_only = 5", "turns = 4", "shared = 9 AND doA = 1", "T_LEFT: n = 7", "time_s = 2")
    assert asked(*known, "T_WATCH:n = 3") == (0, "")
    code, error = asked("n = 7")
    assert code == 2
    assert "the tasks T_LEFT, T_WATCH may each answer it otherwise" in error
    assert "--assert 'T_LEFT:n = 7'" in error
    code, error = asked("left_only = turns")
    assert code == 2
    assert "is not declared; in the other task neither" in error


def test_the_page_for_ci_names_every_figure() -> None:
    page = (DOCS / "ci.md").read_text(encoding="utf-8")
    named = re.findall(r"^\| `(\w+)` \|", page, re.MULTILINE)
    assert named == list(ASKED_FIGURES)


def test_help_lists_the_exit_code() -> None:
    shown = " ".join(rapidsim("run", "--help").out.split())
    assert "4 an --assert or the cycle budget of the station file failed" in shown
