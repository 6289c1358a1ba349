"""Layout of a document, a range, or the line that was just typed."""

from __future__ import annotations

import re
from collections.abc import Iterable

from lsprotocol import types as lsp

from rapidsim.lsp.view import Document
from rapidsim.syntax.formatting import DEFAULT_STYLE, formatting_edits
from rapidsim.text_edits import TextEdit

TRIGGERS = ("\n", ";")
"""Characters after which a client asks for the layout of the line."""
_ROUTINE = re.compile(
    r"^[ \t]*(?:LOCAL[ \t]+)?(?:PROC|FUNC|TRAP|RECORD)\b", re.IGNORECASE | re.MULTILINE
)
_HEAD = "MODULE m\n"


def format_document(document: Document) -> list[lsp.TextEdit]:
    """Return the edits that lay out a document, errors or not."""
    return _as_client(document, formatting_edits(document.text, DEFAULT_STYLE))


def format_range(document: Document, range_: lsp.Range) -> list[lsp.TextEdit]:
    """Return the edits that lay out the lines of a range."""
    start = document.lines.starts[min(range_.start.line, len(document.lines.starts) - 1)]
    end = document.offset(range_.end)
    edits = formatting_edits(document.text, DEFAULT_STYLE)
    return _as_client(document, (one for one in edits if start <= one[0] and one[1] <= end))


def format_on_type(document: Document, position: lsp.Position) -> list[lsp.TextEdit]:
    """Return the edits that lay out the line of a position and the one above it.

    Only the text from the beginning of the routine is read.
    """
    lines, text = document.lines, document.text
    line = min(position.line, len(lines.starts) - 1)
    first = lines.starts[max(0, line - 1)]
    end = lines.line_end(line)
    begin = max((one.start() for one in _ROUTINE.finditer(text, 0, end)), default=None)
    head = "" if begin is None else _HEAD
    begin = begin or 0
    shift = begin - len(head)
    edits = formatting_edits(head + text[begin:end], DEFAULT_STYLE)
    moved = ((start + shift, stop + shift, new) for start, stop, new in edits)
    cursor = document.offset(position)
    # The blanks before the cursor are kept as they are typed; so is the word.
    return _as_client(
        document,
        (one for one in moved if one[0] >= first and not one[0] < cursor == one[1]),
    )


def _as_client(document: Document, edits: Iterable[TextEdit]) -> list[lsp.TextEdit]:
    return [lsp.TextEdit(document.range(start, end), new) for start, end, new in edits]
