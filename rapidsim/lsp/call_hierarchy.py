"""Callers and callees of a routine."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from lsprotocol import types as lsp

from rapidsim.analysis.occurrences.names import NamesOfNodes
from rapidsim.analysis.occurrences.search import occurrences
from rapidsim.analysis.program import RoutineSymbol
from rapidsim.analysis.tree_walk import descendants
from rapidsim.lsp.outline import kind_of_item
from rapidsim.lsp.texts import declaration
from rapidsim.lsp.view import Document, View
from rapidsim.syntax import tree


def prepare(document: Document, position: lsp.Position) -> list[lsp.CallHierarchyItem]:
    """Return the routine that is named at a position, or else the one around it."""
    found = document.name_at(position)
    if found is not None and isinstance(found.symbol, RoutineSymbol):
        return [_item(document.view, found.symbol)]
    place, facts = document.address(position), document.view.workspace.facts(document.path)
    for module in document.file.modules:
        for routine in module.routines:
            symbol = facts.analysis.symbol_of.get(routine)
            if routine.start <= place <= routine.end and isinstance(symbol, RoutineSymbol):
                return [_item(document.view, symbol)]
    return []


def incoming_calls(view: View, item: lsp.CallHierarchyItem) -> list[lsp.CallHierarchyIncomingCall]:
    """Return the routines that name a routine, each with the places."""
    symbol, names = _symbol_of(view, item)
    if symbol is None or names is None:
        return []
    callers: dict[RoutineSymbol, list[lsp.Range]] = {}
    for one in occurrences(symbol, names):
        caller = _around(one.module, one.name, names)
        if caller is not None and not one.is_declaration:
            callers.setdefault(caller, []).append(view.span_range(one.module.span(one.name)))
    return [
        lsp.CallHierarchyIncomingCall(_item(view, caller), ranges)
        for caller, ranges in callers.items()
    ]


def outgoing_calls(view: View, item: lsp.CallHierarchyItem) -> list[lsp.CallHierarchyOutgoingCall]:
    """Return the routines of the program that a routine calls, each with the places."""
    symbol, names = _symbol_of(view, item)
    if symbol is None or names is None:
        return []
    callees: dict[RoutineSymbol, list[lsp.Range]] = {}
    for callee, name in _callees(symbol, names):
        span = symbol.module.span(name)
        callees.setdefault(callee, []).append(view.span_range(span))
    return [
        lsp.CallHierarchyOutgoingCall(_item(view, callee), ranges)
        for callee, ranges in callees.items()
    ]


def _callees(
    symbol: RoutineSymbol, names: NamesOfNodes
) -> Iterator[tuple[RoutineSymbol, tree.Name]]:
    for node in descendants(symbol.node):
        callee = names.facts.analysis.symbol_of.get(node)
        if isinstance(callee, RoutineSymbol):
            match node:
                case tree.Call(name=name) | tree.FunctionCall(name=name):
                    yield callee, name
                case tree.Connect(trap=tree.Name() as name):
                    yield callee, name
                case _:
                    pass


def _around(module: tree.Module, name: tree.Name, names: NamesOfNodes) -> RoutineSymbol | None:
    for routine in module.routines:
        if routine.start <= name.start < routine.end:
            symbol = names.facts.analysis.symbol_of.get(routine)
            return symbol if isinstance(symbol, RoutineSymbol) else None
    return None


def _symbol_of(
    view: View, item: lsp.CallHierarchyItem
) -> tuple[RoutineSymbol | None, NamesOfNodes | None]:
    """Return the routine of an item, which may have moved or gone since it was prepared."""
    path = view.uris.path(item.uri)
    if path not in view.workspace.paths:
        return None, None
    names = view.document(path).names
    symbols: Iterable[object] = (
        names.facts.analysis.symbol_of.get(routine)
        for module in view.workspace.file(path).modules
        for routine in module.routines
        if routine.name.text == item.name
    )
    return next((one for one in symbols if isinstance(one, RoutineSymbol)), None), names


def _item(view: View, symbol: RoutineSymbol) -> lsp.CallHierarchyItem:
    module, node = symbol.module, symbol.node
    return lsp.CallHierarchyItem(
        name=symbol.name,
        kind=kind_of_item(node),
        uri=view.uris.uri(module.source.file),
        range=view.span_range(module.span(node)),
        selection_range=view.span_range(module.span(node.name)),
        detail=declaration(symbol),
    )
