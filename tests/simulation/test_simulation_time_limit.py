"""A run that is cut off says where the program was."""

import pytest

from rapidsim.analysis.checker import check
from rapidsim.diagnostics import Source
from rapidsim.motion.robot import load_robot
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.result import End
from rapidsim.simulation.simulate import simulate
from rapidsim.syntax.parser import parse

LOOPS = {
    "busy": "n:=n+1;",
    "waiting": "WaitTime 1;",
    "moving": "MoveJ p,v500,fine,tool0; MoveJ Offs(p,0,50,0),v500,fine,tool0;",
    "flying by": "MoveL p,v500,z10,tool0; MoveL Offs(p,0,50,0),v500,z10,tool0;",
}
TEXT = """MODULE endless
  CONST robtarget p:=[[800,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num n;
  PROC main()
    MoveJ p,v500,fine,tool0;
    again;
  ENDPROC
  PROC again()
    WHILE TRUE DO
      {body}
    ENDWHILE
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize("body", LOOPS.values(), ids=LOOPS.keys())
def test_the_note_stands_in_the_loop_that_does_not_end(body: str) -> None:
    source = Source("endless.mod", TEXT.format(body=body))
    program = check((parse(source).file,)).program
    assert program is not None
    run = simulate(program, load_robot("irb1600"), options=RunOptions(max_time_s=4.0))
    assert run.end is End.TIME_LIMIT
    assert run.time_s == pytest.approx(4.0)
    (note,) = [d for d in run.diagnostics if d.violation.code == "R109"]
    assert note.span is not None
    assert note.span.line in (9, 10)
    assert note.routine == "again"
    assert [related.span.line for related in note.related] == [6]
