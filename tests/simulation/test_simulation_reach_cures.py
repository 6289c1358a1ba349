"""A target out of reach: by how much, because of what, and the nearest cure.

The arm is an IRB 1600-6/1.2: axis 2 stands 150 mm in front of axis 1, 486.5 mm up; the wrist centre
is 475 + 600 mm from it when the arm is stretched, and 65 mm above the flange of a tool that points
down. The expected shifts come from these lengths alone.
"""

from __future__ import annotations

import re
from math import cos, degrees, radians, sin

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from laws import examples
from simulation_program import ran
from simulation_reach import checked

from rapidsim.findings.reach_and_motion_data import UnreachableTarget

Point = npt.NDArray[np.float64]

STRETCHED = 475.0 + 600.0
TOOL_AND_WRIST = np.array([0.0, 0.0, 65.0 + 120.0])


def axis_2(turn: float) -> Point:
    """Where axis 2 stands [mm] with axis 1 turned [deg]."""
    return np.array([150.0 * cos(radians(turn)), 150.0 * sin(radians(turn)), 486.5])


def target(turn: float, rise: float, beyond: float) -> Point:
    """A point [mm] for a tool that points down, whose wrist centre is so far beyond reach."""
    outward = np.array(
        [
            cos(radians(rise)) * cos(radians(turn)),
            cos(radians(rise)) * sin(radians(turn)),
            sin(radians(rise)),
        ]
    )
    wrist = axis_2(turn) + (STRETCHED + beyond) * outward
    point: Point = wrist - TOOL_AND_WRIST
    return point


def distance_of_wrist(point: Point) -> float:
    """How far [mm] from axis 2 the wrist centre stands for a point, axis 1 turned towards it."""
    wrist = point + TOOL_AND_WRIST
    turn = degrees(np.arctan2(wrist[1], wrist[0]))
    return float(np.linalg.norm(wrist - axis_2(turn)))


def program(*points: Point, frame: tuple[float, ...] = (0.0, 0.0, 0.0)) -> str:
    """A program that goes to points of a table with a tool of 120 mm."""
    declared = "\n".join(
        f"  CONST robtarget p{k}:=[[{x:.4f},{y:.4f},{z:.4f}],[0,0,1,0],[0,0,0,0],"
        "[9E9,9E9,9E9,9E9,9E9,9E9]];"
        for k, (x, y, z) in enumerate(points, 1)
    )
    moves = "\n".join(
        f"    MoveJ p{k},v500,fine,tGrip\\WObj:=table;" for k in range(1, len(points) + 1)
    )
    x, y, z = frame
    return f"""MODULE cell
  PERS tooldata tGrip:=[TRUE,[[0,0,120],[1,0,0,0]],[1,[0,0,60],[1,0,0,0],0,0,0]];
  PERS wobjdata table:=[FALSE,TRUE,"",[[{x:g},{y:g},{z:g}],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
{declared}
  PROC main()
    ConfJ\\Off;
{moves}
  ENDPROC
ENDMODULE
"""


def shift_in(help_: str | None) -> Point:
    """The shift [mm] that a cure proposes."""
    found = re.search(r"by \[([-\d.]+),([-\d.]+),([-\d.]+)\]", help_ or "")
    assert found, help_
    return np.array([float(number) for number in found.groups()])


def test_47_mm_out_of_reach_says_so_and_why_and_where_to_move_the_table() -> None:
    point = target(turn=20.0, rise=15.0, beyond=47.0)
    found = checked(program(point)).only("K601")
    assert isinstance(found.violation, UnreachableTarget)
    assert found.violation.message == (
        "`p1` cannot be reached by ABB IRB 1600-6/1.2: wrist centre 47.0 mm beyond reach: "
        "the stretched arm puts it 1075.0 mm from axis 2, the target asks for 1122.0 mm"
    )
    help_ = found.violation.help
    assert help_ is not None
    assert help_.startswith("it is in reach with `table` moved 48 mm toward the base by [")
    assert [related.message for related in found.related] == [
        "`table`, the work object, is declared here"
    ]
    # The shortest way to a sphere is the way to its centre.
    expected = point + TOOL_AND_WRIST - axis_2(20.0)
    expected *= -47.0 / np.linalg.norm(expected)
    assert np.linalg.norm(shift_in(help_) - expected) < 2.0
    assert distance_of_wrist(point + shift_in(help_)) <= STRETCHED


# Higher up, the tool that points down would turn axis 5 past its limit as well.
@examples(12)
@given(st.floats(-60.0, 60.0), st.floats(-10.0, 20.0), st.floats(0.5, 400.0))
def test_the_cure_is_the_shortest_shift_and_it_works(
    turn: float, rise: float, beyond: float
) -> None:
    point = target(turn, rise, beyond)
    found = checked(program(point), run=False).only("K601").violation
    assert f"wrist centre {beyond:.1f} mm beyond reach" in found.message
    shift = shift_in(found.help)
    # One millimetre for rounding up, one for the last turns of the search.
    assert beyond - 0.2 <= np.linalg.norm(shift) <= 1.01 * beyond + 2.0
    assert distance_of_wrist(point + shift) <= STRETCHED
    moved = program(point, frame=tuple(shift))
    assert "K601" not in {code for code, _ in checked(moved).codes}
    assert "K601" not in {code for code, _ in ran(moved).findings}


