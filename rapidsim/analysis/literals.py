"""RAPID values that need no running code: literals, typed by their context."""

from __future__ import annotations

from typing import Any, TypeAlias

from rapidsim.language.single_precision import single
from rapidsim.language.types import NUM, ArrayOf, Atomic, Kind, Record, Type, resolved
from rapidsim.syntax import tree

Value: TypeAlias = Any
"""A float, bool or str; a record's tuple; a list for an array; the object of a library type."""


def literal(expression: tree.Expression | None, of: Type | None) -> Value | None:
    """Return the value of a literal expression; None for any other.

    Args:
        expression: Any expression.
        of: Its type; None for numbers as written, and for tuples of any record or array.
    """
    target = None if of is None else resolved(of)
    match expression:
        case (
            tree.NumberLiteral(value=value)
            | tree.StringLiteral(value=value)
            | tree.BoolLiteral(value=value)
        ):
            return value if target is None else from_literal(value, target)
        case tree.LiteralAggregate(value=values):
            return values if target is None else from_literal(values, target)
        case tree.Parenthesised(inner=inner):
            return literal(inner, target)
        case tree.Unary(operator="-" | "+" as sign, operand=operand):
            number = literal(operand, target)
            if not isinstance(number, float):
                return None
            return -number if sign == "-" else number
        case tree.Aggregate(elements=elements):
            return _aggregate(elements, target)
        case _:
            return None


def _aggregate(elements: tuple[tree.Expression, ...], of: Type | None) -> Value | None:
    match of:
        case ArrayOf():
            types: list[Type] = [element_type(of)] * len(elements)
        case Record(components=components):
            types = [component.type for component in components]
        case _:
            return None
    values = []
    for element, type_ in zip(elements, types, strict=True):
        value = literal(element, type_)
        if value is None:
            return None
        values.append(value)
    return tuple.__new__(of.python, values) if isinstance(of, Record) else values


def from_literal(value: tree.LiteralValue, of: Type) -> Value:
    """Convert a literal to a value of its type: nums as singles, aggregates as records or lists."""
    target = of if isinstance(of, Record) else resolved(of)
    if isinstance(value, tuple):
        if isinstance(target, Record):
            # Generated programs consist of these; most parts of most literals are plain nums.
            parts = [
                single(one)
                if part.type is NUM and type(one) is float
                else from_literal(one, part.type)
                for one, part in zip(value, target.components, strict=True)
            ]
            return tuple.__new__(target.python, parts)
        if isinstance(target, ArrayOf):
            element = element_type(target)
            return [from_literal(one, element) for one in value]
    if (
        isinstance(target, Atomic)
        and isinstance(value, int | float)
        and not isinstance(value, bool)
    ):
        return float(value) if target.name.lower() == "dnum" else single(float(value))
    return value


def element_type(array: ArrayOf) -> Type:
    """The type of `a{i}`, where `a` may have more dimensions."""
    rest = array.dimensions[1:]
    return ArrayOf(array.element, rest) if rest else array.element


def is_signal(of: Type) -> bool:
    """Whether data of a type refer to a signal, and reading them reads its value."""
    target = resolved(of)
    return isinstance(target, Atomic) and target.kind is Kind.SEMI_VALUE
