"""Forty changes of one program: thirty are named as a programmer would, ten are none at all."""

from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from rapidsim.applications.diff import compare as compare_module
from rapidsim.applications.diff.changes import Comparison
from rapidsim.applications.diff.compare import compare
from rapidsim.applications.diff.rendering import as_text
from rapidsim.jobs.inputs.run_request import RunRequest

MAIN = """MODULE Cell
  ! Take a part and put it down.
  PERS tooldata tGrip:=[TRUE,[[0,0,150],[1,0,0,0]],[3,[0,0,70],[1,0,0,0],0,0,0]];
  PERS wobjdata wTable:=[FALSE,TRUE,"",[[550,-200,300],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST speeddata vSlow:=[100,500,5000,1000];
  PERS num nParts:=0;
  VAR string text:="part";

  PROC main()
    MoveAbsJ jHome,v1000,fine,tGrip;
    FOR i FROM 1 TO 2 DO
      pick;
      place i;
    ENDFOR
    MoveAbsJ jHome,v1000,fine,tGrip;
  ENDPROC

  PROC pick()
    MoveJ Offs(pPick,0,0,50),v500,z10,tGrip\\WObj:=wTable;
    MoveL pPick,vSlow,fine,tGrip\\WObj:=wTable;
    SetDO doGrip,1;
    WaitTime 0.2;
    MoveL Offs(pPick,0,0,50),v500,z10,tGrip\\WObj:=wTable;
  ENDPROC

  PROC place(num row)
    IF row=1 THEN
      MoveJ pPlace,v500,fine,tGrip\\WObj:=wTable;
    ELSE
      MoveJ Offs(pPlace,0,40,0),v500,fine,tGrip\\WObj:=wTable;
    ENDIF
    SetDO doGrip,0;
    SetDO doLamp,1;
    nParts:=nParts+1;
  ENDPROC
ENDMODULE
"""
POINTS = """MODULE Points
  CONST robtarget pPick:=[[0,0,0],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pPlace:=[[50,150,0],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget jHome:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
ENDMODULE
"""

CHANGES = {
    "a target by 0.5 mm": (
        "pPick:=[[0,0,0]",
        "pPick:=[[0,0.5,0]",
        "moved by 0.500 mm (y +0.500: 0 -> 0.5), in wTable; in the world by 0.500 mm (y +0.500: ",
    ),
    "a target turned": (
        "pPlace:=[[50,150,0],[0,0,1,0]",
        "pPlace:=[[50,150,0],[0,0.0871557,0.9961947,0]",
        "target `pPlace`: turned by 10.000 deg ([0,0,1,0] -> [0,0.0871557,0.9961947,0]), in wTable",
    ),
    "a configuration": ("[-1,0,-1,0]", "[-1,0,-2,0]", "target `pPick`: cf6 -1 -> -2"),
    "joints": (
        "[[0,0,0,0,30,0]",
        "[[0,5,0,0,30,0]",
        "target `jHome`: axis 2 by +5.000 deg: 0 -> 5",
    ),
    "the TCP": (
        "[[0,0,150]",
        "[[0,0,152.5]",
        "tool `tGrip`: TCP moved by 2.500 mm (z +2.500: 150 -> 152.5)",
    ),
    "the load": ("[3,[0,0,70]", "[4.5,[0,0,70]", "tool `tGrip`: mass 3 -> 4.5 kg"),
    "a user frame": (
        "[[550,-200,300]",
        "[[550,-190,300]",
        "work object `wTable`: user frame moved by 10.000 mm (y +10.000: -200 -> -190)",
    ),
    "an object frame": (
        "[[0,0,0],[1,0,0,0]]];\n  CONST",
        "[[0,0,5],[1,0,0,0]]];\n  CONST",
        "object frame moved by 5.000 mm (z +5.000: 0 -> 5); in the world by 5.000 mm (z +5",
    ),
    "speed data": ("vSlow:=[100", "vSlow:=[80", "speed `vSlow`: v_tcp 100 -> 80 mm/s"),
    "a speed": ("pPlace,v500", "pPlace,v300", "speed in place: MoveJ: v500 -> v300"),
    "a zone": (
        "50),v500,z10,tGrip\\WObj:=wTable;\n    MoveL pPick",
        "50),v500,z50,tGrip\\WObj:=wTable;\n    MoveL pPick",
        "zone in pick: MoveJ: z10 -> z50",
    ),
    "a target by name": (
        "MoveJ pPlace",
        "MoveJ pPick",
        "target in place: MoveJ: pPlace -> pPick (moved by 158.114 mm",
    ),
    "an offset": (
        "Offs(pPlace,0,40,0)",
        "Offs(pPlace,0,45,0)",
        "target in place: MoveJ: Offs(pPlace,0,40,0) -> Offs(pPlace,0,45,0)",
    ),
    "a tool by name": (
        "MoveAbsJ jHome,v1000,fine,tGrip;\n    FOR",
        "MoveAbsJ jHome,v1000,fine,tool0;\n    FOR",
        "tool in main: MoveAbsJ: tGrip -> tool0",
    ),
    "no work object": (
        "fine,tGrip\\WObj:=wTable;\n    ELSE",
        "fine,tGrip;\n    ELSE",
        "work object in place: MoveJ: wTable -> nothing",
    ),
    "another move": ("MoveL pPick", "MoveJ pPick", "`MoveL pPick,vSlow,fine,tGrip\\WObj:=wTable;`"),
    "another signal": (
        "SetDO doLamp,1",
        "SetDO doHorn,1",
        "signal in place: SetDO: doLamp -> doHorn",
    ),
    "another value": ("SetDO doGrip,1", "SetDO doGrip,0", "argument in pick: SetDO: 1 -> 0"),
    "swapped outputs": (
        "SetDO doGrip,0;\n    SetDO doLamp,1;",
        "SetDO doLamp,1;\n    SetDO doGrip,0;",
        "statement in place: moved: `SetDO do",
    ),
    "a wait": ("WaitTime 0.2", "WaitTime 0.5", "argument in pick: WaitTime: 0.2 -> 0.5"),
    "a statement more": (
        "WaitTime 0.2;",
        "WaitTime 0.2;\n    Stop;",
        "statement in pick: added: `Stop;`",
    ),
    "a statement less": ("    WaitTime 0.2;\n", "", "statement in pick: removed: `WaitTime 0.2;`"),
    "a condition": ("IF row=1", "IF row=2", "`IF row=1 THEN` -> `IF row=2 THEN`"),
    "a loop": ("TO 2 DO", "TO 3 DO", "`FOR i FROM 1 TO 2 DO` -> `FOR i FROM 1 TO 3 DO`"),
    "a number": ("nParts:=0", "nParts:=7", "data `nParts`: 0 -> 7"),
    "a string": ('"part"', '"Part"', 'data `text`: "part" -> "Part"'),
    "storage": ("VAR string", "PERS string", "VAR string -> PERS string"),
    "data more": ("  PERS num", "  VAR num spare;\n  PERS num", "data `spare`: added: num"),
    "a renamed routine": ("pick", "fetch", "routine `fetch`: renamed from `pick`"),
    "a renamed target": ("pPick", "pFetch", "target `pFetch`: renamed from `pPick`"),
}
SAME = {
    "a comment more": ("    WaitTime 0.2;", "    ! The gripper closes.\n    WaitTime 0.2;"),
    "a comment moved": ("  ! Take a part and put it down.\n  PERS tool", "  PERS tool"),
    "blanks": ("MoveJ pPlace,v500,fine", "MoveJ  pPlace , v500 , fine"),
    "lines": ("nParts:=nParts+1;", "nParts :=\n      nParts + 1;"),
    "empty lines": ("  PROC place", "\n\n  PROC place"),
    "case": ("MoveAbsJ jHome,v1000,fine", "MOVEABSJ JHOME,V1000,FINE"),
    "how a number is written": ("[[550,-200,300]", "[[5.5E2,-200.0,300]"),
    "indentation": ("      pick;", "            pick;"),
    "data moved": ("  PERS num nParts:=0;\n  VAR string", "  VAR string"),
    "routines moved": None,
}


