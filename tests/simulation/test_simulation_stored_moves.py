"""Times of the moves around StorePath and RestoPath."""

import pytest
from simulation_program import ran

PROGRAM = """MODULE store
  VAR intnum soon;
  VAR robtarget here;
  CONST robtarget p1:=[[800,-300,700],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    ConfJ\\Off;
    ConfL\\Off;
    MoveJ p1,v500,fine,tool0;
    CONNECT soon WITH aside;
    ITimer\\Single,1.5,soon;
    MoveL Offs(p1,0,200,0),v200,z20,tool0;
    MoveL Offs(p1,0,400,0),v200,z20,tool0;
    MoveL Offs(p1,0,600,0),v200,fine,tool0;
  ENDPROC
  TRAP aside
    StopMove;
    StorePath;
    here:=CRobT(\\Tool:=tool0);
    MoveL Offs(here,0,0,80),v200,fine,tool0;
    MoveL here,v200,fine,tool0;
    RestoPath;
    StartMove;
  ENDTRAP
ENDMODULE
"""


def test_a_move_that_ended_before_the_path_was_stored_keeps_its_end() -> None:
    moves = ran(PROGRAM).run.moves
    first, second, third = (moves[number] for number in (1, 2, 3))
    aside = moves[4:]
    assert first.end_s == pytest.approx(second.start_s)
    assert second.end_s == pytest.approx(third.start_s)
    # The trap interrupts the second one.
    assert second.start_s < aside[0].start_s < aside[-1].end_s < second.end_s
