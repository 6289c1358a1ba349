"""The values of literals: numbers, strings, aggregates of them.

Source: Technical reference manual RAPID Kernel, "Lexical elements".
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from functools import cache
from typing import Any

from rapidsim.syntax.lexer import literal_pattern
from rapidsim.syntax.tree import LiteralValue

_JSON = json.JSONDecoder(parse_int=float)
_BASES = {"0X": 16, "0O": 8, "0B": 2}
# `""` is a quote, `\\` a backslash, `\0D` the character of that code.
_ESCAPE = re.compile(r'""|\\\\|\\[0-9A-Fa-f]{2}')
_BACKSLASH = re.compile(r"\\(?:\\|[0-9A-Fa-f]{2})|(\\)")


def number(text: str) -> float:
    """Return the value of an unsigned numeric literal; infinite if it exceeds a dnum."""
    base = _BASES.get(text[:2].upper())
    if base is None:
        return float(text)
    try:
        return float(int(text[2:], base))
    except OverflowError:
        return float("inf")


def string(text: str) -> str:
    """Return the characters of a string literal, whose closing quote may be missing."""
    inner = text[1:-1] if len(text) > 1 and text.endswith('"') else text[1:]
    if "\\" not in inner and '"' not in inner:
        return inner
    return _ESCAPE.sub(_unescaped, inner)


def aggregate(text: str) -> tuple[LiteralValue, ...]:
    """The value of an aggregate of literals: nested tuples of numbers, strings and truth values."""
    if '"' not in text:
        # Most aggregates are also JSON, which Python reads ten times as fast.
        try:
            return _frozen(_JSON.decode(text))
        except ValueError:
            pass
    return _read(text)


def bad_escape(text: str) -> int | None:
    """Offset of the first backslash of a string that begins no escape."""
    return next((m.start() for m in _BACKSLASH.finditer(text) if m.group(1)), None)


def parts(text: str) -> Iterator[tuple[int, str]]:
    """The literals of a string, or of an aggregate of literals, each with its offset."""
    if text[0] == '"':
        yield 0, text
    else:
        for match in _element().finditer(text):
            if match.group() not in "[]":
                yield match.start(), match.group()


def _unescaped(match: re.Match[str]) -> str:
    escape = match.group()
    if escape in {'""', "\\\\"}:
        return escape[0]
    return chr(int(escape[1:], 16))


def _frozen(elements: list[Any]) -> tuple[LiteralValue, ...]:
    return tuple(_frozen(e) if type(e) is list else e for e in elements)


def _read(text: str) -> tuple[LiteralValue, ...]:
    stack: list[list[LiteralValue]] = [[]]
    for match in _element().finditer(text):
        part = match.group()
        if part == "[":
            stack.append([])
        elif part == "]":
            closed = tuple(stack.pop())
            stack[-1].append(closed)
        else:
            stack[-1].append(_literal(part))
    outermost = stack[0][0]
    assert isinstance(outermost, tuple)
    return outermost


def _literal(text: str) -> LiteralValue:
    if text[0] == '"':
        return string(text)
    if text[0] in "tTfF":
        return text[0] in "tT"
    if text[0] == "-":
        return -number(text[1:])
    return number(text.removeprefix("+"))


@cache
def _element() -> re.Pattern[str]:
    return re.compile(rf"[\[\]]|{literal_pattern()}", re.IGNORECASE)
