"""A program that uses undeclared data, changed so that it runs up to them.

Each statement or condition that uses such data is replaced by a call of an unknown routine: the run
ends there. A controller that does not check references (-BindRef 0) does so too; other controllers
have the modules that are missing here.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import replace

from rapidsim.analysis.cell_names import CellNames
from rapidsim.analysis.names.name_violations import (
    ComponentOfUnknownType,
    UnresolvedReference,
    UnseenName,
)
from rapidsim.analysis.passes.checker import check
from rapidsim.analysis.program import Program
from rapidsim.analysis.replaced_nodes import rebuilt, without_runs
from rapidsim.analysis.tree_walk import clauses, descendants, statements
from rapidsim.diagnostics import Diagnostic, Span, Violation
from rapidsim.syntax import tree

_SIMPLE = (tree.Assignment, tree.Call, tree.LateCall, tree.Return, tree.Raise, tree.Connect)
_PATHS = (tree.DataReference, tree.Index, tree.ComponentAccess)


def stubbed_program(
    files: Sequence[tree.File], findings: Sequence[Diagnostic], cell: CellNames
) -> Program | None:
    """Return the program, runnable up to the names in its findings.

    None if a name is outside statements, for instance in an initial value.

    Args:
        files: The task's files.
        findings: The findings of checking them.
        cell: Names that the configuration declares in addition to the modules.
    """
    instead: dict[int, tree.Node] = {}
    missing: dict[str, str | None] = {}
    simple: dict[int, _SimpleStatements] = {}
    for one in findings:
        lacks, span = _missing(one.violation), one.span
        if lacks is not None and span is not None:
            name, why = lacks
            node = _failing_at(files, span, simple)
            if node is None:
                return None
            instead[id(node)] = _call_in_place_of(node, name)
            missing[name.lower()] = why
    if not missing:
        return None
    # The calls in place of data are calls of undeclared routines.
    assumed = replace(cell, assumes=True)
    parts = tuple(rebuilt(without_runs(file, instead), instead) for file in files)
    program = check(parts, (), cell=assumed).program
    return program and replace(program, missing_data=missing)


def _missing(violation: Violation) -> tuple[str, str | None] | None:
    """Return the missing name of a finding and the reason why a run ends there; else None.

    The reason is None if the run ends with the controller's own error.
    """
    match violation:
        case UnresolvedReference(undefined=name):
            return name, None
        case UnseenName(undefined=name, kind="data"):
            return name, violation.message
        case ComponentOfUnknownType(record=record, type_name=type_name, component=component):
            why = f"`{record}` is {type_name}, whose declaration is missing"
            return f"{record}.{component}", why
        case _:
            return None


class _SimpleStatements:
    """Simple statements of a routine, by position."""

    def __init__(self, routine: tree.RoutineNode) -> None:
        """Collect the statements in order."""
        simple = (one for one in statements(*clauses(routine)) if isinstance(one, _SIMPLE))
        self._statements = sorted(simple, key=lambda one: one.start)
        self._starts = [one.start for one in self._statements]

    def around(self, place: int) -> tree.Node | None:
        """Return the statement that contains an offset; None if there is no such statement."""
        position = bisect_right(self._starts, place) - 1
        if position < 0 or place >= self._statements[position].end:
            return None
        return self._statements[position]


def _failing_at(
    files: Sequence[tree.File], span: Span, simple: dict[int, _SimpleStatements]
) -> tree.Node | None:
    """Return the simple statement around a name, else the data that an expression reads with it.

    Args:
        files: The task's files.
        span: Position of the name.
        simple: The simple statements of routines by identity; filled on demand.
    """
    for file in files:
        for module in file.modules if file.source is span.source else ():
            for routine in module.routines:
                if routine.start <= span.start < routine.end:
                    if id(routine) not in simple:
                        simple[id(routine)] = _SimpleStatements(routine)
                    around = simple[id(routine)].around(span.start)
                    return around or _data_at(routine, span.start)
    return None


def _data_at(routine: tree.RoutineNode, place: int) -> tree.Node | None:
    around = [one for one in statements(*clauses(routine)) if one.start <= place < one.end]
    if not around:
        return None
    # The first is the outermost: `missing{1}.trans` is one access.
    paths = (one for one in descendants(around[-1]) if isinstance(one, _PATHS))
    return next((one for one in paths if one.start <= place < one.end), None)


def _call_in_place_of(node: tree.Node, name: str) -> tree.Call | tree.FunctionCall:
    kind = tree.FunctionCall if isinstance(node, _PATHS) else tree.Call
    return kind(node.start, node.end, tree.Name(node.start, node.end, name), ())
