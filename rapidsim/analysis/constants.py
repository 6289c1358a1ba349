"""Numbers that are known before a program runs: sizes of arrays, indices, initial values."""

from __future__ import annotations

from rapidsim.analysis.context import Context
from rapidsim.analysis.installed import installed_symbol
from rapidsim.analysis.program import DataSymbol, Scope, Storage
from rapidsim.syntax import tree


def constant_number(
    expression: tree.Expression, context: Context, seen: frozenset[DataSymbol] = frozenset()
) -> float | None:
    """The number an expression has in every run; None if it has none or it varies.

    Elements of constant arrays and components of constant records are not looked into.
    """
    match expression:
        case tree.Number(value=value):
            return value
        case tree.Parenthesised(inner=inner):
            return constant_number(inner, context, seen)
        case tree.Unary(operator=operator, operand=operand) if operator != "NOT":
            number = constant_number(operand, context, seen)
            return -number if number is not None and operator == "-" else number
        case tree.Binary(left=left, operator=operator, right=right):
            a = constant_number(left, context, seen)
            b = constant_number(right, context, seen)
            return None if a is None or b is None else computed(operator, a, b)
        case tree.Reference(name=name):
            symbol = context.scope.find(name.key) or installed_symbol(name.key)
            if not isinstance(symbol, DataSymbol) or symbol.storage is not Storage.CONST:
                return None
            return _constant(symbol, context, seen)
        case _:
            return None


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
    """What an operator makes of two numbers; None where it makes none."""
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
    except OverflowError:
        return None
