"""Bounds of integer variables that follow from the conditions of a routine.

After `IF n<2 RETURN;` n is at least 2, and in `WHILE k<=9` k is at most 9 until it is assigned.
Sums of such integers need no check. A forward analysis over the control-flow graph.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from rapidsim.analysis.flow.graph import EdgeKind, FlowEdge
from rapidsim.analysis.flow.solve import forward
from rapidsim.analysis.program import Program, RoutineSymbol, control_flow
from rapidsim.analysis.tree_walk import blocks, descendants, statements
from rapidsim.interpreter.codegen.inlined_instructions import assigned_in_place
from rapidsim.interpreter.codegen.intervals import Interval, rounded
from rapidsim.interpreter.codegen.written_paths import bare, declaration
from rapidsim.syntax import tree
from rapidsim.values import value_class

_Bounds = Mapping[tree.Node, Interval]
_Of = Callable[[tree.Expression], Interval | None]

_OPPOSITE = {"<": ">=", ">=": "<", ">": "<=", "<=": ">", "=": "<>", "<>": "="}
_MIRRORED = {"<": ">", ">": "<", "<=": ">=", ">=": "<=", "=": "=", "<>": "<>"}


def narrowed(
    routine: RoutineSymbol, program: Program, integers: _Bounds, of: _Of
) -> dict[tree.Node, Interval]:
    """Return narrower bounds of integers at the references where control flow implies them.

    Args:
        routine: The routine to analyse.
        program: Resolves names.
        integers: Bounds of variables that hold everywhere, by declaration.
        of: Computes the bounds of an expression.
    """
    graph = control_flow(program, routine.node)
    conditions = _Conditions(program, integers, of)
    # A clause can be entered from any statement, and so can the targets of RETRY and TRYNEXT.
    resumed = [
        edge.to
        for block in graph.blocks
        for edge in block.edges
        if edge.kind & (EdgeKind.RETRY | EdgeKind.TRYNEXT)
    ]
    nothing: _Bounds = {}
    starts = dict.fromkeys((*graph.entries, *resumed), nothing)
    states = forward(graph, starts, conditions.after, _common, conditions.along)
    found: dict[tree.Node, Interval] = {}
    for index, bounds in states.items():
        for node in graph.blocks[index].steps:
            # A function call is part of the step behind it.
            if not isinstance(node, tree.For | tree.FunctionCall):
                found |= conditions.at_references(node, bounds)
            bounds = conditions.after(node, bounds)
    return found


def never_shows(data: tree.Data, routine: RoutineSymbol, program: Program) -> bool:
    """Whether the initial 0 of a variable is never observable.

    True if each statement list that uses the variable assigns to it first.
    """
    return not _is_jump_target(routine) and _assigned_first(routine.node.body, data, program)


def _assigned_first(body: tree.Body, data: tree.Data, program: Program) -> bool:
    named = [one for one in body if _names(one, data, program)]
    first = named[0] if named else None
    if isinstance(first, tree.Assignment) and declaration(first.target, program) is data:
        return not _names(first.value, data, program)
    if first is None or len(named) > 1:
        return False
    lists = [block for block in blocks(first) if any(_names(one, data, program) for one in block)]
    in_lists = sum(_names(one, data, program) for block in lists for one in block)
    return in_lists == _names(first, data, program) and all(
        _assigned_first(block, data, program) for block in lists
    )


def _names(node: tree.Node, data: tree.Data, program: Program) -> int:
    """Number of references to a variable in a part of the text."""
    return sum(
        isinstance(one, tree.DataReference) and declaration(one, program) is data
        for one in descendants(node)
    )


def _is_jump_target(routine: RoutineSymbol) -> bool:
    """Whether control may reach a statement without executing those before it."""
    labels = (isinstance(one, tree.Label) for one in statements(routine.node.body))
    return routine.node.error is not None or routine.node.undo is not None or any(labels)


@value_class(frozen=True, slots=True)
class _Conditions:
    """The transfer functions: assignments forget bounds, conditions narrow them."""

    program: Program
    integers: _Bounds
    of: _Of

    def after(self, node: tree.Node, bounds: _Bounds) -> _Bounds:
        """Return the bounds after a step."""
        if not bounds or not isinstance(node, tree.Assignment | tree.Call):
            return bounds
        assigned = self._assigned(node)
        return {data: known for data, known in bounds.items() if data is not assigned}

    def along(self, edge: FlowEdge, bounds: _Bounds) -> _Bounds:
        """Return the bounds along an edge."""
        if edge.holds is None or not isinstance(
            edge.by, tree.Binary | tree.Unary | tree.Parenthesised
        ):
            return bounds
        return self._bounds_where(edge.by, bounds, holds=edge.holds)

    def at_references(self, node: tree.Node, bounds: _Bounds) -> dict[tree.Node, Interval]:
        """Return the bounds of the variables that a step names, by reference."""
        if not bounds:
            return {}
        return {
            one: bounds[home]
            for one in descendants(node)
            if isinstance(one, tree.DataReference)
            and (home := declaration(one, self.program)) is not None
            and home in bounds
        }

    def _assigned(self, statement: tree.Statement) -> tree.Node | None:
        match statement:
            case tree.Assignment(target=target):
                return declaration(target, self.program)
            case tree.Call():
                variable = assigned_in_place(statement, self.program)
                return None if variable is None else declaration(variable, self.program)
            case _:
                return None

    def _bounds_where(self, condition: tree.Expression, bounds: _Bounds, *, holds: bool) -> _Bounds:
        """Return the bounds under the assumption that a condition holds, or does not."""
        match bare(condition):
            case tree.Unary(operator="NOT", operand=operand):
                return self._bounds_where(operand, bounds, holds=not holds)
            case tree.Binary(operator="AND" | "OR" as operator, left=left, right=right):
                if holds is (operator == "AND"):
                    return self._bounds_where(
                        right, self._bounds_where(left, bounds, holds=holds), holds=holds
                    )
            case tree.Binary(operator=operator, left=left, right=right) if operator in _OPPOSITE:
                relation = operator if holds else _OPPOSITE[operator]
                bounds = self._compared(left, relation, right, bounds)
                return self._compared(right, _MIRRORED[relation], left, bounds)
            case _:
                pass
        return bounds

    def _compared(
        self, variable: tree.Expression, relation: str, other: tree.Expression, facts: _Bounds
    ) -> _Bounds:
        node = declaration(variable, self.program)
        bounds = None if node is None else facts.get(node) or self.integers.get(node)
        limit = self.of(other)
        if node is None or bounds is None or limit is None or limit.low > limit.high:
            return facts
        limit = rounded(limit)
        low, high = bounds.low, bounds.high
        match relation:
            case "<" | "<=":
                high = min(high, limit.high - (relation == "<"))
            case ">" | ">=":
                low = max(low, limit.low + (relation == ">"))
            case "=":
                low, high = max(low, limit.low), min(high, limit.high)
            case _:
                return facts
        # Fall-through keeps all facts.
        return {**facts, node: replace(bounds, low=low, high=high)} if low <= high else facts


def _common(one: _Bounds, other: _Bounds) -> _Bounds:
    """Join the bounds of two paths."""
    return {
        node: replace(
            bounds, low=min(bounds.low, other[node].low), high=max(bounds.high, other[node].high)
        )
        for node, bounds in one.items()
        if node in other
    }
