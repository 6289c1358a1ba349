"""Programs of several tasks, given as text, on default arms."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from simulation_program import arm

from rapidsim.analysis.cell_names import NO_CELL, CellNames
from rapidsim.controller.journal.events import EventKind
from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.diagnostics import Diagnostic
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.load_tasks import load_tasks
from rapidsim.module_files import TaskFiles
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.simulate import simulate_tasks
from rapidsim.simulation.task_run import TaskSetup
from rapidsim.station.task_kind import TaskKind

JOINTS = "[9E9,9E9,9E9,9E9,9E9,9E9]"
"""No external axes."""


@dataclass(frozen=True)
class Ran:
    """A run, and short words for what tests ask of it."""

    run: Simulation

    @property
    def end(self) -> str:
        return self.run.end.value

    @property
    def events(self) -> list[tuple[float, str, str]]:
        """Time to 10 us, task and text of the texts and signals."""
        kinds = (EventKind.TEXT, EventKind.SIGNAL)
        return [
            (round(event.time_s, 5), event.task, event.message)
            for event in self.run.events
            if event.kind in kinds
        ]

    @property
    def texts(self) -> list[tuple[float, str]]:
        """Time to 10 us and text of the operator's lines."""
        kind = EventKind.TEXT
        return [(round(e.time_s, 5), e.message) for e in self.run.events if e.kind is kind]

    def moves(self, task: str) -> Sequence[ExecutedMove]:
        """The moves of a task."""
        (moves,) = [robot.moves for robot in self.run.robots if robot.task == task]
        return moves

    def only(self, code: str) -> Diagnostic:
        """The only finding with a code."""
        (found,) = [d for d in self.run.diagnostics if d.violation.code == code]
        return found


def ran(
    programs: Mapping[str, str],
    *,
    robots: tuple[str, ...] = (),
    background: tuple[str, ...] = (),
    arms: Mapping[str, str] = MappingProxyType({}),
    cell: CellNames = NO_CELL,
    **options: object,
) -> Ran:
    """Run tasks; each program is what stands between MODULE and ENDMODULE.

    Args:
        programs: By name of the task.
        robots: The tasks that have a robot; none means all but those of the background.
        background: The tasks that are static.
        arms: The models of tasks whose arm is not the usual one.
        cell: What a station declares.
        options: Of the run.
    """
    files = [
        TaskFiles(name, (SourceFile(f"{name}.mod", module(name, text), "utf-8"),))
        for name, text in programs.items()
    ]
    loaded = load_tasks(files, cell)
    assert loaded.tasks, [d.violation.message for d in loaded.diagnostics]
    with_robot = robots or tuple(name for name in programs if name not in background)
    setups = [
        TaskSetup(
            task.name,
            task.program,
            arm(arms.get(task.name, "irb1600")) if task.name in with_robot else None,
            kind=TaskKind.STATIC if task.name in background else TaskKind.NORMAL,
            written=task.written,
        )
        for task in loaded.tasks
    ]
    return Ran(simulate_tasks(setups, RunOptions(**options)))  # type: ignore[arg-type]


def module(name: str, text: str) -> str:
    return f"MODULE {name}_module\n{text}\nENDMODULE\n"
