"""The cell with a machine: a collision that is planted is found on its line, and cured."""

from __future__ import annotations

import json
from pathlib import Path

from command_line import call

FOLDER = Path(__file__).parents[2] / "programs" / "machine_tending"


def found(name: str, code: int, folder: Path) -> list[tuple[str, int]]:
    """The findings about collisions of a run, by code and line."""
    ended = call("run", FOLDER / name, "--no-record", "--format", "json", cwd=folder)
    assert ended.code == code, ended
    told = json.loads(ended.out)["diagnostics"]
    return [(one["code"], one["line"]) for one in told if one["code"].startswith("C")]


def test_the_way_through_the_door_hits_nothing(tmp_path: Path) -> None:
    assert not found("Tending.mod", 0, tmp_path)


def test_the_short_way_hits_the_frame_of_the_door(tmp_path: Path) -> None:
    text = (FOLDER / "Hasty.mod").read_text(encoding="utf-8").splitlines()
    (line,) = (number for number, one in enumerate(text, start=1) if "! hits the frame" in one)
    assert found("Hasty.mod", 1, tmp_path) == [("C101", line)]
