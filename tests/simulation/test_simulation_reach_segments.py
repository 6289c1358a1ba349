"""What checking by value judges is, field by field, what a run drives: each setting, any stance.

In `test_simulation_every_program` all programs of the repository.
"""

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from laws import examples
from simulation_segments import agreeing, driven, judged

from rapidsim.analysis.program import Program
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.checked_program import load

AXES = "[9E9,9E9,9E9,9E9,9E9,9E9]"


def compared(program: Program) -> int:
    reach = judged(program)
    return agreeing(reach, driven(program).segments) if reach else 0


DATA = """
  PERS tooldata held:=[TRUE,[[30,0,90],[1,0,0,0]],[4,[0,0,50],[1,0,0,0],0,0,0]];
  PERS loaddata part:=[1.5,[0,0,1],[1,0,0,0],0,0,0];
  PERS wobjdata table:=[FALSE,TRUE,"",[[10,20,30],[1,0,0,0]],[[0,0,5],[1,0,0,0]]];
  CONST robtarget p:=[[700,-200,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
"""
BEFORE = {
    "AccSet": r"AccSet 60,40\FinePointRamp:=50;",
    "VelSet": "VelSet 40,120;",
    "GripLoad": "GripLoad part;",
    "PathAccLim": r"PathAccLim TRUE\AccMax:=2,TRUE\DecelMax:=1;",
    "WorldAccLim": r"WorldAccLim \On:=3;",
    "CirPathMode": r"CirPathMode \ObjectFrame;",
    "SingArea": r"SingArea \Wrist;",
}


@pytest.mark.parametrize("setting", BEFORE.values(), ids=BEFORE.keys())
def test_no_setting_is_ignored(setting: str) -> None:
    text = f"""MODULE cell
{DATA}
  PROC main()
    {setting}
    MoveJ p,v500,fine,tool0;
    MoveL Offs(p,50,0,0),v500,z10,tool0;
    MoveC Offs(p,100,50,0),Offs(p,50,100,0),v300,z5,tool0;
    MoveL Offs(p,0,100,0),v100\\T:=2,fine,tool0;
    MoveJ p,vmax,z50,tool0;
    MoveJ Offs(p,0,20,0),v500,fine,held\\WObj:=table;
    MoveL Offs(p,0,40,0),v500,fine,held\\WObj:=table;
  ENDPROC
ENDMODULE
"""
    loaded = load([SourceFile("cell.mod", text, "utf-8")])
    assert loaded.program is not None, [d.violation.message for d in loaded.diagnostics]
    assert compared(loaded.program) == 6


@examples(15)
@example([("MoveJ", -583, 0, 200, 0), ("MoveJ", 0, 0, 200, 0)])
@given(
    st.lists(
        st.tuples(
            st.sampled_from(["MoveJ", "MoveL"]),
            st.integers(-800, 1000),
            st.integers(-800, 800),
            st.integers(200, 1000),
            st.integers(0, 350),
        ),
        min_size=2,
        max_size=4,
    )
)
def test_where_no_configuration_is_asked_for(moves: list[tuple[str, int, int, int, int]]) -> None:
    body = "\n".join(
        f"{name} RelTool(Offs(p,{x},{y},{z}),0,0,0\\Rz:={turn}),v500,fine,tool0;"
        for name, x, y, z, turn in moves
    )
    text = f"""MODULE cell
  CONST robtarget p:=[[0,0,0],[0,0,1,0],[0,0,0,0],{AXES}];
  PROC main()
    ConfJ\\Off; ConfL\\Off;
    MoveAbsJ [[0,0,0,0,30,0],{AXES}],v500,fine,tool0;
    {body}
  ENDPROC
ENDMODULE
"""
    loaded = load([SourceFile("cell.mod", text, "utf-8")])
    assert loaded.program is not None, [d.violation.message for d in loaded.diagnostics]
    compared(loaded.program)
