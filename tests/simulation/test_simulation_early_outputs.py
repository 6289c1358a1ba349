"""Outputs set before the robot was at a target: told of the move said last, not of the next one."""

import pytest
from simulation_program import ran

TARGETS = """
  CONST robtarget a:=[[700,0,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[700,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
"""
STOP, FLY_BY, OUTPUT = (
    "MoveL a,v200,fine,tool0;",
    "MoveL b,v200,z20,tool0;",
    "SetDO doGrip,1-DOutput(doGrip);",
)


def told(*statements: str) -> list[int]:
    """The numbers of the statements of whose output it is told."""
    body = "\n".join(("MoveJ a,v500,fine,tool0;", *statements))
    text = f"MODULE m\n{TARGETS}  PROC main()\n{body}\n  ENDPROC\nENDMODULE\n"
    first = text[: text.index("MoveJ")].count("\n") + 2
    return [line - first for code, line in ran(text).findings if code == "R117"]


@pytest.mark.parametrize(
    ("statements", "early"),
    [
        # Nothing takes time between the output and the next move, which starts at that instant.
        ((STOP, OUTPUT, FLY_BY, STOP), []),
        ((STOP, FLY_BY, OUTPUT, STOP), [2]),
        ((STOP, OUTPUT, FLY_BY, OUTPUT, STOP), [3]),
        (("FOR i FROM 1 TO 3 DO", STOP, OUTPUT, FLY_BY, "ENDFOR"), []),
        (("FOR i FROM 1 TO 3 DO", FLY_BY, OUTPUT, STOP, "ENDFOR"), [2]),
    ],
)
def test_the_move_said_last_counts(statements: tuple[str, ...], early: list[int]) -> None:
    assert told(*statements) == early
