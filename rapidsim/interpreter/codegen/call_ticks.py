"""Routines that take a tick of virtual time per call, as a loop does per iteration.

Without loops a program can run indefinitely only by recursion, direct or indirect, or by call
chains that multiply. A tick there keeps it within the limits of a run.
"""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence

from rapidsim.analysis.program import LibrarySymbol, Program, RoutineSymbol, UnknownSymbol
from rapidsim.interpreter.codegen.ast_builder import AstBuilder
from rapidsim.interpreter.runtime.loaded_calls import may_be_loaded
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree
from rapidsim.values import value_class

MOST_CALLS = 1000
"""Limit of the calls, direct and indirect, that may result from one call without a tick."""


def tick(at: AstBuilder) -> list[ast.stmt]:
    """Let one tick of virtual time pass, and handle due events."""
    left = at.attribute("_clock", "ticks_left")
    due = at.compare(left, (ast.Lt(), at.constant(0)))
    serve = at.do(at.call(at.attribute("_clock", "service")))
    return [at.decrement(at.store_attribute("_clock", "ticks_left")), at.when(due, [serve])]


@value_class(frozen=True, slots=True)
class Callees:
    """The routines that a routine calls."""

    named: Sequence[RoutineSymbol]
    """One entry per call in the text."""
    anybody: bool
    """Whether it calls a routine by a computed name or from a module loaded later."""


def callees(nodes: Sequence[tree.Node], program: Program) -> Callees:
    """The routines called in the nodes of a routine."""
    named: list[RoutineSymbol] = []
    anybody = False
    for node in nodes:
        if isinstance(node, tree.LateCall):
            anybody = True
        elif isinstance(node, tree.Call | tree.FunctionCall):
            match program.symbol_of.get(node):
                case RoutineSymbol() as symbol:
                    named.append(symbol)
                case UnknownSymbol():
                    anybody = anybody or may_be_loaded(node, program)
                case LibrarySymbol(routine=routine) if Trait.CALL_BY_NAME in routine.traits:
                    anybody = True
    return Callees(named, anybody)


def ticking(calls: Mapping[RoutineSymbol, Callees]) -> frozenset[RoutineSymbol]:
    """Return the routines that take a tick.

    Every call cycle contains a routine that the search reaches again while it is still open; that
    routine ticks.
    """
    found = {routine for routine, called in calls.items() if called.anybody}
    following: dict[RoutineSymbol, int] = {}
    """Number of calls that one call of a routine causes, up to the next tick."""
    for start in calls:
        stack = [(start, iter(calls[start].named))]
        open_now = {start}
        while stack:
            routine, rest = stack[-1]
            callee = next((one for one in rest if one in calls and one not in following), None)
            if callee is None:
                stack.pop()
                open_now.discard(routine)
                named = calls[routine].named
                total = sum(1 if one in found else 1 + following.get(one, 0) for one in named)
                if total > MOST_CALLS:
                    found.add(routine)
                following[routine] = total
            elif callee in open_now:
                found.add(callee)
            else:
                open_now.add(callee)
                stack.append((callee, iter(calls[callee].named)))
    return frozenset(found)
