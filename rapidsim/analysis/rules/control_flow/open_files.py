"""Rule F421: files that a loop opens repeatedly without closing them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rapidsim.analysis.program import DataSymbol, Scope
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.reached_routines import mask_of, reached
from rapidsim.analysis.tree_walk import descendants
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree

_LEAVES = (tree.Return, tree.Exit, tree.Goto, tree.Raise, tree.InvalidStatement, tree.LateCall)


class OpenedInLoop(Violation, code="F421"):
    opened: str


def find_opened_in_loops(facts: Facts) -> Iterator[Diagnostic]:
    """Report files that each iteration of a loop opens, if nothing in the loop may close them."""
    if not facts.in_parts(_has_opening):
        return
    closing = mask_of(_has_closing, facts)
    for part, bodies in facts.in_parts(_loop_bodies):
        for body in bodies:
            opened = next(_opened(body, facts), None)
            if opened is None or any(_leaves(node, facts) for node in descendants(*body)):
                continue
            if closing & reached(descendants(*body), facts) or _closes(descendants(*body), facts):
                continue
            yield part.finding(OpenedInLoop(opened.name.text), opened)


def _loop_bodies(part: ProgramPart, facts: Facts) -> list[tree.Body]:
    del facts
    bodies = [loop.body for loop in part.all(tree.For)]
    return bodies + [loop.body for loop in part.all(tree.While)]


def _has_opening(part: ProgramPart, facts: Facts) -> bool:
    return any(Trait.OPEN in facts.does(call) for call in part.all(tree.Call))


def _has_closing(part: ProgramPart, facts: Facts) -> bool:
    return _closes(part.all(tree.Call), facts)


def _closes(nodes: Iterable[tree.Node], facts: Facts) -> bool:
    return any(Trait.CLOSE in facts.does(node) for node in nodes)


def _opened(body: tree.Body, facts: Facts, depth: int = 0) -> Iterator[tree.Call]:
    """Yield the statements of a list that open something at each execution of the list."""
    for statement in body:
        if not isinstance(statement, tree.Call):
            continue
        if Trait.OPEN in facts.does(statement):
            if depth == 0 or not _is_of_routine(statement, facts):
                yield statement
            continue
        routine = facts.routine_called(statement)
        if routine is not None and depth == 0 and any(_opened(routine.body, facts, depth + 1)):
            yield statement


def _is_of_routine(call: tree.Call, facts: Facts) -> bool:
    """Whether a device is data of the routine, new at each call."""
    symbols = (facts.symbol(node) for node in descendants(call))
    return any(
        isinstance(symbol, DataSymbol) and symbol.scope is Scope.ROUTINE for symbol in symbols
    )


def _leaves(node: tree.Node, facts: Facts) -> bool:
    if isinstance(node, _LEAVES):
        return True
    if not isinstance(node, tree.Call):
        return False
    # Unknown code may close it.
    is_known = facts.installed(node) is not None or facts.routine_called(node) is not None
    return not is_known or Trait.LEAVE in facts.does(node)
