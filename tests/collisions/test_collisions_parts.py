"""Parts of a cell: what carries them, and what a run says where one is not as the program means."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from collision_cells import cell, codes, report

SIGNALS = """
[signals]
doGrip = { type = "do" }
doGrip2 = { type = "do" }
doLock = { type = "do" }
"""
TURNTABLE = """
[[external_axis]]
name = "STN1"
axis = "b"
kind = "rotational"
limits = [-200, 200]
speed = 90
acceleration = 360
carries = "wobj"
frame = { position = [700, 0, 400] }

[[object]]
name = "plate"
cylinder = { diameter = 560, length = 20 }
pose = { position = [0, 0, -10] }
parent = "unit:STN1"

[[object]]
name = "stand"
box = [200, 200, 100]
pose = { position = [450, 600, 350] }
"""
PART = """
[[object]]
name = "part"
box = [50, 50, 80]
pose = { position = [450, 600, 440] }

[[object]]
name = "gripper"
box = [40, 40, 100]
pose = { position = [0, 0, 50] }
parent = "tool"

[[attach]]
when = "doGrip = 1"
object = "part"
to = "tool"
"""
HEAD = r"""MODULE cell
  PERS tooldata tGrip:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  PERS wobjdata wTable:=[FALSE,FALSE,"STN1",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget onStand:=[[450,600,480],[0,0,1,0],[0,0,0,0],[9E9,0,9E9,9E9,9E9,9E9]];
  CONST robtarget onPlate:=[[-200,0,80],[0,0,1,0],[0,0,0,0],[9E9,0,9E9,9E9,9E9,9E9]];
  PROC grip(robtarget at,PERS wobjdata where)
    MoveJ Offs(at,0,0,100),v1000,fine,tGrip\WObj:=where;
    MoveL at,v500,fine,tGrip\WObj:=where;
    SetDO doGrip,1;
    WaitTime 0.1;
    MoveL Offs(at,0,0,100),v500,fine,tGrip\WObj:=where;
  ENDPROC
  PROC put(robtarget at,PERS wobjdata where)
    MoveJ Offs(at,0,0,100),v1000,fine,tGrip\WObj:=where;
    MoveL at,v500,fine,tGrip\WObj:=where;
    SetDO doGrip,0;
    WaitTime 0.1;
    MoveL Offs(at,0,0,100),v500,fine,tGrip\WObj:=where;
  ENDPROC
  PROC turn(num angle)
    VAR robtarget there;
    there:=CRobT(\Tool:=tGrip\WObj:=wobj0);
    there.extax.eax_b:=angle;
    MoveJ there,v1000,fine,tGrip;
  ENDPROC
  PROC main()
    ConfJ\Off;
    ConfL\Off;
"""


def found_at(found: dict[str, Any]) -> list[tuple[str, str]]:
    """Code and message of each finding about the cell."""
    return [
        (one["code"], one["message"]) for one in found["diagnostics"] if one["code"].startswith("C")
    ]


def test_a_part_turns_with_the_table_it_is_put_on(tmp_path: Path) -> None:
    moves = """    grip onStand,wobj0;
    put onPlate,wTable;
    turn 180;
    grip [[-200,0,80],[0,0,1,0],[0,0,0,0],[9E9,180,9E9,9E9,9E9,9E9]],wTable;
    put [[450,600,482],[0,0,1,0],[0,0,0,0],[9E9,180,9E9,9E9,9E9,9E9]],wobj0;"""
    cell(tmp_path, moves, SIGNALS + TURNTABLE + PART, HEAD)
    found = report(tmp_path, 0)
    assert not codes(found)
    parts = found["parts"]
    assert (parts["made"], parts["moved"], parts["lost"]) == (1, 1, 0)
    assert [(one["change"], one["carrier"]) for one in parts["events"]] == [
        ("gripped", "the gripper"),
        ("placed", "`plate`"),
        ("gripped", "the gripper"),
        ("placed", "`stand`"),
    ]


def test_a_part_that_was_turned_away_is_not_where_it_was_put(tmp_path: Path) -> None:
    moves = """    grip onStand,wobj0;
    put onPlate,wTable;
    turn 180;
    grip [[500,0,480],[0,0,1,0],[0,0,0,0],[9E9,180,9E9,9E9,9E9,9E9]],wobj0;"""
    cell(tmp_path, moves, SIGNALS + TURNTABLE + PART, HEAD)
    found = report(tmp_path, 1)
    assert codes(found) == ["C106"]
    assert "`part`, is 3" in found_at(found)[0][1]
