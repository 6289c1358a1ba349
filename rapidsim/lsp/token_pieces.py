"""Codes of the parts of a text: names by their symbols, words, numbers, strings, comments.

A code is relative to the beginning of its part. It holds as long as the text of the part is the
same, and the names in it that are declared elsewhere are of the kinds that they were.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from lsprotocol.types import SemanticTokensLegend

from rapidsim.analysis.cell_names import ConfiguredSymbol
from rapidsim.analysis.installed import installed_symbol
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
    Scope,
    Storage,
    TypeSymbol,
    UnknownSymbol,
)
from rapidsim.language.types import SIGNALS, resolved
from rapidsim.lsp.positions import Encoding, LineTable
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
    """The code of a part of a text."""

    data: tuple[int, ...]
    last_token: tuple[int, int]
    """Line and column of the last token, relative to the part; -1 without tokens."""
    outer: frozenset[OuterName]
    """Names in the part that are declared elsewhere, or nowhere."""


@value_class(frozen=True, slots=True)
class OuterName:
    """A name with the kind that it had when a part was encoded."""

    key: str
    is_type: bool
    kind: str
    """Empty for a name that is not declared."""
    modifiers: int


class OuterKinds:
    """Present kinds of the names that the modules of a task see."""

    def __init__(self, names: NamesOfNodes) -> None:
        """Take the names of a task as it is now."""
        self._names = names
        self._known: dict[tuple[tree.Module, OuterName], bool] = {}

    def are_valid(self, piece: TokenPiece, module: tree.Module | None) -> bool:
        """Whether the names of a part in a module have their old kinds."""
        return module is None or all(self._is_valid(one, module) for one in piece.outer)

    def _is_valid(self, name: OuterName, module: tree.Module) -> bool:
        known = self._known.get((module, name))
        if known is None:
            kind, modifiers = _kind(self._symbol(name, module), is_declaration=False)
            known = self._known[module, name] = (kind, modifiers) == (name.kind, name.modifiers)
        return known

    def _symbol(self, name: OuterName, module: tree.Module) -> NamedSymbol | None:
        if name.is_type:
            return self._names.type_symbol(name.key, module)
        analysis = self._names.facts.analysis
        home = analysis.home_of.get(module)
        found = None if home is None else home.scope.find(name.key)
        return found or analysis.cell.find(name.key) or installed_symbol(name.key)


def encode_piece(
    text: str,
    first: int,
    module: tree.Module | None,
    item: tree.Node | None,
    names: NamesOfNodes,
    encoding: Encoding,
) -> TokenPiece:
    """Encode a part of a text.

    Args:
        text: The part.
        first: Its offset in the file.
        module: The module that it belongs to.
        item: The item that it is; None for what is between items.
        names: Resolves the names of the task.
        encoding: Code units of the client.
    """
    kinds: dict[int, tuple[str, int]] = {}
    outer: set[OuterName] = set()
    if module is not None:
        found = names_in(item, module, names) if item is not None else names.of(module, (), module)
        for one in found:
            kind = _kind(one.symbol, is_declaration=one.is_declaration)
            kinds[module.source.offset(one.name.start) - first] = kind
            if not one.is_declaration and _is_outer(one.symbol):
                is_type = isinstance(one.symbol, TypeSymbol | InstalledTypeSymbol)
                is_declared = one.symbol is not None and not isinstance(one.symbol, UnknownSymbol)
                outer.add(OuterName(one.name.key, is_type, *(kind if is_declared else ("", 0))))
    table = LineTable(text, encoding)
    data: list[int] = []
    line, column = 0, 0
    for start, end, kind_of_token in sorted(_tokens(text)):
        name, modifiers = (kind_of_token, 0) if kind_of_token else kinds.get(start, ("", 0))
        if not name:
            continue
        place = table.position(start)
        step = place.line - line
        data += (
            step,
            place.character - column if step == 0 else place.character,
            encoding.units(text[start:end]),
            _NUMBER_OF[name],
            modifiers,
        )
        line, column = place.line, place.character
    return TokenPiece(tuple(data), (line, column) if data else (-1, -1), frozenset(outer))


def _is_outer(symbol: NamedSymbol | None) -> bool:
    """Whether a name may be declared outside of the part that uses it, or nowhere."""
    match symbol:
        case DataSymbol(scope=scope):
            return scope is not Scope.ROUTINE
        case ParameterSymbol() | CounterSymbol() | LabelSymbol():
            return False
        case ComponentSymbol() | InstalledParameterSymbol():
            return False
        case _:
            return True


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
