"""A check, its run of main included, and a run name the same first error of random programs."""

from __future__ import annotations

import pytest
from laws import cases
from simulation_random_motion import random_program, robot_name, robot_of

from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.reach import trial_run
from rapidsim.reach.reach import check_reach
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import End
from rapidsim.simulation.simulate import simulate

FEW = cases(500)


@pytest.fixture(autouse=True)
def patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the run of a check end however busy the computer is."""
    monkeypatch.setattr(trial_run, "LONGEST_WORK_FOR_ERRORS_S", 60.0)


def _told(found: list[Diagnostic]) -> tuple[str, int, str] | None:
    errors = [one for one in found if one.severity is Severity.ERROR and one.span is not None]
    first = min(errors, key=lambda one: one.order, default=None)
    return None if first is None else (first.code, first.line or 0, first.message)


def first_errors(seed: int) -> tuple[object, object]:
    """The first error of a check, and that of a run: code, line, message."""
    loaded = load([SourceFile("cell.mod", random_program(seed), "utf-8")])
    assert loaded.program is not None, [one.message for one in loaded.diagnostics]
    robot = robot_of(robot_name(seed))
    run = simulate(loaded.program, robot, options=RunOptions())
    ran = _told(list(run.diagnostics))
    assert (ran is not None) == (run.end is End.ERROR)
    by_check = _told(list(check_reach(loaded.program, robot).diagnostics))
    return by_check, ran


@pytest.mark.parametrize("seed", range(FEW))
def test_check_and_run_name_the_same_first_error(seed: int) -> None:
    by_check, by_run = first_errors(seed)
    assert by_check == by_run
