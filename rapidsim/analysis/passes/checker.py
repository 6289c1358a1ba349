"""Check of the trees of a task's files, with a checked program or findings as the result.

The order of the passes: declarations, initial values, names, types and flow of each routine, then
the checks of the whole task. No pass changes the tree; all write to one `Analysis`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from types import MappingProxyType
from typing import TypeAlias

from rapidsim.analysis.cell_names import NO_CELL, CellNames
from rapidsim.analysis.passes.task_check import TaskCheck, deep_recursion
from rapidsim.analysis.passes.versions import find_newer
from rapidsim.analysis.program import Program, RoutineSymbol, Scope
from rapidsim.analysis.program_parts import Facts
from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.syntax import tree
from rapidsim.syntax.garbage_collection import gc_paused
from rapidsim.values import value_class

Find: TypeAlias = Callable[[Facts], Iterable[Diagnostic]]
"""A function that detects violations of rules in the facts of the analysis."""


@value_class(frozen=True, slots=True, eq=False)
class CheckOutcome:
    """Result of a check, with the program unless an error prevents it from running."""

    program: Program | None
    """None after an error, here or in text that the parser skipped."""
    diagnostics: tuple[Diagnostic, ...]
    """Findings in the order of the files, then by position."""


@gc_paused(of_known_program=True)
def check(
    files: Sequence[tree.File],
    rules: Sequence[Find] = (),
    *,
    cell: CellNames = NO_CELL,
    visitor: tree.File | None = None,
) -> CheckOutcome:
    """Check the modules of one task together.

    Args:
        files: The task's files; of two equal names, the one in the later file is the duplicate.
        rules: Additional detectors of findings that do not prevent a run: see `rules/table.py`.
        cell: Names that the configuration declares in addition to the modules.
        visitor: An external file that can also access the LOCAL names of the task's modules.

    Returns:
        The program with its symbols and types, and all findings. Never raises on user input.
    """
    files = files if visitor is None else (*files, visitor)
    task = TaskCheck(files, cell, visitor)
    facts = Facts(tuple(files), task.analysis)
    found = list(task.diagnostics())
    with deep_recursion():
        found += find_newer(facts)
        for rule in rules:
            found += rule(facts)
    diagnostics = _in_order(found, files)
    is_broken = any(one.severity is Severity.ERROR for one in diagnostics)
    if is_broken or task.analysis.unread_text or not task.analysis.runs:
        return CheckOutcome(None, diagnostics)
    return CheckOutcome(_program(task), diagnostics)


def _program(task: TaskCheck) -> Program:
    symbol_of = task.analysis.symbol_of
    symbols = (symbol_of.get(routine) for routine in task.units)
    routines = {
        symbol.name.lower(): symbol
        for symbol in symbols
        if isinstance(symbol, RoutineSymbol) and symbol.scope is not Scope.LOCAL
    }
    return Program(
        task.modules,
        MappingProxyType(symbol_of),
        MappingProxyType(task.analysis.type_of),
        MappingProxyType(routines),
        task.analysis.loads_modules,
        task.analysis.cell,
        graph_of=task.analysis.graph_of,
    )


def _in_order(
    diagnostics: Sequence[Diagnostic], files: Sequence[tree.File]
) -> tuple[Diagnostic, ...]:
    position = {file.source.file: k for k, file in reversed(list(enumerate(files)))}
    return tuple(
        sorted(diagnostics, key=lambda found: (position.get(found.order[0], -1), found.order[1]))
    )
