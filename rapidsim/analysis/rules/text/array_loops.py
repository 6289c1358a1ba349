"""Rule T325: loops that exceed the bounds of an array."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TypeVar

from rapidsim.analysis.evaluation import arithmetic_result
from rapidsim.analysis.program import CounterSymbol, Symbol
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.changed_data import CHANGES, changed_by
from rapidsim.analysis.rules.facts.instruction_questions import arguments_of
from rapidsim.analysis.rules.facts.known_values import known_value
from rapidsim.analysis.rules.facts.reached_routines import may_leave
from rapidsim.analysis.tree_walk import blocks, descendants
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.language.errors import RapidError
from rapidsim.language.types import ArrayOf, resolved
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree
from rapidsim.values import value_class

L = TypeVar("L", tree.For, tree.While)
_PATHS = (tree.DataReference, tree.Index, tree.ComponentAccess)


class LoopBeyondArray(Violation, code="T325"):
    element: str
    index: int
    array: str
    bounds: str


@value_class(frozen=True, slots=True)
class _Rounds:
    """Counter of a loop, with its first and last value if known."""

    counter: Symbol
    least: float | None
    most: float | None


def find_loops_beyond_arrays(facts: Facts) -> Iterator[Diagnostic]:
    """Report elements whose index is out of bounds in the first or last iteration of a loop."""
    for part in facts.routine_parts:
        for loop in _with_elements(part, tree.For):
            rounds = _of_for(loop, facts)
            if rounds is not None and not may_leave(loop.body, part, facts):
                yield from _beyond(loop.body, rounds, part, facts)
        for loop_while in _with_elements(part, tree.While):
            rounds = _of_while(loop_while, part, facts)
            if rounds is not None and not may_leave(loop_while.body, part, facts):
                first = _before_counting(loop_while.body, rounds.counter, facts)
                yield from _beyond(first, rounds, part, facts)


def _of_for(loop: tree.For, facts: Facts) -> _Rounds | None:
    counter = facts.symbol(loop)
    first, last = _number(loop.first, facts), _number(loop.last, facts)
    step = 1.0 if loop.step is None else _number(loop.step, facts)
    if not isinstance(counter, CounterSymbol) or not step:
        return None
    if first is not None and last is not None:
        if loop.step is None and first > last:
            step = -1.0
        if (last - first) * step < 0:
            return None
        last = first + step * int((last - first) / step)
    elif step != 1.0 or loop.step is not None:
        return None
    ends = (first, last) if step > 0 else (last, first)
    return _Rounds(counter, *ends)


def _with_elements(part: ProgramPart, kind: type[L]) -> list[L]:
    """The loops of a part with an element of an array in their bodies."""
    if not part.all(tree.Index):
        return []
    return [loop for loop in part.all(kind) if next(part.inside(loop.body, tree.Index), None)]


def _of_while(loop: tree.While, part: ProgramPart, facts: Facts) -> _Rounds | None:
    """Range of a variable that counts up by one until it passes a constant."""
    match loop.condition:
        case tree.Binary(left=tree.DataReference() as left, operator="<=" | "<" as operator):
            counter = facts.symbol(left)
            limit = _number(loop.condition.right, facts)
        case _:
            return None
    if counter is None or limit is None or not limit.is_integer():
        return None
    changes = part.inside(loop.body, *CHANGES)
    steps = [node for node in changes if counter in changed_by([node], facts)]
    if len(steps) != 1 or not _adds_one(steps[0], facts):
        return None
    return _Rounds(counter, None, limit if operator == "<=" else limit - 1)


def _adds_one(node: tree.Node, facts: Facts) -> bool:
    match node:
        case tree.Assignment(target=tree.DataReference(name=name), value=tree.Binary() as value):
            left = value.left
            is_same = isinstance(left, tree.DataReference) and left.name.key == name.key
            return is_same and value.operator == "+" and _number(value.right, facts) == 1.0
        case tree.Call():
            return Trait.COUNT_UP in facts.does(node)
        case _:
            return False


def _before_counting(body: tree.Body, counter: Symbol, facts: Facts) -> tree.Body:
    """Statements of an iteration before its counter changes."""
    found: list[tree.Statement] = []
    for statement in body:
        if counter in changed_by(descendants(statement), facts):
            break
        found.append(statement)
    return tuple(found)


def _beyond(
    body: tree.Body, rounds: _Rounds, part: ProgramPart, facts: Facts
) -> Iterator[Diagnostic]:
    for node in _unguarded(body, rounds.counter, facts):
        of = facts.analysis.type_of.get(node.array)
        of = None if of is None else resolved(of)
        if not isinstance(of, ArrayOf) or len(of.dimensions) != len(node.indices):
            continue
        for index, size in zip(node.indices, of.dimensions, strict=True):
            beside = _index_offset(index, rounds.counter, facts)
            if beside is None:
                continue
            at = None
            if size is not None and rounds.most is not None and rounds.most + beside > size:
                at = rounds.most + beside
            elif rounds.least is not None and rounds.least + beside < 1:
                at = rounds.least + beside
            if at is not None:
                shown = part.module.span(node).one_line
                array = part.module.span(node.array).one_line
                bounds = "begins at 1" if size is None else f"has 1 to {size}"
                yield part.finding(LoopBeyondArray(shown, int(at), array, bounds), node)
                break


def _unguarded(body: tree.Body, counter: Symbol, facts: Facts) -> Iterator[tree.Index]:
    """Elements that every iteration evaluates, as far as the counter decides."""
    for statement in body:
        inner = list(blocks(statement))
        if inner:
            heads = [node for node in descendants(statement) if facts.symbol(node) is counter]
            decides = any(
                not any(block and block[0].start <= node.start < block[-1].end for block in inner)
                for node in heads
            )
            if not decides or isinstance(statement, tree.For):
                for block in inner:
                    yield from _unguarded(block, counter, facts)
            continue
        for node in descendants(statement):
            if isinstance(node, tree.Index):
                yield node


def _index_offset(index: tree.Expression, counter: Symbol, facts: Facts) -> float | None:
    """Offset of an index from the counter; None for other expressions."""
    match index:
        case tree.Parenthesised(inner=inner):
            return _index_offset(inner, counter, facts)
        case tree.DataReference():
            return 0.0 if facts.symbol(index) is counter else None
        case tree.Binary(left=left, operator="+" | "-" as operator, right=right):
            a, b = _index_offset(left, counter, facts), _number(right, facts)
            if a is not None and b is not None:
                return _result(operator, a, b)
            a, b = _number(left, facts), _index_offset(right, counter, facts)
            return a + b if operator == "+" and a is not None and b is not None else None
        case _:
            return None


def _number(expression: tree.Expression, facts: Facts) -> float | None:
    """Number that is the same in every run, including sizes of arrays."""
    match expression:
        case tree.FunctionCall() if Trait.READ_ARGUMENT in facts.does(expression):
            return _size(expression, facts)
        case tree.Binary(left=left, operator=operator, right=right):
            a, b = _number(left, facts), _number(right, facts)
            return None if a is None or b is None else _finite(_result(operator, a, b))
        case _:
            return _finite(known_value(expression, facts, persistents=False))


def _result(operator: str, a: float, b: float) -> float | None:
    try:
        value = arithmetic_result(operator, a, b)
    except RapidError:
        return None
    return value if isinstance(value, float) else None


def _finite(value: object) -> float | None:
    """Value as a finite number for counting iterations; None for others."""
    return value if isinstance(value, float) and math.isfinite(value) else None


def _size(call: tree.FunctionCall, facts: Facts) -> float | None:
    """Result of Dim for an array of declared size."""
    given = {formal.key: value for formal, value in arguments_of(call, facts) if formal is not None}
    array, number = given.get("arrpar"), given.get("dimno")
    if not isinstance(array, _PATHS) or number is None:
        return None
    of = facts.analysis.type_of.get(array)
    dimension = known_value(number, facts, persistents=False)
    of = None if of is None else resolved(of)
    if not isinstance(of, ArrayOf) or not isinstance(dimension, float):
        return None
    sizes = dict(enumerate(of.dimensions, start=1))
    size = sizes.get(int(dimension))
    return None if size is None else float(size)
