"""What a check says of moves: the programs of `reach.txt`, and all that is said of each.

A section of that file may begin with a station file, up to a line `--`, whose first line may hold
arguments of the command behind `$`; then come the statements of main, behind `||` other items, and
behind `|| other.mod` another file.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from check_helper import HERE
from command_line import call
from exports import export
from whole_findings import assert_section, sections, whole

from rapidsim.jobs.checking import check_files
from rapidsim.reach import (
    arm_configurations,
    path_findings,
    suggestions,
    target_poses,
    trial_run,
)

PROGRAMS = sections(HERE / "reach.txt")
OUT = "[9E9,9E9,9E9,9E9,9E9,9E9]"
POINTS = {
    "a": "[[700,-200,500],[0,0,1,0],[-1,0,-1,0]",
    "b": "[[700,200,500],[0,0,1,0],[0,0,0,0]",
    "c": "[[800,0,500],[0,0,1,0],[0,0,0,0]",
    "d": "[[-700,-100,500],[0,0,1,0],[-2,0,-2,0]",
    "stale": "[[700,200,500],[0,0,1,0],[2,1,0,5]",
    "turned": "[[700,200,500],[0,0,1,0],[0,0,2,0]",
    "quarter": "[[700,200,500],[0,0,1,0],[0,1,0,0]",
    "far": "[[1300,0,300],[0,0,1,0],[0,0,0,0]",
    "nowhere": "[[700,0,500],[0,0,0,0],[0,0,0,0]",
}
HEAD = "\n".join(
    [
        "MODULE cell",
        *(f"CONST robtarget {name}:={numbers},{OUT}];" for name, numbers in POINTS.items()),
        "PERS tooldata grip:=[TRUE,[[0,0,120],[1,0,0,0]],[1,[0,0,60],[1,0,0,0],0,0,0]];",
        'PERS wobjdata table:=[FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];',
        f"CONST jointtarget home:=[[0,0,0,0,30,0],{OUT}];",
        "VAR num n;",
        "PROC main()\n",
    ]
)


def told(folder: Path, section: str) -> Iterator[str]:
    """What a check says of a program."""
    station, _, program = section.rpartition("--\n")
    arguments, _, station = station.partition("\n") if station[:1] == "$" else ("", "", station)
    program, _, other = program.partition("|| other.mod\n")
    body, _, others = program.partition("||\n")
    if other:
        (folder / "other.mod").write_text(other)
    (folder / "cell.mod").write_text(f"{HEAD}{body}ENDPROC\n{others}ENDMODULE\n")
    (folder / "rapidsim.toml").write_text(station or '[robot]\nmodel = "irb1600"\n')
    files = ["."] if other else ["cell.mod"]
    more = arguments[1:].split()
    ended = call("check", *files, "--no-merge", "--output-format", "json", *more, cwd=folder)
    found: Mapping[str, Any] = json.loads(ended.out)
    # What the text alone tells has its own tests.
    moves = (one for one in found["diagnostics"] if one["code"][0] in "CDKMR" and one["routine"])
    yield whole(moves)
    of = found["coverage"]
    counts = f"{of['by_value']} by value, {of['by_run']} by run"
    yield f"{counts}, {of['paths_checked']} of {of['paths']} paths\n"
    for key in ("unchecked", "unchecked_paths"):
        yield from (f"  {one['line']}: {one['reason']}\n" for one in of[key])
    if "main_left_out" in of:
        yield f"  {of['main_left_out']}\n"


@pytest.mark.parametrize("name", PROGRAMS)
def test_all_that_a_check_says_of_moves(name: str, tmp_path: Path) -> None:
    text = "".join(told(tmp_path, PROGRAMS[name]))
    assert_section(HERE / "findings" / "reach.txt", name, text)


@pytest.mark.parametrize(
    "name",
    [
        *("zones", "orientations", "stored configurations", "nothing monitored", "belts"),
        *("a track and a positioner", "only a run tells", "wrist axes lead an arc", "arcs"),
    ],
)
def test_blocks_of_moves_are_as_all_at_once(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(target_poses, "_BLOCK", 2)
    monkeypatch.setattr(path_findings, "_BLOCK", 2)
    monkeypatch.setattr(arm_configurations, "_BATCH", 2)
    test_all_that_a_check_says_of_moves(name, tmp_path)


@pytest.mark.parametrize(
    ("module", "limit", "most", "name"),
    [
        (arm_configurations, "MOST_SEARCHED", 1, "an arm that is solved by search"),
        (arm_configurations, "MOST_SEARCHED", 1, "nothing to say"),
        (suggestions, "MOST_SEARCHES", 2, "out of reach"),
        (trial_run, "MOST_MOVES", 2, "a run takes too long"),
        (trial_run, "MOST_MOVES", 3, "only a run tells"),
        (trial_run, "MOST_MOVES_FOR_ERRORS", 1, "an error of main"),
    ],
)
def test_limits_of_a_check(
    module: ModuleType,
    limit: str,
    most: int,
    name: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(module, limit, most)
    text = "".join(told(tmp_path, PROGRAMS[name]))
    assert_section(HERE / "findings" / "reach.txt", f"{name}, {limit} {most}", text)


@pytest.mark.parametrize("most", [12, 4000])
@pytest.mark.parametrize("form", ["inline", "named"])
def test_all_that_a_check_says_of_a_long_path(
    form: str, most: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of more moves than these, only few are in the tree."""
    monkeypatch.setattr(check_files, "MOST_MOVES", most)
    text = export(form, "spiral", 45, 7).replace("    ConfL\\Off;\n", "")
    rows = [row for row in text.splitlines() if "[[" in row]
    for row, old, new in (
        (9, "[0,0,0,0]", "[0,0,2,0]"),
        (20, "[[", "[[1"),
        (30, "[0,0,0,0]", "[3,0,0,0]"),
    ):
        text = text.replace(rows[row], rows[row].replace(old, new))
    (tmp_path / "path.mod").write_text(text)
    arguments = ("check", "path.mod", "--robot", "irb4600-20-2.5", "--output-format", "json")
    found = json.loads(call(*arguments, cwd=tmp_path).out)
    of = found["coverage"]
    counts = f"{of['by_value']} by value, {of['paths_checked']} of {of['paths']} paths"
    told = f"{whole(found['diagnostics'])}{counts}\n"
    assert_section(HERE / "findings" / "reach.txt", f"a long path, {form}", told)
