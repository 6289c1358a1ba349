"""What calls lead to: the routines of the user that may run because of them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rapidsim.analysis.program_parts import Facts, Part
from rapidsim.analysis.tree_walk import descendants
from rapidsim.syntax import tree


def reached_parts(nodes: Iterable[tree.Node], facts: Facts) -> list[Part]:
    """The routines that nodes of any kind may call, and those that these call, each once."""
    found: dict[Part, None] = {}
    waiting = [part for node in descendants(*nodes) for part in _led_to(node, facts)]
    for part in waiting:
        if part not in found:
            found[part] = None
            waiting += [callee for call in part.calls for callee in _led_to(call, facts)]
    return list(found)


def reached_calls(
    nodes: Iterable[tree.Node], facts: Facts
) -> Iterator[tree.Call | tree.FunctionCall]:
    """The calls among nodes, and in the routines that may run because of them."""
    nodes = list(nodes)
    for node in descendants(*nodes):
        if isinstance(node, tree.Call | tree.FunctionCall):
            yield node
    for part in reached_parts(nodes, facts):
        yield from part.calls


def _led_to(node: tree.Node, facts: Facts) -> Iterator[Part]:
    routine = facts.routine_called(node)
    if routine is not None and routine in facts.part_of:
        yield facts.part_of[routine]
