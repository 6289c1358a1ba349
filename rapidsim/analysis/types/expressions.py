"""The types of expressions.

Every expression gets its type in the side table. Literal numbers are num or dnum and aggregates
take their type from their context; the type of other expressions is independent of it.
"""

from __future__ import annotations

from rapidsim.analysis.context import Context
from rapidsim.analysis.evaluation import ARITHMETIC
from rapidsim.analysis.parameters import ExpectedType
from rapidsim.analysis.types.aggregates import type_of_aggregate
from rapidsim.analysis.types.calls import check_unbound, type_of_call
from rapidsim.analysis.types.data_paths import type_of_path
from rapidsim.analysis.types.error_numbers import check_error_number
from rapidsim.analysis.types.operators import (
    EQUALITY,
    LOGICAL,
    ORDERING,
    binary_result,
    has_value,
    is_literal_number,
    likely_fix,
    unary_result,
    value_type,
)
from rapidsim.analysis.types.type_violations import NoValue, NumberOutOfRange, WrongOperands
from rapidsim.language import types
from rapidsim.language.single_precision import LARGEST_SINGLE
from rapidsim.language.types import Type, resolved
from rapidsim.syntax import tree

_LARGEST_DOUBLE = 1.7976931348623157e308


def type_of_expression(
    node: tree.Expression, context: Context, wanted: ExpectedType | None
) -> Type | None:
    """Determine the types of an expression and its subexpressions; see `context.TypeOf`."""
    type_of = context.analysis.type_of
    match node:
        case tree.NumberLiteral():
            return _number(node, context, wanted)
        case tree.StringLiteral():
            type_of[node] = types.STRING
            return types.STRING
        case tree.BoolLiteral():
            type_of[node] = types.BOOL
            return types.BOOL
        case tree.DataReference() | tree.Index() | tree.ComponentAccess():
            found = type_of_path(node, context, type_of_expression)
            if found is None and wanted is not None and isinstance(node, tree.DataReference):
                context.analysis.wanted_of_undeclared[node] = wanted
            return found
        case tree.FunctionCall():
            return type_of_call(node, context, wanted, type_of_expression)
        case tree.Aggregate() | tree.LiteralAggregate():
            return type_of_aggregate(node, context, wanted, type_of_expression)
        case tree.Binary():
            return _binary(node, context, wanted)
        case tree.Unary():
            return _unary(node, context, wanted)
        case tree.Parenthesised(inner=inner):
            found = type_of_expression(inner, context, wanted)
            if inner in type_of:
                type_of[node] = type_of[inner]
            return found
        case tree.LateFunctionCall(routine=routine, arguments=arguments):
            type_of_expression(routine, context, None)
            check_unbound(arguments, context, type_of_expression, is_skipped=False)
            return None
        case tree.Placeholder():
            # An untaught target or a gap: executing it stops the program.
            type_of[node] = types.NUM if wanted is None else wanted.type
            return None


def _number(node: tree.NumberLiteral, context: Context, wanted: ExpectedType | None) -> Type:
    of = types.DNUM if wanted is not None and resolved(wanted.type) == types.DNUM else types.NUM
    if not abs(node.value) <= (LARGEST_SINGLE if of is types.NUM else _LARGEST_DOUBLE):
        context.report(NumberOutOfRange(node.text, of.name), node)
    context.analysis.type_of[node] = of
    return of


def _unary(node: tree.Unary, context: Context, wanted: ExpectedType | None) -> Type | None:
    is_not = node.operator == "NOT"
    found = type_of_expression(node.operand, context, None if is_not else wanted)
    if found is None:
        guess = types.BOOL if is_not else context.analysis.type_of.get(node.operand, types.NUM)
        context.analysis.type_of[node] = guess
        return types.BOOL if is_not else None
    result = unary_result(node.operator, found)
    if result is None:
        operator = "NOT" if is_not else f"the sign `{node.operator}`"
        cure = "compare the number first, as in `NOT x=1`" if is_not else ""
        context.report(WrongOperands(operator, found.name, cure), node)
        return None
    context.analysis.type_of[node] = result
    return result


