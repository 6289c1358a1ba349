"""Rule F410: routines that call themselves."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from rapidsim.analysis.program_parts import Facts
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.syntax import tree


class Recursion(Violation, code="F410"):
    routine: str
    through: str


def find_recursion(facts: Facts) -> Iterator[Diagnostic]:
    """Report the first call on each call path from a routine back to itself."""
    calls: dict[tree.Routine, dict[tree.Routine, tree.Call | tree.FunctionCall]] = {}
    for part in facts.routine_parts:
        assert part.routine is not None
        called = calls.setdefault(part.routine, {})
        for node in part.calls:
            routine = facts.routine_called(node)
            if routine is not None:
                called.setdefault(routine, node)
    for part in facts.routine_parts:
        assert part.routine is not None
        for callee, node in calls[part.routine].items():
            way = _call_path(callee, part.routine, calls)
            if way is None:
                continue
            names = ", ".join(f"`{routine.name.text}`" for routine in way)
            through = f" through {names}" if names else ""
            yield part.finding(Recursion(part.routine.name.text, through), node)
            break


def _call_path(
    start: tree.Routine,
    end: tree.Routine,
    calls: Mapping[tree.Routine, Iterable[tree.Routine]],
) -> list[tree.Routine] | None:
    """Shortest call path from `start` to before `end`; None without a path.

    The path is empty if `start` is `end`.
    """
    if start is end:
        return []
    came_from: dict[tree.Routine, tree.Routine] = {}
    waiting = [start]
    for routine in waiting:
        for callee in calls.get(routine, ()):
            if callee is end:
                way = [routine]
                while way[-1] is not start:
                    way.append(came_from[way[-1]])
                return way[::-1]
            if callee is not start and callee not in came_from:
                came_from[callee] = routine
                waiting.append(callee)
    return None
