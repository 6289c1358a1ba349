"""Paths laid end to end: the arm is where each path alone has it."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st
from laws import examples
from motion_programs import (
    Programmer,
    path_of,
    path_or_fault,
    programs,
    require_same_when_joined,
    zone,
)

from rapidsim.motion.path.joined_paths import joined_paths
from rapidsim.motion.path.path import Path


@given(st.lists(programs(), min_size=2, max_size=4))
@examples(15)
def test_joined_paths_are_each_path(written: list[Programmer]) -> None:
    paths = [path for path in map(path_or_fault, written) if isinstance(path, Path)]
    if paths:
        require_same_when_joined(paths)


def test_wrists_that_turn_in_joints_and_others_are_joined() -> None:
    in_joints = Programmer().line((0.1, 0.1, 0.0), (0.0, 0.1, 0.2), wrist_in_joints=True)
    arc = Programmer().line((0.1, 0.0, 0.0), via=(0.05, 0.05, 0.0), z=zone(10)).move([0.1] * 6)
    require_same_when_joined(
        [path_of(arc), path_of(in_joints), path_of(Programmer().line((0.1, 0.0, 0.0)))]
    )


def test_few_rows_stand_in_one_path_and_many_do_not() -> None:
    short = path_of(Programmer().line((0.1, 0.0, 0.0)))
    program = Programmer()
    for _ in range(300):
        program.line((1e-4, 0.0, 0.0), z=zone(0.3))
    long = path_of(program)
    assert joined_paths([short, long, long, short]).on.tolist() == [0, 0, 1, 1]
