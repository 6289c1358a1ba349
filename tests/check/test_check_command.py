"""The command around the rules: suppression, settings, baseline, fixes, exit codes."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from rapidsim.cli.boundary import run_commands

BAD = """MODULE bad
  CONST robtarget p10:=[[600,0,600],[0,0,0.999,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    IF TRUE THEN
      WaitTime 1/0;
    ENDIF
    MoveJ p10,v500,fine,tool0;
  ENDPROC
ENDMODULE
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("NO_COLOR", raising=False)
    (tmp_path / "bad.mod").write_text(BAD)
    return tmp_path


class Check:
    """Runs `rapidsim check` without reach in this process."""

    def __init__(self, capsys: pytest.CaptureFixture[str]) -> None:
        self._capsys = capsys
        self.code = 0
        self.out = self.err = ""

    def __call__(self, *arguments: str) -> list[str]:
        """The codes that were found, in order."""
        json_wanted = not any(a.startswith(("--diff", "--output", "--stat")) for a in arguments)
        format = ("--output-format", "json") if json_wanted else ()
        self.code = run_commands(["check", "bad.mod", "--no-reach", *format, *arguments])
        self.out, self.err = self._capsys.readouterr()
        if not json_wanted or self.code == 2:
            return []
        return [finding["code"] for finding in json.loads(self.out)["diagnostics"]]


@pytest.fixture
def check(capsys: pytest.CaptureFixture[str], folder: Path) -> Check:
    return Check(capsys)


def test_comments_take_findings_back(check: Check, folder: Path) -> None:
    assert check() == ["M501", "F402", "T309"]
    text = BAD.replace("1/0;", "1/0; ! rapidsim: ignore[T309] a test")
    text = text.replace(
        "    IF TRUE", "    ! RapidSim: ignore[constant-condition, F4]\n    IF TRUE"
    )
    (folder / "bad.mod").write_text(text)
    assert check() == ["M501"]
    (folder / "bad.mod").write_text(text.replace("1/0;", "1;"))
    assert check() == ["M501", "E160"]
    # What nobody looked for is no useless comment.
    assert check("--ignore", "T3") == ["M501"]
    assert check("--select", "M,E") == ["M501"]
    # Without the robot nobody knows whether a comment about reach is of use.
    reach = BAD.replace("tool0;", "tool0; ! rapidsim: ignore[K601, unreachable-target]")
    (folder / "bad.mod").write_text(reach)
    assert "E160" not in check()
    (folder / "bad.mod").write_text(f"! rapidsim: ignore-file\n{BAD}")
    assert (check(), check.code) == ([], 0)


@pytest.mark.parametrize(
    ("file", "table"), [("rapidsim.toml", "check"), ("pyproject.toml", "tool.rapidsim.check")]
)
def test_settings_stand_in_the_station_or_the_project(
    file: str, table: str, check: Check, folder: Path
) -> None:
    settings = folder / file
    settings.write_text(f'[{table}]\nignore = ["M5"]\n')
    assert check() == ["F402", "T309"]
    settings.write_text(f'[{table}]\nselect = ["T"]\nextend-select = ["S910", "F402"]\n')
    assert check() == ["F402", "T309"]
    assert check("--select", "M") == ["M501", "F402"]
    settings.write_text(f'[{table}.per-file-ignores]\n"*.mod" = ["F", "T"]\n"*.sys" = ["M"]\n')
    assert check() == ["M501"]
    settings.write_text(f'[{table}]\nfail-on = "error"\n')
    check()
    assert check.code == 0
    check("--fail-on", "warning")
    assert check.code == 1
    settings.write_text(f'[{table}]\nignore = ["F999"]\n')
    assert check() == []
    assert (check.code, "there is no rule `F999`" in check.err) == (2, True)
    settings.write_text(f'[{table}]\nignored = ["F4"]\n')
    check()
    assert (check.code, "no such key" in check.err) == (2, True)


def test_a_baseline_hides_what_was_there_wherever_it_moves(check: Check, folder: Path) -> None:
    baseline = ("--baseline", "known.json")
    assert (check(*baseline), check.code) == ([], 0)
    written = (folder / "known.json").read_text()
    assert json.loads(written)["findings"][0] == {
        "code": "F402",
        "routine": "main",
        "statement": "IF TRUE THEN",
        "count": 1,
    }
    moved = BAD.replace("MODULE bad\n", "MODULE bad\n\n  ! moved\n").replace("    IF", "   IF  ")
    (folder / "bad.mod").write_text(moved)
    assert check(*baseline) == []
    (folder / "bad.mod").write_text(moved.replace("WaitTime 1/0;", "WaitTime 1/0; Incr reg1;"))
    assert check(*baseline) == ["T309"]
    assert (folder / "known.json").read_text() == written
    assert check(*baseline, "--update-baseline") == []
    assert "Incr" in (folder / "known.json").read_text()
    (folder / "known.json").write_text("{}")
    check(*baseline)
    assert (check.code, "is not a baseline" in check.err) == (2, True)
    check("--update-baseline")
    assert check.code == 2


def test_a_baseline_of_another_motion_model_is_told_where_times_count(
    check: Check, folder: Path
) -> None:
    told = ("--baseline", "known.json", "--output-format", "concise")
    check(*told)
    known = folder / "known.json"
    made = json.loads(known.read_text())
    assert made["motion_model"] == "3"
    del made["motion_model"]  # as version 0.1 wrote it
    known.write_text(json.dumps(made))
    check(*told)
    assert "motion model" not in check.out
    made["findings"].append({"code": "D701", "routine": "main", "statement": "", "count": 1})
    known.write_text(json.dumps(made))
    check(*told)
    assert "The baseline was made with motion model 1; this is 3" in check.out
    check(*told, "--update-baseline")
    assert "motion model" not in check.out


def test_a_baseline_that_is_made_is_named(check: Check, folder: Path) -> None:
    told = ("--baseline", "known.json", "--output-format", "concise")
    check(*told)
    assert "Found nothing new in 1 file" in check.out
    assert "3 more are in the baseline.\nWritten: known.json (baseline)\n" in check.out
    check(*told)
    assert "Written" not in check.out


def test_two_programs_in_one_task_are_told_apart_from_two_names(check: Check, folder: Path) -> None:
    for name in ("one", "two"):
        (folder / f"{name}.mod").write_text(
            f"MODULE {name}\nPROC main()\nENDPROC\nPROC same()\nENDPROC\nENDMODULE\n"
        )
    check("one.mod", "two.mod", "--output-format", "full")
    said = check.out.split("error[")
    assert all("form one task" in one for one in said if "`main` is declared twice" in one)
    assert [("LOCAL" in one) for one in said if "`same` is declared twice" in one] == [True]


def test_two_equal_findings_need_two_in_the_baseline(check: Check, folder: Path) -> None:
    check("--baseline", "known.json")
    (folder / "bad.mod").write_text(
        BAD.replace("      WaitTime 1/0;\n", "      WaitTime 1/0;\n" * 2)
    )
    assert check("--baseline", "known.json") == ["T309"]


@pytest.mark.parametrize("line_end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp1252", "utf-16"])
def test_fixes_change_what_they_mean_and_no_other_byte(
    encoding: str, line_end: str, check: Check, folder: Path
) -> None:
    text = BAD.replace("MODULE bad\n", "MODULE bad\n  ! Größe\n").replace("IF TRUE", "if TRUE")
    before = text.replace("\n", line_end).encode(encoding)
    (folder / "bad.mod").write_bytes(before)
    fixes = ("--extend-select", "S901")
    check("--diff", *fixes)
    assert (check.code, (folder / "bad.mod").read_bytes()) == (1, before)
    assert "-    if TRUE THEN\n+    IF TRUE THEN\n" in check.out
    assert check("--fix", *fixes) == ["F402", "T309"]
    fixed = text.replace("if TRUE", "IF TRUE").replace("0.999", "1")
    assert (folder / "bad.mod").read_bytes() == fixed.replace("\n", line_end).encode(encoding)
    check("--diff", *fixes)
    assert (check.code, check.out) == (0, "")


def test_unsafe_fixes_are_only_applied_when_asked(check: Check, folder: Path) -> None:
    text = BAD.replace("v500,fine,tool0;", "v500,z50,tool0;\n    WaitTime 1;")
    (folder / "bad.mod").write_text(text)
    assert "M502" in check("--fix")
    assert "M502" not in check("--fix", "--unsafe-fixes")
    assert "v500,fine,tool0" in (folder / "bad.mod").read_text()
    check("--unsafe-fixes")
    assert check.code == 2


def test_line_ends_doubled_by_a_transfer_are_cured(check: Check, folder: Path) -> None:
    (folder / "bad.mod").write_bytes(BAD.replace("\n", "\r\r\n").encode())
    assert "E106" not in check("--fix")
    fixed = BAD.replace("0.999", "1").replace("\n", "\r\n")
    assert (folder / "bad.mod").read_bytes() == fixed.encode()


def test_an_input_that_the_station_never_sets_is_found(check: Check, folder: Path) -> None:
    (folder / "bad.mod").write_text(
        """MODULE bad
  PROC main()
    WaitDI diPart,1\\MaxTime:=9;
    WaitDI diDoor,0\\MaxTime:=9;
    WaitDI diOther,1\\MaxTime:=9;
  ENDPROC
ENDMODULE
"""
    )
    station = folder / "rapidsim.toml"
    signals = '[signals]\ndiPart = { type = "di" }\ndiDoor = { type = "di" }\n'
    station.write_text(signals)
    assert check() == ["I803", "I801"]
    station.write_text(f"{signals}[[stimulus]]\nat = 1\nset = {{ DIPART = 1 }}\n")
    assert check() == ["I801"]
    station.write_text("[robot]\n")
    assert check() == ["I801"]


def test_an_arm_that_nobody_named_makes_no_errors(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    far = BAD.replace("[600,0,600],[0,0,0.999,0]", "[9000,0,600],[0,0,1,0]")
    (folder / "bad.mod").write_text(far)
    arguments = ["check", "bad.mod", "--select", "K601", "--output-format", "json"]

    def severities(*more: str) -> list[str]:
        run_commands([*arguments, *more])
        report = json.loads(capsys.readouterr().out)
        return [finding["severity"] for finding in report["diagnostics"]]

    assert severities() == ["warning"]
    assert severities("--robot", "irb1600") == ["error"]
    (folder / "rapidsim.toml").write_text('[robot]\nmodel = "irb1600"\n')
    assert severities() == ["error"]


def test_statistics_count_rules(check: Check, folder: Path) -> None:
    (folder / "bad.mod").write_text(BAD.replace("1/0", "1/0+2/0"))
    check("--statistics")
    assert [line.split()[:2] for line in check.out.splitlines()[:3]] == [
        ["2", "T309"],
        ["1", "F402"],
        ["1", "M501"],
    ]


@pytest.mark.parametrize("format", ["sarif", "github", "junit"])
def test_formats_for_tools_hold_nothing_else(format: str, check: Check, folder: Path) -> None:
    check("--output-format", format)
    assert check.code == 1
    assert "Found" not in check.out
    assert check.out.count("F402")
    first = check.out
    check("--output-format", format)
    assert check.out == first


def test_a_misspelt_signal_of_the_station_file_is_found(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "bad.mod").write_text(
        "MODULE bad\n  PROC main()\n    WaitDI diPart,1\\MaxTime:=9;\n    Set doGo;\n  ENDPROC\n"
        "ENDMODULE\n"
    )
    (folder / "rapidsim.toml").write_text(
        "[signals]\n"
        'diPart = { type = "di" }\n'
        'doGo = { type = "do" }\n'
        "[[cross]]\n"
        'set = "inner"\n'
        'from = "doGo and not diFualt"\n'
        "[[stimulus]]\n"
        'when = "inner = 1"\n'
        "set = { diPrat = 1, diPart = 1 }\n"
    )
    assert run_commands(["check", str(folder), "--output-format", "json"]) == 1
    found = json.loads(capsys.readouterr().out)["diagnostics"]
    told = [(one["code"], one["line"], one["help"]) for one in found if one["code"] == "I804"]
    assert told == [
        ("I804", 6, "declare it in [signals] if the name is intended"),
        ("I804", 9, "did you mean `diPart`?"),
    ]
