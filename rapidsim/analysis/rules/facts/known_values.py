"""Values that are known before a program runs: literals, constants, persistents as stored.

A record or an array is a tuple, and names resolve as in analysis. A persistent counts with the
value in the text, which the program starts with.
"""

from __future__ import annotations

from rapidsim.analysis.program import DataSymbol, Storage
from rapidsim.analysis.program_parts import Facts
from rapidsim.analysis.types.constant_folding import Value, evaluated
from rapidsim.syntax import tree

_DEEPEST = 32


def known_value(
    expression: tree.Expression | None, facts: Facts, *, persistents: bool = True, depth: int = 0
) -> Value | None:
    """The value of an expression.

    Args:
        expression: Of any type.
        facts: The task.
        persistents: Whether a PERS counts as known.
        depth: How many names have been followed; circular definitions have no value.

    Returns:
        None if the value varies, is not known, or was never given in the declaration.
    """

    def read(reference: tree.DataReference) -> Value | None:
        return _of_symbol(facts.symbol(reference), facts, persistents, depth)

    return evaluated(expression, read)


def numbers(value: object, count: int) -> tuple[float, ...] | None:
    """A value as a tuple of the given number of numbers; None if it is something else."""
    if not isinstance(value, tuple) or len(value) != count:
        return None
    if not all(isinstance(part, float) for part in value):
        return None
    return value


def _of_symbol(symbol: object, facts: Facts, persistents: bool, depth: int) -> Value | None:
    if not isinstance(symbol, DataSymbol) or depth > _DEEPEST:
        return None
    if symbol.storage is not Storage.CONST and not (persistents and symbol.storage is Storage.PERS):
        return None
    if symbol.node is None:
        return symbol.value  # type: ignore[return-value]
    return known_value(symbol.node.value, facts, persistents=persistents, depth=depth + 1)
