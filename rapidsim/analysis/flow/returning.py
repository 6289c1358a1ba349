"""Which routines return to their caller; a server with an endless loop does not."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from typing import TypeVar

from rapidsim.analysis.flow.graph import EXIT, ControlFlowGraph, EdgeKind
from rapidsim.analysis.flow.summaries import summarise
from rapidsim.syntax import tree

R = TypeVar("R", bound=Hashable)
_ANY = sum(EdgeKind)


def may_return(graph: ControlFlowGraph) -> bool:
    """Whether control reaches the end of a routine if all its calls return."""
    return EXIT in graph.reached(_ANY, graph.entries)


def returning(
    routines: Sequence[R],
    callees: Callable[[R], Sequence[R]],
    callee_of: Callable[[tree.Node], R | None],
    graph_of: Callable[[R], ControlFlowGraph],
    may_return: Callable[[R], bool],
    order: Iterable[tuple[R, ...]] | None = None,
) -> dict[R, bool]:
    """Return whether a call of each routine can return, also after an error.

    Args:
        routines: The routines of a program.
        callees: Returns the routines that a routine calls.
        callee_of: Returns the routine that a step calls; None for any other step.
        graph_of: Returns the control flow of a routine.
        may_return: Returns whether a routine can return if all its calls do.
        order: The components of the call graph, callees first, if they are known already.
    """

    def summary_of(routine: R, known: Mapping[R, bool]) -> bool:
        def never_returns(node: tree.Node) -> bool:
            callee = callee_of(node)
            return callee is not None and not known[callee]

        if not may_return(routine):
            return False
        if all(known[callee] for callee in callees(routine)):
            return True
        graph = graph_of(routine)
        return EXIT in graph.reached(_ANY, graph.entries, never_returns)

    return summarise(routines, callees, False, summary_of, order)
