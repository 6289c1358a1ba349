"""Symbols of a document and of the workspace."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types as lsp

from rapidsim.analysis.program import DataSymbol, RoutineSymbol
from rapidsim.analysis.program_parts import Facts
from rapidsim.analysis.tree_walk import clauses, statements
from rapidsim.lsp.texts import declaration
from rapidsim.lsp.view import Document, View
from rapidsim.syntax import tree

_MOST = 500
"""Maximum number of symbols of the workspace in one answer."""


def document_symbols(document: Document) -> list[lsp.DocumentSymbol]:
    """Return the modules of a document with their types, data and routines."""
    facts = document.view.workspace.facts(document.path)
    return [
        _symbol(
            document,
            module,
            module.name,
            lsp.SymbolKind.Module,
            "",
            [one for item in module.items for one in _of_item(document, item, facts)],
        )
        for module in document.file.modules
    ]


def workspace_symbols(view: View, query: str) -> Iterator[lsp.WorkspaceSymbol]:
    """Yield the declarations outside of routines whose names contain the letters of a query."""
    count, letters = 0, query.lower()
    for path in view.workspace.paths:
        for module in view.workspace.file(path).modules:
            for item in (module, *module.items):
                name = getattr(item, "name", None)
                if not isinstance(name, tree.Name) or not _contains(name.key, letters):
                    continue
                yield lsp.WorkspaceSymbol(
                    location=view.location(module.span(name)),
                    name=name.text,
                    kind=kind_of_item(item),
                    container_name=None if item is module else module.name.text,
                )
                count += 1
                if count == _MOST:
                    return


def kind_of_item(item: tree.Node) -> lsp.SymbolKind:
    """Return the kind of a declaration."""
    match item:
        case tree.Module():
            return lsp.SymbolKind.Module
        case tree.Trap():
            return lsp.SymbolKind.Event
        case tree.RoutineNode():
            return lsp.SymbolKind.Function
        case tree.RecordType():
            return lsp.SymbolKind.Struct
        case tree.AliasType():
            return lsp.SymbolKind.TypeParameter
        case tree.Data(storage="CONST"):
            return lsp.SymbolKind.Constant
        case tree.ComponentDeclaration():
            return lsp.SymbolKind.Field
        case _:
            return lsp.SymbolKind.Variable


def _of_item(document: Document, item: tree.Node, facts: Facts) -> Iterator[lsp.DocumentSymbol]:
    name = getattr(item, "name", None)
    if not isinstance(name, tree.Name):
        return
    inner: list[lsp.DocumentSymbol] = []
    if isinstance(item, tree.RecordType):
        parts = (one for one in item.components if isinstance(one, tree.ComponentDeclaration))
        inner = [
            _symbol(document, one, one.name, lsp.SymbolKind.Field, one.type.text, [])
            for one in parts
        ]
    elif isinstance(item, tree.RoutineNode):
        data = (one for one in statements(*clauses(item)) if isinstance(one, tree.Data))
        inner = [
            _symbol(document, one, one.name, kind_of_item(one), one.type.text, []) for one in data
        ]
    symbol = facts.analysis.symbol_of.get(item)
    detail = ""
    if isinstance(symbol, RoutineSymbol | DataSymbol):
        detail = declaration(symbol)
    yield _symbol(document, item, name, kind_of_item(item), detail, inner)


def _symbol(
    document: Document,
    node: tree.Node,
    name: tree.Name,
    kind: lsp.SymbolKind,
    detail: str,
    children: list[lsp.DocumentSymbol],
) -> lsp.DocumentSymbol:
    # The range must contain that of the name, also where a repair has moved one of them.
    whole = tree.Node(min(node.start, name.start), max(node.end, name.end))
    return lsp.DocumentSymbol(
        name=name.text or "?",
        kind=kind,
        range=document.node_range(whole),
        selection_range=document.node_range(name),
        detail=detail or None,
        children=children or None,
    )


def _contains(key: str, letters: str) -> bool:
    """Whether a name contains letters in their order."""
    place = iter(key)
    return all(letter in place for letter in letters)
