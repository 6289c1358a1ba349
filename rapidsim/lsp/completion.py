"""Completion: names in scope, options behind a backslash, components, words, block snippets."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from lsprotocol import types as lsp

from rapidsim.analysis.cell_names import ConfiguredSymbol
from rapidsim.analysis.installed import (
    installed_routine_names,
    installed_symbol,
    installed_type_names,
)
from rapidsim.analysis.names.names import is_function, is_procedure
from rapidsim.analysis.parameters import Formal
from rapidsim.analysis.program import (
    CounterSymbol,
    DataSymbol,
    LibrarySymbol,
    ParameterSymbol,
    RoutineSymbol,
    Symbol,
    TypeSymbol,
    UnknownSymbol,
)
from rapidsim.analysis.suggestions import reserved_words
from rapidsim.analysis.types.assignability import agrees
from rapidsim.language import types
from rapidsim.language.types import Record, Type, resolved
from rapidsim.library.predefined import DATA
from rapidsim.lsp.call_context import CallContext, StatementContext, Token, statement_context
from rapidsim.lsp.scope import PlaceScope, formal_at
from rapidsim.lsp.snippets import BLOCKS
from rapidsim.lsp.texts import declaration, documentation
from rapidsim.lsp.view import Document

MOST_ITEMS = 200
"""Maximum number of items of an answer; a client asks again when more letters are typed."""
_STORAGES = frozenset({"VAR", "PERS", "CONST", "FUNC", "ALIAS", "INOUT"})
"""Words before the name of a type."""
_KINDS: dict[type, lsp.CompletionItemKind] = {
    DataSymbol: lsp.CompletionItemKind.Variable,
    ParameterSymbol: lsp.CompletionItemKind.Variable,
    CounterSymbol: lsp.CompletionItemKind.Variable,
    ConfiguredSymbol: lsp.CompletionItemKind.Event,
    UnknownSymbol: lsp.CompletionItemKind.Event,
    RoutineSymbol: lsp.CompletionItemKind.Function,
    LibrarySymbol: lsp.CompletionItemKind.Function,
    TypeSymbol: lsp.CompletionItemKind.Struct,
}
_FITTING, _NAMED, _OTHER, _PREDEFINED, _WORD = "0", "1", "2", "3", "4"
"""Prefixes of sort keys: fitting names of the program, fitting predefined data, other names of the
program, other predefined names, words.
"""


def completions(
    document: Document, position: lsp.Position, *, snippets: bool = False
) -> lsp.CompletionList:
    """Return what may stand at a position.

    Args:
        document: The text.
        position: Behind the letters that are typed.
        snippets: Whether the client can insert snippets.
    """
    offset = document.offset(position)
    statement = statement_context(document.text, offset)
    if statement.is_text:
        return lsp.CompletionList(False, [])
    scope = PlaceScope(document, offset)
    found: list[lsp.CompletionItem] = []
    for item in _items(statement, scope, snippets=snippets):
        if _matches(item.filter_text or item.label, statement.prefix):
            found.append(item)
    found.sort(key=lambda item: item.sort_text or "")
    is_incomplete = len(found) > MOST_ITEMS or not statement.prefix
    return lsp.CompletionList(is_incomplete, found[:MOST_ITEMS])


def resolve(item: lsp.CompletionItem) -> lsp.CompletionItem:
    """Add the words about a predefined routine to an item."""
    key = item.data if isinstance(item.data, str) else ""
    symbol = installed_symbol(key)
    if symbol is not None and item.documentation is None:
        text = documentation(symbol)
        item.documentation = lsp.MarkupContent(lsp.MarkupKind.Markdown, text) if text else None
    return item


def _items(
    statement: StatementContext, scope: PlaceScope, *, snippets: bool
) -> Iterator[lsp.CompletionItem]:
    previous = statement.previous
    call = scope.call(statement)
    if previous == "\\":
        yield from _options(call, scope)
    elif previous == ".":
        yield from _components(statement.tokens, scope)
    elif _awaits_type(statement.tokens):
        yield from _type_names(scope)
    elif statement.is_start or previous.upper() == "THEN":
        yield from _statements(statement, scope, snippets=snippets)
    else:
        yield from _values(call, statement, scope)


def _options(call: CallContext | None, scope: PlaceScope) -> Iterator[lsp.CompletionItem]:
    found = None if call is None else scope.callee(call)
    if call is None or found is None:
        return
    symbol, callee = found
    for formal in callee.parameters:
        # The backslash before the cursor has made an option of the name being typed.
        if formal.optional and call.written.count(formal.key) == 0:
            yield _option(formal, symbol)


def _option(formal: Formal, symbol: Symbol) -> lsp.CompletionItem:
    detail = "switch" if formal.is_switch else " or ".join(of.name for of in formal.types)
    return lsp.CompletionItem(
        label=formal.name,
        kind=lsp.CompletionItemKind.Property,
        detail=f"{detail} - argument of {symbol.name}",
        insert_text=formal.name if formal.is_switch else f"{formal.name}:=",
        sort_text=_FITTING,
    )


def _components(tokens: tuple[Token, ...], scope: PlaceScope) -> Iterator[lsp.CompletionItem]:
    of = scope.type_of_path(_path_before(tokens))
    target = None if of is None else resolved(of)
    if isinstance(target, Record):
        for index, component in enumerate(target.components):
            yield lsp.CompletionItem(
                label=component.name,
                kind=lsp.CompletionItemKind.Field,
                detail=component.type.name,
                sort_text=f"{index:03}",
            )


def _path_before(tokens: tuple[Token, ...]) -> list[str]:
    """Return the data path that ends in a dot: `a{1}.b.` gives `["a", "{}", "b"]`."""
    path: list[str] = []
    index = len(tokens) - 2
    while index >= 0:
        if tokens[index].text == "}":
            depth = 0
            while index >= 0:
                depth += (tokens[index].text == "}") - (tokens[index].text == "{")
                index -= 1
                if depth == 0:
                    break
            path.append("{}")
            continue
        if not tokens[index].is_name:
            return []
        path.append(tokens[index].text.lower())
        if index == 0 or tokens[index - 1].text != ".":
            break
        index -= 2
    return path[::-1]


def _awaits_type(tokens: tuple[Token, ...]) -> bool:
    if not tokens:
        return False
    words = [token.text.upper() for token in tokens[:2]]
    in_head = any(word in ("PROC", "FUNC") for word in words)
    if in_head and "(" in (token.text for token in tokens):
        return tokens[-1].text in ("(", ",", "\\", "|") or words[-1] in _STORAGES
    return tokens[-1].text.upper() in _STORAGES or words == ["RECORD"]


def _type_names(scope: PlaceScope) -> Iterator[lsp.CompletionItem]:
    own = [one for one in scope.symbols.values() if isinstance(one, TypeSymbol)]
    for symbol in own:
        yield _item(symbol, _FITTING)
    for name in installed_type_names():
        yield lsp.CompletionItem(
            label=name, kind=lsp.CompletionItemKind.Struct, sort_text=_PREDEFINED + name
        )


def _statements(
    statement: StatementContext, scope: PlaceScope, *, snippets: bool
) -> Iterator[lsp.CompletionItem]:
    for symbol in scope.symbols.values():
        if isinstance(symbol, RoutineSymbol) and is_procedure(symbol):
            yield _item(symbol, _FITTING, snippets=snippets)
    is_inside = scope.location is not None and scope.location.routine is not None
    for block in BLOCKS if snippets else ():
        if block.is_of_routine == is_inside or not statement.prefix:
            yield block.item(_OTHER)
    for symbol in scope.symbols.values():
        if isinstance(symbol, DataSymbol | ParameterSymbol):
            yield _item(symbol, _OTHER)
    yield from _words(statement.prefix)
    if statement.prefix:
        for name in installed_routine_names():
            if _matches(name, statement.prefix):
                installed = installed_symbol(name.lower())
                if installed is not None and is_procedure(installed):
                    yield _item(installed, _PREDEFINED, snippets=snippets)


def _values(
    call: CallContext | None, statement: StatementContext, scope: PlaceScope
) -> Iterator[lsp.CompletionItem]:
    accepted = _accepted(call, scope)
    for symbol in scope.symbols.values():
        of = _value_type(symbol)
        if of is not None:
            fits = not accepted or _fits(of, accepted)
            yield _item(symbol, _FITTING if fits else _OTHER)
    for datum in DATA.values():
        # Not all that are numbers: each of many aliases has its own data.
        if datum.type in accepted:
            installed = installed_symbol(datum.name.lower())
            if installed is not None:
                yield _item(installed, _NAMED)
    if not statement.prefix:
        return
    yield from _words(statement.prefix)
    for name in (*installed_routine_names(), *DATA):
        if _matches(name, statement.prefix):
            installed = installed_symbol(name.lower())
            if installed is not None and _value_type(installed) is not None:
                yield _item(installed, _PREDEFINED)


def _accepted(call: CallContext | None, scope: PlaceScope) -> tuple[Type, ...]:
    """Types that the argument at the place may have; empty if they are not known."""
    found = None if call is None else scope.callee(call)
    at = None if call is None or found is None else formal_at(call, found[1])
    if at is None:
        return ()
    formal = at[1]
    return formal.only.types if formal.only is not None else formal.types


def _fits(of: Type, accepted: Iterable[Type]) -> bool:
    return any(agrees(of, one) for one in accepted)


def _value_type(symbol: Symbol) -> Type | None:
    """Return the type of the value of a symbol; None for what has none."""
    match symbol:
        case DataSymbol(type=of) | ParameterSymbol(type=of) | ConfiguredSymbol(type=of):
            return of
        case CounterSymbol():
            return types.NUM
        case UnknownSymbol():
            return types.SIGNAL_DI
        case RoutineSymbol(result=result) if is_function(symbol):
            return result
        case LibrarySymbol(routine=routine):
            return routine.signature.result
        case _:
            return None


def _words(prefix: str) -> Iterator[lsp.CompletionItem]:
    for word in reserved_words() if prefix else ():
        yield lsp.CompletionItem(
            label=word, kind=lsp.CompletionItemKind.Keyword, sort_text=_WORD + word
        )


def _item(symbol: Symbol, group: str, *, snippets: bool = False) -> lsp.CompletionItem:
    item = lsp.CompletionItem(
        label=symbol.name,
        kind=_KINDS[type(symbol)],
        detail=declaration(symbol),
        sort_text=group + symbol.name.lower(),
        data=symbol.name.lower(),
    )
    if isinstance(symbol, DataSymbol) and symbol.storage.value == "CONST":
        item.kind = lsp.CompletionItemKind.Constant
    if snippets and isinstance(symbol, LibrarySymbol):
        required = [one for one in symbol.routine.signature.parameters if not one.optional]
        fields = ",".join(f"${{{k}:{one.name}}}" for k, one in enumerate(required, 1))
        item.insert_text = f"{symbol.name} {fields};" if fields else f"{symbol.name};"
        item.insert_text_format = lsp.InsertTextFormat.Snippet
    return item


def _matches(name: str, prefix: str) -> bool:
    """Whether a name begins with the typed letters, or has them at the begins of its words."""
    if name[: len(prefix)].lower() == prefix.lower():
        return True
    if len(prefix) < 2:
        return False
    initials = "".join(re.findall(r"[A-Z0-9]|(?<=_)\w|^\w", name)).lower()
    return initials.startswith(prefix.lower())
