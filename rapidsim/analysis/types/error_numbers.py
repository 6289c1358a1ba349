"""Comparisons of ERRNO, which must be with names or with numbers that a program may raise."""

from __future__ import annotations

from rapidsim.analysis.context import Context
from rapidsim.analysis.names.names import find
from rapidsim.analysis.program import DataSymbol
from rapidsim.analysis.types.error_violations import RawErrorNumber
from rapidsim.syntax import tree

_LARGEST_OF_PROGRAMS = 90.0
"""RAISE accepts 1 to 90 without booking."""


def check_error_number(subject: tree.Expression, value: tree.Expression, context: Context) -> None:
    """Report a comparison of ERRNO with a number that it never has."""
    if not (isinstance(subject, tree.DataReference) and subject.name.key == "errno"):
        return
    symbol = find("errno", context)
    is_predefined = isinstance(symbol, DataSymbol) and symbol.node is None
    if (
        is_predefined
        and isinstance(value, tree.NumberLiteral)
        and value.value > _LARGEST_OF_PROGRAMS
    ):
        context.report(RawErrorNumber(value.text), value)
