"""What is printed parses to the tree that was printed: any tree, all kinds of nodes."""

from __future__ import annotations

import inspect

from hypothesis import given, settings
from syntax_trees import modules, shape

from rapidsim.diagnostics import Source
from rapidsim.syntax import tree
from rapidsim.syntax.parser import parse
from rapidsim.syntax.printer import print_module

# What no sound text gives, and what only stands for others.
NOT_DRAWN = {"Broken", "Node", "RoutineNode"}


def test_parse_undoes_print() -> None:
    met: set[str] = set()

    @settings(max_examples=200)
    @given(modules())
    def law(module: tree.Module) -> None:
        printed = print_module(module)
        parsed = parse(Source("printed", printed))
        assert not parsed.diagnostics, printed
        assert shape(parsed.file.modules) == shape((module,)), printed
        met.update(kinds(module))

    law()
    nodes = {
        name
        for name in tree.__all__
        if inspect.isclass(kind := getattr(tree, name)) and issubclass(kind, tree.Node)
    }
    assert nodes - met == NOT_DRAWN


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
