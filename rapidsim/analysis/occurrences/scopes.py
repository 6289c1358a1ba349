"""Names that can be used at a place: of the routine, its module, the task, the cell."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.occurrences.locate import Location
from rapidsim.analysis.program import Symbol
from rapidsim.analysis.program_parts import Facts
from rapidsim.analysis.tree_walk import children, clauses, statements
from rapidsim.syntax import tree


def symbols_in_scope(location: Location, facts: Facts) -> Iterator[Symbol]:
    """Yield the symbols of the program and its cell that are visible at a place.

    The innermost come first; a name that an inner one hides is omitted. Predefined names are
    omitted as well.
    """
    seen: set[str] = set()
    for symbol in _all_symbols(location, facts):
        key = symbol.name.lower()
        if key not in seen:
            seen.add(key)
            yield symbol


def local_symbols(routine: tree.RoutineNode, facts: Facts) -> Iterator[Symbol]:
    """Yield the parameters and data of a routine, in order of declaration."""
    symbol_of = facts.analysis.symbol_of
    for part in routine.parameters:
        for node in children(part) if isinstance(part, tree.OptionalGroup) else (part,):
            if (symbol := symbol_of.get(node)) is not None:
                yield symbol
    for statement in statements(*clauses(routine)):
        if isinstance(statement, tree.Data):
            symbol = symbol_of.get(statement)
            if symbol is not None:
                yield symbol


def _all_symbols(location: Location, facts: Facts) -> Iterator[Symbol]:
    analysis = facts.analysis
    for node in reversed(location.path):
        if isinstance(node, tree.For) and (counter := analysis.symbol_of.get(node)) is not None:
            yield counter
    if location.routine is not None:
        yield from local_symbols(location.routine, facts)
    home = analysis.home_of.get(location.module)
    if home is not None:
        yield from home.scope.symbols()
    yield from analysis.cell.symbols.values()
    for key in analysis.signals:
        if key in analysis.unknown:
            yield analysis.unknown[key]
