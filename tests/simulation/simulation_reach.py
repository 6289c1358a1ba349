"""Programs whose moves are checked on the default arm."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from rapidsim.diagnostics import Diagnostic
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.motion.robot.robot import Robot, load_robot
from rapidsim.reach.checked_moves import ReachReport
from rapidsim.reach.reach import check_reach
from rapidsim.simulation.options import RunOptions


@dataclass(frozen=True)
class Found:
    """A finding in short."""

    code: str
    line: int
    message: str
    diagnostic: Diagnostic


@dataclass(frozen=True)
class Checked:
    """What checking the moves of a program found."""

    report: ReachReport

    @property
    def findings(self) -> list[Found]:
        """In order of the text."""
        ordered = sorted(self.report.diagnostics, key=lambda found: found.order)
        return [
            Found(one.violation.code, one.span.line if one.span else 0, one.violation.message, one)
            for one in ordered
        ]

    @property
    def codes(self) -> list[tuple[str, int]]:
        """Code and line of each finding."""
        return [(found.code, found.line) for found in self.findings]

    def only(self, code: str) -> Diagnostic:
        """The only finding with a code."""
        (found,) = [one for one in self.findings if one.code == code]
        return found.diagnostic

    @property
    def counts(self) -> tuple[int, int, int]:
        """Moves checked by value, by run, and not at all."""
        coverage = self.report.coverage
        return coverage.by_value, coverage.by_run, len(coverage.unchecked)

    @property
    def reasons(self) -> list[tuple[int, str]]:
        """Why moves were not checked, by line."""
        return [(one.span.line, one.reason) for one in self.report.coverage.unchecked]


@cache
def arm(name: str = "irb1600") -> Robot:
    return load_robot(name)


def checked(
    text: str,
    *,
    run: bool = True,
    robot: str = "irb1600",
    options: RunOptions | None = None,
    budget_s: float | None = None,
) -> Checked:
    """Check the moves of a program without errors."""
    loaded = load([SourceFile("cell.mod", text, "utf-8")])
    assert loaded.program is not None, [d.violation.message for d in loaded.diagnostics]
    program, on = loaded.program, arm(robot)
    return Checked(check_reach(program, on, options, run=run, cycle_budget_s=budget_s))
