r"""The argument \T: kept where the arm can, reported where it cannot."""

import re

import pytest
from simulation_program import ran

from rapidsim.motion.timing.axis_limits import model_of

HEAD = (
    "MODULE cell\n PROC main()\n"
    "  MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;\n"
)
TAIL = " ENDPROC\nENDMODULE\n"


def turn(degrees: float, time_s: float, zone: str = "fine") -> str:
    axes = "[9E9,9E9,9E9,9E9,9E9,9E9]"
    return f"  MoveAbsJ [[{degrees},0,0,0,30,0],{axes}],v500\\T:={time_s},{zone},tool0;\n"


def line(x: float, time_s: float, zone: str = "fine") -> str:
    target = f"[[{x},0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
    return f"  MoveL {target},v500\\T:={time_s},{zone},tool0;\n"


def test_a_move_with_too_little_time_says_what_it_needs() -> None:
    it = ran(HEAD + turn(90, 0.2) + TAIL)
    assert it.findings == [("K612", 4)]
    found = it.only("K612")
    assert found.severity == "warning"
    needed = (
        it.run.moves[1].end_s
        - it.run.moves[1].start_s
        - model_of(it.run.only.robot, it.run.model).window
    )
    told = re.fullmatch(
        r"the move takes (\d\.\d{3}) s; `\\T` allows 0\.2 s", found.violation.message
    )
    assert told
    # What is told ends with the command, the record where the arm has come to rest.
    assert float(told[1]) == pytest.approx(needed, abs=0.001)
    assert it.end == "ended"


@pytest.mark.parametrize(
    "moves",
    [
        turn(90, 2),
        turn(45, 1, "z50") + turn(90, 1.5),
        turn(45, 1, "z50") + "  TPWrite ValToStr(CPos());\n" + turn(90, 1.5),
        "  MoveJ [[800,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;\n"
        + line(900, 1, "z10")
        + line(800, 2),
    ],
)
def test_a_time_that_can_be_kept_is_no_finding(moves: str) -> None:
    it = ran(HEAD + moves + TAIL)
    assert (it.end, it.findings) == ("ended", [])


def test_each_move_without_enough_time_is_reported() -> None:
    it = ran(HEAD + turn(45, 0.05, "z50") + turn(90, 3, "z50") + turn(0, 0.1) + TAIL)
    assert it.findings == [("K612", 4), ("K612", 6)]
