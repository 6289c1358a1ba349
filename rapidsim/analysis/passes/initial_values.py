"""Initial values of data: their types, and whether they are known before the program runs."""

from __future__ import annotations

from collections.abc import Iterable

from rapidsim.analysis.context import Context
from rapidsim.analysis.names.declaration_violations import (
    CircularDefinition,
    MissingInitialValue,
    NotConstant,
)
from rapidsim.analysis.names.names import find, kind_of
from rapidsim.analysis.names.user_types import literal_value
from rapidsim.analysis.parameters import ExpectedType
from rapidsim.analysis.program import DataSymbol, Storage, Symbol
from rapidsim.analysis.tree_walk import descendants
from rapidsim.analysis.types.assignability import require, require_value
from rapidsim.analysis.types.expressions import type_of_expression
from rapidsim.language import types
from rapidsim.language.types import ArrayOf, Kind, resolved
from rapidsim.syntax import tree


def check_initial_value(symbol: DataSymbol, context: Context) -> None:
    """Check the initial value of one declaration, and the expressions of its array sizes."""
    node = symbol.node
    assert node is not None
    if isinstance(symbol.type, ArrayOf):
        wanted_size = ExpectedType(types.NUM, f"the size of `{symbol.name}`")
        for dimension, size in zip(node.dimensions, symbol.type.dimensions, strict=True):
            if size is not None:
                require(dimension, wanted_size, context, type_of_expression)
    if node.value is None:
        if symbol.storage is Storage.CONST and not node.equals_sign:
            context.report(MissingInitialValue(symbol.name), node.name)
        return
    of = symbol.type
    if resolved(of) in types.SIGNALS:
        of = types.Atomic(of.name, Kind.NON_VALUE)
    if not require_value(node.value, of, "given at the declaration", context):
        return
    wanted = ExpectedType(of, f"`{symbol.name}`")
    require(node.value, wanted, context, type_of_expression)
    if literal_value(node.value) is not None:
        return
    if symbol.storage is Storage.PERS:
        _check_literal(symbol, node.value, context)
    else:
        _check_constant(symbol, node.value, context)


def check_circles(symbols: Iterable[tuple[DataSymbol, Context]]) -> None:
    """Report constants with circular definitions."""
    homes = {symbol: context for symbol, context in symbols if symbol.storage is Storage.CONST}
    finished: set[DataSymbol] = set()
    for start in homes:
        path: list[DataSymbol] = []
        pending: list[tuple[DataSymbol, bool]] = [(start, False)]
        while pending:
            symbol, is_left = pending.pop()
            if is_left:
                path.pop()
                finished.add(symbol)
            elif symbol in path:
                _report_circle([*path[path.index(symbol) :], symbol], homes[symbol])
            elif symbol not in finished:
                path.append(symbol)
                pending.append((symbol, True))
                pending += [(used, False) for used in _constants_in(symbol, homes[symbol], homes)]


def _constants_in(
    symbol: DataSymbol, context: Context, constants: Iterable[DataSymbol]
) -> list[DataSymbol]:
    node = symbol.node
    if node is None or node.value is None:
        return []
    used: list[DataSymbol] = []
    for part in descendants(node.value):
        if isinstance(part, tree.DataReference):
            found = context.analysis.symbol_of.get(part)
            if isinstance(found, DataSymbol) and found in constants:
                used.append(found)
    return used


def _report_circle(circle: list[DataSymbol], context: Context) -> None:
    first = circle[0]
    assert first.node is not None
    names = " -> ".join(symbol.name for symbol in circle)
    context.report(CircularDefinition(first.name, names), first.node.name)


def _check_literal(symbol: DataSymbol, value: tree.Expression, context: Context) -> None:
    for part in descendants(value):
        match part:
            case (
                tree.NumberLiteral()
                | tree.StringLiteral()
                | tree.BoolLiteral()
                | tree.LiteralAggregate()
            ):
                pass
            case tree.Aggregate() | tree.Unary(operator="-" | "+") | tree.Placeholder():
                pass
            case _:
                found = _literal_problem(part, context)
                context.report(NotConstant(symbol.name, "a literal", found), part)
                return


def _literal_problem(part: tree.Node, context: Context) -> str:
    written = context.module.span(part).one_line
    match part:
        case tree.DataReference(name=name):
            symbol = find(name.key, context)
            return f"`{written}` is {_kind(symbol)}"
        case tree.FunctionCall(name=name):
            return f"`{name.text}` is a function"
        case _:
            return f"`{written}` is computed"


def _check_constant(symbol: DataSymbol, value: tree.Expression, context: Context) -> None:
    for part in descendants(value):
        match part:
            case tree.FunctionCall(name=name):
                violation = NotConstant(symbol.name, "constant", f"`{name.text}` is a function")
                context.report(violation, part)
                return
            case tree.DataReference(name=name):
                used = find(name.key, context)
                if isinstance(used, DataSymbol) and used.storage is Storage.CONST:
                    continue
                if used is None:
                    continue
                found = f"`{name.text}` is {_kind(used)}"
                violation = NotConstant(symbol.name, "constant", found)
                context.report(violation, part, *context.declaration(used))
                return
            case _:
                pass


def _kind(symbol: Symbol | None) -> str:
    return "not declared" if symbol is None else kind_of(symbol)
