"""Tree traversal for passes that examine only a few kinds of nodes."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import fields
from operator import attrgetter
from typing import TypeVar

from rapidsim.syntax import tree

N = TypeVar("N", bound=tree.Node)
# Annotations of fields that hold no node, or only names and numbers.
_WITHOUT_NODES = frozenset(
    {
        *("int", "str", "bool", "float", "str | None", "Name", "Name | None", "Source"),
        *("tuple[Name, ...]", "tuple[LiteralValue, ...]"),
        *("tuple[int, ...]", "tuple[tuple[float, ...], ...]"),
        # A statement of the tree represents these.
        *("tuple[Run, ...]", "Offsets", "Offsets | None", "Numbers"),
        *("tuple[str, ...]", "int | None"),
    }
)
# By kind of node; looked up several times for every node of a program.
_FIELDS_WITH_NODES: dict[type[tree.Node], tuple[str, ...]] = {
    kind: tuple(field.name for field in fields(kind) if field.type not in _WITHOUT_NODES)
    for kind in vars(tree).values()
    if isinstance(kind, type) and issubclass(kind, tree.Node)
}

_start = attrgetter("start")
_WITH_BLOCKS = (tree.If, tree.CompactIf, tree.For, tree.While, tree.Test)


def clauses(routine: tree.RoutineNode) -> Iterator[tree.Body]:
    """Yield the body of a routine and the bodies of its clauses."""
    yield routine.body
    if routine.backward is not None:
        yield routine.backward
    if routine.error is not None:
        yield routine.error.body
    if routine.undo is not None:
        yield routine.undo


def blocks(statement: tree.Statement) -> Iterator[tree.Body]:
    """Yield the statement lists directly inside a statement."""
    match statement:
        case tree.If(branches=branches, otherwise=otherwise):
            for branch in branches:
                yield branch.body
            if otherwise is not None:
                yield otherwise
        case tree.CompactIf(statement=inner):
            yield (inner,)
        case tree.For(body=body) | tree.While(body=body):
            yield body
        case tree.Test(cases=cases, default=default):
            for case in cases:
                yield case.body
            if default is not None:
                yield default
        case _:
            pass


def statements(*bodies: tree.Body) -> Iterator[tree.Statement]:
    """Yield the statements of lists and of their nested blocks, in source order."""
    stack = [statement for body in reversed(bodies) for statement in reversed(body)]
    while stack:
        statement = stack.pop()
        yield statement
        if isinstance(statement, _WITH_BLOCKS):
            inner = [part for block in blocks(statement) for part in block]
            stack += reversed(inner)


def data_of(module: tree.Module) -> Iterator[tree.Data]:
    """Yield every data declaration of a module, including those in its routines."""
    for item in module.items:
        if isinstance(item, tree.Data):
            yield item
        elif isinstance(item, tree.RoutineNode):
            for statement in statements(*clauses(item)):
                if isinstance(statement, tree.Data):
                    yield statement


def descendants(*roots: tree.Node) -> Iterator[tree.Node]:
    """Yield nodes and their descendants in source order, without names."""
    stack = list(reversed(roots))
    while stack:
        node = stack.pop()
        yield node
        for name in reversed(_FIELDS_WITH_NODES[type(node)]):
            value = getattr(node, name)
            if isinstance(value, tree.Node):
                stack.append(value)
            elif value:
                stack += [part for part in reversed(value) if isinstance(part, tree.Node)]


class NodesByKind(dict[type[tree.Node], list[tree.Node]]):
    """Nodes by class, each class in source order."""

    def all(self, kind: type[N]) -> Sequence[N]:
        """Return the nodes of one class."""
        return self.get(kind, ())  # type: ignore[return-value]


def nodes_by_kind(*roots: tree.Node) -> NodesByKind:
    """Return nodes and their descendants by class."""
    found = NodesByKind()
    for node in descendants(*roots):
        try:
            found[type(node)].append(node)
        except KeyError:
            found[type(node)] = [node]
    return found


def children(node: tree.Node) -> list[tree.Node]:
    """Return the direct children of a node, in the order of the fields, without names."""
    found: list[tree.Node] = []
    for name in _FIELDS_WITH_NODES[type(node)]:
        value = getattr(node, name)
        if isinstance(value, tree.Node):
            found.append(value)
        elif value:
            found += [part for part in value if isinstance(part, tree.Node)]
    return found


def child_at(node: tree.Node, offset: int) -> tree.Node | None:
    """Return the direct child that contains an offset or ends there; names are no children."""
    for name in _FIELDS_WITH_NODES[type(node)]:
        value = getattr(node, name)
        if isinstance(value, tuple):
            index = bisect_right(value, offset, key=_start) - 1
            value = value[index] if index >= 0 else None
        if isinstance(value, tree.Node) and value.start <= offset <= value.end:
            return value
    return None
