"""From a name to its declaration, its type, its uses."""

from __future__ import annotations

import re

from lsprotocol import types as lsp

from rapidsim.analysis.occurrences.names import NamesOfNodes, declared_name
from rapidsim.analysis.occurrences.search import occurrences
from rapidsim.analysis.occurrences.symbols import (
    ComponentSymbol,
    InstalledTypeSymbol,
    NamedSymbol,
)
from rapidsim.analysis.program import (
    DataSymbol,
    ParameterSymbol,
    RoutineSymbol,
    TypeSymbol,
)
from rapidsim.language.types import ArrayOf, Type
from rapidsim.lsp.view import Document

_ASSIGNED = re.compile(r"(?:\s*\{[^{}]*\}|\s*\.\s*\w+)*\s*:=")


def definition(document: Document, position: lsp.Position) -> list[lsp.Location]:
    """Return where the name at a position is declared; empty for predefined names."""
    names = document.names
    found = document.name_at(position, names)
    return [] if found is None else _declared_at(document, found.symbol, names)


def type_definition(document: Document, position: lsp.Position) -> list[lsp.Location]:
    """Return where the type of the data at a position is declared; empty for predefined types."""
    names = document.names
    found = document.name_at(position, names)
    if found is None:
        return []
    of = _type_of(found.symbol)
    element = of.element if isinstance(of, ArrayOf) else of
    return [] if element is None else _declared_at(document, names.symbol_of_type(element), names)


def references(
    document: Document, position: lsp.Position, *, with_declaration: bool
) -> list[lsp.Location]:
    """Return all uses of the name at a position in its task."""
    names = document.names
    found = document.name_at(position, names)
    if found is None or found.symbol is None:
        return []
    view = document.view
    return [
        view.location(one.module.span(one.name))
        for one in occurrences(found.symbol, names)
        if with_declaration or not one.is_declaration
    ]


def document_highlights(document: Document, position: lsp.Position) -> list[lsp.DocumentHighlight]:
    """Return the uses of the name at a position in its file, writing ones apart."""
    names = document.names
    found = document.name_at(position, names)
    if found is None or found.symbol is None:
        return []
    return [
        lsp.DocumentHighlight(
            document.node_range(one.name),
            lsp.DocumentHighlightKind.Write
            if one.is_declaration or _is_assigned(document.text, *document.offsets(one.name))
            else lsp.DocumentHighlightKind.Read,
        )
        for one in occurrences(found.symbol, names, (document.file,))
    ]


def _declared_at(
    document: Document, symbol: NamedSymbol | None, names: NamesOfNodes
) -> list[lsp.Location]:
    declared = None if symbol is None else declared_name(symbol, names.facts)
    if declared is None:
        return []
    module, name = declared
    return [document.view.location(module.span(name))]


def _type_of(symbol: NamedSymbol | None) -> Type | None:
    match symbol:
        case DataSymbol(type=of) | ParameterSymbol(type=of) | TypeSymbol(type=of):
            return of
        case RoutineSymbol(result=result):
            return result
        case ComponentSymbol(component=component):
            return component.type
        case InstalledTypeSymbol(type=of):
            return of
        case _:
            return None


def _is_assigned(text: str, start: int, end: int) -> bool:
    """Whether a value is assigned to data at a name, to an element or to a component."""
    is_argument = text[max(0, start - 8) : start].rstrip(" \t").endswith("\\")
    return _ASSIGNED.match(text, end) is not None and not is_argument
