"""A check that looks at long runs of moves as runs, beside one that looks at each statement."""

from __future__ import annotations

from functools import cache
from typing import Any
from unittest.mock import patch

from rapidsim.analysis.cell_names import NO_CELL, CellNames
from rapidsim.analysis.program import Program
from rapidsim.diagnostics import Diagnostic, Span
from rapidsim.files import SourceFile
from rapidsim.jobs.checking import check_files
from rapidsim.jobs.checking.check_files import check_tasks
from rapidsim.jobs.checking.check_result import CheckResult
from rapidsim.module_files import TaskFiles
from rapidsim.motion.robot.robot import Robot, load_robot
from rapidsim.reach import trial_run
from rapidsim.reach.checked_moves import ReachReport
from rapidsim.reach.reach import check_reach

FEW = 20
"""Moves beyond which a check of these tests runs no program."""


def assert_runs_change_nothing(
    *texts: str,
    cell: CellNames = NO_CELL,
    unseen: tuple[str, ...] = (),
    refers_late: bool = False,
) -> CheckResult:
    """Check a task in both ways.

    Args:
        texts: Its modules.
        cell: What the configuration declares besides the modules.
        unseen: Modules of the task that cannot be read.
        refers_late: Whether its controller allows unresolved references.

    Returns:
        What was found where moves were looked at as runs.
    """
    files = tuple(SourceFile(f"m{k}.mod", text, "utf-8") for k, text in enumerate(texts))
    task = TaskFiles("T_ROB1", files, refers_late=refers_late, unseen=unseen)
    with (
        patch.object(trial_run, "MOST_MOVES", FEW),
        patch.object(trial_run, "MOST_MOVES_FOR_ERRORS", FEW),
    ):
        plain = check_tasks([task], moves=_moves, cell=cell)
        with patch.object(check_files, "MOST_MOVES", FEW):
            found = check_tasks([task], moves=_moves, cell=cell)
    assert list(map(facts, found.diagnostics)) == list(map(facts, plain.diagnostics))
    assert coverage(found) == coverage(plain)
    return found


def rows_in_runs(result: CheckResult) -> int:
    """How many statements were looked at as rows of a run."""
    return sum(len(run) for file in result.trees for one in file.modules for run in one.runs)


def facts(found: Diagnostic) -> tuple[Any, ...]:
    """All that a finding says, comparable."""
    fix = found.fix
    return (
        found.violation,
        found.severity,
        _place(found.span),
        [(_place(one.span), one.message) for one in found.related],
        fix and (fix.title, fix.safe, [(_place(one.span), one.text) for one in fix.edits]),
        found.routine,
    )


def coverage(result: CheckResult) -> tuple[Any, ...]:
    """How moves were checked, comparable."""
    of = result.coverage
    unchecked = [(_place(one.span), one.reason) for one in of.unchecked]
    return of.by_value, of.by_run, unchecked


def _place(span: Span | None) -> tuple[str, int, int] | None:
    return None if span is None else (span.file, span.start, span.end)


def _moves(program: Program, task: str, *, runs: bool) -> ReachReport:
    del task
    return check_reach(program, _robot(), run=runs)


@cache
def _robot() -> Robot:
    return load_robot("irb4600-45-2.05")
