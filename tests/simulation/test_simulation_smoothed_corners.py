"""A run says where its smoothing asks more of the axes than they have, and how much."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from simulation_program import ran

from rapidsim.diagnostics import Severity
from rapidsim.findings.runs import CornerTooFast
from rapidsim.motion.model import MODELS, MotionModel

DATA = "CONST robtarget p:=[[700,0,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];"


def corner(zone: str, speed: str = "v500") -> str:
    moves = "\n".join(
        (
            "MoveJ p,v500,fine,tool0;",
            f"MoveL Offs(p,0,200,0),{speed},{zone},tool0;",
            f"MoveL Offs(p,150,200,0),{speed},{zone},tool0;",
            f"MoveL Offs(p,150,0,0),{speed},fine,tool0;",
        )
    )
    return f"MODULE cell\n{DATA}\nPROC main()\n{moves}\nENDPROC\nENDMODULE"


def test_a_sharp_corner_is_told_with_what_it_takes() -> None:
    run = ran(corner("z1"), model=MODELS["1"])
    found = run.only("R116")
    violation = found.violation
    assert isinstance(violation, CornerTooFast)
    assert (violation.severity, violation.other_text) == (
        Severity.NOTE,
        ", and 1 more corner likewise",
    )
    # By differences of the joints that are seen, a millisecond apart.
    move = next(move for move in run.run.moves if found.span and move.place.span == found.span)
    times = move.end_s + 1e-3 * np.arange(-30.0, 31.0)
    assert times[0] > 0.0
    joints = run.run.only.sample(times).joints
    taken = abs(joints[2:] - 2.0 * joints[1:-1] + joints[:-2]).max(axis=0) / 1e-6
    axis = int(violation.limit.removeprefix("acceleration of axis ")) - 1
    limit = run.run.only.robot.joints[axis].max_speed
    assert limit is not None
    assert violation.load == pytest.approx(taken[axis] * 0.16 / limit, rel=0.1)


@pytest.mark.parametrize("program", [corner("z50"), corner("fine"), corner("z1", "v50")])
def test_gentle_corners_are_not_told(program: str) -> None:
    assert ran(program, model=MODELS["1"]).findings == []


def test_torques_are_told_too() -> None:
    violation = ran(corner("z1"), model=MotionModel(smoothing="path")).only("R116").violation
    assert isinstance(violation, CornerTooFast)
    assert violation.limit == "torque of axis 2"
    assert violation.load == pytest.approx(3.6, abs=0.1)


@pytest.mark.parametrize(
    "model",
    [
        MotionModel(),
        replace(MODELS["1"], accelerations_kept_by="motion"),
        replace(MODELS["1"], filter_time=0.0),
    ],
)
def test_what_keeps_the_accelerations_has_nothing_to_tell(model: MotionModel) -> None:
    assert ran(corner("z1"), model=model).findings == []
