"""Nodes of expressions, and of the arguments that calls take."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias, TypeVar, dataclass_transform

T = TypeVar("T")


@dataclass_transform(eq_default=False, frozen_default=True)
def node(cls: type[T]) -> type[T]:
    """Define a kind of node as a dataclass without comparison.

    Nodes are not modified, which mypy checks; enforcing it at run time would take longer than all
    other work of creating a node, and there are fifty kinds and as many nodes as words.
    """
    return dataclass(eq=False, repr=False, slots=True)(cls)


@dataclass_transform(eq_default=False, frozen_default=True)
def keeping_node(cls: type[T]) -> type[T]:
    """Define a kind of node that caches derived values."""
    return dataclass(eq=False, repr=False)(cls)


@node
class Node:
    """Node of the tree with character offsets in the source, `end` exclusive."""

    start: int
    end: int

    def __repr__(self) -> str:
        """Kind and offsets."""
        return f"<{type(self).__name__} {self.start}:{self.end}>"


@node
class Name(Node):
    """An identifier at its position; `key` is its form for comparisons."""

    text: str

    @property
    def key(self) -> str:
        """The folded name."""
        return self.text.lower()


@node
class NumberLiteral(Node):
    """A numeric literal; the text is kept: `9E+09`, `0x1F`, `.5`."""

    text: str
    value: float


@node
class StringLiteral(Node):
    """A string literal with its escapes resolved."""

    value: str


@node
class BoolLiteral(Node):
    """TRUE or FALSE."""

    value: bool


@node
class DataReference(Node):
    """Data, by name only."""

    name: Name


@node
class Index(Node):
    """An element of an array: `a{i}`, `a{i,j}`."""

    array: DataPath
    indices: tuple[Expression, ...]


@node
class ComponentAccess(Node):
    """A component of a record: `p.trans`."""

    record: DataPath
    name: Name


DataPath: TypeAlias = DataReference | Index | ComponentAccess


@node
class FunctionCall(Node):
    """A function call in an expression."""

    name: Name
    arguments: tuple[Argument, ...]


@node
class LateFunctionCall(Node):
    """Lenient: `%"name"%(...)` as an operand, which RAPID does not have."""

    routine: Expression
    arguments: tuple[Argument, ...]


@node
class Aggregate(Node):
    """`[a, b, c]`: a record or an array, depending on its context."""

    elements: tuple[Expression, ...]


LiteralValue: TypeAlias = "float | str | bool | tuple[LiteralValue, ...]"


@node
class LiteralAggregate(Node):
    """An aggregate of literals only, kept as one value without a node per number."""

    value: tuple[LiteralValue, ...]


@node
class Unary(Node):
    """`-x`, `+x`, `NOT x`; the operator is folded to upper case."""

    operator: str
    operand: Expression
    not_after_operator: bool = False
    """Lenient: a sign or NOT where the strict grammar has none, as in `x * -2`."""


@node
class Binary(Node):
    """Two operands and an operator, folded to upper case: `+`, `<>`, `DIV`, `AND`."""

    left: Expression
    operator: str
    operator_start: int
    right: Expression


@node
class Parenthesised(Node):
    """`(x)`, kept because `P (x);` means a call with one argument."""

    inner: Expression


@node
class Placeholder(Node):
    """Unfinished code such as `<EXP>`; `kind` is the word inside."""

    kind: str


Expression: TypeAlias = (
    NumberLiteral
    | StringLiteral
    | BoolLiteral
    | DataReference
    | Index
    | ComponentAccess
    | FunctionCall
    | LateFunctionCall
    | Aggregate
    | LiteralAggregate
    | Unary
    | Binary
    | Parenthesised
    | Placeholder
)


@node
class RequiredArgument(Node):
    """A required argument, positional or named (`Par := x`)."""

    value: Expression
    name: Name | None = None


@node
class OptionalArgument(Node):
    r"""An optional argument: `\Par := x`, or a switch `\Par`."""

    name: Name
    value: Expression | None


@node
class ConditionalArgument(Node):
    r"""`\Par?q`: pass \Par if the caller's own optional parameter q is present."""

    name: Name
    present: Name


Argument: TypeAlias = RequiredArgument | OptionalArgument | ConditionalArgument
