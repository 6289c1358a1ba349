"""Cells for the tests of this folder: a program and a station file in a folder, run by its user."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from command_line import call

ARM = """
[robot]
model = "irb1600-6-1.2"
"""
HEAD = """MODULE cell
  PERS tooldata tGrip:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  CONST robtarget over:=[[700,0,620],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ over,v500,fine,tool0;
"""
TABLE = """
[[object]]
name = "table"
box = [400, 400, 40]
pose = { position = [700, 0, 480] }
"""


def cell(folder: Path, moves: str, station: str, head: str = HEAD) -> Path:
    """Write a program, whose main makes moves, and the station file beside it."""
    file = folder / "cell.mod"
    file.write_text(f"{head}{moves}\n  ENDPROC\nENDMODULE\n", encoding="utf-8")
    (folder / "rapidsim.toml").write_text(ARM + station, encoding="utf-8")
    return file


def report(folder: Path, code: int) -> dict[str, Any]:
    """What `rapidsim run` says of the cell as JSON; its exit code is as given."""
    ended = call("run", "cell.mod", "--no-record", "--format", "json", cwd=folder)
    assert ended.code == code, ended
    found: dict[str, Any] = json.loads(ended.out)
    return found


def codes(found: dict[str, Any]) -> list[str]:
    """The codes of the findings about collisions."""
    return [one["code"] for one in found["diagnostics"] if one["code"].startswith("C")]