def test_one_shift_cures_all_targets_of_a_work_object() -> None:
    # The table is too far and too wide: both ends must come in, so the shift is no target's own.
    left, right = target(30.0, 10.0, 60.0), target(-30.0, 10.0, 25.0)
    near = np.array([600.0, 0.0, 300.0])
    found = checked(program(left, near, right)).findings
    assert [(one.code, one.line) for one in found] == [("K601", 9), ("K601", 11)]
    cures = {one.diagnostic.violation.help for one in found}
    assert len({tuple(shift_in(cure)) for cure in cures}) == 1
    assert all(cure and "all its targets are in reach with `table` moved" in cure for cure in cures)
    shift = shift_in(found[0].diagnostic.violation.help)
    for point in (left, right):
        assert distance_of_wrist(point + shift) <= STRETCHED
    # No shorter shift does, by trying: the two spheres leave no room below that length.
    size = float(np.linalg.norm(shift))
    rng = np.random.default_rng(7)
    tries = rng.normal(size=(20_000, 3))
    tries *= (0.97 * (size - 1.0) / np.linalg.norm(tries, axis=1))[:, None]
    both = np.maximum(
        [distance_of_wrist(left + one) for one in tries],
        [distance_of_wrist(right + one) for one in tries],
    )
    assert both.min() > STRETCHED
    moved = program(left, near, right, frame=tuple(shift))
    assert "K601" not in {code for code, _ in checked(moved).codes}
    assert ran(moved).end == "ended"


def test_a_joint_limit_is_named_and_another_orientation_proposed() -> None:
    text = program(np.array([700.0, 0.0, 400.0])).replace(
        "[0,0,1,0],[0,0,0,0]", "[1,0,0,0],[0,0,0,0]"
    )
    found = checked(text).only("K601").violation
    assert re.search(r"joint 5 over by \d+\.\d deg at its (upper|lower) limit", found.message)
    turn = re.search(r"with the tool turned ([+-]\d+) deg about its ([xyz])", found.help or "")
    assert turn
    angle = float(turn[1]) if turn[2] == "y" else 0.0
    assert angle
    half = radians(angle) / 2.0
    turned = text.replace("[1,0,0,0],[0,0,", f"[{cos(half):.7f},0,{sin(half):.7f},0],[0,0,")
    assert "K601" not in {code for code, _ in checked(turned).codes}


# --- a work object that is moved

RNG = np.random.default_rng(2)
SPREAD = np.vstack(
    [RNG.uniform([250.0, -800.0, -100.0], [1150.0, 800.0, 900.0], (11, 3)), [1260.0, 0.0, 300.0]]
)
"""Eleven targets here and there, and one that is out of reach while the table stands still."""


def shifted_program(shift: tuple[float, float, float]) -> str:
    """Twelve targets of a table, each reached in a routine of its own that tells when it was."""
    text = program(*SPREAD, frame=shift)
    routines = "\n".join(
        f"""  PROC go{k}()
    joints:=CalcJointT(p{k},tGrip\\WObj:=table);
    MoveJ p{k},v1000,fine,tGrip\\WObj:=table;
    TPWrite "{k}";
  ERROR
    RETURN;
  ENDPROC"""
        for k in range(1, len(SPREAD) + 1)
    )
    calls = "\n".join(f"    go{k};" for k in range(1, len(SPREAD) + 1))
    head = f"{text[: text.index('  PROC main()')]}  VAR jointtarget joints;\n"
    return f"{head}  PROC main()\n    ConfJ\\Off;\n{calls}\n  ENDPROC\n{routines}\nENDMODULE\n"


def red(shift: tuple[float, float, float]) -> set[int]:
    """The targets that checking by value holds out of reach."""
    found = checked(shifted_program(shift), run=False).findings
    return {int(one.message.split("`")[1][1:]) for one in found if one.code == "K601"}


@examples(12)
@given(st.tuples(*(st.floats(-300.0, 300.0).map(lambda x: round(x, 1)),) * 3))
def test_a_moved_work_object_turns_exactly_the_right_targets_red(
    shift: tuple[float, float, float],
) -> None:
    assume(any(shift))
    reached = {int(text) for text in ran(shifted_program(shift)).texts}
    assert red(shift) == set(range(1, len(SPREAD) + 1)) - reached


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("way", [300.0, -300.0])
def test_300_mm_turn_targets_red_and_moving_back_turns_them_green(axis: int, way: float) -> None:
    still = red((0.0, 0.0, 0.0))
    shift = [0.0, 0.0, 0.0]
    shift[axis] = way
    moved = red((shift[0], shift[1], shift[2]))
    reached = {int(text) for text in ran(shifted_program((shift[0], shift[1], shift[2]))).texts}
    assert moved == set(range(1, len(SPREAD) + 1)) - reached
    assert moved != still
    assert red((0.0, 0.0, 0.0)) == still
