"""The signature of the call at a position, with the argument that is being written."""

from __future__ import annotations

from lsprotocol import types as lsp

from rapidsim.analysis.program import LibrarySymbol, RoutineSymbol, Symbol
from rapidsim.lsp.call_context import statement_context
from rapidsim.lsp.scope import PlaceScope, formal_at
from rapidsim.lsp.texts import chapter_remark, declaration, unit_of
from rapidsim.lsp.view import Document


def signature_help(document: Document, position: lsp.Position) -> lsp.SignatureHelp | None:
    """Return the signature of the innermost call at a position; None outside of calls."""
    offset = document.offset(position)
    statement = statement_context(document.text, offset)
    scope = PlaceScope(document, offset)
    call = None if statement.is_text else scope.call(statement)
    found = None if call is None else scope.callee(call)
    if call is None or found is None:
        return None
    symbol, callee = found
    label = declaration(symbol)
    spans = _parameter_spans(label, [formal.spelled for formal in callee.parameters], symbol)
    at = formal_at(call, callee)
    # An index past the last highlights none.
    active = len(spans) if at is None else at[0]
    return lsp.SignatureHelp(
        signatures=[
            lsp.SignatureInformation(
                label=label,
                documentation=_documentation(symbol),
                parameters=[
                    lsp.ParameterInformation(label=span, documentation=text)
                    for span, text in zip(spans, _parameter_texts(symbol), strict=True)
                ],
                # It is sent in any case, and `null` would take precedence over that of the help.
                active_parameter=active,
            )
        ],
        active_signature=0,
        active_parameter=active,
    )


def _parameter_spans(label: str, names: list[str], symbol: Symbol) -> list[tuple[int, int]]:
    """Spans of the parameters in the label; with mode and type in a routine of the user."""
    spans: list[tuple[int, int]] = []
    start = label.find("(" if isinstance(symbol, RoutineSymbol) else " ") + 1
    for name in names:
        bare = name.lstrip("\\")
        at = label.find(bare, start)
        while at > 0 and _is_inside_word(label, at, at + len(bare)):
            at = label.find(bare, at + 1)
        at = start if at < 0 else at
        begin = at
        if isinstance(symbol, RoutineSymbol):
            begin = max(label.rfind(mark, 0, at) for mark in ("(", ",", "|")) + 1
            begin += len(label[begin:at]) - len(label[begin:at].lstrip())
        elif label[at - 1 : at] == "\\":
            begin = at - 1
        spans.append((begin, at + len(bare)))
        start = at + len(bare)
    return spans


def _is_inside_word(text: str, start: int, end: int) -> bool:
    before, after = text[start - 1 : start], text[end : end + 1]
    return any(one.isalnum() or one == "_" for one in (before, after) if one)


def _documentation(symbol: Symbol) -> str | None:
    return chapter_remark(symbol.routine) if isinstance(symbol, LibrarySymbol) else None


def _parameter_texts(symbol: Symbol) -> list[str | None]:
    if isinstance(symbol, LibrarySymbol):
        routine = symbol.routine
        texts = []
        for one in routine.signature.parameters:
            accepted = " or ".join(dict.fromkeys(of.name for of in one.types))
            if one.only is not None:
                accepted = one.only.words
            unit = unit_of(one, routine)
            texts.append(f"{accepted} [{unit}]" if unit else accepted)
        return list(texts)
    return [None] * len(symbol.parameters) if isinstance(symbol, RoutineSymbol) else []
