"""Semantic tokens: kinds of names by their symbols, words, numbers, strings and comments.

A text is encoded in pieces, one for each item of a module and one for what is between items. The
code of a piece is relative to its beginning, so it is used again until the piece itself changes.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from lsprotocol.types import SemanticTokensEdit, SemanticTokensLegend

from rapidsim.analysis.cell_names import ConfiguredSymbol
from rapidsim.analysis.occurrences.locate import names_in
from rapidsim.analysis.occurrences.names import NamesOfNodes
from rapidsim.analysis.occurrences.symbols import (
    ComponentSymbol,
    InstalledParameterSymbol,
    InstalledTypeSymbol,
    LabelSymbol,
    ModuleSymbol,
    NamedSymbol,
)
from rapidsim.analysis.program import (
    CounterSymbol,
    DataSymbol,
    LibrarySymbol,
    ParameterSymbol,
    RoutineSymbol,
    Storage,
    TypeSymbol,
    UnknownSymbol,
)
from rapidsim.language.types import SIGNALS, resolved
from rapidsim.lsp.positions import LineTable
from rapidsim.lsp.view import Document
from rapidsim.syntax import tree
from rapidsim.syntax.lexer import lex
from rapidsim.values import value_class

TYPES = (
    *("namespace", "type", "function", "method", "variable", "parameter", "property", "event"),
    *("label", "keyword", "number", "string", "comment"),
)
MODIFIERS = ("declaration", "readonly", "static", "defaultLibrary")
LEGEND = SemanticTokensLegend(TYPES, MODIFIERS)

_KIND_OF: dict[type, str] = {
    ModuleSymbol: "namespace",
    TypeSymbol: "type",
    InstalledTypeSymbol: "type",
    RoutineSymbol: "function",
    LibrarySymbol: "function",
    DataSymbol: "variable",
    CounterSymbol: "variable",
    ParameterSymbol: "parameter",
    InstalledParameterSymbol: "parameter",
    ComponentSymbol: "property",
    ConfiguredSymbol: "event",
    UnknownSymbol: "event",
    LabelSymbol: "label",
}
"""Kind of token by kind of symbol."""
_KIND_OF_TOKEN = {"NUMBER": "number", "STRING": "string", "NAME": ""}
_IN_LITERALS = re.compile(
    r'"(?:[^"\r\n]|"")*"|\b(?:TRUE|FALSE)\b|[+-]?[\d.][\w.+-]*', re.IGNORECASE
)
_NUMBER_OF = {name: index for index, name in enumerate(TYPES)}
_BIT_OF = {name: 1 << index for index, name in enumerate(MODIFIERS)}


@value_class(frozen=True, slots=True)
class TokenPiece:
    """The code of a part of a text, relative to its first character."""

    text: str
    data: tuple[int, ...]
    lines: int
    """Number of line ends in the part."""
    last_token: tuple[int, int]
    """Line and column of the last token, relative to the part; -1 without tokens."""


class SemanticTokenEncoder:
    """Codes of the pieces of texts, kept until they change."""

    def __init__(self) -> None:
        """Know none."""
        self._pieces: dict[str, dict[tuple[tree.Node | None, str], TokenPiece]] = {}
        self._answers: dict[str, tuple[str, list[int]]] = {}
        self._count = 0

    def forget(self) -> None:
        """Discard what depends on declarations, after one of them changed."""
        self._pieces.clear()

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
        kept: dict[tuple[tree.Node | None, str], TokenPiece] = {}
        data: list[int] = []
        line, column = 0, 0
        lines = document.lines
        for first, last, module, item in _parts(document.file):
            if last < start or first > end:
                continue
            part = text[first:last]
            key = (item, part)
            piece = kept.get(key) or before.get(key)
            if piece is None:
                piece = _piece(part, first, module, item, names, lines)
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


def _piece(
    text: str,
    first: int,
    module: tree.Module | None,
    item: tree.Node | None,
    names: NamesOfNodes,
    lines: LineTable,
) -> TokenPiece:
    """Encode a part of a text that begins at an offset."""
    kinds: dict[int, tuple[str, int]] = {}
    if module is not None:
        found = names_in(item, module, names) if item is not None else names.of(module, (), module)
        for one in found:
            kinds[module.source.offset(one.name.start) - first] = _kind(
                one.symbol, is_declaration=one.is_declaration
            )
    table = LineTable(text, lines.encoding)
    data: list[int] = []
    line, column = 0, 0
    for start, end, kind in sorted(_tokens(text)):
        name, modifiers = kinds.get(start, ("", 0)) if not kind else (kind, 0)
        if not name:
            continue
        place = table.position(start)
        step = place.line - line
        data += (
            step,
            place.character - column if step == 0 else place.character,
            lines.encoding.units(text[start:end]),
            _NUMBER_OF[name],
            modifiers,
        )
        line, column = place.line, place.character
    return TokenPiece(
        text, tuple(data), len(table.starts) - 1, (line, column) if data else (-1, -1)
    )


def _tokens(text: str) -> Iterator[tuple[int, int, str]]:
    """Yield start, end and kind of the tokens of a text; the kind of a name is empty."""
    tokens = lex(text)
    for comment in tokens.comments:
        yield comment.start, comment.start + len(comment.text.rstrip()), "comment"
    for kind, start, end in zip(tokens.kinds, tokens.starts, tokens.ends, strict=True):
        if kind == "LITERALS":
            for match in _IN_LITERALS.finditer(text, start, end):
                yield match.start(), match.end(), _literal_kind(match.group())
        elif kind in _KIND_OF_TOKEN:
            yield start, end, _KIND_OF_TOKEN[kind]
        elif text[start : start + 1].isalpha():
            yield start, end, "keyword"


def _literal_kind(text: str) -> str:
    if text[0] == '"':
        return "string"
    return "keyword" if text[0].isalpha() else "number"


def _kind(symbol: NamedSymbol | None, *, is_declaration: bool) -> tuple[str, int]:
    if symbol is None:
        return "", 0
    kind, bits = _KIND_OF[type(symbol)], _BIT_OF["declaration"] * is_declaration
    match symbol:
        case DataSymbol(type=of) if resolved(of) in SIGNALS:
            kind = "event"
        case RoutineSymbol(node=tree.Trap()):
            kind = "event"
        case _:
            pass
    match symbol:
        case DataSymbol(storage=Storage.CONST) | CounterSymbol():
            bits |= _BIT_OF["readonly"]
        case DataSymbol(storage=Storage.PERS):
            bits |= _BIT_OF["static"]
        case _:
            pass
    is_predefined = isinstance(
        symbol, LibrarySymbol | InstalledTypeSymbol | InstalledParameterSymbol
    ) or (isinstance(symbol, DataSymbol) and symbol.module is None)
    return kind, bits | _BIT_OF["defaultLibrary"] * is_predefined
