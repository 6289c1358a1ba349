"""A program without its erroneous statements, so that the moves of the rest can be checked.

Each is replaced by a call of an unknown routine: after it, all data may have changed. If an error
is not within a simple statement, or that statement writes local data, nothing can be checked.
"""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.analysis.cell_names import CellNames
from rapidsim.analysis.passes.checker import check
from rapidsim.analysis.program import Program
from rapidsim.analysis.replaced_nodes import rebuilt
from rapidsim.analysis.tree_walk import clauses, descendants, statements
from rapidsim.diagnostics import Severity, Span
from rapidsim.jobs.checked_program import Loaded
from rapidsim.syntax import tree
from rapidsim.values import dataclass


@dataclass(frozen=True, slots=True, eq=False)
class FaultlessPart:
    """The rest of a program."""

    program: Program
    replaced: tuple[Span, ...]
    """The statements that were taken out of it."""


def faultless_part(loaded: Loaded, cell: CellNames) -> FaultlessPart | None:
    """The program with its erroneous statements replaced; None if errors remain."""
    faulty: dict[int, tree.Statement] = {}
    replaced = []
    for one in loaded.diagnostics:
        if one.severity is not Severity.ERROR:
            continue
        found = None if one.span is None else _statement_at(loaded.files, one.span)
        if found is None or one.span is None:
            return None
        faulty[id(found)] = found
        replaced.append(Span(one.span.source, found.start, found.end))
    instead = {key: _unknown_call(statement) for key, statement in faulty.items()}
    files = tuple(rebuilt(file, instead) for file in loaded.files)
    checked = check(files, (), cell=cell)
    if checked.program is None:
        return None
    return FaultlessPart(checked.program, tuple(replaced))


def _statement_at(files: Sequence[tree.File], span: Span) -> tree.Statement | None:
    """The assignment or call that a place stands in, if it writes nothing of its routine alone."""
    for file in files:
        for module in file.modules:
            for routine in module.routines if module.source is span.source else ():
                if routine.start <= span.start < routine.end:
                    return _in_routine(routine, span)
    return None


def _in_routine(routine: tree.RoutineNode, span: Span) -> tree.Statement | None:
    own = {node.name.key for node in descendants(routine) if isinstance(node, tree.Data)}
    own |= {node.name.key for node in descendants(routine) if isinstance(node, tree.Parameter)}
    for statement in statements(*clauses(routine)):
        simple = isinstance(statement, tree.Assignment | tree.Call)
        if simple and statement.start <= span.start < statement.end:
            named = (node for node in descendants(statement) if isinstance(node, tree.Reference))
            return None if any(node.name.key in own for node in named) else statement
    return None


def _unknown_call(statement: tree.Statement) -> tree.LateCall:
    """A call of what only a run would know, in the place of a statement."""
    start, end = statement.start, statement.end
    return tree.LateCall(start, end, tree.String(start, end, ""), ())
