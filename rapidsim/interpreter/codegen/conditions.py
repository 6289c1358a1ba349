"""What conditions imply about the integers of a routine.

After `IF n<2 RETURN;` n is at least 2, and in `WHILE k<=9` k is at most 9 until it is assigned.
Sums of such integers need no check. Routines with an ERROR clause or with labels are left alone:
there a statement may be reached in other ways.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace

from rapidsim.analysis.program import Program, RoutineSymbol
from rapidsim.analysis.tree_walk import blocks, descendants, statements
from rapidsim.interpreter.codegen.inlined_instructions import assigned_in_place
from rapidsim.interpreter.codegen.intervals import Interval, rounded
from rapidsim.interpreter.codegen.written_paths import bare, declaration
from rapidsim.syntax import tree

_Bounds = Mapping[tree.Node, Interval]
_Of = Callable[[tree.Expression], Interval | None]

_OPPOSITE = {"<": ">=", ">=": "<", ">": "<=", "<=": ">", "=": "<>", "<>": "="}
_MIRRORED = {"<": ">", ">": "<", "<=": ">=", ">=": "<=", "=": "=", "<>": "<>"}


def narrowed(
    routine: RoutineSymbol, program: Program, integers: _Bounds, of: _Of
) -> dict[tree.Node, Interval]:
    """Narrower bounds of integers at the references where the text implies them.

    Args:
        routine: The routine to look at.
        program: Resolves names.
        integers: Bounds of variables that hold everywhere, by declaration.
        of: Gives the bounds of an expression.
    """
    if _is_jump_target(routine):
        return {}
    flow = _Flow(program, integers, of)
    flow.follow(routine.node.body, {})
    return flow.intervals


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
    """How often a part of the text names a variable."""
    return sum(
        isinstance(one, tree.DataReference) and declaration(one, program) is data
        for one in descendants(node)
    )


def _is_jump_target(routine: RoutineSymbol) -> bool:
    """Whether a statement may come to execution without those before it."""
    labels = (isinstance(one, tree.Label) for one in statements(routine.node.body))
    return routine.node.error is not None or routine.node.undo is not None or any(labels)


@dataclass(slots=True)
class _Flow:
    program: Program
    integers: _Bounds
    of: _Of
    intervals: dict[tree.Node, Interval] = field(default_factory=dict)

    def follow(self, body: tree.Body, bounds: _Bounds) -> _Bounds | None:
        """Walk through statements; what is known after them, None if control never gets there."""
        for statement in body:
            after = self._statement(statement, bounds)
            if after is None:
                return None
            bounds = after
        return bounds

    def _statement(self, statement: tree.Statement, bounds: _Bounds) -> _Bounds | None:
        match statement:
            case tree.Return() | tree.Raise() | tree.Exit():
                self._name(descendants(statement), bounds)
                return None
            case tree.If(branches=branches, otherwise=otherwise):
                rest: _Bounds = bounds
                ends = []
                for branch in branches:
                    self._name(descendants(branch.condition), rest)
                    holds = self._bounds_where(branch.condition, rest, holds=True)
                    ends.append(self.follow(branch.body, holds))
                    rest = self._bounds_where(branch.condition, rest, holds=False)
                ends.append(self.follow(otherwise or (), rest))
                return _common(ends)
            case tree.CompactIf(condition=condition, statement=inner):
                self._name(descendants(condition), bounds)
                done = self._statement(inner, self._bounds_where(condition, bounds, holds=True))
                return _common([done, self._bounds_where(condition, bounds, holds=False)])
            case tree.While(condition=condition, body=body):
                bounds = self._forgets(bounds, body)
                self._name(descendants(condition), bounds)
                self.follow(body, self._bounds_where(condition, bounds, holds=True))
                return self._bounds_where(condition, bounds, holds=False)
            case tree.For(first=first, last=last, step=step, body=body):
                parts = [part for part in (first, last, step) if part is not None]
                self._name(descendants(*parts), bounds)
                bounds = self._forgets(bounds, body)
                self.follow(body, bounds)
                return bounds
            case tree.Test():
                bounds = self._forgets(bounds, *blocks(statement))
                for block in blocks(statement):
                    self.follow(block, bounds)
                return bounds
            case _:
                self._name(descendants(statement), bounds)
                return self._forgets(bounds, (statement,))

    def _name(self, nodes: Iterable[tree.Node], facts: _Bounds) -> None:
        """Note what is known where variables are named."""
        for node in nodes:
            if isinstance(node, tree.DataReference):
                home = declaration(node, self.program) if facts else None
                bounds = None if home is None else facts.get(home)
                if bounds is not None:
                    self.intervals[node] = bounds

    def _forgets(self, facts: _Bounds, *bodies: tree.Body) -> _Bounds:
        """What is still known when some statements may have assigned."""
        if not facts:
            return facts
        changed = {self._assigned(one) for one in statements(*bodies)}
        return {node: bounds for node, bounds in facts.items() if node not in changed}

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
        """What is known where a condition holds, or does not."""
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
        # Who comes here all the same knows no less.
        return {**facts, node: replace(bounds, low=low, high=high)} if low <= high else facts


def _common(alternatives: Iterable[_Bounds | None]) -> _Bounds | None:
    """What is known where several ways meet."""
    every = [way for way in alternatives if way is not None]
    if not every:
        return None
    shared = set.intersection(*(set(way) for way in every))
    return {
        node: replace(
            every[0][node],
            low=min(way[node].low for way in every),
            high=max(way[node].high for way in every),
        )
        for node in shared
    }
