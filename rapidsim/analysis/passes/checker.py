"""Check of the trees of a task's files, with a checked program or findings as the result.

The order of the passes: declarations, initial values, names, types and flow of each routine, then
the checks of the whole task. No pass changes the tree; all write to one `Analysis`.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from types import MappingProxyType
from typing import TypeAlias

from rapidsim.analysis.cell_names import NO_CELL, CellNames
from rapidsim.analysis.context import Analysis, Context
from rapidsim.analysis.installed import installed_symbol
from rapidsim.analysis.names.user_types import UserTypes
from rapidsim.analysis.passes.control_flow import check_flow
from rapidsim.analysis.passes.declarations import declare_locals, declare_task, show_local_names
from rapidsim.analysis.passes.initial_values import check_circles, check_initial_value
from rapidsim.analysis.passes.statements import check_routine_body
from rapidsim.analysis.passes.undeclared import decide_undeclared
from rapidsim.analysis.passes.versions import find_newer
from rapidsim.analysis.program import DataSymbol, Program, RoutineSymbol, Scope, does
from rapidsim.analysis.program_parts import Facts
from rapidsim.analysis.tolerated_syntax import check_lenient_marks
from rapidsim.analysis.tree_walk import clauses, statements
from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree
from rapidsim.syntax.garbage_collection import gc_paused
from rapidsim.values import value_class

Find: TypeAlias = Callable[[Facts], Iterable[Diagnostic]]
"""A function that detects violations of rules in the facts of the analysis."""

_LOADING_WORD = re.compile(r"load\b")
_DEEPEST = 20_000
"""Maximum depth of Python calls while checking; the parser limits the nesting of programs."""


@value_class(frozen=True, slots=True, eq=False)
class CheckOutcome:
    """Result of a check, with the program unless an error prevents it from running."""

    program: Program | None
    """None after an error, here or in text that the parser skipped."""
    diagnostics: tuple[Diagnostic, ...]
    """Findings in the order of the files, then by position."""


@gc_paused()
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
    modules = [module for file in files for module in file.modules]
    unread, loads = _unread_text(modules), _loads_modules(modules)
    analysis = Analysis(cell, unread_text=unread, loads_modules=loads)
    with _deep_recursion():
        homes, user_types = declare_task(modules, analysis)
        if visitor is not None:
            show_local_names(visitor.modules, homes)
        data = [
            (symbol, home)
            for home in homes
            for symbol in _symbols_of(home)
            if isinstance(symbol, DataSymbol)
        ]
        for symbol, home in data:
            check_initial_value(symbol, home)
        for home in homes:
            check_lenient_marks(home)
            for routine in _symbols_of(home):
                if isinstance(routine, RoutineSymbol):
                    data += _check_routine(routine, home, user_types)
        check_circles(data)
        decide_undeclared(analysis)
        facts = Facts(tuple(files), analysis)
        analysis.diagnostics += find_newer(facts)
        for rule in rules:
            analysis.diagnostics += rule(facts)
    diagnostics = _in_order(analysis.diagnostics, files)
    is_broken = any(found.severity is Severity.ERROR for found in diagnostics)
    if is_broken or analysis.unread_text or not analysis.runs:
        return CheckOutcome(None, diagnostics)
    return CheckOutcome(_program(modules, homes, analysis), diagnostics)


def _check_routine(
    routine: RoutineSymbol, home: Context, user_types: UserTypes
) -> list[tuple[DataSymbol, Context]]:
    """Check one routine.

    Returns:
        The data declared in it.
    """
    context = declare_locals(routine, home, user_types)
    local_data = [
        (symbol, context)
        for node in statements(*clauses(routine.node))
        if isinstance(node, tree.Data)
        and isinstance(symbol := context.analysis.symbol_of.get(node), DataSymbol)
    ]
    for symbol, _ in local_data:
        check_initial_value(symbol, context)
    check_routine_body(routine.node, context)
    check_flow(routine.node, context)
    return local_data


def _symbols_of(home: Context) -> Iterator[object]:
    """Yield the symbols that a module declares outside its routines, in order."""
    for item in home.module.items:
        symbol = home.analysis.symbol_of.get(item)
        if symbol is not None:
            yield symbol


def _program(
    modules: Sequence[tree.Module], homes: Sequence[Context], analysis: Analysis
) -> Program:
    routines = {
        symbol.name.lower(): symbol
        for home in homes
        for symbol in _symbols_of(home)
        if isinstance(symbol, RoutineSymbol) and symbol.scope is not Scope.LOCAL
    }
    return Program(
        tuple(modules),
        MappingProxyType(analysis.symbol_of),
        MappingProxyType(analysis.type_of),
        MappingProxyType(routines),
        analysis.loads_modules,
        analysis.cell,
    )


def _unread_text(modules: Sequence[tree.Module]) -> str:
    """Folded text of all parts that the parser skipped."""
    unread = [
        module.span(part).text.lower()
        for module in modules
        for item in module.items
        for part in (statements(*clauses(item)) if isinstance(item, tree.RoutineNode) else (item,))
        if isinstance(part, tree.InvalidStatement)
    ]
    return "\n".join(unread)


def _loads_modules(modules: Sequence[tree.Module]) -> bool:
    """Whether an instruction adds other modules to the program."""
    # Few programs have one, so most are never traversed. Names have no symbols yet.
    return any(
        isinstance(part, tree.Call) and Trait.LOAD in does(installed_symbol(part.name.key))
        for module in modules
        if _LOADING_WORD.search(module.source.text.lower())
        for item in module.items
        if isinstance(item, tree.RoutineNode)
        for part in statements(*clauses(item))
    )


def _in_order(
    diagnostics: Sequence[Diagnostic], files: Sequence[tree.File]
) -> tuple[Diagnostic, ...]:
    position = {file.source.file: k for k, file in reversed(list(enumerate(files)))}
    return tuple(
        sorted(diagnostics, key=lambda found: (position.get(found.order[0], -1), found.order[1]))
    )


@contextmanager
def _deep_recursion() -> Iterator[None]:
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(max(limit, _DEEPEST))
    try:
        yield
    finally:
        sys.setrecursionlimit(limit)
