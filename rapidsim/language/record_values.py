"""Python values of records, and pickling of those of a program's own records."""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Sequence
from functools import cache
from typing import Any

_LONGEST = 120
_UNUSED = 8e9
"""A number above it is the 9E9 that RAPID uses for unused values."""


def new_record_class(name: str, fields: Sequence[str]) -> type[tuple[object, ...]]:
    """A class for the values of a record that a program declares.

    Its values can be pickled: in a process without the program they are restored as values of an
    equal class.
    """
    # A component may have a name that is not a Python attribute; only its position matters.
    made: Any = namedtuple(name, fields, rename=True)  # type: ignore[misc]
    extra: dict[str, Any] = {
        "__reduce__": lambda value: (_rebuilt, (name, tuple(fields), tuple(value))),
        "__repr__": in_brackets,
    }
    for method, function in extra.items():
        setattr(made, method, function)
    python: type[tuple[object, ...]] = made
    return python


def in_brackets(value: tuple[object, ...]) -> str:
    """A record in one line, in RAPID syntax: `RobTarget[[600,0,800],[1,0,0,0],...`."""
    text = f"{type(value).__name__}{_text(value)}"
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 3]}..."


def _text(value: object) -> str:
    match value:
        case bool():
            return "TRUE" if value else "FALSE"
        case float():
            return "9E9" if value > _UNUSED else f"{value:.6G}"
        case tuple():
            return f"[{','.join(map(_text, value))}]"
        case _:
            return repr(value)


def _rebuilt(name: str, fields: tuple[str, ...], values: tuple[object, ...]) -> object:
    return tuple.__new__(_of(name, fields), values)


@cache
def _of(name: str, fields: tuple[str, ...]) -> type[tuple[object, ...]]:
    return new_record_class(name, fields)
