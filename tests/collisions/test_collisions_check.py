"""What a check says of moves that its run of main does not make."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from collision_cells import HEAD, TABLE, cell
from command_line import call
from whole_findings import whole

BEHIND_AN_INPUT = "    IF DInput(diAgain)=1 THEN\n{0}    ENDIF"
SIGNALS = '[signals]\ndiAgain = { type = "di" }\n'
DOWN = "      MoveL Offs(over,0,0,{0}),v200,{1},tool0;\n"
POST = """
[[object]]
name = "post"
cylinder = { diameter = 80, length = 1600 }
pose = { position = [600, 450, 400] }
"""
ACROSS = """
  CONST robtarget left:=[[0,700,620],[0,0,1,0],[1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
"""


def findings(folder: Path, moves: str, station: str, head: str = HEAD) -> list[dict[str, Any]]:
    """What a check says of collisions."""
    cell(folder, BEHIND_AN_INPUT.format(moves), SIGNALS + station, head)
    ended = call("check", "cell.mod", "--output-format", "json", cwd=folder)
    assert ended.code in (0, 1), ended
    found = json.loads(ended.out)["diagnostics"]
    return [one for one in found if one["code"].startswith("C")]


def test_a_move_behind_an_input_is_driven_by_itself_and_its_cure_is_told(tmp_path: Path) -> None:
    (found,) = findings(tmp_path, DOWN.format(-150, "fine"), TABLE)
    assert (found["code"], found["line"]) == ("C104", 7)
    assert "link 6 would hit `table` after 7" in found["message"]
    assert "50 mm higher" in found["help"]
    assert not findings(tmp_path, DOWN.format(-100, "fine"), TABLE)


def test_what_a_corner_cuts_off_is_not_looked_at(tmp_path: Path) -> None:
    up = DOWN.format(0, "fine")
    assert not findings(tmp_path, DOWN.format(-125, "z50") + up, TABLE)
    assert findings(tmp_path, DOWN.format(-150, "z10") + up, TABLE)


def test_all_that_is_said_of_joint_moves_and_arcs(tmp_path: Path) -> None:
    head = HEAD.replace("  PROC main", f"{ACROSS}  PROC main")
    axes = "[[60,0,0,0,90,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
    arc = "MoveC Offs(over,50,50,-150),Offs(over,0,100,-150)"
    moves = ("MoveJ left", POST), (f"MoveAbsJ {axes}", POST), (arc, TABLE)
    found = [
        one
        for move, station in moves
        for one in findings(tmp_path, f"      {move},v200,fine,tool0;\n", station, head)
    ]
    hit, no_run = "in main: link", "mm deep; no run of main makes this move"
    start = "  7: the path starts here"
    free = "  help: the way is free to `left` in the configuration [-1,-2,1,6]"
    assert whole(found).splitlines() == [
        f"C104 error 9:13-17 {hit} 4 would hit `post` after 32 % of the way, 42.5 {no_run}",
        free,
        start,
        f"C104 error 9:16-59 {hit} 4 would hit `post` after 47 % of the way, 50.8 {no_run}",
        start,
        f"C104 error 9:35-56 {hit} 6 would hit `table` after 55 % of the way, 30.4 {no_run}",
        start,
    ]


@pytest.mark.parametrize("where", ["9E8", "0"])
def test_a_move_that_the_arm_cannot_make_has_no_way_to_look_at(where: str, tmp_path: Path) -> None:
    moves = f"      MoveL Offs(over,{where},0,-9E8),v200,fine,tool0;\n"
    assert not findings(tmp_path, moves, TABLE)


def test_what_may_be_carried_is_nowhere(tmp_path: Path) -> None:
    part = """
doGrip = { type = "do" }

[[object]]
name = "part"
box = [60, 60, 100]
pose = { position = [700, 0, 480] }

[[attach]]
when = "doGrip = 1"
object = "part"
to = "tool"
"""
    moves = DOWN.format(-150, "fine")
    grip = f"{HEAD}    WaitTime 0.1;\n"
    assert not findings(tmp_path, moves, part, grip)
