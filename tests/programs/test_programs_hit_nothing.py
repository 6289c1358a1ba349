"""No arm of the programs in the repository hits itself or another, but where that is the lesson."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest
from command_line import call

PROGRAMS = Path(__file__).parents[2] / "programs"
COLLISIONS = "\n[collisions]\n"


@pytest.mark.parametrize(
    "program",
    [
        "circle.mod",
        "pentagon.mod",
        "cell",
        "tested",
        "two_robots/Left.mod",
        "multimove/Left.mod",
        "coordinated/Holder.mod",
    ],
)
def test_an_arm_hits_nothing(program: str, tmp_path: Path) -> None:
    copy = tmp_path / "programs"
    shutil.copytree(PROGRAMS, copy)
    folder = copy / program if (copy / program).is_dir() else (copy / program).parent
    station = folder / "rapidsim.toml"
    text = station.read_text(encoding="utf-8") if station.exists() else ""
    if COLLISIONS not in text:
        station.write_text(text + COLLISIONS, encoding="utf-8")
    ended = call("run", copy / program, "--no-record", "--format", "json", cwd=tmp_path)
    told = json.loads(ended.out)
    assert told["moves"]
    assert (told["collisions"], told["not_judged"]) == ([], [])
