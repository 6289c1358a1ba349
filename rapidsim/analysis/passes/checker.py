"""From the trees of a task's files to a checked program, or to findings.

The order of the passes: declarations, initial values, names, types and flow of each routine, then
what requires the whole task. No pass changes the tree; all write to one `Analysis`.
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
"""A function that looks for mistakes in what analysis has found out."""

_LOADING_WORD = re.compile(r"load\b")
_DEEPEST = 20_000
"""Python calls within each other while checking; the parser bounds how deep programs nest."""


@value_class(frozen=True, slots=True, eq=False)
class CheckOutcome:
    """The result of checking; the program only if nothing prevents it from running."""

    program: Program | None
    """None where there is an error, here or where the parser gave up a stretch of text."""
    diagnostics: tuple[Diagnostic, ...]
    """Ordered by file as given, then by place."""


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
        rules: What to look for beyond what keeps a program from running: see `rules/table.py`.
        cell: What the configuration declares besides the modules.
        visitor: An external file that also sees the LOCAL names of the task's modules.

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
    """The symbols that a module declares outside its routines, in order."""
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
    """The folded text of every stretch that the parser gave up."""
    unread = [
        module.span(part).text.lower()
        for module in modules
        for item in module.items
        for part in (statements(*clauses(item)) if isinstance(item, tree.RoutineNode) else (item,))
        if isinstance(part, tree.InvalidStatement)
    ]
    return "\n".join(unread)


def _loads_modules(modules: Sequence[tree.Module]) -> bool:
    """Whether an instruction takes other modules into the program."""
    # Few programs do, so that most are never walked through. Names have no symbols yet.
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
