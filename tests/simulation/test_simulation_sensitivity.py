"""Timing a run again with other accelerations gives what another run would take."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from simulation_program import ran

from rapidsim.motion.model import MODELS, MotionModel
from rapidsim.motion.timing.axis_limits import limits_of
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.timing.time_scaling import TimeScaling
from rapidsim.simulation.results import acceleration_sensitivity
from rapidsim.simulation.results.acceleration_sensitivity import extra_time_s

PROGRAM = """MODULE cell
  CONST robtarget a:=[[600,-100,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    ConfJ\\Off;
    ConfL\\Off;
    MoveJ a, v1000, fine, tool0;
    MoveL Offs(a, 0, 200, 0), v1000, z20, tool0;
    SetDO doGlue, 1;
    MoveL Offs(a, 0, 200, 100), v500, z5, tool0;
    WaitTime 0.3;
    MoveJ a, vmax, fine, tool0;
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize("factor", [0.5, 1.0, 2.0])
def test_another_run_with_other_accelerations_takes_that_long(factor: float) -> None:
    run = ran(PROGRAM, model=MODELS["1"]).run
    other = ran(PROGRAM, model=replace(MODELS["1"], acceleration_time=0.16 / factor)).run
    extra_s = extra_time_s(run.only.trajectory, limits_of(run.only.robot, run.model), factor)
    assert extra_s is not None
    assert run.time_s + extra_s == pytest.approx(other.time_s, abs=1e-3)


@pytest.mark.parametrize("factor", [0.5, 2.0])
def test_another_run_with_other_torques_takes_about_that_long(factor: float) -> None:
    """About: where a block is cut to go on from, another run has another speed."""
    run = ran(PROGRAM).run
    other = ran(PROGRAM, model=MotionModel(torque=(factor,) * 3, wrist=factor)).run
    extra_s = extra_time_s(run.only.trajectory, limits_of(run.only.robot, run.model), factor)
    assert extra_s is not None
    assert run.time_s + extra_s == pytest.approx(other.time_s, abs=5e-3)


def test_a_long_run_is_not_timed_again(monkeypatch: pytest.MonkeyPatch) -> None:
    run = ran(PROGRAM).run
    monkeypatch.setattr(acceleration_sensitivity, "MOST_SEGMENTS", 2)
    assert extra_time_s(run.only.trajectory, limits_of(run.only.robot, run.model), 2.0) is None


def test_programmed_times_count_as_much_as_their_bisection(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """2,000 of them took four times as long to time again as all moves of a run usually do."""
    monkeypatch.setattr(acceleration_sensitivity, "MOST_SEGMENTS", 50)
    for text, is_timed_again in ((PROGRAM, True), (PROGRAM.replace("v500", "v500\\T:=2"), False)):
        run = ran(text).run
        extra_s = extra_time_s(run.only.trajectory, limits_of(run.only.robot, run.model), 2.0)
        assert (extra_s is not None) == is_timed_again


def test_cycles_that_repeat_are_timed_again_once(monkeypatch: pytest.MonkeyPatch) -> None:
    main = PROGRAM.replace("main()", "cycle()")
    loop = (
        "  PROC main()\n    FOR i FROM 1 TO 6 DO\n      cycle;\n    ENDFOR\n  ENDPROC\nENDMODULE\n"
    )
    run = ran(main.replace("ENDMODULE\n", loop)).run
    starts: list[float] = []

    def counted(*arguments: Any, **named: Any) -> TimeScaling:
        starts.append(named["start"])
        return plan(*arguments, **named)

    monkeypatch.setattr(acceleration_sensitivity, "plan", counted)
    limits = limits_of(run.only.robot, run.model)
    assert extra_time_s(run.only.trajectory, limits, 2.0) is not None
    assert len(starts) < len(run.only.trajectory.pieces) / 2
