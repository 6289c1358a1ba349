"""Whether an expression has the required type, and the finding if not."""

from __future__ import annotations

from rapidsim.analysis.cell_names import ConfiguredSymbol
from rapidsim.analysis.context import Context, TypeOf
from rapidsim.analysis.names.names import find
from rapidsim.analysis.parameters import ExpectedType
from rapidsim.analysis.types.operators import has_value, value_type
from rapidsim.analysis.types.type_violations import NoValue, TypeMismatch
from rapidsim.language import types
from rapidsim.language.types import ArrayOf, Atomic, Kind, Type, resolved
from rapidsim.syntax import tree


def require(
    expression: tree.Expression, wanted: ExpectedType, context: Context, type_of: TypeOf
) -> None:
    """Determine the type of an expression, and report a value that lacks the required type."""
    found = type_of(expression, context, wanted)
    if found is not None and not agrees(found, wanted.type):
        report_mismatch(expression, found, wanted, context)


def agrees(actual: Type, wanted: Type) -> bool:
    """Whether a value of one type satisfies another required type; anytype accepts all."""
    if actual is wanted or wanted is types.ANYTYPE:
        return True
    value = value_type(actual)
    target = resolved(wanted)
    if is_unknown(value) or is_unknown(target):
        return True
    if isinstance(value, ArrayOf) and isinstance(target, ArrayOf):
        return value.element == target.element and _sizes_agree(value, target)
    return value == target or resolved(actual) == target


def is_unknown(of: Type) -> bool:
    """Whether a type is undeclared, or an array of an undeclared one."""
    target = resolved(of)
    inner = resolved(target.element) if isinstance(target, ArrayOf) else target
    return isinstance(inner, Atomic) and inner.kind is Kind.UNKNOWN


def report_mismatch(
    expression: tree.Node, actual: Type, wanted: ExpectedType, context: Context
) -> None:
    """Report a value of the wrong type."""
    name = expression.name if isinstance(expression, tree.DataReference) else None
    symbol = None if name is None else find(name.key, context)
    configured = symbol.name if isinstance(symbol, ConfiguredSymbol) else ""
    violation = TypeMismatch(wanted.by, wanted.type.name, actual.name, configured)
    context.report(violation, expression, *wanted.declared)


def require_value(expression: tree.Node, actual: Type, used: str, context: Context) -> bool:
    """Report an expression of a type without values if a value is required.

    Args:
        expression: The expression of that type.
        actual: The type.
        used: The use of the value, such as "assigned".
        context: The scope.

    Returns:
        Whether it has values.
    """
    if has_value(actual):
        return True
    context.report(NoValue(actual.name, used), expression)
    return False


def _sizes_agree(actual: ArrayOf, wanted: ArrayOf) -> bool:
    if len(actual.dimensions) != len(wanted.dimensions):
        return False
    return all(
        a is None or b is None or a == b
        for a, b in zip(actual.dimensions, wanted.dimensions, strict=True)
    )
