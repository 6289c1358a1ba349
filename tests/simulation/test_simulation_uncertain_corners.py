"""A run says where the motion model is known to have another speed than a controller."""

from __future__ import annotations

import pytest
from simulation_program import ran

from rapidsim.files import SourceFile
from rapidsim.findings.runs import CornerSpeedUncertain
from rapidsim.jobs.checking.checked_program import load
from rapidsim.motion.robot.robot import load_robot
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.simulate import simulate

ROBOT = load_robot("irb6640-180-2.55")
CONF = "[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]"


def pose(x: float, y: float, turn: str = "0,0,1,0") -> str:
    return f"[[{1000 + x},{y},1200],[{turn}],{CONF}]"


def program(*moves: str) -> str:
    lines = "\n".join((f"MoveJ {pose(700, 0)},v500,fine,tool0;", *moves))
    return f"MODULE cell\nPROC main()\nConfL\\Off;\n{lines}\nENDPROC\nENDMODULE"


def sharp(speed: str = "v1000", zone: str = "z10", into: str = "MoveL") -> str:
    return program(
        f"{into} {pose(700, 400)},{speed},{zone},tool0;",
        f"MoveL {pose(900, 700)},{speed},{zone},tool0;",
        f"MoveL {pose(900, 1000)},v1000,fine,tool0;",
    )


def arcs(speed: str, turn: str) -> str:
    """Two arcs of one circle, between which the tool turns back by 22 degrees."""
    return program(
        f"MoveL {pose(900, -600)},v500,fine,tool0;",
        f"MoveC {pose(1158, -314)},{pose(1250, 60, turn)},{speed},z10,tool0;",
        f"MoveC {pose(1142, 434)},{pose(870, 700)},{speed},fine,tool0;",
    )


def found(text: str) -> list[CornerSpeedUncertain]:
    loaded = load([SourceFile("cell.mod", text, "utf-8")])
    assert loaded.program is not None
    run = simulate(loaded.program, ROBOT, options=RunOptions())
    return [d.violation for d in run.diagnostics if isinstance(d.violation, CornerSpeedUncertain)]


def test_the_first_sharp_corner_is_reported_with_the_number_of_others() -> None:
    (only,) = found(sharp())
    assert only.limit.startswith("torque of axis ")
    assert only.difference.startswith("up to 24 % faster")
    assert only.other_text == " (and in 1 like it)"


def test_arcs_that_turn_the_tool_are_reported() -> None:
    (only,) = found(arcs("vmax", "0.19081,0,0.98163,0"))
    assert only.difference.startswith("up to 18 % slower")


@pytest.mark.parametrize(
    "text",
    [
        sharp(speed="v200"),
        sharp(zone="z1"),
        sharp(zone="z50"),
        program(
            f"MoveJ {pose(700, 400)},v1000,z10,tool0;", f"MoveL {pose(900, 700)},v1000,fine,tool0;"
        ),
        arcs("vmax", "0,0,1,0"),
    ],
)
def test_corners_as_in_logs_that_agree_are_not_reported(text: str) -> None:
    assert found(text) == []


def test_the_accuracy_of_other_arms_includes_such_corners() -> None:
    assert [code for code, _ in ran(sharp()).findings if code == "R118"] == []
