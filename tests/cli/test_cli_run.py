"""`rapidsim run`: what it prints, writes and ends with."""

import json
import re
from pathlib import Path

import pytest
from cli_helper import PROGRAMS, Ended, rapidsim

LOOP = (
    "MODULE a\n  PROC main()\n    WHILE TRUE DO\n      WaitTime 1;\n    ENDWHILE\n  ENDPROC\n"
    "ENDMODULE\n"
)
DIVIDES = "MODULE a\n  PROC main()\n    VAR num n:=0;\n    n:=1/n;\n  ENDPROC\nENDMODULE\n"
ASKS = (
    'MODULE a\n  PROC main()\n    VAR num n;\n    TPReadNum n,"How many?";\n'
    '    TPWrite "n is "\\Num:=n;\n  ENDPROC\nENDMODULE\n'
)
WRITES = (
    'MODULE a\n  PROC main()\n    VAR iodev log;\n    Open "HOME:"\\File:="log.txt",log\\Write;\n'
    '    Write log,"hello";\n    Close log;\n  ENDPROC\nENDMODULE\n'
)
FAR = (
    "MODULE a\n  CONST robtarget p:=[[5000,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
    "  PROC main()\n    MoveJ p,v100,fine,tool0;\n  ENDPROC\nENDMODULE\n"
)

LACKS = (
    "MODULE a\n  CONST robtarget p:=[[900,0,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
    "  PROC main()\n    MoveJ p,v100,fine,tGrip\\WObj:=wBox;\n  ENDPROC\nENDMODULE\n"
)


def run(folder: Path, text: str, *arguments: str, record: bool = False) -> Ended:
    (folder / "a.mod").write_text(text)
    return rapidsim("run", "a.mod", *(() if record else ("--no-record",)), *arguments, cwd=folder)


def report(folder: Path, text: str, *arguments: str) -> dict[str, object]:
    ended = run(folder, text, "--format", "json", *arguments)
    assert ended.err == ""
    loaded = json.loads(ended.out)
    assert isinstance(loaded, dict)
    return loaded


@pytest.mark.parametrize(
    ("text", "arguments", "code", "end"),
    [
        ("MODULE a\n  PROC main()\n  ENDPROC\nENDMODULE\n", (), 0, "ended"),
        ("MODULE a\n  PROC main()\n    EXIT;\n  ENDPROC\nENDMODULE\n", (), 0, "stopped"),
        (DIVIDES, (), 1, "error"),
        (FAR, (), 1, "error"),
        ("MODULE a\n  PROC main()\n    x:=;\n  ENDPROC\nENDMODULE\n", (), 1, "error"),
        (LOOP, ("--max-time", "20"), 3, "time_limit"),
    ],
)
def test_the_exit_code_says_how_it_ended(
    text: str, arguments: tuple[str, ...], code: int, end: str, tmp_path: Path
) -> None:
    ended = run(tmp_path, text, "--format", "json", *arguments)
    assert (ended.code, json.loads(ended.out)["end"]) == (code, end)


def test_the_summary_of_a_cell() -> None:
    ended = rapidsim("run", "cell.mod", "--no-record")
    assert (ended.code, ended.err) == (0, "")
    shown = " ".join(ended.out.split())
    assert "cell.mod on ABB IRB 1600-6/1.2 ended as programmed after" in shown
    assert "irb1600-6-1.2 (by default; --robot names another)" in shown
    assert "5 (3 MoveJ, 2 MoveL)" in shown
    assert "Done" in shown


def test_json_says_where_and_when() -> None:
    loaded = json.loads(rapidsim("run", "cell.mod", "--no-record", "--format", "json").out)
    assert [move["to"] for move in loaded["moves"]] == [
        "pHome",
        "pAbove",
        "pPick",
        "pAbove",
        "pHome",
    ]
    assert loaded["moves"][2]["length_mm"] == pytest.approx(180.0)
    assert loaded["moves"][2]["speed_mm_s"] == 100.0
    assert loaded["time_s"] > loaded["moves"][-1]["end_s"] - 0.5
    # The part lies in the tray's frame, turned by 30 degrees about z.
    x, y, z = loaded["moves"][2]["target"]["position_mm"]
    assert (x, y, z) == pytest.approx((616.9615, -109.3782, 220.0), abs=1e-3)


