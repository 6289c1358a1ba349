"""What is printed parses to the tree that was printed: any tree, all kinds of nodes."""

from __future__ import annotations

import inspect

from hypothesis import given
from laws import examples
from syntax_trees import Drawing, Sequence64, modules, shape

from rapidsim.diagnostics import Source
from rapidsim.syntax import tree
from rapidsim.syntax.parser import parse
from rapidsim.syntax.printer import print_module

# What no sound text gives, and what only stands for others.
NOT_DRAWN = {"InvalidStatement", "Node", "RoutineNode"} | {
    "BulkStatements",
    "BulkRow",
    "RepeatedCall",
}
ENOUGH = 60
"""Modules that hold every kind of node; as their sequence is fixed, they do always."""


@examples(200)
@given(modules())
def test_parse_undoes_print(module: tree.Module) -> None:
    assert_parse_undoes_print(module)


def test_parse_undoes_print_for_every_kind_of_node() -> None:
    choice = Sequence64()
    drawn = [Drawing(choice).module() for _ in range(ENOUGH)]
    for module in drawn:
        assert_parse_undoes_print(module)
    nodes = {
        name
        for name in tree.__all__
        if inspect.isclass(kind := getattr(tree, name)) and issubclass(kind, tree.Node)
    }
    met = {kind for module in drawn for kind in kinds(module)}
    assert nodes - met == NOT_DRAWN


def assert_parse_undoes_print(module: tree.Module) -> None:
    printed = print_module(module)
    parsed = parse(Source("printed", printed))
    assert not parsed.diagnostics, printed
    assert shape(parsed.file.modules) == shape((module,)), printed


def kinds(node: object) -> set[str]:
    """The names of all classes in a tree."""
    found: set[str] = set()
    todo = [node]
    while todo:
        part = todo.pop()
        if isinstance(part, tuple):
            todo.extend(part)
        elif isinstance(part, tree.Node):
            found.add(type(part).__name__)
            slots = {slot for kind in type(part).__mro__ for slot in getattr(kind, "__slots__", ())}
            todo.extend(getattr(part, slot) for slot in slots if slot != "__weakref__")
            todo.extend(getattr(part, "items", ()) if isinstance(part, tree.Module) else ())
    return found
