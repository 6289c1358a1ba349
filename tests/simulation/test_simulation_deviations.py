"""How far the TCP is off its lines and arcs, by forward kinematics of the joints of a run."""

from simulation_program import Ran, ran

from rapidsim.motion.model import MotionModel
from rapidsim.simulation.results.curve_deviations import CurveDeviation, all_curve_deviations

PROGRAM = r"""
MODULE cell
  CONST robtarget pA := [[700,-200,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ pA, v500, fine, tool0;
    MoveL Offs(pA, 0, 300, 0), v500, z20, tool0;
    MoveC Offs(pA, -60, 360, 0), Offs(pA, -120, 300, 0), v500, fine, tool0;
  ENDPROC
ENDMODULE
"""


def deviations(model: MotionModel) -> dict[int, CurveDeviation]:
    made: Ran = ran(PROGRAM, model=model, nearest_configuration=True)
    return dict(all_curve_deviations(made.run))


def test_smoothed_along_the_path_the_arm_is_on_its_line_and_arc() -> None:
    found = deviations(MotionModel(smoothing="path"))
    assert list(found) == [1, 2]
    assert all(one.rms <= one.largest < 1e-9 for one in found.values())


def test_smoothed_by_axis_it_is_a_little_beside() -> None:
    for one in deviations(MotionModel(smoothing="axes")).values():
        assert 1e-6 < one.rms < one.largest < 5e-3


NEVER_BEGUN = r"""
MODULE cell
  CONST robtarget pA := [[700,-200,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ pA, v500, fine, tool0;
    FOR i FROM 1 TO 3 DO
      MoveL Offs(pA, 0, 300, 0), v500, z20, tool0;
      MoveL Offs(pA, 0, 300, 90), v500, z20, tool0;
      StopMove;
      ClearPath;
      StartMove;
      MoveL pA, v500, fine, tool0;
    ENDFOR
  ENDPROC
ENDMODULE
"""


def test_moves_that_are_never_begun_have_none() -> None:
    run = ran(NEVER_BEGUN, nearest_configuration=True).run
    lines = [move.index for move in run.only.moves][1:]
    assert lines == [1, 3, 4, 6, 7, 9]
    assert list(all_curve_deviations(run)) == lines
