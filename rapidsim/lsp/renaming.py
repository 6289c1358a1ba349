"""Renaming of a symbol in all files of its task."""

from __future__ import annotations

from lsprotocol import types as lsp

from rapidsim.analysis.occurrences.names import NamesOfNodes
from rapidsim.analysis.occurrences.rename import (
    RenameRefusedError,
    plan_rename,
    require_renameable,
)
from rapidsim.analysis.occurrences.symbols import NamedSymbol
from rapidsim.analysis.program import DataSymbol, Scope, Storage
from rapidsim.lsp.view import Document, spans_by_file
from rapidsim.workspace.workspace import Workspace


def prepare_rename(
    document: Document, position: lsp.Position
) -> lsp.PrepareRenamePlaceholder | None:
    """Return the range and text of the name at a position; None without a name.

    Raises:
        RenameRefusedError: If the name cannot be changed.
    """
    found = document.name_at(position)
    if found is None:
        return None
    require_renameable(found.symbol)
    return lsp.PrepareRenamePlaceholder(document.node_range(found.name), found.name.text)


def rename(document: Document, position: lsp.Position, new: str) -> lsp.WorkspaceEdit | None:
    """Return the edits that rename the symbol at a position; None without a name.

    Raises:
        RenameRefusedError: If the name cannot be changed, or the new one would change the program.
    """
    names, view = document.names, document.view
    found = document.name_at(position, names)
    if found is None:
        return None
    renaming = plan_rename(found.symbol, new, names)
    _require_not_shared(found.symbol, document, view.workspace)
    edits = {
        path: [lsp.TextEdit(view.span_range(span), new) for span in spans]
        for path, spans in spans_by_file(renaming.spans).items()
    }
    return view.workspace_edit(edits)


def _require_not_shared(
    symbol: NamedSymbol | None, document: Document, workspace: Workspace
) -> None:
    """Refuse a persistent that another task shares by its name."""
    if not isinstance(symbol, DataSymbol) or symbol.storage is not Storage.PERS:
        return
    if symbol.scope is not Scope.GLOBAL:
        return
    key = symbol.name.lower()
    own = set(_files_of(workspace, document.path))
    for path in workspace.paths:
        if path in own:
            continue
        for home in NamesOfNodes(workspace.facts(path)).facts.analysis.home_of.values():
            other = home.scope.find(key)
            if isinstance(other, DataSymbol) and other.storage is Storage.PERS:
                raise RenameRefusedError(
                    f"another task shares the persistent `{symbol.name}` by its name"
                )


def _files_of(workspace: Workspace, path: str) -> list[str]:
    return [file.name for file in workspace.task_of(path).files]
