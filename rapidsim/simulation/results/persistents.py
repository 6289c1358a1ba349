"""Persistents that a run has changed, with values in the notation of their declarations.

A controller keeps the value of a PERS in the text of its module: saving the module saves the value.
A run changes no file; it reports which values would be saved.

Source: RAPID Overview, "Declarations", persistent declarations.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from rapidsim.analysis.types.operators import has_value
from rapidsim.diagnostics import Span
from rapidsim.interpreter.linking.loader import Task
from rapidsim.interpreter.linking.saved_text import declared_value
from rapidsim.library.text import source_text
from rapidsim.values import value_class

_LITERAL = r'"(?:[^"]|"")*"|(?:[+-]\s*)?(?:\d+\.?\d*|\.\d+)(?:E[+-]?\d+)?|TRUE\b|FALSE\b'
_BETWEEN = r"[\[\](),\s]+|![^\r\n]*"
_LEAF = re.compile(f"(?P<leaf>{_LITERAL})|(?:{_BETWEEN})", re.IGNORECASE)
_VALUE = re.compile(rf"{_LITERAL}|[+-]?INF\b|NAN\b", re.IGNORECASE)
"""A value that a program may have computed."""


@value_class(frozen=True, slots=True)
class PersistentChange:
    """A PERS whose final value differs from that of its declaration."""

    name: str
    module: str
    old: str
    """Declared value, as RAPID text."""
    new: str
    """Final value, with as many digits as distinguish it from neighbouring numbers."""
    declared: Span
    """The initial value in the declaration; without one, the empty span before the semicolon."""


def changed_persistents(task: Task) -> tuple[PersistentChange, ...]:
    """Return the persistents of a task whose values have changed, in order of writing."""
    return tuple(
        PersistentChange(
            change.name,
            change.module,
            source_text(change.old, change.symbol.type),
            source_text(change.new, change.symbol.type),
            declared_value(change.symbol),
        )
        for change in task.persistents()
        if has_value(change.symbol.type)
    )


def deduplicated(changes: Iterable[PersistentChange]) -> tuple[PersistentChange, ...]:
    """Return each change once, also if several tasks have the module that declares it."""
    found: dict[tuple[str, int, str], PersistentChange] = {}
    for one in changes:
        found.setdefault((one.declared.file, one.declared.start, one.new), one)
    return tuple(found.values())


def parts_of(text: str) -> tuple[str, ...]:
    """Return the numbers, strings and bools of a value; a single one for a plain value."""
    return tuple(_VALUE.findall(text))


def literal_places(text: str) -> tuple[tuple[int, int], ...] | None:
    """Return the offsets of the numbers, strings and bools in the text of a literal value.

    Returns:
        Offsets of start and end; None if the text contains anything other than literals, brackets
        and comments.
    """
    found: list[tuple[int, int]] = []
    at = 0
    while at < len(text):
        match = _LEAF.match(text, at)
        if match is None:
            return None
        if match["leaf"] is not None:
            found.append(match.span())
        at = match.end()
    return tuple(found)
