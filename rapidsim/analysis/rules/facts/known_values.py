"""Values of constants, and of persistents as stored, for rules.

A record is a tuple. A persistent counts with the value in the text, which the program starts with.
No function is called.
"""

from __future__ import annotations

from typing import TypeAlias

from rapidsim.analysis.evaluation import NOT_STATIC, Evaluator, Known, NotStatic
from rapidsim.analysis.program import DataSymbol, Storage
from rapidsim.analysis.program_parts import Facts
from rapidsim.language.types import Type
from rapidsim.syntax import tree

Value: TypeAlias = "float | str | bool | tuple[Value, ...]"

_DEEPEST = 32


def known_value(
    expression: tree.Expression | None, facts: Facts, *, persistents: bool = True
) -> Value | None:
    """Return the value of an expression.

    Args:
        expression: Of any type.
        facts: The task.
        persistents: Whether a PERS counts as known.

    Returns:
        None if the value varies, is not known, is an array, or was never given in the declaration.
    """
    if expression is None:
        return None
    value = _value(expression, None, facts, persistents, 0)
    return None if isinstance(value, NotStatic | list) else value


def numbers(value: object, count: int) -> tuple[float, ...] | None:
    """A value as a tuple of the given number of numbers; None if it is something else."""
    if not isinstance(value, tuple) or len(value) != count:
        return None
    if not all(isinstance(part, float) for part in value):
        return None
    return value


def _value(
    expression: tree.Expression, of: Type | None, facts: Facts, persistents: bool, depth: int
) -> Known:
    """The value of an expression, after so many names; circular definitions have no value."""

    def read(reference: tree.DataReference) -> Known:
        symbol = facts.symbol(reference)
        if not isinstance(symbol, DataSymbol) or depth > _DEEPEST:
            return NOT_STATIC
        is_stored = persistents and symbol.storage is Storage.PERS
        if symbol.storage is not Storage.CONST and not is_stored:
            return NOT_STATIC
        if symbol.node is None:
            return symbol.value
        if symbol.node.value is None:
            return NOT_STATIC
        return _value(symbol.node.value, symbol.type, facts, persistents, depth + 1)

    return Evaluator(facts.analysis, read).value(expression, of)
