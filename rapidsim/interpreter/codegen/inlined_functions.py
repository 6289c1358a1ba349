"""Functions that are an expression: a character, a number with its decimals, a magnitude, a root.

Loops call these most. Valid arguments are handled inline; for the rest, such as a fractional
position, the function is called, which reports the error.

Source: Technical reference manual RAPID Instructions, Functions and Data types: Abs, NumToStr,
Sqrt, StrPart.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import TypeAlias

from rapidsim.interpreter.codegen.ast_builder import AstBuilder
from rapidsim.interpreter.codegen.expression_code import Code, DeferredCheck, finished, within
from rapidsim.interpreter.codegen.operands import Operands
from rapidsim.library.mathematics import abs_, sqrt
from rapidsim.library.strings import MAX_DECIMALS, num_to_str, str_part
from rapidsim.library.table import LibraryRoutine
from rapidsim.syntax import tree

_Form: TypeAlias = Callable[
    [Sequence[tree.Expression], Operands, ast.expr, AstBuilder], Code | None
]


def function_in_place(
    routine: LibraryRoutine,
    call: tree.FunctionCall,
    expressions: Operands,
    function: ast.Name,
    at: AstBuilder,
) -> Code | None:
    """Translate a call of an installed function to an inline expression; None if impossible."""
    form = _FORMS.get(routine.function)
    values = [
        one.value
        for one in call.arguments
        if isinstance(one, tree.RequiredArgument) and one.name is None
    ]
    if form is None or len(values) != len(call.arguments):
        return None
    expressions.names.module.computing.add(function.id)
    return form(values, expressions, function, at)


def _character(
    values: Sequence[tree.Expression], expressions: Operands, function: ast.expr, at: AstBuilder
) -> Code | None:
    """StrPart of length 1: `text[i - 1] if 0 < i <= _len(text) else strpart(text, i, 1)`."""
    text, place, length = values
    string, position = expressions.value(text), expressions.code(place)
    one = expressions.value(length)
    # Both nodes occur more than once in the code.
    if one.literal != 1.0 or not (_is_plain(string.node) and _is_simple(position.node)):
        return None
    if not position.stays_integer:
        return None
    name = position.node if isinstance(position.node, ast.Name) else at.name("_i")
    first = name if name is position.node else at.named("_i", position.node)
    begins = position.integer is not None and position.integer.low >= 1
    inside = within(first, None if begins else 1, at.call("_len", [string.node]), at)
    found = at.item(string.node, at.operation(name, ast.Sub(), at.constant(1)))
    refused = at.call(function, [string.node, finished(position, at).node, one.node])
    return Code(at.choice(inside, found, refused), may_raise=True)


def _decimals(
    values: Sequence[tree.Expression], expressions: Operands, function: ast.expr, at: AstBuilder
) -> Code | None:
    """NumToStr without its option: no num is too long for a string."""
    del function
    number, decimals = values
    count = expressions.value(decimals).literal
    if count is None or not (count.is_integer() and 0 <= count <= MAX_DECIMALS):
        return None
    value = expressions.value(number)
    node = at.operation(at.constant(f"%.{int(count)}f"), ast.Mod(), value.node)
    return Code(node, may_raise=value.may_raise, calls=value.calls)


def _magnitude(
    values: Sequence[tree.Expression], expressions: Operands, function: ast.expr, at: AstBuilder
) -> Code | None:
    """Abs: a num without its sign is a num."""
    del function
    value = expressions.value(values[0])
    node = at.call("_magnitude", [value.node])
    return Code(node, may_raise=value.may_raise, calls=value.calls)


def _root(
    values: Sequence[tree.Expression], expressions: Operands, function: ast.expr, at: AstBuilder
) -> Code | None:
    """Sqrt: the rounded root of a number from 0 up; else the call, which raises."""
    value = expressions.value(values[0])
    has_root = at.compare(at.constant(0.0), (ast.LtE(), at.named("_x", value.node)))
    root = finished(Code(at.call("_root", [at.name("_x")]), DeferredCheck.SINGLE), at)
    node = at.choice(has_root, root.node, at.call(function, [at.name("_x")]))
    return Code(node, may_raise=True, calls=value.calls)


def _is_plain(node: ast.expr) -> bool:
    return isinstance(node, ast.Name | ast.Constant)


def _is_simple(node: ast.expr) -> bool:
    """Whether a node is at most a sum of two plain operands."""
    if isinstance(node, ast.BinOp):
        return _is_plain(node.left) and _is_plain(node.right)
    return _is_plain(node)


_FORMS: Mapping[Callable[..., object], _Form] = MappingProxyType(
    {abs_: _magnitude, num_to_str: _decimals, sqrt: _root, str_part: _character}
)
"""Translation by the function that it replaces."""
