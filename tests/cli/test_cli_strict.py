"""What nobody declares, assumed on request; and strictness: any reservation fails."""

import json
from pathlib import Path

import pytest
from command_line import call

import rapidsim
from rapidsim.jobs.running.run_files import ProgramRejectedError

LACKS = r"""MODULE m
  PROC main()
    VAR num n;
    FOR i FROM 1 TO 3 DO
      OpenGripper i;
    ENDFOR
    n:=Sensor(1);
    IF diDoor=1 AND partReady=1 TPWrite "both";
    IF partReady=0 TPWrite "no part";
  ENDPROC
ENDMODULE
"""
HEADLINE = "4 calls of 2 unknown routines skipped; 2 undeclared signals assumed"
SOFT = "MODULE m\n  PROC main()\n    CapNoProcess 1;\n    CapNoProcess 2;\n  ENDPROC\nENDMODULE\n"
ACCEPTED = "MODULE m\n  PROC main()\n    MotionSup\\Off;\n  ENDPROC\nENDMODULE\n"
UNCHECKED = """MODULE m
  CONST robtarget p:=[[600,0,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
  ENDPROC
  PROC go(robtarget where)
    MoveJ where,v100,fine,tool0;
  ENDPROC
ENDMODULE
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "m.mod").write_text(LACKS)
    return tmp_path


def test_what_nobody_declares_is_an_error_in_every_command(folder: Path) -> None:
    for command in ("check", "run"):
        ended = call(command, "m.mod", "--no-record" if command == "run" else "-q", cwd=folder)
        assert ended.code == 1
        assert "error[N209]" in ended.out
    with pytest.raises(ProgramRejectedError, match="`OpenGripper` is not declared"):
        rapidsim.load(folder / "m.mod").run(home=folder)


@pytest.mark.parametrize("by", ["option", "station"])
def test_on_request_it_is_skipped_and_counted(by: str, folder: Path) -> None:
    option = ["--assume-missing"] if by == "option" else []
    if by == "station":
        (folder / "rapidsim.toml").write_text("[check]\nassume-missing = true\n")
    ended = call("run", "m.mod", "--no-record", *option, cwd=folder)
    assert ended.code == 0
    assert HEADLINE in " ".join(ended.out.split())
    assert "as programmed" not in ended.out
    report = json.loads(
        call("run", "m.mod", "--no-record", "--format", "json", *option, cwd=folder).out
    )
    assert report["ok"] is True
    assert "; ".join(report["qualifications"]) == HEADLINE
    assert report["skipped"] == [
        {"name": "OpenGripper", "count": 3},
        {"name": "Sensor", "count": 1},
    ]
    html = folder / "r.html"
    call("run", "m.mod", "--no-record", "--report", html.name, *option, cwd=folder)
    assert HEADLINE in html.read_text("utf-8")
    checked = call("check", "m.mod", "--output-format", "json", *option, cwd=folder)
    found = {(one["code"], one["severity"]) for one in json.loads(checked.out)["diagnostics"]}
    assert {("N209", "warning"), ("I801", "warning")} <= found
    assert "error" not in {severity for _, severity in found}


def test_python_does_the_same(folder: Path) -> None:
    run = rapidsim.load(folder / "m.mod", assume_missing=True).run(home=folder)
    assert (run.ok, run.skipped) == (True, {"OpenGripper": 3, "Sensor": 1})
    assert run.headline == f"ended after {run.time_s:.3f} s; {HEADLINE}"
    strict = rapidsim.load(folder / "m.mod", assume_missing=True, strict=True)
    assert strict.run(home=folder).ok is False


@pytest.mark.parametrize(
    ("program", "run_says", "check_says"),
    [
        (SOFT, ["2 calls of CapNoProcess not simulated"], ["1 routine not simulated"]),
        (ACCEPTED, [], []),
        (UNCHECKED, [], ["1 of 1 moves not checked"]),
    ],
)
def test_strictness_fails_on_reservations(
    program: str, run_says: list[str], check_says: list[str], tmp_path: Path
) -> None:
    (tmp_path / "m.mod").write_text(program)
    fails_on_errors = ("--fail-on", "error")
    for strict in (False, True):
        option = ["--strict"] if strict else []
        ended = call("run", "m.mod", "--no-record", "--format", "json", *option, cwd=tmp_path)
        report = json.loads(ended.out)
        assert report["qualifications"] == run_says
        assert report["ok"] is (ended.code == 0) is not (strict and run_says)
        arguments = ("--output-format", "json", *fails_on_errors, *option)
        ended = call("check", "m.mod", *arguments, cwd=tmp_path)
        report = json.loads(ended.out)
        assert report["qualifications"] == check_says
        assert report["ok"] is (ended.code == 0) is not (strict and check_says)
    (tmp_path / "rapidsim.toml").write_text("[check]\nstrict = true\n")
    assert call("check", "m.mod", *fails_on_errors, cwd=tmp_path).code == bool(check_says)
    found = rapidsim.load(tmp_path / "m.mod").check()
    assert not (found.ok and check_says)


def test_a_strict_check_says_why_it_fails(tmp_path: Path) -> None:
    (tmp_path / "m.mod").write_text(UNCHECKED)
    ended = call("check", "m.mod", "--strict", cwd=tmp_path)
    assert "Fails, because the check is strict: 1 of 1 moves not checked." in ended.out


def test_a_cell_that_declares_signals_has_no_others(tmp_path: Path) -> None:
    (tmp_path / "m.mod").write_text(
        "MODULE m\n  PROC main()\n    SetDO doGirp,1;\n  ENDPROC\nENDMODULE\n"
    )
    assert call("run", "m.mod", "--no-record", cwd=tmp_path).code == 0
    (tmp_path / "rapidsim.toml").write_text('[signals]\ndoGrip = { type = "do" }\n')
    ended = call("run", "m.mod", "--no-record", cwd=tmp_path)
    assert ended.code == 1
    assert "error[I801] unknown-signal: the signal `doGirp` is not declared\n" in ended.out
    assert "did you mean `doGrip` by `doGirp`?" in ended.out
    assert call("run", "m.mod", "--no-record", "--assume-missing", cwd=tmp_path).code == 0


def test_modules_that_a_program_file_lists_may_be_absent(folder: Path) -> None:
    text = LACKS.replace("IF diDoor=1 AND partReady=1", "IF diDoor=1").replace(
        "partReady", "diDoor"
    )
    (folder / "m.mod").write_text(text)
    (folder / "p.pgf").write_text(
        "<Program><Module>m.mod</Module><Module>Vendor.sysx</Module></Program>"
    )
    ended = call("run", "p.pgf", "--no-record", cwd=folder)
    assert ended.code == 0
    assert "may be declared in Vendor.sysx (listed by p.pgf, not next to it)" in ended.out
    assert "4 calls of 2 unknown routines skipped" in " ".join(ended.out.split())


@pytest.mark.parametrize("command", ["check", "run"])
def test_what_init_writes_for_a_program_with_missing_modules_runs(
    command: str, folder: Path
) -> None:
    assert call("init", "m.mod", cwd=folder).code == 0
    text = (folder / "rapidsim.toml").read_text("utf-8")
    assert "# OpenGripper, Sensor\nassume-missing = true\n" in text
    assert 'partReady = { type = "di" }' in text
    ended = call(command, "m.mod", "--no-record" if command == "run" else "-q", cwd=folder)
    assert "error[" not in ended.out
    if command == "run":
        assert ended.code == 0


@pytest.mark.parametrize(
    ("station", "body", "phrase"),
    [
        ("[check]\ncycle-budget = 5\n", "EXIT;", "1 of 1 assertions not evaluated"),
        (
            '[[object]]\nname = "vice"\nbox = [100, 100, 100]\nparent = "wobj:wVice"\n',
            "WaitTime 1;",
            "1 part of the cell not checked for collisions",
        ),
    ],
)
def test_a_strict_run_fails_on_what_was_not_judged(
    station: str, body: str, phrase: str, tmp_path: Path
) -> None:
    (tmp_path / "m.mod").write_text(f"MODULE m\n  PROC main()\n    {body}\n  ENDPROC\nENDMODULE\n")
    (tmp_path / "rapidsim.toml").write_text(station)
    run = ("run", "m.mod", "--no-record", "--format", "json")
    assert call(*run, cwd=tmp_path).code == 0
    ended = call(*run, "--strict", cwd=tmp_path)
    assert (ended.code, json.loads(ended.out)["ok"]) == (1, False)
    text = " ".join(call(*run[:3], "--strict", cwd=tmp_path).out.split())
    assert phrase in text
