"""Messages from clients: the type of data that arrives as text."""

from __future__ import annotations

from collections.abc import Iterable

from rapidsim.analysis.program import TypeSymbol
from rapidsim.language.messages import MessageKind
from rapidsim.language.types import Record, Type, resolved
from rapidsim.library.predefined import TYPES
from rapidsim.simulation.live.live_task import LiveTask


def kind_of(type_name: str, text: str, tasks: Iterable[LiveTask]) -> MessageKind:
    """Return the type and the array dimensions of data that came as text.

    Brackets in addition to those of the type are those of an array; data of a type that no task
    declares count as no array.
    """
    of = _type(type_name, tasks)
    if of is None:
        return MessageKind(type_name)
    depth = _leading(text) - _brackets(of)
    return MessageKind(type_name, tuple(_sizes(text, depth)))


def _type(name: str, tasks: Iterable[LiveTask]) -> Type | None:
    for key, of in TYPES.items():
        if key.lower() == name.lower():
            return of
    for task in tasks:
        for symbol in task.program.symbol_of.values():
            if isinstance(symbol, TypeSymbol) and symbol.name.lower() == name.lower():
                return symbol.type
    return None


def _brackets(of: Type) -> int:
    """Number of opening brackets at the start of a value of a type."""
    of = resolved(of)
    return 1 + _brackets(of.components[0].type) if isinstance(of, Record) else 0


def _leading(text: str) -> int:
    stripped = text.replace(" ", "")
    return len(stripped) - len(stripped.lstrip("["))


def _sizes(text: str, depth: int) -> list[int]:
    """Number of elements at each outer level of a text, counted in the first part of each."""
    sizes: list[int] = []
    for _ in range(min(depth, 3)):
        text = text.strip()[1:]
        parts = _parts(text)
        sizes.append(len(parts))
        text = parts[0]
    return sizes


def _parts(text: str) -> list[str]:
    """Texts between the commas of one level, up to its closing bracket."""
    parts, begin, level, in_string = list[str](), 0, 0, False
    for at, one in enumerate(text):
        if one == '"':
            in_string = not in_string
        elif in_string:
            continue
        elif one == "[":
            level += 1
        elif one == "]" and level == 0:
            return [*parts, text[begin:at]]
        elif one == "]":
            level -= 1
        elif one == "," and level == 0:
            parts.append(text[begin:at])
            begin = at + 1
    return [*parts, text[begin:]]
