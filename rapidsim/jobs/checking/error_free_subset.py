"""A program without its erroneous statements, so that the moves of the rest can be checked.

Each is replaced by a call of an unknown routine, after which all data may have changed. If an error
is not within a simple statement, or that statement uses local data, nothing is checked.
"""

from __future__ import annotations

from bisect import bisect_right

from rapidsim.analysis.cell_names import CellNames
from rapidsim.analysis.passes.checker import check
from rapidsim.analysis.program import Program
from rapidsim.analysis.replaced_nodes import rebuilt, without_runs
from rapidsim.analysis.tree_walk import clauses, descendants, statements
from rapidsim.diagnostics import Severity, Span
from rapidsim.jobs.checking.checked_program import LoadedProgram
from rapidsim.syntax import tree
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class ErrorFreeSubset:
    """A program without its erroneous statements."""

    program: Program
    replaced: tuple[Span, ...]
    """Spans of the removed statements."""


def error_free_subset(loaded: LoadedProgram, cell: CellNames) -> ErrorFreeSubset | None:
    """Return the program with its erroneous statements replaced; None if errors remain."""
    errors = [one for one in loaded.diagnostics if one.severity is Severity.ERROR]
    simple = {file.source: _SimpleStatements(file) for file in loaded.files} if errors else {}
    faulty: dict[int, tree.Statement] = {}
    replaced = []
    for one in errors:
        found = None if one.span is None else simple[one.span.source].around(one.span)
        if found is None or one.span is None:
            return None
        statement, place = found
        faulty[id(statement)] = statement
        replaced.append(Span(one.span.source, place.start, place.end))
    instead = {key: _unknown_call(statement) for key, statement in faulty.items()}
    files = tuple(rebuilt(without_runs(file, instead), instead) for file in loaded.files)
    checked = check(files, (), cell=cell)
    if checked.program is None:
        return None
    return ErrorFreeSubset(checked.program, tuple(replaced))


class _SimpleStatements:
    """Assignments and calls of a file, by position."""

    def __init__(self, file: tree.File) -> None:
        """Collect the statements in order, each with its routine."""
        routines = [routine for module in file.modules for routine in module.routines]
        found = [
            (statement, routine)
            for routine in routines
            for statement in statements(*clauses(routine))
            if isinstance(statement, tree.Assignment | tree.Call)
        ]
        self._found = sorted(found, key=lambda pair: pair[0].start)
        self._starts = [statement.start for statement, _ in self._found]
        self._own_names: dict[int, frozenset[str]] = {}
        self._writing: dict[int, bool] = {}
        self._runs: dict[tree.Node, tree.BulkStatements] = {
            run.like: run for module in file.modules for run in module.runs
        }

    def around(self, span: Span) -> tuple[tree.Statement, tree.Node] | None:
        """Return the statement at the start of a span, and its position.

        For a row of bulk statements, the statement is the one that represents the row. None if
        there is no such statement, or it uses data of its routine.
        """
        position = bisect_right(self._starts, span.start) - 1
        if position < 0:
            return None
        statement, routine = self._found[position]
        place: tree.Node | None = statement
        if span.start >= statement.end:
            run = self._runs.get(statement)
            place = None if run is None else run.row_around(span.start)
        if place is None or self._writes_own_data(statement, routine):
            return None
        return statement, place

    def _writes_own_data(self, statement: tree.Statement, routine: tree.RoutineNode) -> bool:
        writes = self._writing.get(id(statement))
        if writes is None:
            own = self._own_names.get(id(routine))
            if own is None:
                own = self._own_names[id(routine)] = _own_names(routine)
            named = (
                node for node in descendants(statement) if isinstance(node, tree.DataReference)
            )
            writes = self._writing[id(statement)] = any(node.name.key in own for node in named)
        return writes


def _own_names(routine: tree.RoutineNode) -> frozenset[str]:
    """Return the folded names of the data and parameters of a routine."""
    declared = (tree.Data, tree.ParameterDeclaration)
    return frozenset(node.name.key for node in descendants(routine) if isinstance(node, declared))


def _unknown_call(statement: tree.Statement) -> tree.LateCall:
    """Return a call of a routine known only at run time, in place of a statement."""
    start, end = statement.start, statement.end
    return tree.LateCall(start, end, tree.StringLiteral(start, end, ""), ())
