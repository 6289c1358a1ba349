"""Load source files into a checked program: parse every file, then check them together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rapidsim.analysis.cell_names import NO_CELL, CellNames
from rapidsim.analysis.passes.checker import Find, check
from rapidsim.analysis.program import Program
from rapidsim.diagnostics import Diagnostic, Severity, Source
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.stubbed_program import stubbed_program
from rapidsim.module_files import TaskFiles
from rapidsim.syntax import tree
from rapidsim.syntax.bulk_reading import BulkReading
from rapidsim.syntax.parser import parse
from rapidsim.values import value_class
from rapidsim.workspace.guesses import without_guesses


@value_class(frozen=True, slots=True, eq=False)
class LoadedProgram:
    """Files of one task, their findings, and the program if it can run."""

    files: tuple[tree.File, ...]
    program: Program | None
    """None if there is an error among the findings."""
    diagnostics: tuple[Diagnostic, ...]


def load(
    files: Sequence[SourceFile],
    rules: Sequence[Find] = (),
    *,
    cell: CellNames = NO_CELL,
    unseen: Sequence[str] = (),
    refers_late: bool = False,
    bulk: BulkReading | None = None,
) -> LoadedProgram:
    """Parse and check the modules of one task; errors in them are findings, never raised.

    Args:
        files: The task's files.
        rules: Rules in addition to the errors that prevent a run.
        cell: Names that the configuration declares in addition to the modules.
        unseen: Modules of the task that cannot be read.
        refers_late: Whether its controller allows unresolved references.
        bulk: See `parse`.
    """
    sources = (Source(file.name, file.text) for file in files)
    parsed = [parse(one, bulk) for one in sources]
    trees = tuple(one.file for one in parsed)
    names = replace(cell, unseen=tuple(unseen), refers_late=refers_late)
    checked = check(trees, rules, cell=names)
    of_syntax = [found for one in parsed for found in one.diagnostics]
    of_names = without_guesses(checked.diagnostics, of_syntax, trees)
    diagnostics = (*of_syntax, *of_names)
    program = checked.program
    if any(d.severity is Severity.ERROR for d in diagnostics):
        program = None
    elif program is None:
        program = stubbed_program(trees, diagnostics, names)
    return LoadedProgram(trees, program, diagnostics)


def load_task(
    task: TaskFiles,
    cell: CellNames,
    rules: Sequence[Find] = (),
    *,
    bulk: BulkReading | None = None,
) -> LoadedProgram:
    """Parse and check a task, with the known facts about its modules; see `load`."""
    return load(
        task.files,
        rules,
        cell=cell,
        unseen=task.unseen,
        refers_late=task.refers_late,
        bulk=bulk,
    )
