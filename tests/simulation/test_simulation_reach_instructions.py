"""Every installed move stands in a checked program beside a plain one; some instructions end it."""

import pytest
from simulation_reach import checked

from rapidsim.language.types import Type
from rapidsim.library.catalogue import ROUTINES
from rapidsim.library.traits import Trait

OUT = "[9E9,9E9,9E9,9E9,9E9,9E9]"
HEAD = f"""MODULE cell
  CONST robtarget p:=[[800,0,600],[0,0,1,0],[0,0,0,0],{OUT}];
  CONST robtarget q:=[[800,60,600],[0,0,1,0],[0,0,0,0],{OUT}];
  VAR robtarget found;
  VAR jointtarget axes;
  VAR triggdata near;
  VAR pose moved;
  PERS num any:=1;
  VAR triggios outs{{1}}:=[[TRUE,5,TRUE,0,"doGlue",1,0]];
  VAR seamdata seam;
  VAR welddata weld;
  VAR egmident egm;
"""
GIVEN = {
    "ToPoint": "q",
    "CirPoint": "[[800,30,620],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]",
    "SearchPoint": "found",
    "SearchJointPos": "axes",
    "GrooveWidth": "any",
    "ProcName": '"greet"',
}
OF_TYPE = {
    "jointtarget": f"[[0,0,0,0,30,0],{OUT}]",
    "speeddata": "v100",
    "zonedata": "z10",
    "tooldata": "tool0",
    "triggdata": "near",
    "seamdata": "seam",
    "welddata": "weld",
    "egmident": "egm",
    "dionum": "1",
    "num": "1",
    "anytype": "any",
    "robtarget": "p",
    "pose": "moved",
}
OPTIONS = {
    "MoveJGO": r"\Value:=1",
    "MoveLGO": r"\Value:=1",
    "MoveCGO": r"\Value:=1",
    "TriggJIOs": r"\TriggData1:=outs",
    "TriggLIOs": r"\TriggData1:=outs",
}
WITHOUT_TARGET = {"ArcMoveExtJ", "MoveExtJ", "SearchExtJ"}
"""They move external axes alone, and this arm has none."""


def argument(name: str, of: Type) -> str:
    if of.name.startswith("signal"):
        return f"{of.name.removeprefix('signal')}Some"
    return GIVEN.get(name) or OF_TYPE[of.name]


@pytest.mark.parametrize(
    "name", [row.name for row in ROUTINES.values() if Trait.MOVE in row.traits]
)
def test_an_installed_move_beside_a_plain_one(name: str) -> None:
    parameters = ROUTINES[name.lower()].signature.parameters
    given = ",".join(argument(p.name, p.types[0]) for p in parameters if not p.optional)
    option = OPTIONS.get(name, "")
    given = f"{given}{option}" if name.endswith("GO") else given.replace("v100", f"v100{option}")
    call = f"{name} {given};"
    set_up = r"TriggIO near,5\DOp:=doSome,1;"
    plain = "MoveJ p,v100,fine,tool0;"
    main = f"PROC main()\n{set_up}\n{plain}\n{call}\n{plain}\nENDPROC\n"
    found = checked(f"{HEAD}{main}PROC greet()\nENDPROC\nENDMODULE\n")
    by_value, by_run, unchecked = found.counts
    assert by_value + by_run >= 2
    assert by_value + by_run + unchecked == 3
    if name not in WITHOUT_TARGET and ROUTINES[name.lower()].simulated:
        assert unchecked == 0, found.reasons


@pytest.mark.parametrize("end", ["ExitCycle;", "Break;", r"SystemStopAction\Halt;", "EXIT;"])
def test_the_way_ends_where_the_program_does(end: str) -> None:
    out_of_reach = "MoveL Offs(p,0,0,9000),v100,fine,tool0;"
    body = f"MoveJ p,v100,fine,tool0;\n{end}\n{out_of_reach}\n"
    found = checked(f"{HEAD}PROC main()\n{body}ENDPROC\nENDMODULE\n")
    # What stands behind is still looked at, as what no way leads to.
    assert [code for code, _ in found.codes] == ["K601"]


@pytest.mark.parametrize("before", range(5))
def test_what_no_way_leads_to_is_looked_at_whatever_was_before(before: int) -> None:
    quiet = "".join(
        f'  PROC quiet{k}()\n    RETURN;\n    TPWrite "never";\n  ENDPROC\n' for k in range(before)
    )
    calls = "".join(f"    quiet{k};\n" for k in range(before))
    body = f"""  PROC main()
{calls}    MoveJ p,v100,fine,tool0;
    EXIT;
    MoveL Offs(p,0,0,9000),v100,fine,tool0;
  ENDPROC
{quiet}"""
    assert [code for code, _ in checked(f"{HEAD}{body}ENDMODULE\n").codes] == ["K601"]


def test_a_procedure_on_the_way_may_write_what_later_moves_need() -> None:
    body = """  VAR num far:=9000;
  PROC main()
    MoveJ p,v100,fine,tool0;
    MoveLSync q,v100,fine,tool0,"greet";
    WaitTime 1;
    MoveL Offs(p,0,0,far),v100,fine,tool0;
  ENDPROC
  PROC greet()
    far:=0;
  ENDPROC
"""
    assert checked(f"{HEAD}{body}ENDMODULE\n").codes == []


@pytest.mark.parametrize("given", ["near", "all"])
def test_what_triggers_do_need_not_be_known(given: str) -> None:
    """They change nothing about the move, which is then known without a run and can be fixed."""
    body = rf"""  VAR triggdata all{{2}};
  CONST robtarget turned:=[[800,60,600],[0,0,1,0],[0,2,0,0],{OUT}];
  PROC main()
    TriggIO near,5\DOp:=doSome,1;
    TriggIO all{{1}},5\DOp:=doSome,0;
    TriggJ turned,v100,{given},fine,tool0;
  ENDPROC
"""
    # An instruction that writes trigger data leaves nothing behind for the next check.
    moving = "MoveJ p,v100,fine,tool0;\nTriggDataReset near;\n"
    checked(f"{HEAD}PROC main()\n{moving}ENDPROC\nENDMODULE\n")
    found = checked(f"{HEAD}{body}ENDMODULE\n")
    assert found.counts == (1, 0, 0)
    assert found.only("K603").fix is not None
