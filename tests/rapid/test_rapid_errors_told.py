"""No run ends with an error that no finding names, and `check` names the same one."""

import json
from pathlib import Path
from typing import Any

import pytest
from command_line import call
from rapid_promises import MODULES, ROBOT, promised, sources

from rapidsim.station.station import FILE_NAME

BOOK = Path(__file__).parent
PROGRAMS = [
    program
    for chapter in sorted(path for path in BOOK.iterdir() if path.is_dir())
    for program in sorted(chapter.iterdir())
    if program.is_dir() or program.suffix in MODULES
]
STOPPED = [
    program
    for program in PROGRAMS
    if any(
        kind == "stops" or (kind == "error" and text.startswith("M5"))
        for _, _, kind, text in promised(sources(program))
    )
]
WAITS = "R106"
"""A check cannot know that nobody ever sets an input: to it this is a warning."""

UNSURE = {"operator/key_timeout_again", "operator/number_uncaught"}
"""What a check cannot be sure of, and warns of: somebody may answer the question."""

Error = tuple[str, int, int, str, str]
"""File, line, column, code and words of an error."""


def name(program: Path) -> str:
    return f"{program.parent.name}/{program.stem}"


@pytest.mark.parametrize("program", STOPPED, ids=name)
def test_run_names_the_error_that_ends_it_and_check_the_same(program: Path, tmp_path: Path) -> None:
    robot = () if (program / FILE_NAME).exists() else ("--robot", ROBOT)
    run = call("run", program, *robot, "--no-record", "--format", "json", cwd=tmp_path)
    told = json.loads(run.out)
    errors = errors_of(told)
    assert (told["end"], run.code, len(errors)) == ("error", 1, 1)
    if name(program) in UNSURE:
        check = call("check", program, *robot, "--output-format", "json", cwd=tmp_path)
        assert errors_of(json.loads(check.out)) == []
    else:
        check = call("check", program, *robot, "--output-format", "json", cwd=tmp_path)
        assert check.code == 1
        assert errors_of(json.loads(check.out)) == errors


def errors_of(told: dict[str, Any]) -> list[Error]:
    return [
        (found["file"], found["line"], found["column"], found["code"], found["message"])
        for found in told["diagnostics"]
        if found["severity"] == "error" or found["code"] == WAITS
    ]
