"""The cells with a machine: a collision that is planted is found on its line, and cured."""

from __future__ import annotations

import json
import re
from pathlib import Path

from command_line import call

PROGRAMS = Path(__file__).parents[2] / "programs"
FOLDER, SHARED = PROGRAMS / "machine_tending", PROGRAMS / "shared_machine"


def found(file: Path, code: int, folder: Path, *options: str) -> list[tuple[str, int]]:
    """The findings about collisions of a run, by code and line."""
    ended = call("run", file, "--no-record", "--format", "json", *options, cwd=folder)
    assert ended.code == code, ended
    told = json.loads(ended.out)["diagnostics"]
    return [(one["code"], one["line"]) for one in told if one["code"].startswith("C")]


def marked(file: Path, mark: str) -> int:
    """The line of a program that a comment marks."""
    text = file.read_text(encoding="utf-8").splitlines()
    (line,) = (number for number, one in enumerate(text, start=1) if mark in one)
    return line


def test_the_short_way_hits_the_frame_of_the_door(tmp_path: Path) -> None:
    line = marked(FOLDER / "Hasty.mod", "! hits the frame")
    assert found(FOLDER / "Hasty.mod", 1, tmp_path) == [("C101", line)]


def test_a_run_that_hits_something_says_so_in_its_first_line(tmp_path: Path) -> None:
    ended = call("run", FOLDER / "Hasty.mod", "--no-record", "--report", "r.html", cwd=tmp_path)
    said = re.compile(r"ended as programmed after [\d.]+ s, with 1\s+collision")
    assert said.search(ended.out)
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert re.search(f'class="end error">{said.pattern}', page)


def test_the_way_through_the_door_hits_nothing_and_the_report_draws_what_is_carried(
    tmp_path: Path,
) -> None:
    assert not found(FOLDER / "Tending.mod", 0, tmp_path, "--report", "r.html")
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    begin = page.index(">", page.index('id="run"')) + 1
    drawn = json.loads(page[begin : page.index("</script>", begin)])
    objects = {one["name"]: one for one in drawn["objects"]}
    assert {"part", "vice"} <= objects.keys()
    assert all(one["parts"] for one in objects.values())
    # What stands has one place, what is carried one at each of many instants.
    assert len(objects["vice"]["place"][0]["steps"]) == 1
    x, y, z = (sum(column["steps"][:]) / column["scale"] for column in objects["part"]["place"])
    first = [column["steps"][0] / column["scale"] for column in objects["part"]["place"]]
    assert max(abs(a - b) for a, b in zip((x, y, z), first, strict=True)) > 500.0


def test_two_robots_that_wait_for_each_other_share_a_machine(tmp_path: Path) -> None:
    assert not found(SHARED / "Load.mod", 0, tmp_path)


def test_a_robot_that_does_not_wait_hits_the_other(tmp_path: Path) -> None:
    line = marked(SHARED / "Eager.mod", "! hits the other robot")
    # What else it hits takes long to find.
    assert ("C101", line) in found(SHARED / "Eager.mod", 3, tmp_path, "--max-time", "4")
