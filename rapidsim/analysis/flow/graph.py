"""The control-flow graph of a routine: blocks of steps and the edges between them.

A step is a unit of evaluation: a function call, then the expression or statement that contains
it. Blocks without incoming edges are kept: the statements that begin there are unreachable. Calls
are steps, not edges; the effect of a call is the callee's summary (`summaries`). After Aho, Lam,
Sethi and Ullman, Compilers, 8.4 and 9.6, with one exception: a loop has its test twice, before the
first iteration and after each one, so that an analysis can distinguish "before the loop" from
"after an iteration".
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import IntEnum

from rapidsim.syntax import tree


class EdgeKind(IntEnum):
    """Kind of a control-flow edge; a sum of several is a set of them."""

    NEXT = 1
    """The step is done, or a condition is decided."""
    JUMP = 2
    """GOTO."""
    BACK = 4
    """To the test of the next iteration."""
    RETURN = 8
    ERROR = 16
    """From a statement that may fail to the ERROR clause."""
    RETRY = 32
    """From a statement that failed to itself, through the ERROR clause."""
    TRYNEXT = 64
    """From a statement that failed past it, through the ERROR clause."""
    UNREAD = 128
    """Around text that the parser could not read, which may contain anything."""


NORMAL = EdgeKind.NEXT | EdgeKind.JUMP | EdgeKind.BACK | EdgeKind.RETURN
"""The edges that control follows while nothing fails."""


@dataclass(slots=True, eq=False)
class FlowEdge:
    """A transition to another block."""

    to: int
    kind: EdgeKind
    by: tree.Node | None = None
    """Deciding node: a condition, CASE or FOR; or a RETURN; None at the end of the text."""
    holds: bool | None = None
    """Outcome of the condition for this edge."""


@dataclass(slots=True, eq=False)
class Block:
    """Steps that execute one after another."""

    steps: list[tree.Node] = field(default_factory=list)
    edges: list[FlowEdge] = field(default_factory=list)


ENTRY, EXIT, RAISED, ENDED = range(4)
"""Indices of blocks: the first; the exits by a return, by an error, by the program's end."""


@dataclass(slots=True, eq=False)
class ControlFlowGraph:
    """The blocks of a routine and of its clauses."""

    blocks: Sequence[Block]
    block_of: Mapping[tree.Node, int]
    """Block of the beginning of each statement."""
    clauses: Sequence[int]
    """First blocks of the BACKWARD, ERROR and UNDO clauses."""
    handler: int | None
    """First block of the ERROR clause; one of `clauses`."""
    loop_tests: frozenset[int]
    """Blocks that decide about another iteration of a loop."""

    @property
    def entries(self) -> tuple[int, ...]:
        """First blocks of the routine and its clauses."""
        return (ENTRY, *self.clauses)

    def reached(
        self,
        kinds: int,
        starts: Sequence[int] = (ENTRY,),
        stops: Callable[[tree.Node], bool] | None = None,
    ) -> set[int]:
        """Return the blocks that control can enter.

        Args:
            kinds: The edges to follow.
            starts: The blocks to begin with.
            stops: Whether control never continues past a step, unless the step fails.
        """
        seen, stack = set(starts), list(starts)
        while stack:
            block = self.blocks[stack.pop()]
            is_end = stops is not None and any(map(stops, block.steps))
            followed = kinds & ~NORMAL if is_end else kinds
            for edge in block.edges:
                if edge.kind & followed and edge.to not in seen:
                    seen.add(edge.to)
                    stack.append(edge.to)
        return seen

    def loop(self, head: int, ends: Iterable[int]) -> set[int] | None:
        """Return the blocks of a natural loop, from which control comes back to its first block.

        Args:
            head: The first block.
            ends: The blocks whose edges lead back to it.

        Returns:
            The blocks; None if control also enters the loop elsewhere.
        """
        before: dict[int, list[int]] = defaultdict(list)
        for index, block in enumerate(self.blocks):
            for edge in block.edges:
                before[edge.to].append(index)
        found, stack = {head}, list(ends)
        while stack:
            index = stack.pop()
            if index not in found:
                found.add(index)
                stack += before[index]
        return None if found.intersection(self.entries) else found
