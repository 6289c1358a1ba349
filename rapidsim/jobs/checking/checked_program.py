"""Load source files into a checked program: parse every file, then check them together."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import replace

from rapidsim.analysis.cell_names import NO_CELL, CellNames
from rapidsim.analysis.passes.checker import Find, check
from rapidsim.analysis.passes.flow_violations import UnreachableCode
from rapidsim.analysis.program import Program
from rapidsim.diagnostics import Diagnostic, Severity, Source, Span
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.stubbed_program import stubbed_program
from rapidsim.module_files import TaskFiles
from rapidsim.syntax import tree
from rapidsim.syntax.parser import parse
from rapidsim.syntax.violations import UnclosedBlock
from rapidsim.values import value_class


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
    runs_of: int | None = None,
    keeps_data: bool = False,
) -> LoadedProgram:
    """Parse and check the modules of one task; errors in them are findings, never raised.

    Args:
        files: The task's files.
        rules: Rules in addition to the errors that prevent a run.
        cell: Names that the configuration declares in addition to the modules.
        unseen: Modules of the task that cannot be read.
        refers_late: Whether its controller allows unresolved references.
        runs_of: See `parse`.
        keeps_data: See `parse`.
    """
    sources = (Source(file.name, file.text) for file in files)
    parsed = [parse(one, runs_of=runs_of, keeps_data=keeps_data) for one in sources]
    trees = tuple(one.file for one in parsed)
    names = replace(cell, unseen=tuple(unseen), refers_late=refers_late)
    checked = check(trees, rules, cell=names)
    of_syntax = [found for one in parsed for found in one.diagnostics]
    of_names = _without_guesses(checked.diagnostics, of_syntax, trees)
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
    runs_of: int | None = None,
    keeps_data: bool = False,
) -> LoadedProgram:
    """Parse and check a task, with the known facts about its modules; see `load`."""
    return load(
        task.files,
        rules,
        cell=cell,
        unseen=task.unseen,
        refers_late=task.refers_late,
        runs_of=runs_of,
        keeps_data=keeps_data,
    )


def _without_guesses(
    findings: Sequence[Diagnostic], of_syntax: Sequence[Diagnostic], files: Sequence[tree.File]
) -> Iterator[Diagnostic]:
    """Yield the findings, without unreachable code in routines with an unclosed block.

    The repair inserts the end at the last possible position, so the statements after a RETURN seem
    to be in the block.
    """
    unclosed = [one.span for one in of_syntax if isinstance(one.violation, UnclosedBlock)]
    if not unclosed:
        yield from findings
        return
    starts = {
        file.source.file: [routine.start for module in file.modules for routine in module.routines]
        for file in files
    }

    def routine_around(span: Span | None) -> tuple[str, int] | None:
        """Return file and number of the last routine that begins before a position."""
        return None if span is None else (span.file, bisect_right(starts[span.file], span.start))

    broken = {routine_around(span) for span in unclosed}
    for one in findings:
        if not isinstance(one.violation, UnreachableCode) or routine_around(one.span) not in broken:
            yield one
