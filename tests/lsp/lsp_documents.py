"""Documents of a session in this process, with a mark where the pointer is."""

from __future__ import annotations

from typing import Any

from lsprotocol import types as lsp

from rapidsim.lsp.editor_session import EditorSession, OpenDocument
from rapidsim.lsp.positions import Encoding, LineTable
from rapidsim.lsp.requests import REQUESTS

URI = "untitled:m.mod"
HERE = lsp.TextDocumentIdentifier(URI)
MARK = "^"


def opened(marked: str, encoding: Encoding = Encoding.UTF16) -> tuple[OpenDocument, lsp.Position]:
    """An open document, and the position of the mark; the end of the text without one."""
    before, _, after = marked.partition(MARK)
    text = before + after
    session = EditorSession(encoding)
    session.open(URI, text)
    found = session.find(URI)
    assert found is not None
    return found, LineTable(text, encoding).position(len(before))


def kind_of_parameters(method: str) -> Any:
    """The class of the parameters of a method."""
    return lsp.METHOD_TO_TYPES[method][2]


def ask(method: str, of: OpenDocument, **parameters: object) -> Any:
    """Ask for a method of the table, with parameters as the protocol has them."""
    return REQUESTS[method].answer(of, kind_of_parameters(method)(text_document=HERE, **parameters))


def at(method: str, marked: str, **others: object) -> Any:
    """Ask for a method at the mark of a text."""
    document, position = opened(marked)
    return ask(method, document, position=position, **others)


def texts_of(document: OpenDocument, ranges: list[lsp.Range]) -> list[str]:
    """The texts of ranges of a document."""
    table, text = document.document.lines, document.document.text
    return [text[table.offset(one.start) : table.offset(one.end)] for one in ranges]


def line_texts(document: OpenDocument, ranges: list[lsp.Range]) -> list[str]:
    """The lines in which ranges begin."""
    lines = document.document.text.split("\n")
    return [lines[one.start.line].strip() for one in ranges]


def applied(text: str, edits: list[lsp.TextEdit], encoding: Encoding = Encoding.UTF16) -> str:
    """A text after edits that refer to it."""
    table = LineTable(text, encoding)
    spans = sorted(
        (table.offset(one.range.start), table.offset(one.range.end), one.new_text) for one in edits
    )
    for start, end, new in reversed(spans):
        text = text[:start] + new + text[end:]
    return text
