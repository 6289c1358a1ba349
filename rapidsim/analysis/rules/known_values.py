"""Values that are known before a program runs: literals, constants, persistents as they are stored.

A record or an array is a tuple, a name resolves as analysis resolved it. A persistent counts with
the value in the text: it is what the program starts with.
"""

from __future__ import annotations

from typing import TypeAlias

from rapidsim.analysis.constants import computed
from rapidsim.analysis.program import DataSymbol, Storage
from rapidsim.analysis.rules.facts import Facts
from rapidsim.syntax import tree

Value: TypeAlias = "float | str | bool | tuple[Value, ...]"
_DEEPEST = 32


def known_value(
    expression: tree.Expression | None, facts: Facts, *, persistents: bool = True, depth: int = 0
) -> Value | None:
    """The value of an expression.

    Args:
        expression: Of any type.
        facts: The task.
        persistents: Whether a PERS counts as known.
        depth: How many names led here; what is defined by itself has no value.

    Returns:
        None where the value varies or is not known; data that are declared without a value too.
    """
    match expression:
        case tree.Number(value=value) | tree.String(value=value) | tree.Bool(value=value):
            return value
        case tree.LiteralAggregate(value=value):
            return value
        case tree.Parenthesised(inner=inner):
            return known_value(inner, facts, persistents=persistents, depth=depth)
        case tree.Unary(operator="-" | "+" as sign, operand=operand):
            number = known_value(operand, facts, persistents=persistents, depth=depth)
            if not isinstance(number, float):
                return None
            return -number if sign == "-" else number
        case tree.Binary(left=left, operator=operator, right=right):
            a = known_value(left, facts, persistents=persistents, depth=depth)
            b = known_value(right, facts, persistents=persistents, depth=depth)
            if isinstance(a, float) and isinstance(b, float):
                return computed(operator, a, b)
            return a + b if operator == "+" and isinstance(a, str) and isinstance(b, str) else None
        case tree.Aggregate(elements=elements):
            parts: list[Value] = []
            for element in elements:
                part = known_value(element, facts, persistents=persistents, depth=depth)
                if part is None:
                    return None
                parts.append(part)
            return tuple(parts)
        case tree.Reference():
            symbol = facts.symbol(expression)
            return _of_symbol(symbol, facts, persistents, depth) if symbol is not None else None
        case _:
            return None


def numbers(value: object, count: int) -> tuple[float, ...] | None:
    """A value as so many numbers; None if it is something else."""
    if not isinstance(value, tuple) or len(value) != count:
        return None
    if not all(isinstance(part, float) for part in value):
        return None
    return value


def _of_symbol(symbol: object, facts: Facts, persistents: bool, depth: int) -> Value | None:
    if not isinstance(symbol, DataSymbol) or depth > _DEEPEST:
        return None
    if symbol.storage is not Storage.CONST and not (persistents and symbol.storage is Storage.PERS):
        return None
    if symbol.node is None:
        return symbol.value  # type: ignore[return-value]
    return known_value(symbol.node.value, facts, persistents=persistents, depth=depth + 1)
