"""Programs whose targets are all in metres are one error, however many moves they have."""

from collections.abc import Iterator
from math import cos, sin
from pathlib import Path

import pytest
from command_line import call

WOBJ = 'PERS wobjdata w:=[FALSE,TRUE,"",[[800,0,900],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];'
MOVES = 40


def module(positions: Iterator[tuple[float, float, float]]) -> str:
    moves = "".join(
        f"    MoveL [[{x:.6f},{y:.6f},{z:.6f}],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],"
        "v100,z1,tool0\\WObj:=w;\n"
        for x, y, z in positions
    )
    return f"MODULE job\n  {WOBJ}\n  PROC main()\n{moves}  ENDPROC\nENDMODULE\n"


def circle(radius: float, x: float = 0.0) -> Iterator[tuple[float, float, float]]:
    return ((x + radius * cos(i), radius * sin(i), 0.1 + 0.001 * i) for i in range(MOVES))


def line(step: float) -> Iterator[tuple[float, float, float]]:
    return ((30.0 + step * i, 0.0, 0.1) for i in range(MOVES))


@pytest.mark.parametrize(
    ("positions", "message"),
    [
        (circle(0.3), "all 40 targets lie within 5 mm of an origin: these look like metres"),
        (line(0.01), "all 40 moves are shorter than 0.02 mm: these look like metres"),
        (circle(300.0), None),
        (circle(6.0), None),
        (line(0.05), None),
    ],
    ids=["metres", "tiny steps", "millimetres", "small", "small steps"],
)
def test_a_routine_in_metres(
    positions: Iterator[tuple[float, float, float]], message: str | None, tmp_path: Path
) -> None:
    (tmp_path / "job.mod").write_text(module(positions))
    checked = call(
        "check", "job.mod", "--robot", "irb1600", "--select", "M516", "--output-format", "concise",
        "--no-run", cwd=tmp_path,
    )  # fmt: skip
    found = [] if message is None else [f"job.mod:4:11: error[M516] {message}"]
    assert [text for text in checked.out.splitlines() if "[M516]" in text] == found
    assert checked.code == len(found)


def test_a_routine_that_only_declares_targets(tmp_path: Path) -> None:
    """Many targets of its own, and no move: nothing is concluded, and nothing fails."""
    shown = "".join(
        f"    CONST robtarget p{i}:=[[{600 + i},0,600],[0,0,1,0],[0,0,0,0],"
        "[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        for i in range(MOVES)
    )
    moves = "".join(f"    MoveL p{i},v100,z1,tool0;\n" for i in range(MOVES))
    (tmp_path / "job.mod").write_text(
        f"MODULE job\n{shown}  PROC main()\n{moves}  ENDPROC\n"
        f"  PROC other()\n{shown}  ENDPROC\nENDMODULE\n"
    )
    checked = call("check", "job.mod", "--robot", "irb1600", "--select", "M516", cwd=tmp_path)
    assert checked.code == 0, checked.out
