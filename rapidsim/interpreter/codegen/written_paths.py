"""Data paths in the source, such as `a{i}.trans.x`."""

from __future__ import annotations

from rapidsim.analysis.program import DataSymbol, ParameterSymbol, Program
from rapidsim.syntax import tree
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class FlatPath:
    """A flattened path: a RAPID path is a name, then indices, then components."""

    reference: tree.DataReference
    indices: tuple[tree.Expression, ...]
    names: tuple[str, ...]


def flat(path: tree.DataPath) -> FlatPath:
    """Flatten a path."""
    indices: tuple[tree.Expression, ...] = ()
    names: list[str] = []
    while not isinstance(path, tree.DataReference):
        if isinstance(path, tree.ComponentAccess):
            names.insert(0, path.name.key)
            path = path.record
        else:
            indices = (*path.indices, *indices)
            path = path.array
    return FlatPath(path, indices, tuple(names))


def bare(expression: tree.Expression) -> tree.Expression:
    """The expression without enclosing parentheses."""
    while isinstance(expression, tree.Parenthesised):
        expression = expression.inner
    return expression


def declaration(path: tree.Expression, program: Program) -> tree.Node | None:
    """The declaration of a path that is a whole variable or parameter."""
    inner = bare(path)
    symbol = program.symbol_of[inner] if isinstance(inner, tree.DataReference) else None
    return symbol.node if isinstance(symbol, DataSymbol | ParameterSymbol) else None
