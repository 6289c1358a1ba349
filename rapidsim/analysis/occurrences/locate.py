"""The nodes and the name at an offset of a text."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.occurrences.names import NamesOfNodes, Occurrence
from rapidsim.analysis.tree_walk import child_at, children
from rapidsim.syntax import tree
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class Location:
    """The nodes that contain an offset, from the module to the innermost."""

    module: tree.Module
    path: tuple[tree.Node, ...]

    @property
    def innermost(self) -> tree.Node:
        """The smallest node."""
        return self.path[-1]

    @property
    def routine(self) -> tree.RoutineNode | None:
        """The routine that contains the offset; None outside of routines."""
        return next((one for one in self.path if isinstance(one, tree.RoutineNode)), None)


def locate(file: tree.File, offset: int) -> Location | None:
    """Return the nodes at a position of the tree, its end included; None outside of modules."""
    module = next((one for one in file.modules if one.start <= offset <= one.end), None)
    if module is None:
        return None
    path: list[tree.Node] = [module]
    while (child := child_at(path[-1], offset)) is not None:
        path.append(child)
    return Location(module, tuple(path))


def name_at(file: tree.File, offset: int, names: NamesOfNodes) -> Occurrence | None:
    """Return the name at a position of the tree, its end included; None without a name."""
    # Where a name ends, the next node may begin, as in `p10\WObj`.
    return _name_over(file, offset, names) or _name_over(file, offset - 1, names, ends=offset)


def _name_over(
    file: tree.File, offset: int, names: NamesOfNodes, *, ends: int | None = None
) -> Occurrence | None:
    """Return the name of the nodes at a position; None without one, or if it ends elsewhere."""
    location = locate(file, offset)
    if location is None:
        return None
    path = location.path
    for depth in range(len(path) - 1, -1, -1):
        for found in names.of(path[depth], path[:depth], location.module):
            if found.name.start <= offset <= found.name.end and ends in (None, found.name.end):
                return found
    return None


def names_in(node: tree.Node, module: tree.Module, names: NamesOfNodes) -> Iterator[Occurrence]:
    """Yield all names in a routine, another item of a module, or a whole module."""
    parents: list[tree.Node] = [] if node is module else [module]
    stack: list[tuple[tree.Node, int]] = [(node, len(parents))]
    while stack:
        one, depth = stack.pop()
        del parents[depth:]
        yield from names.of(one, parents, module)
        below = children(one)
        if below:
            parents.append(one)
            stack += [(child, depth + 1) for child in reversed(below)]