def test_files_are_written_and_named(tmp_path: Path) -> None:
    ended = rapidsim(
        "run",
        PROGRAMS / "cell.mod",
        *("--trace", "t.csv", "--dt", "0.1", "--events", "e.jsonl"),
        cwd=tmp_path,
    )
    assert ended.code == 0
    assert sorted(file.name for file in tmp_path.iterdir()) == ["cell.rrd", "e.jsonl", "t.csv"]
    assert re.fullmatch(
        r"Open the recording with: \S*rerun(\.exe)? cell\.rrd", ended.out.splitlines()[-1]
    )
    for name in ("cell.rrd", "t.csv", "e.jsonl"):
        assert name in ended.out
    assert (tmp_path / "t.csv").read_text().startswith("time_s,move,j1,")
    for line in (tmp_path / "e.jsonl").read_text().splitlines():
        assert "time_s" in json.loads(line)


def test_nothing_is_printed_when_not_asked(tmp_path: Path) -> None:
    assert (
        run(tmp_path, "MODULE a\n  PROC main()\n  ENDPROC\nENDMODULE\n", "--format", "none").out
        == ""
    )
    assert run(tmp_path, LOOP, "--max-time", "2", "-q").out == ""
    assert "division by zero" in run(tmp_path, DIVIDES, "-q").out


def test_answers_come_from_the_file_in_order(tmp_path: Path) -> None:
    (tmp_path / "answers.txt").write_text("# how many parts\n\n7\n")
    events = report(tmp_path, ASKS, "--answers", "answers.txt")["events"]
    assert "n is 7" in json.dumps(events)
    unanswered = report(tmp_path, ASKS)
    assert "R102" in json.dumps(unanswered["diagnostics"])


def test_home_is_a_folder_of_its_own_unless_named(tmp_path: Path) -> None:
    ended = run(tmp_path, WRITES)
    assert (tmp_path / "a.home" / "log.txt").read_text() == "hello\n"
    assert "a.home/log.txt (by the program)" in ended.out.replace("\\", "/")
    (tmp_path / "disk").mkdir()
    run(tmp_path, WRITES, "--home", "disk")
    assert (tmp_path / "disk" / "log.txt").read_text() == "hello\n"


def test_another_procedure_may_be_run_and_often() -> None:
    ended = rapidsim(
        *("run", "cell.mod", "--proc", "PICK", "--cycles", "2", "--no-record", "--format", "json")
    )
    assert len(json.loads(ended.out)["moves"]) == 6


def test_a_module_comes_from_standard_input(tmp_path: Path) -> None:
    module = b"MODULE a\n  PROC main()\n  ENDPROC\nENDMODULE\n"
    ended = rapidsim("run", "-", "--no-record", "--format", "json", stdin=module, cwd=tmp_path)
    assert json.loads(ended.out)["program"] == ["<stdin>"]


def test_the_station_decides_where_the_option_does_not(tmp_path: Path) -> None:
    (tmp_path / "rapidsim.toml").write_text(
        '[robot]\nmodel = "irb120"\n[motion]\nacceleration_time = 0.25\ncorner = "parabola"\n'
    )
    text = "MODULE a\n  PROC main()\n  ENDPROC\nENDMODULE\n"
    loaded = report(tmp_path, text)
    assert loaded["robot"] == "irb120-3-0.58"
    assert loaded["models"] == {
        **loaded["models"],  # type: ignore[dict-item]
        "acceleration": "axis acceleration = axis speed / 0.25 s",
        "corner": "parabola",
    }
    assert report(tmp_path, text, "--robot", "irb1600")["robot"] == "irb1600-6-1.2"


def test_modules_of_the_station_are_loaded_too(tmp_path: Path) -> None:
    (tmp_path / "lib.mod").write_text(
        'MODULE lib\n  PROC greet()\n    TPWrite "hi";\n  ENDPROC\nENDMODULE\n'
    )
    (tmp_path / "rapidsim.toml").write_text(
        '[[task]]\nname = "T_X"\nmodules = ["a.mod", "lib.mod"]\n'
    )
    loaded = report(tmp_path, "MODULE a\n  PROC main()\n    greet;\n  ENDPROC\nENDMODULE\n")
    assert loaded["program"] == ["a.mod", "lib.mod"]
    assert [event["task"] for event in loaded["events"]] == ["T_X"]  # type: ignore[attr-defined]


