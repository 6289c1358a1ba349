"""Loads slow accelerations as far as the station file says, and not at all by default."""

from __future__ import annotations

import pytest
from simulation_program import ran

from rapidsim.motion.model import MotionModel

PROGRAM = """MODULE cell
  PERS loaddata part:=[4.5,[0,0,50],[1,0,0,0],0,0,0];
  PERS tooldata tGrip:=[TRUE,[[0,0,0],[1,0,0,0]],[1.5,[0,0,50],[1,0,0,0],0,0,0]];
  CONST robtarget a:=[[600,-100,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    ConfJ\\Off;
    ConfL\\Off;
    MoveJ a, vmax, fine, tGrip;
    GripLoad part;
    MoveJ Offs(a,0,200,0), vmax, fine, tGrip;
    GripLoad load0;
    MoveJ a, vmax, fine, tGrip;
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize(
    ("left", "shares"), [(1.0, (1.0, 1.0, 1.0)), (0.6, (0.9, 0.6, 0.9))], ids=["default", "0.6"]
)
def test_the_load_in_the_hand_slows_as_the_model_says(
    left: float, shares: tuple[float, ...]
) -> None:
    """The arm carries 6 kg: the tool is a quarter of that, tool and part are all of it."""
    run = ran(PROGRAM, model=MotionModel(payload_acceleration=left)).run
    segments = [piece.path.segments[0] for piece in run.only.trajectory.pieces]
    assert [s.acceleration_share for s in segments] == pytest.approx(shares, abs=1e-3)
    assert not run.unsimulated
