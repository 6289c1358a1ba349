"""From the files of several tasks to their programs, and what they disagree about."""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.analysis.cell_names import NO_CELL, CellNames
from rapidsim.analysis.program import DataSymbol, Program
from rapidsim.diagnostics import Diagnostic, Related, Span, Violation
from rapidsim.interpreter.runtime.memory import module_data
from rapidsim.interpreter.runtime.shared_persistents import disagreements, may_be_shared
from rapidsim.jobs.checked_program import load_task
from rapidsim.module_files import TaskFiles
from rapidsim.reach.dataflow.side_effects import ProgramEffects
from rapidsim.reach.dataflow.written_moves import written_moves
from rapidsim.station.tasks import DEFAULT_TASK
from rapidsim.values import dataclass


class SharedPersistentTypes(Violation, code="N208"):
    data: str
    of: str
    other: str


@dataclass(frozen=True, slots=True)
class LoadedTask:
    """A task whose program can run."""

    name: str
    program: Program
    moves: int
    """How many move instructions it has."""

    @property
    def has_moves(self) -> bool:
        """Whether it moves a robot."""
        return self.moves > 0

    @property
    def written(self) -> frozenset[str]:
        """Folded names of the persistents that it may write."""
        effects = ProgramEffects(self.program)
        persistents = filter(may_be_shared, module_data(self.program))
        return frozenset(one.name.lower() for one in persistents if effects.is_written(one))


@dataclass(frozen=True, slots=True)
class LoadedTasks:
    """The tasks of a cell, and what was found in their files."""

    tasks: tuple[LoadedTask, ...]
    """Empty where there is an error among the findings."""
    diagnostics: tuple[Diagnostic, ...]


def load_tasks(tasks: Sequence[TaskFiles], cell: CellNames = NO_CELL) -> LoadedTasks:
    """Parse and check the modules of tasks; mistakes in them are findings, never raised."""
    loaded = [load_task(task, cell) for task in tasks]
    programs = [one.program for one in loaded if one.program is not None]
    conflicts = shared_findings(programs) if len(tasks) > 1 else ()
    diagnostics = (*(found for one in loaded for found in one.diagnostics), *conflicts)
    if conflicts or len(programs) < len(tasks):
        return LoadedTasks((), diagnostics)
    named = tuple(
        LoadedTask(task.name or DEFAULT_TASK, program, len(written_moves(one.files)))
        for task, one, program in zip(tasks, loaded, programs, strict=True)
    )
    return LoadedTasks(named, diagnostics)


def shared_findings(programs: Sequence[Program]) -> tuple[Diagnostic, ...]:
    """The persistents that tasks would share if they agreed on their type."""
    return tuple(
        Diagnostic(
            SharedPersistentTypes(one.other.name, one.other.type.name, one.first.type.name),
            _name_span(one.other),
            (Related(_name_span(one.first), "declared here in another task"),),
        )
        for one in disagreements(programs)
    )


def _name_span(symbol: DataSymbol) -> Span:
    assert symbol.node is not None
    assert symbol.module is not None
    return symbol.module.span(symbol.node.name)
