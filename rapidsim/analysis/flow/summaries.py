"""Summaries of routines, computed bottom-up over the call graph.

Routines that call each other, directly or not, form a strongly connected component (Tarjan 1972);
within one, the summaries are iterated to their least fixed point.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from heapq import heapify, heappop, heappush
from typing import TypeVar

R = TypeVar("R", bound=Hashable)
S = TypeVar("S")


def components(routines: Sequence[R], callees: Callable[[R], Iterable[R]]) -> list[tuple[R, ...]]:
    """Return the strongly connected components of a call graph, callees first."""
    index: dict[R, int] = {}
    low: dict[R, int] = {}
    path: list[R] = []
    on_path: set[R] = set()
    found: list[tuple[R, ...]] = []

    def enter(routine: R) -> tuple[R, Iterable[R]]:
        index[routine] = low[routine] = len(index)
        path.append(routine)
        on_path.add(routine)
        return routine, iter(callees(routine))

    for root in routines:
        if root in index:
            continue
        # An explicit stack: programs nest deeper than Python's recursion limit.
        stack = [enter(root)]
        while stack:
            routine, remaining = stack[-1]
            for callee in remaining:
                if callee not in index:
                    stack.append(enter(callee))
                    break
                if callee in on_path:
                    low[routine] = min(low[routine], index[callee])
            else:
                stack.pop()
                if stack:
                    caller = stack[-1][0]
                    low[caller] = min(low[caller], low[routine])
                if low[routine] == index[routine]:
                    component = [path.pop()]
                    while component[-1] != routine:
                        component.append(path.pop())
                    on_path.difference_update(component)
                    found.append(tuple(reversed(component)))
    return found


def summarise(
    routines: Sequence[R],
    callees: Callable[[R], Iterable[R]],
    nothing: S,
    summary_of: Callable[[R, Mapping[R, S]], S],
    order: Iterable[tuple[R, ...]] | None = None,
) -> dict[R, S]:
    """Return a summary of each routine.

    Args:
        routines: The routines of a program.
        callees: Returns the routines that a routine calls.
        nothing: The initial summary of mutually recursive routines.
        summary_of: Returns the summary of a routine from the summaries of its callees.
        order: The components of the call graph, callees first, if they are known already.
    """
    summaries: dict[R, S] = {}
    for component in components(routines, callees) if order is None else order:
        summaries |= dict.fromkeys(component, nothing)
        is_recursive = len(component) > 1 or component[0] in callees(component[0])
        while True:
            before = [summaries[routine] for routine in component]
            for routine in component:
                summaries[routine] = summary_of(routine, summaries)
            if not is_recursive or [summaries[routine] for routine in component] == before:
                break
    return summaries


def resummarise(
    summaries: dict[R, S],
    changed: Iterable[R],
    component_of: Mapping[R, int],
    callers: Callable[[R], Iterable[R]],
    summary_of: Callable[[R, Mapping[R, S]], S],
) -> None:
    """Renew the summaries of routines that do not call themselves, and those that follow from them.

    Args:
        summaries: The summaries, of which those that are others now are replaced.
        changed: The routines that changed, but have the same callees as before.
        component_of: The number of the component of each routine, callees first.
        callers: Returns the routines that call a routine.
        summary_of: As in `summarise`.
    """
    waiting = {component_of[routine]: routine for routine in changed}
    numbers = list(waiting)
    heapify(numbers)
    while numbers:
        routine = waiting[heappop(numbers)]
        before = summaries[routine]
        summaries[routine] = summary_of(routine, summaries)
        if summaries[routine] == before:
            continue
        for caller in callers(routine):
            if caller in summaries and component_of[caller] not in waiting:
                waiting[component_of[caller]] = caller
                heappush(numbers, component_of[caller])
