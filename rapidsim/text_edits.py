"""Edits of a text: spans and the text that replaces them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeAlias

TextEdit: TypeAlias = tuple[int, int, str]
"""Start and end of the replaced span, in characters, and the new text."""


def edited_text(text: str, edits: Iterable[TextEdit]) -> str:
    """Return a text after replacing spans that do not overlap."""
    pieces: list[str] = []
    end_before = 0
    for start, end, new in sorted(edits):
        pieces += (text[end_before:start], new)
        end_before = end
    return "".join((*pieces, text[end_before:]))
