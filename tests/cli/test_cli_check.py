"""`rapidsim check`: exit codes, selection, JSON, encodings."""

import json
from pathlib import Path

import pytest
from cli_helper import rapidsim

WARNED = "MODULE a\n  PROC main()\n    Gripper_Open;\n  ENDPROC\nENDMODULE\n"
BROKEN = "MODULE a\n  PROC main()\n    parts:=1;\n  ENDPROC\nENDMODULE\n"


def test_the_exit_code_follows_the_failing_level(tmp_path: Path) -> None:
    (tmp_path / "a.mod").write_text(WARNED)
    assumed = ("check", "a.mod", "--assume-missing")
    assert rapidsim(*assumed, cwd=tmp_path).code == 1
    assert rapidsim(*assumed, "--fail-on", "error", cwd=tmp_path).code == 0
    assert rapidsim("check", "a.mod", "--fail-on", "error", cwd=tmp_path).code == 1
    (tmp_path / "a.mod").write_text(BROKEN)
    assert rapidsim("check", "a.mod", "--fail-on", "error", cwd=tmp_path).code == 1


def test_rules_are_selected_and_ignored(tmp_path: Path) -> None:
    (tmp_path / "a.mod").write_text(BROKEN)
    assert rapidsim("check", "a.mod", "--select", "T,F", cwd=tmp_path).code == 0
    assert rapidsim("check", "a.mod", "--select", "undefined-name", cwd=tmp_path).code == 1
    assert rapidsim("check", "a.mod", "--ignore", "N2", cwd=tmp_path).code == 0
    (tmp_path / "rapidsim.toml").write_text('[check]\nignore = ["N201"]\n')
    assert rapidsim("check", "a.mod", cwd=tmp_path).code == 0


def test_json() -> None:
    ended = rapidsim("check", "wrong.mod", "cell.mod", "--output-format", "json")
    assert (ended.code, ended.err) == (1, "")
    report = json.loads(ended.out)
    assert list(report) == ["schema", "ok", "qualifications", "files", "diagnostics", "coverage"]
    assert report["ok"] is False
    assert (report["schema"], report["files"]) == (1, 2)
    for diagnostic in report["diagnostics"]:
        assert diagnostic["severity"] in ("error", "warning", "note")
        assert diagnostic["line"] <= diagnostic["end_line"]
        assert {
            "code",
            "name",
            "message",
            "file",
            "column",
            "end_column",
            "related",
            "fix",
            "cf",
        } <= (set(diagnostic))
    coverage = report["coverage"]
    assert (coverage["moves"], coverage["checked"], len(coverage["unchecked"])) == (5, 0, 5)
    assert ended.out == rapidsim("check", "wrong.mod", "cell.mod", "--output-format", "json").out


def test_repeats_are_merged_unless_asked(tmp_path: Path) -> None:
    (tmp_path / "a.mod").write_text(WARNED.replace("Gripper_Open;", "Gripper_Open;" * 5))
    merged = json.loads(rapidsim("check", "a.mod", "--output-format", "json", cwd=tmp_path).out)
    [finding] = merged["diagnostics"]
    assert len(finding["repeats"]) == 4
    every = rapidsim("check", "a.mod", "--output-format", "json", "--no-merge", cwd=tmp_path).out
    assert len(json.loads(every)["diagnostics"]) == 5


@pytest.mark.parametrize("line_end", ["\n", "\r\n", "\r\r\n", "\r"])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "latin-1", "cp1252"])
def test_lines_and_columns_do_not_depend_on_bytes(
    encoding: str, line_end: str, tmp_path: Path
) -> None:
    text = "MODULE a\n  ! größer\n  PROC main()\n    parts:=1;\n  ENDPROC\nENDMODULE\n"
    (tmp_path / "a.mod").write_bytes(text.replace("\n", line_end).encode(encoding))
    ended = rapidsim(
        "check", "a.mod", "--ignore", "E106", "--output-format", "concise", cwd=tmp_path
    )
    assert ended.out.startswith("a.mod:4:5: error[N201]")


def test_a_backup_is_checked_task_by_task(tmp_path: Path) -> None:
    for task in ("TASK1", "TASK2"):
        folder = tmp_path / "RAPID" / task / "PROGMOD"
        folder.mkdir(parents=True)
        (folder / "main.mod").write_text("MODULE m\n  PROC main()\n  ENDPROC\nENDMODULE\n")
    ended = rapidsim("check", ".", cwd=tmp_path)
    assert (ended.code, ended.out.splitlines()[0][:32]) == (0, "Found nothing wrong in 2 files (")


def test_neighbours_are_named_when_a_name_is_missing(tmp_path: Path) -> None:
    (tmp_path / "main.mod").write_text(WARNED)
    (tmp_path / "CalibData.mod").write_text("MODULE CalibData\nENDMODULE\n")
    hint = "Modules next to it: CalibData.mod;"
    assert hint in rapidsim("check", "main.mod", cwd=tmp_path).out
    assert hint not in rapidsim("check", ".", cwd=tmp_path).out
    (tmp_path / "main.mod").write_text("MODULE a\n  PROC main()\n  ENDPROC\nENDMODULE\n")
    assert hint not in rapidsim("check", "main.mod", cwd=tmp_path).out


def test_modules_with_a_main_each_are_no_task(tmp_path: Path) -> None:
    for name in ("one", "two", "three"):
        (tmp_path / f"{name}.mod").write_text(
            f"MODULE {name}\n  VAR num n;\n  PROC main()\n    n:=1;\n  ENDPROC\nENDMODULE\n"
        )
    hint = "3 of the modules have a main, so they are no single task: `rapidsim init`"
    for command in ("check", "run"):
        ended = rapidsim(command, ".", cwd=tmp_path)
        assert (ended.code, hint in ended.out) == (1, True)
    names = ("one.mod", "two.mod", "three.mod")
    assert rapidsim("check", "--each", *names, cwd=tmp_path).code == 0
    rapidsim("init", ".", cwd=tmp_path)
    assert hint not in rapidsim("check", ".", cwd=tmp_path).out
