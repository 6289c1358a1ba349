"""Nodes of the items of a module, types and routines; and of modules and files."""

from __future__ import annotations

from functools import cached_property
from typing import TypeAlias

from rapidsim.diagnostics import Source, Span
from rapidsim.syntax.tree.bulk_statements import BulkStatements
from rapidsim.syntax.tree.expressions import (
    Expression,
    Name,
    Node,
    Placeholder,
    keeping_node,
    node,
)
from rapidsim.syntax.tree.statements import Body, Data, InvalidStatement
from rapidsim.values import value_class


@node
class ComponentDeclaration(Node):
    """One component of a RECORD declaration."""

    type: Name
    name: Name
    dimensions: tuple[Expression, ...] = ()
    """Lenient: components cannot be arrays."""


@node
class RecordType(Node):
    """RECORD ... ENDRECORD."""

    scope: str | None
    name: Name
    components: tuple[ComponentDeclaration | Placeholder, ...]


@node
class AliasType(Node):
    """`ALIAS type name;`"""

    scope: str | None
    type: Name
    name: Name


@node
class ParameterDeclaration(Node):
    """One parameter; `mode` is "IN", "INOUT", "VAR", "PERS" or "REF", `dimensions` its stars."""

    mode: str
    type: Name
    name: Name
    dimensions: int = 0


@node
class OptionalGroup(Node):
    r"""`\a | b`: optional parameters, at most one of which may be passed."""

    alternatives: tuple[ParameterDeclaration | Placeholder, ...]


@node
class ErrorHandler(Node):
    """The ERROR clause; `numbers` is the list of a long-jump handler."""

    numbers: tuple[Expression, ...] | None
    body: Body


@node
class RoutineNode(Node):
    """Common fields of PROC, FUNC and TRAP."""

    scope: str | None
    name: Name
    parameters: tuple[ParameterDeclaration | OptionalGroup | Placeholder, ...]
    body: Body
    backward: Body | None
    error: ErrorHandler | None
    undo: Body | None
    header_end: int
    """Offset just past the header, where the body begins."""
    parentheses_missing: bool
    """Lenient: `PROC name` without `()`."""

    def take_body(self, edited: RoutineNode) -> None:
        """Take the body and the clauses of a routine that has the same header.

        The only change of a tree: everything that refers to a routine whose text is edited, such
        as its symbol, stays valid.
        """
        for name in ("end", "body", "backward", "error", "undo"):
            object.__setattr__(self, name, getattr(edited, name))


@node
class Proc(RoutineNode):
    """PROC."""


@node
class Func(RoutineNode):
    """FUNC with the type of its result."""

    type: Name


@node
class Trap(RoutineNode):
    """TRAP."""


Routine: TypeAlias = Proc | Func | Trap
Item: TypeAlias = (
    RecordType | AliasType | Data | Proc | Func | Trap | InvalidStatement | Placeholder
)


@keeping_node
class Module(Node):
    """One module with everything in it."""

    source: Source
    name: Name
    attributes: tuple[Name, ...]
    items: tuple[Item, ...]
    runs: tuple[BulkStatements, ...] = ()
    """Bulk statements outside the tree, each represented by one in it; in source order."""

    def span(self, node: Node) -> Span:
        """Return the span of a node of this module."""
        return Span(self.source, node.start, node.end)

    @cached_property
    def routines(self) -> tuple[Routine, ...]:
        """The routines, in order."""
        return tuple(item for item in self.items if isinstance(item, Proc | Func | Trap))

    def take_items(self, items: tuple[Item, ...]) -> None:
        """Take other items after the text of some was edited; see `RoutineNode.take_body`."""
        object.__setattr__(self, "items", items)
        vars(self).pop("routines", None)


@value_class(frozen=True, slots=True)
class Comment:
    """A comment from `!` to the end of its line, kept outside the tree for tools."""

    start: int
    text: str


@value_class(frozen=True, slots=True, repr=False)
class File:
    """Contents of a file: its modules (several are allowed) and its comments."""

    source: Source
    modules: tuple[Module, ...]
    comments: tuple[Comment, ...]

    def __repr__(self) -> str:
        """Short form, because a tree is long."""
        return f"<tree of {self.source!r}>"
