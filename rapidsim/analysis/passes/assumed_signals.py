"""Undeclared names that are compared as signals are, and assumed to be signals on request."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.cell_names import ConfiguredSymbol
from rapidsim.analysis.context import Analysis, Context
from rapidsim.analysis.names.names import evident_signal, find
from rapidsim.analysis.program import DataSymbol, ParameterSymbol
from rapidsim.analysis.tree_walk import descendants
from rapidsim.language.types import SIGNALS, resolved
from rapidsim.syntax import tree

_LOGICAL = frozenset({"AND", "OR", "XOR"})
_LEVELS = (0.0, 1.0)
_NAMED_LEVELS = frozenset({"low", "high"})


def compared_signals(analysis: Analysis) -> frozenset[str]:
    """Folded undeclared names that are only compared with 0 and 1, at least once next to a signal.

    Other uses of a name, such as arithmetic or assignment, exclude it.
    """
    uses: dict[str, int] = {}
    contexts: dict[tree.Module, Context] = {}
    for reference, context in analysis.undeclared:
        uses[reference.name.key] = uses.get(reference.name.key, 0) + 1
        contexts.setdefault(context.module, context)
    compared: dict[str, int] = {}
    beside: set[str] = set()
    for context in contexts.values():
        for leaves in _conditions(context.module):
            names = [leaf for leaf in map(_compared_name, leaves) if leaf is not None]
            for name in names:
                compared[name.key] = compared.get(name.key, 0) + 1
            if any(_is_signal(name, context) for name in names):
                beside.update(name.key for name in names)
    return frozenset(
        key for key, count in uses.items() if compared.get(key) == count and key in beside
    )


def _conditions(module: tree.Module) -> Iterator[list[tree.Expression]]:
    """Yield the comparisons of each condition of a module; AND and OR join them in one list."""
    inner: set[int] = set()
    for node in descendants(*module.items):
        if isinstance(node, tree.Binary) and id(node) not in inner:
            yield list(_leaves(node, inner))


def _leaves(node: tree.Expression, inner: set[int]) -> Iterator[tree.Expression]:
    inner.add(id(node))
    match node:
        case tree.Binary(left=left, operator=operator, right=right) if operator in _LOGICAL:
            yield from _leaves(left, inner)
            yield from _leaves(right, inner)
        case tree.Parenthesised(inner=part) | tree.Unary(operator="NOT", operand=part):
            yield from _leaves(part, inner)
        case _:
            yield node


def _compared_name(comparison: tree.Expression) -> tree.Name | None:
    """Name that an expression compares with a level of a digital signal."""
    match comparison:
        case tree.Binary(left=tree.DataReference(name=name), operator="=" | "<>", right=level) if (
            _is_level(level)
        ):
            return name
        case tree.Binary(left=level, operator="=" | "<>", right=tree.DataReference(name=name)) if (
            _is_level(level)
        ):
            return name
        case _:
            return None


def _is_level(value: tree.Expression) -> bool:
    match value:
        case tree.NumberLiteral(value=number):
            return number in _LEVELS
        case tree.DataReference(name=name):
            return name.key in _NAMED_LEVELS
        case _:
            return False


def _is_signal(name: tree.Name, context: Context) -> bool:
    analysis = context.analysis
    symbol = find(name.key, context)
    if symbol is None:
        return name.key in analysis.signals or evident_signal(name, context) is not None
    declared = DataSymbol | ParameterSymbol | ConfiguredSymbol
    return isinstance(symbol, declared) and resolved(symbol.type) in SIGNALS
