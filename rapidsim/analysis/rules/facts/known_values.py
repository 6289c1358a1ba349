"""Values of constants, and of persistents as stored, for rules.

A record or an array is a tuple. A persistent counts with the value in the text, which the program
starts with. No function is called.
"""

from __future__ import annotations

from typing import TypeAlias

from rapidsim.analysis.evaluation import NOT_STATIC, Evaluator, Known, NotStatic
from rapidsim.analysis.program import DataSymbol, Storage
from rapidsim.analysis.program_parts import Facts
from rapidsim.syntax import tree
from rapidsim.values import value_class

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
        None if the value varies, is not known, or was never given in the declaration.
    """
    if expression is None:
        return None
    value = Evaluator(facts.analysis, _Declarations(facts, persistents)).value(expression)
    return None if isinstance(value, NotStatic) else _as_tuples(value)


def numbers(value: object, count: int) -> tuple[float, ...] | None:
    """A value as a tuple of the given number of numbers; None if it is something else."""
    if not isinstance(value, tuple) or len(value) != count:
        return None
    if not all(isinstance(part, float) for part in value):
        return None
    return value


@value_class(frozen=True, slots=True)
class _Declarations:
    """Implements `evaluation.Environment` with the values that data are declared with."""

    facts: Facts
    persistents: bool
    depth: int = 0
    """Names followed so far; circular definitions have no value."""

    def read(self, reference: tree.DataReference) -> Known:
        symbol = self.facts.symbol(reference)
        if not isinstance(symbol, DataSymbol) or self.depth > _DEEPEST:
            return NOT_STATIC
        is_stored = self.persistents and symbol.storage is Storage.PERS
        if symbol.storage is not Storage.CONST and not is_stored:
            return NOT_STATIC
        if symbol.node is None:
            return symbol.value
        if symbol.node.value is None:
            return NOT_STATIC
        inner = _Declarations(self.facts, self.persistents, self.depth + 1)
        return Evaluator(self.facts.analysis, inner).value(symbol.node.value, symbol.type)

    def call(self, call: tree.FunctionCall, evaluator: Evaluator) -> Known:
        return NOT_STATIC


def _as_tuples(value: Known) -> Value | None:
    """A value with tuples for its arrays; None if an element of one is not known."""
    if not isinstance(value, list):
        return value  # type: ignore[no-any-return]
    parts = [_as_tuples(part) for part in value]
    return None if None in parts else tuple(part for part in parts if part is not None)
