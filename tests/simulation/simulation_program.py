"""Whole programs on the default arm: what they show, how they end, what the run finds."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from rapidsim.analysis.cell_names import CellNames
from rapidsim.controller.journal.events import EventKind
from rapidsim.diagnostics import Diagnostic
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.motion.robot.robot import Robot, load_robot
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.simulate import simulate


@dataclass(frozen=True)
class Ran:
    """A run, and short words for what tests ask of it."""

    run: Simulation

    @property
    def end(self) -> str:
        return self.run.end.value

    @property
    def texts(self) -> list[str]:
        return [event.message for event in self.run.events if event.kind is EventKind.TEXT]

    @property
    def findings(self) -> list[tuple[str, int]]:
        """Code and line of each finding; line 0 where it has no place."""
        return [(d.violation.code, d.span.line if d.span else 0) for d in self.run.diagnostics]

    def only(self, code: str) -> Diagnostic:
        """The only finding with a code."""
        (found,) = [d for d in self.run.diagnostics if d.violation.code == code]
        return found


@cache
def arm(name: str = "irb1600") -> Robot:
    return load_robot(name)


def ran(text: str, *, assumes: bool = False, robot: str = "irb1600", **options: object) -> Ran:
    """Run a program without errors, on request with what it lacks assumed."""
    loaded = load([SourceFile("cell.mod", text, "utf-8")], cell=CellNames(assumes=assumes))
    assert loaded.program is not None, [d.violation.message for d in loaded.diagnostics]
    return Ran(simulate(loaded.program, arm(robot), options=RunOptions(**options)))  # type: ignore[arg-type]


def calls(found: Diagnostic) -> list[tuple[str, int]]:
    """What is said of the calls that led to a finding, innermost first, with their lines."""
    return [(related.message, related.span.line) for related in found.related]
