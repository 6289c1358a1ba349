"""After a slow stop the command goes on before the arm is quite at rest, also in loops."""

from __future__ import annotations

import pytest
from simulation_program import ran

PLACE = "[[%s,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
MOVES = "    MoveAbsJ %s, v10, fine, tool0;\n"


def duration_s(statements: str) -> float:
    """Of a run [s]."""
    text = f"MODULE m\n  VAR jointtarget at:={PLACE % 0};\n  PROC main()\n{statements}  ENDPROC\n"
    return ran(text + "ENDMODULE\n").run.trajectory.duration


def test_a_loop_takes_as_long_as_its_rounds_written_out() -> None:
    """A round of a loop takes ten microseconds, for which no robot comes to rest first."""
    rounds = 4
    written_out = "".join(MOVES % (PLACE % k) for k in range(1, rounds + 1))
    turn = "      at.robax.rax_1:=i;\n  " + MOVES % "at"
    looped = f"    FOR i FROM 1 TO {rounds} DO\n{turn}    ENDFOR\n"
    assert duration_s(looped) == pytest.approx(duration_s(written_out), abs=1e-3)


def test_a_wait_after_a_slow_stop_begins_when_the_arm_stands() -> None:
    there, back = MOVES % (PLACE % 1), MOVES % (PLACE % 0)
    thinks, waits, longer = (
        duration_s(f"{there}    WaitTime {wait_s};\n{back}") for wait_s in (0.001, 0.1, 0.2)
    )
    assert longer == pytest.approx(waits + 0.1, abs=1e-6)
    assert waits > thinks + 0.1
