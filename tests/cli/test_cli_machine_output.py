"""With `--format json` each command prints one object that its schema accepts, whatever happens."""

import json
from collections.abc import Iterator
from pathlib import Path
from unittest.mock import patch

import pytest
from command_line import Ended, call
from jsonschema import Draft202012Validator
from laws import cases as cases_of
from machine_output_cases import Case, cases, machine_commands, write_files

import rapidsim
from rapidsim.cli.boundary import run_commands
from rapidsim.cli.group import commands
from rapidsim.cli.machine_output import is_json_requested

SCHEMAS = {
    "run": ("run",),
    "check": ("check",),
    "diff": ("diff",),
    "frames": ("frames",),
    "robots": ("robots", "robot"),
    "calibrate": ("calibrate",),
    "protocol": ("protocol",),
    "follow": ("follow", "follow-compare"),
    "kin fk": ("kin-fk",),
    "kin ik": ("kin-ik",),
    "kin jacobian": ("kin-jacobian",),
}
"""The schemas of what a command prints."""
CODES = {0, 1, 2, 3, 4}


def faults(case: Case, ended: Ended) -> list[str]:
    """What is wrong with an answer."""
    try:
        printed = json.loads(ended.out)
    except ValueError as error:
        return [f"no JSON: {error}: {ended.out[:200]!r}"]
    if not isinstance(printed, dict):
        return ["no object"]
    found = [] if ended.code in CODES else [f"exit code {ended.code}: {ended.err[-300:]}"]
    limited = {2, 3} if "--max-wall" in case.words else {2}
    if "error" in printed and ended.code not in limited:
        found.append(f"an error with exit code {ended.code}")
    if ended.code == 2 and "error" not in printed:
        found.append("exit code 2 without an error")
    if printed.keys() == {"schema", "error"}:
        names: tuple[str, ...] = ("error", *SCHEMAS[case.command])
        mistakes = [next(_mistakes(name, printed), "") for name in names]
    else:
        # One of several forms.
        mistakes = [min(next(_mistakes(name, printed), "") for name in SCHEMAS[case.command])]
    return found + [mistake for mistake in mistakes if mistake]


def _mistakes(name: str, printed: object) -> Iterator[str]:
    validator = Draft202012Validator(rapidsim.json_schema(name))
    return (
        f"{name}: {one.json_path}: {one.message[:200]}" for one in validator.iter_errors(printed)
    )


def test_every_command_with_a_format_has_its_schemas() -> None:
    assert {" ".join(words) for words, _ in machine_commands()} == set(SCHEMAS)


@pytest.mark.parametrize("number", range(cases_of(40)))
def test_any_options_give_one_object(number: int, tmp_path: Path) -> None:
    write_files(tmp_path)
    wrong = []
    for case in cases(number, 12):
        ended = call(*case.words, cwd=tmp_path)
        wrong += [(" ".join(case.words), fault) for fault in faults(case, ended)]
        write_files(tmp_path)
    assert not wrong


@pytest.mark.parametrize(
    ("words", "message", "similar"),
    [
        (("run", "nix.mod"), "nix.mod does not exist", []),
        (("run", "job.mod", "--fromat", "x"), "there is no option `--fromat`", ["--format"]),
        (("run", "jbo.mod"), "jbo.mod does not exist", ["job.mod"]),
        (("check",), "PATH... is missing", []),
        (("check", "job.mod", "--select", "K9999"), None, []),
        (("run", "job.mod", "--robot", "irb1601"), None, ["irb1600"]),
        (("run", "job.mod", "--proc", "mian"), None, ["main"]),
        (("kin", "fk", "--joints", "1,2"), None, []),
        (("robots", "irb121"), None, ["irb120"]),
    ],
)
def test_an_error_of_use_is_an_object(
    words: tuple[str, ...], message: str | None, similar: list[str], tmp_path: Path
) -> None:
    (tmp_path / "job.mod").write_text("MODULE job\n  PROC main()\n  ENDPROC\nENDMODULE\n")
    ended = call(*words, "--format", "json", cwd=tmp_path)
    printed = json.loads(ended.out)
    Draft202012Validator(rapidsim.json_schema("error")).validate(printed)
    assert (ended.code, list(printed)) == (2, ["schema", "error"])
    assert printed["error"]["message"] == message or message is None
    assert printed["error"]["similar"][: len(similar)] == similar
    assert printed["error"]["message"].splitlines()[0] in ended.err


def test_a_file_that_cannot_be_written_is_said_beside_the_run(tmp_path: Path) -> None:
    (tmp_path / "job.mod").write_text("MODULE job\n  PROC main()\n  ENDPROC\nENDMODULE\n")
    with patch("rapidsim.export.events.write_events", side_effect=rapidsim.InputError("full")):
        ended = call(
            *("run", "job.mod", "--no-record", "--events", "e.jsonl", "--format", "json"),
            cwd=tmp_path,
        )
    printed = json.loads(ended.out)
    Draft202012Validator(rapidsim.json_schema("run")).validate(printed)
    assert (ended.code, printed["end"]) == (2, "ended")
    assert printed["error"] == {"message": "full", "help": "", "similar": []}


def test_ctrl_c_is_an_object(tmp_path: Path) -> None:
    with (
        patch.object(commands, "invoke", side_effect=KeyboardInterrupt(" after 3 s")),
        pytest.raises(KeyboardInterrupt),
    ):
        call("run", "job.mod", "--format", "json", cwd=tmp_path)


def test_ctrl_c_prints_what_was_reached(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with patch.object(commands, "invoke", side_effect=KeyboardInterrupt(" after 3 s")):
        code = run_commands(["run", "job.mod", "--format", "json"])
    printed = json.loads(capsys.readouterr().out)
    assert (code, printed["error"]["message"]) == (130, "interrupted after 3 s")


def test_a_defect_is_an_object(tmp_path: Path) -> None:
    with patch.object(commands, "invoke", side_effect=KeyError("lost")):
        ended = call("run", "job.mod", "--format", "json", cwd=tmp_path)
    assert ended.code == 70
    assert "has a defect" in json.loads(ended.out)["error"]["message"]


def test_help_is_text_in_an_object(tmp_path: Path) -> None:
    ended = call("run", "--format", "json", "--help", cwd=tmp_path)
    printed = json.loads(ended.out)
    assert ended.code == 0
    assert printed["text"].startswith("Usage: rapidsim run")


@pytest.mark.parametrize(
    ("words", "wants"),
    [
        (("run", "--format", "json"), True),
        (("run", "--format=json"), True),
        (("check", "--output-format", "json"), True),
        (("run", "--format", "json", "--format", "table"), False),
        (("run", "--format"), False),
        (("run", "--", "--format", "json"), False),
    ],
)
def test_the_words_say_whether_json_is_wanted(words: tuple[str, ...], wants: bool) -> None:
    assert is_json_requested(words) is wants
