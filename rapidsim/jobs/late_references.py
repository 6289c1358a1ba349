"""A program that names data which nothing declares, as a controller runs it with -BindRef 0.

In place of each statement that names such data, or of the condition, stands a call of what nobody
knows: a run fails where it comes there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rapidsim.analysis.cell_names import CellNames
from rapidsim.analysis.names.name_violations import UnresolvedReference
from rapidsim.analysis.passes.checker import check
from rapidsim.analysis.program import Program
from rapidsim.analysis.replaced_nodes import rebuilt
from rapidsim.analysis.tree_walk import clauses, descendants, statements
from rapidsim.diagnostics import Diagnostic, Span
from rapidsim.syntax import tree

_SIMPLE = (tree.Assignment, tree.Call, tree.LateCall, tree.Return, tree.Raise, tree.Connect)
_PATHS = (tree.Reference, tree.Index, tree.Component)


def program_with_late_references(
    files: Sequence[tree.File], found: Sequence[Diagnostic], cell: CellNames
) -> Program | None:
    """The program that runs up to the names of its findings.

    None where one of them stands outside of statements, as the value that a declaration gives.

    Args:
        files: The task's files.
        found: What a check of them found.
        cell: What the configuration declares beside the modules.
    """
    instead: dict[int, tree.Node] = {}
    missing: set[str] = set()
    for one in found:
        violation, span = one.violation, one.span
        if isinstance(violation, UnresolvedReference) and span is not None:
            node = _failing_at(files, span)
            if node is None:
                return None
            instead[id(node)] = _call_in_place_of(node, violation.undefined)
            missing.add(violation.undefined.lower())
    if not missing:
        return None
    program = check(tuple(rebuilt(file, instead) for file in files), (), cell=cell).program
    return program and replace(program, missing_data=frozenset(missing))


def _failing_at(files: Sequence[tree.File], span: Span) -> tree.Node | None:
    """The simple statement around a name, else the data that an expression reads with it."""
    for file in files:
        for module in file.modules if file.source is span.source else ():
            for routine in module.routines:
                if routine.start <= span.start < routine.end:
                    return _in_routine(routine, span.start)
    return None


def _in_routine(routine: tree.RoutineNode, place: int) -> tree.Node | None:
    around = [one for one in statements(*clauses(routine)) if one.start <= place < one.end]
    if not around or isinstance(around[-1], _SIMPLE):
        return around[-1] if around else None
    # The first is the outermost: `missing{1}.trans` is read as a whole.
    paths = (one for one in descendants(around[-1]) if isinstance(one, _PATHS))
    return next((one for one in paths if one.start <= place < one.end), None)


def _call_in_place_of(node: tree.Node, name: str) -> tree.Call | tree.FunctionCall:
    kind = tree.FunctionCall if isinstance(node, _PATHS) else tree.Call
    return kind(node.start, node.end, tree.Name(node.start, node.end, name), ())
