"""Whoever stops the arm, and whenever: it brakes as its axes can, and goes on from a standstill."""

from __future__ import annotations

from itertools import pairwise

import pytest
from simulation_program import arm, ran

from rapidsim.motion.model import MotionModel
from rapidsim.motion.timing.axis_limits import limits_of
from rapidsim.motion.trajectory.trajectory import Trajectory

HEAD = r"""MODULE cell
  CONST robtarget a:=[[700,-200,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[700,200,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget p;
  VAR num n;
  PROC main()
    ConfL\Off; ConfJ\Off;
    MoveJ a,v500,fine,tool0;
    MoveL b,v500,z10,tool0;
    MoveL a,v500,z10,tool0;
"""
TAIL = "  ENDPROC\nENDMODULE\n"
REST = "MoveL Offs(a,0,50,0),v500,fine,tool0;"


def assert_brakes(trajectory: Trajectory) -> None:
    """Pieces go on at the speed at which the one before ended; before a pause, that is none."""
    speeds = []
    for piece in trajectory.pieces:
        first, last = (piece.timing.time_at(s) for s in (piece.from_s, piece.to_s))
        ends = piece.timing.speed_at(first), piece.timing.speed_at(last)
        speeds.append((piece.start_time, *ends, piece.start_time + last - first))
    for (_, _, before, end_s), (start_s, after, _, _) in pairwise(speeds):
        pause = start_s > end_s + 1e-9
        assert before == pytest.approx(0.0 if pause else after, abs=1e-6)
        assert after == pytest.approx(0.0 if pause else before, abs=1e-6)
    assert speeds[-1][2] == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize(
    "stop",
    [
        "StopMove;",
        "WaitTime 0.3; StopMove;",
        "WaitTime 0.3; p:=CRobT(); StopMove;",
        "WaitTime 0.3; p:=CRobT(); MoveL b,v500,z10,tool0; StopMove;",
    ],
)
def test_stopmove_in_a_row_of_fly_by_moves(stop: str) -> None:
    run = ran(f"{HEAD}{stop} WaitTime 1; StartMove; {REST}\n{TAIL}")
    assert run.end == "ended"
    trajectory = run.run.only.trajectory
    assert_brakes(trajectory)
    pauses = [b.start_time - a.start_time for a, b in pairwise(trajectory.pieces)]
    assert max(pauses) > 1.0


@pytest.mark.parametrize(
    ("then", "end"),
    [
        ("WHILE TRUE DO WaitTime 0.05; p:=CRobT(); ENDWHILE", "time_limit"),
        ("n:=1/n;", "error"),
        ("MoveL Offs(a,5000,0,0),v500,z10,tool0;", "error"),
        ("EXIT;", "stopped"),
    ],
)
@pytest.mark.parametrize("limit_s", [1.4, 1.9, 2.0, 2.7])
def test_the_time_limit_comes_while_the_arm_moves(then: str, end: str, limit_s: float) -> None:
    run = ran(f"{HEAD}{then}\n{TAIL}", max_time_s=limit_s)
    assert run.end == end
    trajectory = run.run.only.trajectory
    assert_brakes(trajectory)
    limits = limits_of(arm(), MotionModel())
    longest_s = float((limits.max_speed / limits.max_acceleration).max())
    assert limit_s < trajectory.command_end < limit_s + longest_s
