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
    if _may_be_reached_otherwise(routine):
        return {}
    flow = _Flow(program, integers, of)
    flow.follow(routine.node.body, {})
    return flow.found


def never_shows(data: tree.Data, routine: RoutineSymbol, program: Program) -> bool:
    """Whether the initial 0 of a variable is never observable.

    True if each statement list that uses the variable assigns to it first.
    """
    return not _may_be_reached_otherwise(routine) and _assigned_first(
        routine.node.body, data, program
    )


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
        isinstance(one, tree.Reference) and declaration(one, program) is data
        for one in descendants(node)
    )


def _may_be_reached_otherwise(routine: RoutineSymbol) -> bool:
    """Whether a statement may come to execution without those before it."""
    labels = (isinstance(one, tree.Label) for one in statements(routine.node.body))
    return routine.node.error is not None or routine.node.undo is not None or any(labels)


@dataclass(slots=True)
class _Flow:
    program: Program
    integers: _Bounds
    of: _Of
    found: dict[tree.Node, Interval] = field(default_factory=dict)

    def follow(self, body: tree.Body, known: _Bounds) -> _Bounds | None:
        """Walk through statements; what is known after them, None if control never gets there."""
        for statement in body:
            after = self._statement(statement, known)
            if after is None:
                return None
            known = after
        return known

    def _statement(self, statement: tree.Statement, known: _Bounds) -> _Bounds | None:
        match statement:
            case tree.Return() | tree.Raise() | tree.Exit():
                self._name(descendants(statement), known)
                return None
            case tree.If(branches=branches, otherwise=otherwise):
                rest: _Bounds = known
                ends = []
                for branch in branches:
                    self._name(descendants(branch.condition), rest)
                    holds = self._where(branch.condition, rest, holds=True)
                    ends.append(self.follow(branch.body, holds))
                    rest = self._where(branch.condition, rest, holds=False)
                ends.append(self.follow(otherwise or (), rest))
                return _common(ends)
            case tree.CompactIf(condition=condition, statement=inner):
                self._name(descendants(condition), known)
                done = self._statement(inner, self._where(condition, known, holds=True))
                return _common([done, self._where(condition, known, holds=False)])
            case tree.While(condition=condition, body=body):
                known = self._forgets(known, body)
                self._name(descendants(condition), known)
                self.follow(body, self._where(condition, known, holds=True))
                return self._where(condition, known, holds=False)
            case tree.For(first=first, last=last, step=step, body=body):
                parts = [part for part in (first, last, step) if part is not None]
                self._name(descendants(*parts), known)
                known = self._forgets(known, body)
                self.follow(body, known)
                return known
            case tree.Test():
                known = self._forgets(known, *blocks(statement))
                for block in blocks(statement):
                    self.follow(block, known)
                return known
            case _:
                self._name(descendants(statement), known)
                return self._forgets(known, (statement,))

    def _name(self, nodes: Iterable[tree.Node], known: _Bounds) -> None:
        """Note what is known where variables are named."""
        for node in nodes:
            if isinstance(node, tree.Reference):
                home = declaration(node, self.program) if known else None
                bounds = None if home is None else known.get(home)
                if bounds is not None:
                    self.found[node] = bounds

    def _forgets(self, known: _Bounds, *bodies: tree.Body) -> _Bounds:
        """What is still known when some statements may have assigned."""
        if not known:
            return known
        changed = {self._assigned(one) for one in statements(*bodies)}
        return {node: bounds for node, bounds in known.items() if node not in changed}

    def _assigned(self, statement: tree.Statement) -> tree.Node | None:
        match statement:
            case tree.Assignment(target=target):
                return declaration(target, self.program)
            case tree.Call():
                variable = assigned_in_place(statement, self.program)
                return None if variable is None else declaration(variable, self.program)
            case _:
                return None

    def _where(self, condition: tree.Expression, known: _Bounds, *, holds: bool) -> _Bounds:
        """What is known where a condition holds, or does not."""
        match bare(condition):
            case tree.Unary(operator="NOT", operand=operand):
                return self._where(operand, known, holds=not holds)
            case tree.Binary(operator="AND" | "OR" as operator, left=left, right=right):
                if holds is (operator == "AND"):
                    return self._where(right, self._where(left, known, holds=holds), holds=holds)
            case tree.Binary(operator=operator, left=left, right=right) if operator in _OPPOSITE:
                relation = operator if holds else _OPPOSITE[operator]
                known = self._compared(left, relation, right, known)
                return self._compared(right, _MIRRORED[relation], left, known)
            case _:
                pass
        return known

    def _compared(
        self, variable: tree.Expression, relation: str, other: tree.Expression, known: _Bounds
    ) -> _Bounds:
        node = declaration(variable, self.program)
        bounds = None if node is None else known.get(node) or self.integers.get(node)
        limit = self.of(other)
        if node is None or bounds is None or limit is None or limit.low > limit.high:
            return known
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
                return known
        # Who comes here all the same knows no less.
        return {**known, node: replace(bounds, low=low, high=high)} if low <= high else known


def _common(ways: Iterable[_Bounds | None]) -> _Bounds | None:
    """What is known where several ways meet."""
    every = [way for way in ways if way is not None]
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
