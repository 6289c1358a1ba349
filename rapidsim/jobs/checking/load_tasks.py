"""Load the programs of several tasks from their files, and find conflicts between them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from rapidsim.analysis.cell_names import NO_CELL, CellNames
from rapidsim.analysis.program import DataSymbol, LibrarySymbol, Program
from rapidsim.diagnostics import Diagnostic, Related, Span, Violation
from rapidsim.interpreter.runtime.memory import module_data
from rapidsim.interpreter.runtime.shared_persistents import disagreements, may_be_shared
from rapidsim.jobs.checking.bulk_representatives import bulk_reading, findings_of_all
from rapidsim.jobs.checking.checked_program import LoadedProgram, load_task
from rapidsim.library.traits import Trait
from rapidsim.module_files import TaskFiles
from rapidsim.reach.dataflow.side_effects import ProgramEffects
from rapidsim.reach.dataflow.written_moves import written_move_count
from rapidsim.station.tasks import DEFAULT_TASK
from rapidsim.syntax import tree
from rapidsim.values import value_class


class SharedPersistentTypes(Violation, code="N208"):
    data: str
    of: str
    other_name: str


MOST_STATEMENTS = 1000
"""Number of moves of one shape above which they are executed in bulk; fewer do not pay."""


@value_class(frozen=True, slots=True)
class LoadedTask:
    """A task whose program can run."""

    name: str
    program: Program
    moves: int
    """Number of move instructions."""

    @property
    def has_moves(self) -> bool:
        """Whether the task moves a robot."""
        return self.moves > 0

    @property
    def written(self) -> frozenset[str]:
        """Folded names of the persistents that the program may write."""
        effects = ProgramEffects(self.program)
        persistents = filter(may_be_shared, module_data(self.program))
        return frozenset(one.name.lower() for one in persistents if effects.is_written(one))


@value_class(frozen=True, slots=True)
class LoadedTasks:
    """Tasks of a cell, and the findings in their files."""

    tasks: tuple[LoadedTask, ...]
    """Empty if there is an error among the findings."""
    diagnostics: tuple[Diagnostic, ...]


def load_tasks(
    tasks: Sequence[TaskFiles],
    cell: CellNames = NO_CELL,
    *,
    in_runs: bool = False,
    keeps_data: bool = True,
) -> LoadedTasks:
    """Parse and check the modules of tasks; errors in them are findings, never raised.

    Args:
        tasks: Tasks with their files.
        cell: Names that the configuration declares in addition to the modules.
        in_runs: Keep long sequences of moves of one shape as columns, executed as one statement.
        keeps_data: Keep the targets that such moves name as data of the program.
    """
    loaded = [
        _in_runs(task, cell, keeps_data=keeps_data) if in_runs else load_task(task, cell)
        for task in tasks
    ]
    programs = [one.program for one in loaded if one.program is not None]
    conflicts = shared_findings(programs) if len(tasks) > 1 else ()
    diagnostics = (*(found for one in loaded for found in one.diagnostics), *conflicts)
    if conflicts or len(programs) < len(tasks):
        return LoadedTasks((), diagnostics)
    named = tuple(
        LoadedTask(task.name or DEFAULT_TASK, program, written_move_count(one.files))
        for task, one, program in zip(tasks, loaded, programs, strict=True)
    )
    return LoadedTasks(named, diagnostics)


def _in_runs(task: TaskFiles, cell: CellNames, *, keeps_data: bool) -> LoadedProgram:
    """Load a task with long sequences of moves as columns, if the moves have no findings."""
    bulk = bulk_reading(MOST_STATEMENTS, keeps_data=keeps_data)
    loaded = load_task(task, cell, bulk=bulk)
    modules = [module for file in loaded.files for module in file.modules]
    runs = [run for module in modules for run in module.runs]
    if not runs:
        return loaded
    found = findings_of_all(loaded.files, loaded.diagnostics, cell)
    if found is not None and _can_execute(loaded.program, modules, runs):
        return replace(loaded, diagnostics=found)
    if any(run.names for run in runs):
        return _in_runs(task, cell, keeps_data=True)
    return load_task(task, cell)


def _can_execute(
    program: Program | None, modules: Sequence[tree.Module], runs: Iterable[tree.BulkStatements]
) -> bool:
    """Whether a program executes its modules' bulk statements; True if errors prevent a run."""
    if program is None:
        return True
    # A program without some of its statements is not the program that was read.
    is_whole = list(map(id, program.modules)) == list(map(id, modules))
    return is_whole and all(bool(run.names) or _is_move(run, program) for run in runs)


def _is_move(run: tree.BulkStatements, program: Program) -> bool:
    """Whether bulk statements are moves, whose name a routine of the program might hide."""
    symbol = program.symbol_of.get(run.like)
    return isinstance(symbol, LibrarySymbol) and Trait.MOVE in symbol.routine.traits


def shared_findings(programs: Sequence[Program]) -> tuple[Diagnostic, ...]:
    """Return findings on persistents that tasks would share if they agreed on the type."""
    return tuple(
        Diagnostic(
            SharedPersistentTypes(one.symbol.name, one.symbol.type.name, one.first.type.name),
            _name_span(one.symbol),
            (Related(_name_span(one.first), "declared here in another task"),),
        )
        for one in disagreements(programs)
    )


def _name_span(symbol: DataSymbol) -> Span:
    assert symbol.node is not None
    assert symbol.module is not None
    return symbol.module.span(symbol.node.name)
