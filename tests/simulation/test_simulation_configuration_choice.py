"""Which configuration an arm takes where the program does not insist on one."""

from __future__ import annotations

import pytest
from simulation_program import ran

# The same place and direction with the flange turned by steps of 60 degrees: turned by 180, axis 6
# has as far to go as axis 1 would have to the other side.
TURNS = (0, 60, 120, 180, 240, 300)
PROGRAM = """MODULE turns
  CONST robtarget p:=[[700,-150,350],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    ConfJ \\Off;
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
    MoveJ RelTool(p,0,0,-180\\Rz:={turn}),v500,fine,tool0;
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize("turn", TURNS)
def test_without_monitoring_the_main_axes_stay_on_their_branch(turn: int) -> None:
    it = ran(PROGRAM.format(turn=turn))
    move = it.run.moves[-1]
    assert it.end == "ended"
    assert round(move.conf[3]) in (0, 1)
    # Some 530 mm of way, and not round the back of the arm.
    assert move.end_s - move.start_s < 2.0


def test_they_change_it_where_nothing_else_reaches() -> None:
    text = PROGRAM.format(turn=0).replace("[700,-150,350]", "[350,0,340]")
    it = ran(text)
    assert it.end == "ended"
    assert round(it.run.moves[-1].conf[3]) in (6, 7)
