"""A module as saved: its text with the current values of its persistents.

Source: Technical reference manual RAPID Overview, "Persistent declarations": when a module is
saved, the initial values in its text are replaced by the current ones.
"""

from __future__ import annotations

from rapidsim.analysis.program import DataSymbol, Storage
from rapidsim.analysis.types.operators import has_value
from rapidsim.diagnostics import Span
from rapidsim.interpreter.linking.linker import LinkedProgram
from rapidsim.interpreter.runtime.memory import initial_literal
from rapidsim.library.text import source_text
from rapidsim.syntax import tree


def text_of(module: tree.Module) -> str:
    """Return the original text of a module, from its first to its last word."""
    return module.source.text[module.start : module.end] + "\n"


def saved_text(module: tree.Module, linked: LinkedProgram) -> str:
    """The text of a module with current values."""
    text, end = module.source.text, module.end
    for item in reversed(module.items):
        symbol = linked.program.symbol_of.get(item)
        if not isinstance(symbol, DataSymbol) or symbol.storage is not Storage.PERS:
            continue
        value = linked.value_of(symbol)
        if has_value(symbol.type) and value != initial_literal(symbol):
            place = declared_value(symbol)
            new = source_text(value, symbol.type)
            written = new if place.end > place.start else f":={new}"
            end += len(written) - (place.end - place.start)
            text = text[: place.start] + written + text[place.end :]
    return text[module.start : end] + "\n"


def declared_value(symbol: DataSymbol) -> Span:
    """Span of the initial value in a declaration; without one empty, before the semicolon."""
    node, module = symbol.node, symbol.module
    assert isinstance(node, tree.Data)
    assert module is not None
    if node.value is not None:
        return module.span(node.value)
    semicolon = module.source.text.rfind(";", node.start, node.end + 1)
    at = semicolon if semicolon >= 0 else node.end
    return Span(module.source, at, at)
