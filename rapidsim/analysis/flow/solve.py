"""Dataflow analysis: states at the blocks of a control-flow graph, computed by worklists.

Forward, a state holds at the beginning of a block, and each step changes it; backward, it describes
the execution after a block. The analysis must have a join of finite height (Kam and Ullman 1977); a
state of None means "unreachable". Blocks that no start or end reaches have no state.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from typing import TypeVar

from rapidsim.analysis.flow.graph import NORMAL, ControlFlowGraph, FlowEdge
from rapidsim.syntax import tree

S = TypeVar("S")


def _unchanged(edge: FlowEdge, state: S) -> S | None:
    return state


def forward(
    graph: ControlFlowGraph,
    starts: Mapping[int, S],
    step: Callable[[tree.Node, S], S | None],
    join: Callable[[S, S], S],
    along: Callable[[FlowEdge, S], S | None] = _unchanged,
    kinds: int = NORMAL,
) -> dict[int, S]:
    """Return the state at the beginning of each reached block.

    Args:
        graph: The routine.
        starts: The states of the blocks where control enters.
        step: Returns the state after a step, None if control does not continue.
        join: Returns the state where two paths meet.
        along: Returns the state past an edge, None if control does not follow it.
        kinds: The edges to follow.
    """
    states = dict(starts)
    work = sorted(starts, reverse=True)
    pending = set(work)
    while work:
        index = work.pop()
        pending.discard(index)
        block = graph.blocks[index]
        state = after_steps(block.steps, states[index], step)
        if state is None:
            continue
        for edge in block.edges:
            passed = along(edge, state) if edge.kind & kinds else None
            if passed is None:
                continue
            before = states.get(edge.to)
            joined = passed if before is None else join(before, passed)
            if joined != before:
                states[edge.to] = joined
                if edge.to not in pending:
                    pending.add(edge.to)
                    work.append(edge.to)
    return states


def after_steps(
    steps: Sequence[tree.Node], state: S, step: Callable[[tree.Node, S], S | None]
) -> S | None:
    """Return the state after steps, None if control does not get past them."""
    current: S | None = state
    for node in steps:
        if current is None:
            break
        current = step(node, current)
    return current


def backward(
    graph: ControlFlowGraph,
    ends: Mapping[int, S],
    step: Callable[[tree.Node, S], S],
    join: Callable[[int, Sequence[S]], S],
    along: Callable[[FlowEdge, S], S | None] = _unchanged,
    kinds: int = NORMAL,
) -> dict[int, S]:
    """Return the state at the end of each block.

    Args:
        graph: The routine.
        ends: The states of the blocks where control leaves.
        step: Returns the state before a step.
        join: Returns the state at the end of a block from the states of its known edges; the
            others are assumed to allow anything, so a join may only become weaker.
        along: Returns the state before an edge, None if control does not follow it.
        kinds: The edges to follow.
    """
    predecessors: dict[int, list[int]] = defaultdict(list)
    for index, block in enumerate(graph.blocks):
        for edge in block.edges:
            if edge.kind & kinds:
                predecessors[edge.to].append(index)
    at_end: dict[int, S] = dict(ends)
    at_begin: dict[int, S] = {}
    work = list(range(len(graph.blocks)))
    pending = set(work)
    while work:
        index = work.pop()
        pending.discard(index)
        block = graph.blocks[index]
        if index not in ends:
            passed = [
                state
                for edge in block.edges
                if edge.kind & kinds
                and edge.to in at_begin
                and (state := along(edge, at_begin[edge.to])) is not None
            ]
            if not passed and not block.steps and block.edges:
                continue
            at_end[index] = join(index, passed)
        state = at_end[index]
        for node in reversed(block.steps):
            state = step(node, state)
        if index not in at_begin or at_begin[index] != state:
            at_begin[index] = state
            fresh = [one for one in predecessors[index] if one not in pending]
            pending.update(fresh)
            work += fresh
    return at_end
