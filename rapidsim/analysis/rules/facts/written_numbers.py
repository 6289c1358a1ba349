"""Source spans of parts of an aggregate: literals in aggregates have no nodes."""

from __future__ import annotations

import re
from collections.abc import Sequence

from rapidsim.diagnostics import Span
from rapidsim.syntax import tree

_TOKEN = re.compile(r'"(?:[^"\n]|"")*"|![^\r\n]*|[\[\],]')


def part_span(module: tree.Module, aggregate: tree.Node, path: Sequence[int]) -> Span:
    """The text span of a part of an aggregate.

    Args:
        module: The module that contains the aggregate.
        aggregate: `[a, [b, c]]` as written.
        path: Positions from the outside in, from 0: (1, 0) is `b`. Empty is the aggregate itself.

    Returns:
        The part without surrounding blanks; the aggregate if there is no such part.
    """
    text = module.source.text
    start, end = aggregate.start, aggregate.end
    for position in path:
        found = _element(text, start, end, position)
        if found is None:
            return module.span(aggregate)
        start, end = found
    return Span(module.source, start, end)


def _element(text: str, start: int, end: int, position: int) -> tuple[int, int] | None:
    """Offsets of one element of the aggregate between two offsets."""
    depth, count, begin = 0, 0, start
    for match in _TOKEN.finditer(text, start, end):
        mark = match.group()
        if mark == "[":
            depth += 1
            if depth == 1:
                begin = match.end()
        elif depth == 1 and mark in ",]":
            if count == position:
                return _trimmed(text, begin, match.start())
            count += 1
            begin = match.end()
        if mark == "]":
            depth -= 1
    return None


def _trimmed(text: str, start: int, end: int) -> tuple[int, int]:
    piece = text[start:end]
    left = len(piece) - len(piece.lstrip())
    return start + left, start + left + len(piece.strip())
