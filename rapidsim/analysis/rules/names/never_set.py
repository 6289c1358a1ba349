"""Rule F412: variables that are read but never assigned a value."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program import DataSymbol, Scope, Storage, Symbol
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.changed_data import changed_in
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.language import types
from rapidsim.language.types import ArrayOf, Record, resolved
from rapidsim.library.predefined import TYPES
from rapidsim.syntax import tree

_WITHOUT_START = (types.NUM, types.DNUM, types.STRING, types.BOOL, TYPES["triggdata"])
"""Types in addition to records whose data have no meaning before they are assigned."""


class ReadBeforeSet(Violation, code="F412"):
    data: str


def find_never_set(facts: Facts) -> Iterator[Diagnostic]:
    """Report the first use of each number, string or record variable that nothing sets."""
    if not facts.is_read:
        return
    done = set[Symbol]().union(*(changed for _, changed in facts.in_parts(changed_in)))
    for _, uses in facts.in_parts(_first_uses):
        for symbol, finding in uses:
            if symbol in done:
                continue
            if symbol.name.lower() in facts.strings or not _all_is_seen(symbol, facts):
                continue
            done.add(symbol)
            yield finding


def _first_uses(part: ProgramPart, facts: Facts) -> list[tuple[DataSymbol, Diagnostic]]:
    """Variables without an initial value, with the finding at their first use in a part."""
    copied = {one.value for one in part.all(tree.Assignment)}
    found: dict[DataSymbol, Diagnostic] = {}
    for node in part.all(tree.DataReference):
        symbol = facts.symbol(node)
        if not isinstance(symbol, DataSymbol) or symbol in found:
            continue
        declared = symbol.node
        if declared is None or declared.value is not None or not _has_value(symbol):
            continue
        if node in copied and _clears(symbol):
            continue
        related = part.place(declared.name, "declared without a value here")
        is_same_module = symbol.module is None or symbol.module is part.module
        places = (related,) if is_same_module else ()
        found[symbol] = part.finding(ReadBeforeSet(symbol.name), node, *places)
    return list(found.items())


def _has_value(symbol: DataSymbol) -> bool:
    """Whether data are a variable of a type that needs an assigned value."""
    if symbol.storage is not Storage.VAR:
        return False
    of = resolved(symbol.type)
    if isinstance(of, ArrayOf):
        of = resolved(of.element)
    return isinstance(of, Record) or of in _WITHOUT_START


def _clears(symbol: DataSymbol) -> bool:
    """Whether copying unset data serves to clear others, as with arrays and strings."""
    of = resolved(symbol.type)
    if isinstance(of, ArrayOf):
        of = resolved(of.element)
        return of in _WITHOUT_START
    return of == types.STRING


def _all_is_seen(symbol: DataSymbol, facts: Facts) -> bool:
    """Whether all code that could set the data is available."""
    assert symbol.node is not None
    is_outside = symbol.module is not None and symbol.scope is not Scope.ROUTINE
    return not is_outside or symbol.node.scope == "LOCAL" or facts.is_whole
