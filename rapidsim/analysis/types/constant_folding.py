"""The numbers among constants that declarations need: the sizes of arrays.

They are needed before references have symbols, so names are looked up in their scopes.
"""

from __future__ import annotations

from rapidsim.analysis.context import Context
from rapidsim.analysis.evaluation import NOT_STATIC, Evaluator, Known
from rapidsim.analysis.installed import installed_symbol
from rapidsim.analysis.program import DataSymbol, Scope, Storage
from rapidsim.language.types import NUM
from rapidsim.syntax import tree


def constant_number(expression: tree.Expression, context: Context) -> float | None:
    """The numeric value of an expression in every run; None if it has none or it varies."""
    value = _value(expression, context, frozenset())
    return value if isinstance(value, float) else None


def _value(expression: tree.Expression, context: Context, seen: frozenset[DataSymbol]) -> Known:
    def read(reference: tree.DataReference) -> Known:
        key = reference.name.key
        symbol = context.scope.find(key) or installed_symbol(key)
        if not isinstance(symbol, DataSymbol) or symbol.storage is not Storage.CONST:
            return NOT_STATIC
        if symbol.node is None:
            return symbol.value
        if symbol.node.value is None or symbol in seen:
            return NOT_STATIC
        home = context
        if symbol.scope is not Scope.ROUTINE:
            home = home.analysis.home_of[home.analysis.module_of[symbol]]
        return _value(symbol.node.value, home, seen | {symbol})

    return Evaluator(context.analysis, read).value(expression, NUM)
