"""All programs of the repository: what checking by value calls an error, a run cannot do either."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest
from laws import some
from simulation_program import arm

from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.files import InputError
from rapidsim.frames.transform import Transform
from rapidsim.jobs.checking.checked_program import LoadedProgram, load
from rapidsim.library.catalogue import ROUTINES
from rapidsim.library.traits import Trait
from rapidsim.module_files import read_tasks
from rapidsim.motion.configurations.reachability import unreachable_reason
from rapidsim.reach.checked_moves import ReachReport
from rapidsim.reach.dataflow.program_walk import walk_program
from rapidsim.reach.reach import check_reach
from rapidsim.reach.target_poses import posed

ROOT = Path(__file__).parents[2]
PROGRAMS = sorted(
    path for folder in ("programs", "tests") for path in (ROOT / folder).rglob("*.mod")
)
MOVES = re.compile("|".join(k for k, row in ROUTINES.items() if Trait.MOVE in row.traits).encode())


@cache
def read(path: Path) -> LoadedProgram | None:
    """A module on its own, read once; None where it is no text of RAPID."""
    try:
        return load(read_tasks([str(path)])[0].files)
    except InputError:
        return None


def names_a_move(path: Path) -> bool:
    """Whether a text names an instruction that moves; there is nothing to reach without one."""
    return MOVES.search(path.read_bytes().lower()) is not None


def errors(report: ReachReport) -> list[Diagnostic]:
    """The findings that keep a robot from a move."""
    return [one for one in report.diagnostics if one.severity is Severity.ERROR]


def test_no_error_is_a_false_one(rule_programs: list[Path]) -> None:
    """By value: the arm's own solver says so of a target, and of no other one."""
    checked = 0
    for path in filter(names_a_move, [*PROGRAMS, *some(rule_programs, 3)]):
        loaded = read(path)
        if loaded is None or loaded.program is None:
            continue
        walked = walk_program(loaded.program)
        placed = posed(walked.moves, arm(), Transform.identity())
        report = check_reach(loaded.program, arm(), run=False)
        told = {
            one.span.line for one in errors(report) if one.violation.code == "K601" and one.span
        }
        out = {
            known.span.line
            for row, known in enumerate(walked.moves)
            if row not in placed.left_out
            and not placed.to_axes[row]
            and unreachable_reason(arm(), placed.base_from_flange[row]) is not None
        }
        assert told == out, path
        checked += report.coverage.by_value
    assert checked > 150


@pytest.mark.parametrize("name", ["pentagon", "algorithms"])
def test_the_programs_for_readers_have_no_errors(name: str) -> None:
    loaded = read(ROOT / "programs" / f"{name}.mod")
    assert loaded is not None
    assert loaded.program is not None
    report = check_reach(loaded.program, arm())
    assert errors(report) == []
    assert report.coverage.unchecked == ()
