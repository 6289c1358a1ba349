"""Frames of tools and work objects whose orientation is none: told, never computed with."""

import pytest
from simulation_program import ran

PROGRAM = """MODULE m
PERS tooldata t:=[TRUE,[[0,0,100],[{tool}]],[1,[0,0,1],[1,0,0,0],0,0,0]];
PERS wobjdata w:=[FALSE,TRUE,"",[[0,0,0],[{user}]],[[0,0,0],[{object}]]];
CONST robtarget p:=[[700,0,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
VAR jointtarget j;
PROC main()
{statement}
ENDPROC
ENDMODULE
"""
GOOD = {"tool": "1,0,0,0", "user": "1,0,0,0", "object": "1,0,0,0"}
STATEMENTS = (
    r"MoveL p,v1000,fine,t\WObj:=w;",
    r"MoveJ p,v1000,fine,t\WObj:=w;",
    r"j:=CalcJointT(p,t\WObj:=w);",
)


@pytest.mark.parametrize("statement", STATEMENTS)
@pytest.mark.parametrize("frame", GOOD)
def test_a_frame_without_orientation_stops_the_program(frame: str, statement: str) -> None:
    assert ran(PROGRAM.format(**GOOD, statement=statement)).end == "ended"
    stopped = ran(PROGRAM.format(**{**GOOD, frame: "0,0,0,0"}, statement=statement))
    assert stopped.end == "error"
    (told,) = (d.violation.message for d in stopped.run.diagnostics)
    assert "frame of the" in told
    assert "has length 0.0000, not 1" in told
