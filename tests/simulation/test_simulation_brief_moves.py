"""Stop points so close that the move between them is over before the wait at one."""

from __future__ import annotations

import pytest
from simulation_program import ran

from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.robot import load_robot
from rapidsim.motion.timing.axis_limits import model_of
from rapidsim.simulation.results.simulation import RobotRun

JOINTS = "[9E9,9E9,9E9,9E9,9E9,9E9]"


def moves(distance_mm: float, speed: str, model: MotionModel, zone: str = "fine") -> RobotRun:
    """A move, one of a distance [mm], and another, each to a stop point but for the middle one."""
    text = f"""MODULE m
  CONST robtarget p:=[[800,0,700],[0,0,1,0],[0,0,0,0],{JOINTS}];
  PROC main()
    ConfL \\Off;
    ConfJ \\Off;
    MoveJ p,v500,fine,tool0;
    MoveL Offs(p,0,100,0),{speed},fine,tool0;
    MoveL Offs(p,0,{100 + distance_mm},0),{speed},{zone},tool0;
    MoveL Offs(p,0,{200 + distance_mm},0),{speed},fine,tool0;
  ENDPROC
ENDMODULE
"""
    return ran(text, model=model).run.only


def shorter_s(distance_mm: float, speed: str, zone: str = "fine") -> float:
    """How much less time [s] they take than where each stop point has its own wait.

    That is so with `smoothing = "path"`, which takes the same time otherwise.
    """
    axes, path = (
        moves(distance_mm, speed, MotionModel(smoothing=smoothing), zone).moves[-1].end_s
        for smoothing in ("axes", "path")
    )
    return path - axes


def wait_s() -> float:
    return model_of(load_robot("irb1600"), MotionModel()).dwell


@pytest.mark.parametrize("speed", ["v300", "v500", "v1000", "vmax"])
def test_two_stop_points_close_together_take_little_more_than_one(speed: str) -> None:
    """Of two waits 1.15 remain; half of the torque takes some of that back."""
    assert 0.6 * wait_s() < shorter_s(2, speed) < 0.85 * wait_s()


def test_stop_points_farther_apart_have_a_wait_each() -> None:
    assert shorter_s(84, "v1000") == pytest.approx(0.0, abs=1e-6)
    assert shorter_s(30, "v300") == pytest.approx(0.0, abs=1e-6)


def test_a_corner_is_no_stop_point() -> None:
    assert shorter_s(2, "v500", "z1") == pytest.approx(0.0, abs=1e-6)


def test_a_row_of_brief_moves_never_moves_before_the_command_has_ended() -> None:
    """Each is closer to the one before than a wait, and none begins before that has ended."""
    rows = "\n".join(f"    MoveL Offs(p,0,{2 * k},0),v500,fine,tool0;" for k in range(1, 12))
    text = f"""MODULE m
  CONST robtarget p:=[[800,0,700],[0,0,1,0],[0,0,0,0],{JOINTS}];
  PROC main()
    ConfL \\Off;
    MoveJ p,v500,fine,tool0;
{rows}
  ENDPROC
ENDMODULE
"""
    run = ran(text).run.only
    pieces = run.trajectory.pieces
    ends = [piece.start_time + piece.timing.duration for piece in pieces]
    starts = [piece.start_time for piece in pieces[1:]]
    assert all(start >= end - 1e-9 for start, end in zip(starts, ends, strict=False))
    places = run.sample(run.trajectory.duration).base_from_tcp.translation
    assert places[0] == pytest.approx([0.8, 0.022, 0.7], abs=1e-9)
