"""Rule I802: waits for a signal that may never come."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program_parts import Facts
from rapidsim.analysis.tree_walk import descendants
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree

_ENDED_OTHERWISE = Trait.ASK | Trait.GIVE_UP


class WaitWithoutTimeout(Violation, code="I802"):
    wait: str
    option: str


def find_waits_without_timeout(facts: Facts) -> Iterator[Diagnostic]:
    """Waits for signals, conditions and other tasks that have no timeout."""
    for part in facts.routine_parts:
        for call in part.all(tree.Call):
            routine = facts.installed(call)
            if routine is None or routine.limit is None or _ENDED_OTHERWISE & routine.traits:
                continue
            given = {
                one.name.key
                for one in call.arguments
                if isinstance(one, tree.OptionalArgument | tree.ConditionalArgument)
            }
            looks_at_time = any(
                Trait.TIME in facts.does(node)
                for node in descendants(call)
                if isinstance(node, tree.FunctionCall)
            )
            if routine.limit.lower() not in given and not looks_at_time:
                yield part.finding(WaitWithoutTimeout(call.name.text, routine.limit), call.name)