def test_a_run_points_at_the_target_as_a_check_does(tmp_path: Path) -> None:
    arm = ("--robot", "irb1600")
    diagnostics = report(tmp_path, FAR, *arm)["diagnostics"]
    assert isinstance(diagnostics, list)
    (found,) = diagnostics
    checked = rapidsim("check", "a.mod", "--output-format", "json", *arm, cwd=tmp_path)
    (told,) = json.loads(checked.out)["diagnostics"]
    same = ("code", "severity", "line", "column", "end_line", "end_column")
    assert [found[key] for key in same] == [told[key] for key in same]


def test_targets_that_functions_are_given_stand_in_the_work_object_of_their_move(
    tmp_path: Path,
) -> None:
    (tmp_path / "a.mod").write_text(
        "MODULE a\n  CONST robtarget p:=[[600,0,500],[0,0,1,0],[0,0,0,0],"
        "[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        '  PERS wobjdata w:=[FALSE,TRUE,"",[[100,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n'
        "  PROC main()\n    MoveJ Offs(p,0,0,5),v100,fine,tool0\\WObj:=w;\n  ENDPROC\nENDMODULE\n"
    )
    it = rapidsim("frames", "a.mod", "--format", "json", cwd=tmp_path)
    user = json.loads(it.out)["root"]["children"][-1]
    assert user["children"][0]["children"][0]["name"] == "p"


def test_tools_and_work_objects_that_are_missing_are_assumed_if_asked_for(tmp_path: Path) -> None:
    refused = run(tmp_path, LACKS)
    assert refused.code == 1
    assert "`tGrip` is not declared" in refused.out + refused.err
    found = report(tmp_path, LACKS, "--assume-missing")
    assert found["end"] == "ended"
    diagnostics = found["diagnostics"]
    assert isinstance(diagnostics, list)
    told = [one["message"] for one in diagnostics if one["code"] == "N220"]
    assert told == [
        "the tooldata `tGrip` is not declared; `tool0` is used instead",
        "the wobjdata `wBox` is not declared; `wobj0` is used instead",
    ]


COURSE = """MODULE a
  CONST robtarget p:=[[900,0,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num n;
  PROC main()
    MoveJ p,v500,fine,tool0;
    FOR i FROM 1 TO 2 DO
      SetDO doGrip,i MOD 2;
      WaitTime 0.25;
      TPWrite "part " \\Num:=i;
    ENDFOR
    MoveL Offs(p,0,0,100),v100,z10,tool0;
    MoveL p,v100,fine,tool0;
    n:=1/0*n;
  ENDPROC
ENDMODULE
"""


def test_verbose_prints_the_course_of_the_run_in_order_of_time(tmp_path: Path) -> None:
    (tmp_path / "rapidsim.toml").write_text('[signals]\ndoGrip = { type = "do" }\n')
    plain, verbose = run(tmp_path, COURSE), run(tmp_path, COURSE, "-v")
    said = [
        line.strip().split("  ", 2) for line in verbose.out.partition("happened\n")[2].splitlines()
    ]
    moves = [(place, re.sub(r"[0-9.]+ (s|mm)", r"# \1", what)) for _, place, what in said]
    assert moves == [
        ("a.mod:5", "MoveJ p: # s, # mm, stop"),
        ("a.mod:7", "doGrip = 1"),
        ("a.mod:8", "WaitTime # s: # s, ended by the time"),
        ("a.mod:9", "part 1"),
        ("a.mod:7", "doGrip = 0"),
        ("a.mod:8", "WaitTime # s: # s, ended by the time"),
        ("a.mod:9", "part 2"),
        ("a.mod:11", "MoveL Offs(p,0,0,100): # s, # mm, fly-by"),
        ("a.mod:12", "MoveL p: # s, # mm, stop"),
        ("a.mod:13", "ERR_DIVZERO: division by zero; ended the program"),
    ]
    times = [float(time_s) for time_s, _, _ in said]
    assert times == sorted(times)
    assert "happened" not in plain.out