def _binary(node: tree.Binary, context: Context, wanted: ExpectedType | None) -> Type | None:
    # The expected type of an arithmetic expression applies to its literals.
    is_dnum = wanted is not None and resolved(wanted.type) == types.DNUM
    hint = wanted if is_dnum and node.operator in ARITHMETIC else None
    if _waits_for_other(node.left):
        right = type_of_expression(node.right, context, hint)
        left = _operand(node.left, node.right, right, hint, context)
    else:
        left = type_of_expression(node.left, context, hint)
        right = _operand(node.right, node.left, left, hint, context)
    if node.operator in EQUALITY:
        check_error_number(node.left, node.right, context)
        check_error_number(node.right, node.left, context)
    return _result(node, left, right, context)


def _operand(
    node: tree.Expression,
    opposite: tree.Expression,
    other: Type | None,
    hint: ExpectedType | None,
    context: Context,
) -> Type | None:
    """Type of an operand; a literal takes the type of the opposite value."""
    is_aggregate = isinstance(node, tree.Aggregate | tree.LiteralAggregate)
    if other is None and is_aggregate and not _waits_for_other(opposite):
        # The other operand is invalid or unknown, already reported.
        context.analysis.runs = False
        return None
    if other is None or not _waits_for_other(node):
        return type_of_expression(node, context, hint)
    target = value_type(other)
    if is_aggregate:
        return type_of_expression(node, context, ExpectedType(target, "the other side"))
    return type_of_expression(
        node, context, ExpectedType(target, "") if target == types.DNUM else None
    )


def _result(
    node: tree.Binary, left: Type | None, right: Type | None, context: Context
) -> Type | None:
    """Type of an operation whose operands are typed."""
    operator = node.operator
    type_of = context.analysis.type_of
    if left is None or right is None:
        known = left if left is not None else right
        unknown = node.left if left is None else node.right
        if known is not None and isinstance(unknown, tree.FunctionCall):
            # An unknown function is assumed to return the type of the other operand.
            type_of[unknown] = value_type(known)
        if operator in LOGICAL or operator in ORDERING or operator in EQUALITY:
            type_of[node] = types.BOOL
            return types.BOOL
        type_of[node] = types.NUM if known is None else value_type(known)
        return None
    result = binary_result(operator, left, right)
    if result is None and {left, right} == {types.NUM, types.DNUM}:
        # Literals were assumed to be num before the dnum operand was known.
        literal = node.left if left == types.NUM else node.right
        if is_literal_number(literal):
            type_of_expression(literal, context, ExpectedType(types.DNUM, ""))
            result = binary_result(operator, types.DNUM, types.DNUM)
    if result is None:
        _report_operands(node, left, right, context)
        return types.BOOL if operator in LOGICAL | ORDERING | EQUALITY else None
    type_of[node] = result
    return result


def _report_operands(node: tree.Binary, left: Type, right: Type, context: Context) -> None:
    operator = node.operator
    for side, of in ((node.left, left), (node.right, right)):
        if not has_value(of):
            context.report(NoValue(of.name, "compared" if operator in EQUALITY else "used"), side)
            return
    written = operator if operator.isalpha() else f"`{operator}`"
    operands = f"{left.name} and {right.name}"
    cure = likely_fix(operator, left, right)
    place = tree.Node(node.operator_start, node.operator_start + len(operator))
    context.report(WrongOperands(written, operands, cure), place)


def _waits_for_other(node: tree.Expression) -> bool:
    """Whether the type of an operand depends on the other one."""
    match node:
        case tree.NumberLiteral() | tree.Aggregate() | tree.LiteralAggregate():
            return True
        case tree.Parenthesised(inner=inner) | tree.Unary(operator="-" | "+", operand=inner):
            return _waits_for_other(inner)
        case _:
            return False
