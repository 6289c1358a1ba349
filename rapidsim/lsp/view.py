"""A workspace as an editor sees it: documents by URI, places by line and column."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property

from lsprotocol.types import Location, Position, Range, TextEdit, WorkspaceEdit

from rapidsim.analysis.occurrences.locate import name_at
from rapidsim.analysis.occurrences.names import NamesOfNodes, Occurrence
from rapidsim.diagnostics import Span
from rapidsim.lsp.positions import Encoding, LineTable
from rapidsim.lsp.uris import Uris
from rapidsim.syntax import tree
from rapidsim.workspace.workspace import Workspace


class View:
    """A workspace with the encoding and the URIs of a client."""

    def __init__(
        self, workspace: Workspace, uris: Uris | None = None, encoding: Encoding = Encoding.UTF16
    ) -> None:
        """Take the parts; without URIs, those of the paths."""
        self.workspace = workspace
        self.uris = uris or Uris()
        self.encoding = encoding
        self._tables: dict[str, LineTable] = {}

    def document(self, path: str) -> Document:
        """Return one text.

        Raises:
            KeyError: If the workspace has no such file.
        """
        return Document(self, path)

    def lines(self, path: str) -> LineTable:
        """Return the lines of a text.

        Raises:
            KeyError: If the workspace has no such file.
        """
        text = self.workspace.text(path)
        table = self._tables.get(path)
        if table is None or table.text is not text:
            table = self._tables[path] = LineTable(text, self.encoding)
        return table

    def location(self, span: Span) -> Location:
        """Return a span of a text as a location."""
        return Location(self.uris.uri(span.file), self.span_range(span))

    def span_range(self, span: Span) -> Range:
        """Return the range of a span in its file."""
        span = span.written
        text = span.source.text
        table = self._tables.get(span.file)
        if table is None or table.text is not text:
            table = self._tables[span.file] = LineTable(text, self.encoding)
        return table.range(span.start, span.end)

    def workspace_edit(self, edits: Mapping[str, list[TextEdit]]) -> WorkspaceEdit:
        """Return edits by path as those of a client."""
        return WorkspaceEdit(changes={self.uris.uri(path): of for path, of in edits.items()})


class Document:
    """One text of a view, for one request: its tree and lines are read once."""

    def __init__(self, view: View, path: str) -> None:
        """Take a path of the workspace."""
        self.view = view
        self.path = path

    @property
    def uri(self) -> str:
        """URI of the client."""
        return self.view.uris.uri(self.path)

    @cached_property
    def text(self) -> str:
        """The present text."""
        return self.view.workspace.text(self.path)

    @cached_property
    def lines(self) -> LineTable:
        """Lines of the text."""
        return self.view.lines(self.path)

    @cached_property
    def file(self) -> tree.File:
        """Tree of the text."""
        return self.view.workspace.file(self.path)

    @property
    def names(self) -> NamesOfNodes:
        """Names of the task of the file."""
        return NamesOfNodes(self.view.workspace.facts(self.path))

    def offset(self, position: Position) -> int:
        """Offset of a position."""
        return self.lines.offset(position)

    def address(self, position: Position) -> int:
        """Place in the tree of a position."""
        return self.file.source.address(self.lines.offset(position))

    def range(self, start: int, end: int) -> Range:
        """Range of a part of the text."""
        return self.lines.range(start, end)

    def name_at(self, position: Position, names: NamesOfNodes | None = None) -> Occurrence | None:
        """Return the name at a position; None without one."""
        return name_at(self.file, self.address(position), names or self.names)

    def node_range(self, node: tree.Node) -> Range:
        """Range of a node of this file."""
        return self.range(*self.offsets(node))

    def offsets(self, node: tree.Node) -> tuple[int, int]:
        """Offsets of a node of this file."""
        return self.file.source.offsets(node.start, node.end)


def spans_by_file(spans: Iterator[Span] | tuple[Span, ...]) -> dict[str, list[Span]]:
    """Return spans grouped by file, in order."""
    found: dict[str, list[Span]] = {}
    for span in spans:
        found.setdefault(span.file, []).append(span)
    return found
