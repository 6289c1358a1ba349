"""All nodes below a node of the tree, in order of writing."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields

from rapidsim.syntax import tree

_PARTS: dict[type[tree.Node], tuple[str, ...]] = {
    kind: tuple(part.name for part in fields(kind) if part.name not in ("start", "end"))
    for kind in vars(tree).values()
    if isinstance(kind, type) and issubclass(kind, tree.Node)
}


def walk(node: tree.Node) -> Iterator[tree.Node]:
    """The node itself and everything below it."""
    waiting = [node]
    while waiting:
        node = waiting.pop()
        yield node
        for name in reversed(_PARTS[type(node)]):
            part = getattr(node, name)
            if isinstance(part, tree.Node):
                waiting.append(part)
            # Tuples hold nodes, or the numbers of literal aggregates and runs.
            elif isinstance(part, tuple) and part and isinstance(part[0], tree.Node):
                waiting.extend(reversed(part))
