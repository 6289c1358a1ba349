"""Semantic tokens of a document: whole, of a range, or as a difference from the last answer.

A text is encoded in pieces, one for each item of a module and one for what is between items, which
are used again until they change.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lsprotocol.types import SemanticTokensEdit

from rapidsim.lsp.token_pieces import OuterKinds, TokenPiece, encode_piece
from rapidsim.lsp.view import Document
from rapidsim.syntax import tree


class SemanticTokenEncoder:
    """Codes of the pieces of texts, kept until they change."""

    def __init__(self) -> None:
        """Know none."""
        self._pieces: dict[str, dict[tuple[bool, str], TokenPiece]] = {}
        self._answers: dict[str, tuple[str, list[int]]] = {}
        self._count = 0

    def full(self, document: Document) -> tuple[str, list[int]]:
        """Return the identifier of an answer, and the code of a whole document."""
        data = self._encoded(document, 0, len(document.text))
        self._count += 1
        answer = (str(self._count), data)
        self._answers[document.path] = answer
        return answer

    def delta(
        self, document: Document, previous: str
    ) -> tuple[str, list[SemanticTokensEdit] | list[int]]:
        """Return the edits from a previous answer, or the whole code if it is not known."""
        known = self._answers.get(document.path)
        identifier, data = self.full(document)
        if known is None or known[0] != previous:
            return identifier, data
        return identifier, difference(known[1], data)

    def range(self, document: Document, start: int, end: int) -> list[int]:
        """Return the code of the pieces that touch a range of offsets."""
        return self._encoded(document, start, end)

    def close(self, path: str) -> None:
        """Forget a document."""
        self._pieces.pop(path, None)
        self._answers.pop(path, None)

    def _encoded(self, document: Document, start: int, end: int) -> list[int]:
        names, text = document.names, document.text
        before = self._pieces.get(document.path, {})
        kept: dict[tuple[bool, str], TokenPiece] = {}
        outer = OuterKinds(names)
        data: list[int] = []
        line, column = 0, 0
        lines = document.lines
        for first, last, module, item in _parts(document.file):
            if last < start or first > end:
                continue
            part = text[first:last]
            key = (item is None, part)
            piece = kept.get(key) or before.get(key)
            if piece is None or not outer.are_valid(piece, module):
                piece = encode_piece(part, first, module, item, names, lines.encoding)
            kept[key] = piece
            if not piece.data:
                continue
            origin = lines.position(first)
            # The first token of a piece is relative to the piece, in the answer to the last token.
            to_line, to_column = origin.line + piece.data[0], piece.data[1]
            if piece.data[0] == 0:
                to_column += origin.character
            step = to_line - line
            data += (step, to_column - column if step == 0 else to_column)
            data += piece.data[2:]
            line = origin.line + piece.last_token[0]
            column = piece.last_token[1]
            if piece.last_token[0] == 0:
                column += origin.character
        if start == 0 and end >= len(text):
            self._pieces[document.path] = kept
        else:
            self._pieces.setdefault(document.path, {}).update(kept)
        return data


def difference(before: Sequence[int], after: Sequence[int]) -> list[SemanticTokensEdit]:
    """Return the edit that makes one code of another; empty if they are equal."""
    most = min(len(before), len(after))
    same_at_start = _equal_up_to(before, after, most, from_end=False)
    same_at_end = _equal_up_to(before, after, most - same_at_start, from_end=True)
    removed = len(before) - same_at_start - same_at_end
    added = list(after[same_at_start : len(after) - same_at_end])
    if not removed and not added:
        return []
    return [SemanticTokensEdit(same_at_start, removed, added)]


def _equal_up_to(before: Sequence[int], after: Sequence[int], most: int, *, from_end: bool) -> int:
    """Number of equal values at one end, found by halving."""
    low, high = 0, most
    while low < high:
        middle = (low + high + 1) // 2
        if from_end:
            is_equal = before[len(before) - middle :] == after[len(after) - middle :]
        else:
            is_equal = before[:middle] == after[:middle]
        low, high = (middle, high) if is_equal else (low, middle - 1)
    return low


def _parts(
    file: tree.File,
) -> Iterator[tuple[int, int, tree.Module | None, tree.Node | None]]:
    """Yield the parts of a text in order, without gaps: items, and what is between them."""
    at, source = 0, file.source
    end = len(source.written.text)
    for module in file.modules:
        for item in module.items:
            start, stop = source.offsets(item.start, item.end)
            if start < at or stop <= start:
                continue
            if start > at:
                yield at, start, module, None
            yield start, stop, module, item
            at = stop
    if at < end:
        yield at, end, file.modules[-1] if file.modules else None, None