def folder(place: Path, main: str, points: str) -> RunRequest:
    place.mkdir()
    (place / "Main.mod").write_text(main)
    (place / "Points.mod").write_text(points)
    return RunRequest(paths=(str(place),), robot="irb1600")


@pytest.fixture(scope="module")
def old(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunRequest]:
    """The program before all changes, which is checked and run once."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(compare_module, "_side", cache(compare_module._side))
        yield folder(tmp_path_factory.mktemp("before") / "old", MAIN, POINTS)


def compared(old: RunRequest, tmp_path: Path, main: str, points: str, *, run: bool) -> Comparison:
    return compare(old, folder(tmp_path / "new", main, points), run=run)


@pytest.mark.parametrize("name", CHANGES)
def test_a_change_is_named(name: str, old: RunRequest, tmp_path: Path) -> None:
    before, after, told = CHANGES[name]
    assert before in MAIN + POINTS
    everywhere = -1 if name.startswith("a renamed") else 1
    main = MAIN.replace(before, after, everywhere)
    points = POINTS.replace(before, after, everywhere)
    found = compared(old, tmp_path, main, points, run=False)
    assert not found.is_same
    text = as_text(found)
    assert told in text
    assert len(found.changes) == 1, text


@pytest.mark.parametrize("name", SAME)
def test_what_changes_nothing_is_silent(name: str, old: RunRequest, tmp_path: Path) -> None:
    how = SAME[name]
    if how is None:
        head, _, rest = MAIN.partition("  PROC pick")
        pick, _, place = rest.partition("  PROC place")
        end = "ENDMODULE\n"
        main = f"{head}  PROC place{place.removesuffix(end)}\n  PROC pick{pick}{end}"
    else:
        assert how[0] in MAIN
        main = MAIN.replace(*how, 1)
    if name == "data moved":
        main = main.replace("  PROC main()", "  PERS num nParts:=0;\n\n  PROC main()")
    assert main != MAIN
    found = compared(old, tmp_path, main, POINTS, run=True)
    assert found.run is not None
    assert found.is_same, as_text(found)
    assert as_text(found) == "No difference.\n"
