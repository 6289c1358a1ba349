"""Control flow that does not follow the text: jumps, errors, and calls that never return.

The abstract interpreter walks statement lists. The control-flow graph adds which labels a path
reaches, what is executed before a jump back, and where control resumes after an error.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from functools import cached_property

from rapidsim.analysis.flow.graph import ControlFlowGraph, EdgeKind, FlowEdge
from rapidsim.analysis.flow.returning import may_return, returning
from rapidsim.analysis.program import Program, RoutineSymbol, control_flow
from rapidsim.analysis.tree_walk import clauses, statements
from rapidsim.reach.dataflow.side_effects import Effects, ProgramEffects
from rapidsim.syntax import tree
from rapidsim.values import value_class

_ANY = sum(EdgeKind)
_RESUMING = EdgeKind.RETRY | EdgeKind.TRYNEXT


@value_class(frozen=True, eq=False)
class RoutineJumps:
    """The labels and jumps of a routine."""

    routine: RoutineSymbol
    graph: ControlFlowGraph
    effects: ProgramEffects
    _repeated: dict[tree.Label, Effects] = field(default_factory=dict)

    def is_forward(self, jump: tree.Goto) -> bool:
        """Whether a jump leads to a label behind it in the text."""
        return jump.start < self._labels[jump.name.key].start

    def is_reached(self, label: tree.Label) -> bool:
        """Whether some path leads to a label."""
        return self.graph.block_of[label] in self._reached

    def is_resumed(self, statement: tree.Statement) -> bool:
        """Whether control may come to a statement after an error before it."""
        return self.graph.block_of[statement] in self._resumed

    def repeated(self, label: tree.Label) -> Effects:
        """Return the effects of what may be executed between a label and a jump back to it."""
        if label not in self._repeated:
            self._repeated[label] = self._effects_before_jumps(label)
        return self._repeated[label]

    def _effects_before_jumps(self, label: tree.Label) -> Effects:
        graph = self.graph
        head = graph.block_of[label]
        ends = [
            index
            for index, block in enumerate(graph.blocks)
            for edge in block.edges
            if edge.to == head and _is_jump_back(edge, label)
        ]
        loop = graph.loop(head, ends) if ends else ()
        if loop is None:
            return self.effects.of_routine(self.routine)
        return self.effects.of_bodies(
            tuple(one for one in self._statements if graph.block_of[one] in loop)
        )

    @cached_property
    def _statements(self) -> tuple[tree.Statement, ...]:
        return tuple(statements(*clauses(self.routine.node)))

    @cached_property
    def _labels(self) -> Mapping[str, tree.Label]:
        return {one.name.key: one for one in self._statements if isinstance(one, tree.Label)}

    @cached_property
    def _reached(self) -> set[int]:
        return self.graph.reached(_ANY, self.graph.entries)

    @cached_property
    def _resumed(self) -> set[int]:
        targets = [
            edge.to for block in self.graph.blocks for edge in block.edges if edge.kind & _RESUMING
        ]
        return self.graph.reached(_ANY, targets)


@value_class(frozen=True, eq=False)
class ProgramJumps:
    """The jumps of a program, and its routines that never return."""

    program: Program
    effects: ProgramEffects
    _of: dict[RoutineSymbol, RoutineJumps] = field(default_factory=dict)

    def of(self, routine: RoutineSymbol) -> RoutineJumps:
        """Return the jumps of a routine."""
        if routine not in self._of:
            self._of[routine] = RoutineJumps(routine, self._graph(routine), self.effects)
        return self._of[routine]

    def returns(self, routine: RoutineSymbol) -> bool:
        """Whether a call of a routine can return."""
        return self._returning[routine]

    @cached_property
    def _returning(self) -> Mapping[RoutineSymbol, bool]:
        return returning(
            self.effects.routines,
            self.effects.callees,
            self._called,
            self._graph,
            lambda routine: may_return(self._graph(routine)),
        )

    def _called(self, step: tree.Node) -> RoutineSymbol | None:
        symbol = self.program.symbol_of.get(step)
        is_call = isinstance(step, tree.Call | tree.FunctionCall)
        return symbol if is_call and isinstance(symbol, RoutineSymbol) else None

    def _graph(self, routine: RoutineSymbol) -> ControlFlowGraph:
        return control_flow(self.program, routine.node)


def _is_jump_back(edge: FlowEdge, label: tree.Label) -> bool:
    return edge.kind == EdgeKind.JUMP and edge.by is not None and edge.by.start > label.start
