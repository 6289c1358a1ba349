"""Every node of a tree, whatever its kind, for passes that look for a few kinds only."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields
from functools import cache

from rapidsim.syntax import tree

# Annotations of fields that hold no node, or only names and numbers.
_WITHOUT_NODES = frozenset(
    {
        *("int", "str", "bool", "float", "str | None", "Name", "Name | None", "Source"),
        *("tuple[Name, ...]", "tuple[LiteralValue, ...]"),
        *("tuple[int, ...]", "tuple[tuple[float, ...], ...]"),
    }
)


def descendants(*roots: tree.Node) -> Iterator[tree.Node]:
    """The nodes under some nodes and these themselves, in the order of the text; names left out."""
    stack = list(reversed(roots))
    while stack:
        node = stack.pop()
        yield node
        stack += reversed(children(node))


def children(node: tree.Node) -> list[tree.Node]:
    """The nodes directly under a node, in the order of the fields; names left out."""
    found: list[tree.Node] = []
    for name in _fields_with_nodes(type(node).__name__):
        value = getattr(node, name)
        if isinstance(value, tree.Node):
            found.append(value)
        elif value:
            found += [part for part in value if isinstance(part, tree.Node)]
    return found


@cache
def _fields_with_nodes(kind: str) -> tuple[str, ...]:
    return tuple(
        field.name for field in fields(getattr(tree, kind)) if field.type not in _WITHOUT_NODES
    )
