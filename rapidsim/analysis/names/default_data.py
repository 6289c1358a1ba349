"""Undeclared tools, work objects and loads, replaced by the system's own on request."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from rapidsim.analysis.context import Context
from rapidsim.analysis.installed import installed_symbol
from rapidsim.analysis.names.name_violations import AssumedData
from rapidsim.language.types import Type
from rapidsim.syntax import tree

OF_SYSTEM: Mapping[str, str] = MappingProxyType(
    {"tooldata": "tool0", "wobjdata": "wobj0", "loaddata": "load0"}
)
"""By type, the data that every controller has."""


def is_assumed(reference: tree.DataReference, of: Type, context: Context) -> bool:
    """Replace an undeclared name by system data; whether that was requested."""
    taken = OF_SYSTEM.get(of.name)
    if taken is None or not context.analysis.cell.assumes:
        return False
    symbol = installed_symbol(taken)
    assert symbol is not None
    context.analysis.symbol_of[reference] = symbol
    context.analysis.type_of[reference] = of
    context.report(AssumedData(reference.name.text, of.name, taken), reference)
    return True
