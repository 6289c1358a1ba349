"""Values known before a program runs, and the numbers among them: sizes, indices.

Records and arrays are tuples. Numbers are not rounded as in a run, and no function is called; the
interpreter evaluates what needs that.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from rapidsim.analysis.context import Context
from rapidsim.analysis.installed import installed_symbol
from rapidsim.analysis.program import DataSymbol, Scope, Storage
from rapidsim.syntax import tree

Value: TypeAlias = "float | str | bool | tuple[Value, ...]"


def evaluated(
    expression: tree.Expression | None, read: Callable[[tree.DataReference], Value | None]
) -> Value | None:
    """The value of an expression; None if it varies or is not known.

    Args:
        expression: Of any type; array elements and record components are not resolved.
        read: Gives the value of the data that a name refers to.
    """
    match expression:
        case (
            tree.NumberLiteral(value=value)
            | tree.StringLiteral(value=value)
            | tree.BoolLiteral(value=value)
        ):
            return value
        case tree.LiteralAggregate(value=value):
            return value
        case tree.Parenthesised(inner=inner):
            return evaluated(inner, read)
        case tree.Unary(operator="-" | "+" as sign, operand=operand):
            number = evaluated(operand, read)
            if not isinstance(number, float):
                return None
            return -number if sign == "-" else number
        case tree.Binary(left=left, operator=operator, right=right):
            a, b = evaluated(left, read), evaluated(right, read)
            if isinstance(a, float) and isinstance(b, float):
                return computed(operator, a, b)
            return a + b if operator == "+" and isinstance(a, str) and isinstance(b, str) else None
        case tree.Aggregate(elements=elements):
            parts: list[Value] = []
            for element in elements:
                part = evaluated(element, read)
                if part is None:
                    return None
                parts.append(part)
            return tuple(parts)
        case tree.DataReference():
            return read(expression)
        case _:
            return None


def constant_number(
    expression: tree.Expression, context: Context, seen: frozenset[DataSymbol] = frozenset()
) -> float | None:
    """The numeric value of an expression in every run; None if it has none or it varies."""

    def read(reference: tree.DataReference) -> float | None:
        key = reference.name.key
        symbol = context.scope.find(key) or installed_symbol(key)
        if not isinstance(symbol, DataSymbol) or symbol.storage is not Storage.CONST:
            return None
        return _constant(symbol, context, seen)

    value = evaluated(expression, read)
    return value if isinstance(value, float) else None


def _constant(symbol: DataSymbol, context: Context, seen: frozenset[DataSymbol]) -> float | None:
    if symbol.node is None:
        return symbol.value if isinstance(symbol.value, float) else None
    if symbol.node.value is None or symbol in seen:
        return None
    if symbol.scope is Scope.ROUTINE:
        home = context
    else:
        home = context.analysis.home_of[context.analysis.module_of[symbol]]
    return constant_number(symbol.node.value, home, seen | {symbol})


def computed(operator: str, left: float, right: float) -> float | None:
    """The result of an operator on two numbers; None if there is none."""
    if operator in ("/", "DIV", "MOD") and right == 0.0:
        return None
    try:
        match operator:
            case "+":
                return left + right
            case "-":
                return left - right
            case "*":
                return left * right
            case "/":
                return left / right
            case "DIV":
                return float(int(left / right))
            case "MOD":
                return left - right * int(left / right)
            case _:
                return None
    except (OverflowError, ValueError):
        # Infinite, or what infinite less infinite is.
        return None
