"""Reconstruction of bulk statements as nodes, as the parser would have built them."""

from __future__ import annotations

import re
from dataclasses import fields, is_dataclass, replace
from typing import Any

from rapidsim.syntax import tree
from rapidsim.syntax.literals import aggregate

_OFFSETS = frozenset({"start", "end", "operator_start"})
"""Fields of nodes that are offsets in the text."""
_DECLARED = re.compile(r"(\w+)\s*:=\s*(\[[^;]*\])")


def statement_of(row: tree.BulkRow, text: str) -> tree.Call:
    """Build the node of a bulk statement."""
    moved: tree.Call = _moved(row.like, row)
    start, end = row.target.start, row.target.end
    value: tree.LiteralAggregate | tree.DataReference
    if row.declared is None:
        value = tree.LiteralAggregate(start, end, aggregate(text[start:end]))
    else:
        value = tree.DataReference(start, end, tree.Name(start, end, text[start:end]))
    return replace(
        moved, arguments=(tree.RequiredArgument(start, end, value), *moved.arguments[1:])
    )


def declaration_of(row: tree.BulkRow, text: str) -> tuple[str, tree.Node]:
    """Return the name of a declared target and the node of its value."""
    assert row.declared is not None
    found = _DECLARED.search(text, row.declared)
    assert found is not None, "a run of declarations was matched there"
    return found[1], tree.Node(found.start(2), found.end(2))


def _moved(part: Any, row: tree.BulkRow) -> Any:
    """Copy a part of the statement in the tree, with the offsets of a row."""
    if isinstance(part, tuple):
        return tuple(_moved(one, row) for one in part)
    if not is_dataclass(part) or isinstance(part, type):
        return part
    new: dict[str, Any] = {}
    for one in fields(part):
        value = getattr(part, one.name)
        if one.name in _OFFSETS:
            new[one.name] = row.moved(value)
        else:
            new[one.name] = _moved(value, row)
    return replace(part, **new)
