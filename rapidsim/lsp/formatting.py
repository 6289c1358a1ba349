"""Layout of a document, a range, or the line that was just typed."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from lsprotocol import types as lsp

from rapidsim.lsp.view import Document
from rapidsim.syntax.formatting import DEFAULT_STYLE, formatting_edits
from rapidsim.text_edits import TextEdit

TRIGGERS = ("\n", ";")
"""Characters after which a client asks for the layout of the line."""
_ROUTINE = re.compile(r"[ \t]*(?:LOCAL[ \t]+)?(?:PROC|FUNC|TRAP|RECORD)\b", re.IGNORECASE)
_HEAD = "MODULE m\n"


def format_document(document: Document) -> list[lsp.TextEdit]:
    """Return the edits that lay out a document, errors or not."""
    return _as_client(document, formatting_edits(document.text, DEFAULT_STYLE))


def format_range(document: Document, range_: lsp.Range) -> list[lsp.TextEdit]:
    """Return the edits that lay out the lines of a range."""
    start = document.lines.starts[min(range_.start.line, len(document.lines.starts) - 1)]
    end = document.offset(range_.end)
    edits = _edits_up_to(document, start, end)
    return _as_client(document, (one for one in edits if start <= one[0] and one[1] <= end))


def format_on_type(document: Document, position: lsp.Position) -> list[lsp.TextEdit]:
    """Return the edits that lay out the line of a position and the one above it.

    The blanks before the cursor stay as they are typed.
    """
    lines = document.lines
    line = min(position.line, len(lines.starts) - 1)
    first = lines.starts[max(0, line - 1)]
    edits = _edits_up_to(document, first, lines.line_end(line))
    cursor = document.offset(position)
    return _as_client(
        document,
        (one for one in edits if one[0] >= first and not one[0] < cursor == one[1]),
    )


def _edits_up_to(document: Document, first: int, end: int) -> Iterator[TextEdit]:
    """Yield the edits of the text before an end, from the head of the routine around an offset.

    A head of a module stands in for the text before it, so that the levels are right.
    """
    text, lines = document.text, document.lines
    # The routine is searched upwards, line by line, as it is near.
    line = lines.position(first).line
    while line > 0 and not _ROUTINE.match(text, lines.starts[line]):
        line -= 1
    begin, head = lines.starts[line], _HEAD if line else ""
    shift = begin - len(head)
    for start, stop, new in formatting_edits(head + text[begin:end], DEFAULT_STYLE):
        if start >= len(head):
            yield start + shift, stop + shift, new


def _as_client(document: Document, edits: Iterable[TextEdit]) -> list[lsp.TextEdit]:
    return [lsp.TextEdit(document.range(start, end), new) for start, end, new in edits]
