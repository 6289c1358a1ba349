"""Nodes of expressions, and of the arguments that calls take."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias


@dataclass(frozen=True, eq=False, slots=True)
class Node:
    """Anything with a place: character offsets in the source, `end` exclusive."""

    start: int
    end: int


@dataclass(frozen=True, eq=False, slots=True)
class Name(Node):
    """An identifier where it is written; `key` is how it compares."""

    text: str

    @property
    def key(self) -> str:
        """The folded name."""
        return self.text.lower()


@dataclass(frozen=True, eq=False, slots=True)
class Number(Node):
    """A numeric literal; the text is kept: `9E+09`, `0x1F`, `.5`."""

    text: str
    value: float


@dataclass(frozen=True, eq=False, slots=True)
class String(Node):
    """A string literal with its escapes resolved."""

    value: str


@dataclass(frozen=True, eq=False, slots=True)
class Bool(Node):
    """TRUE or FALSE."""

    value: bool


@dataclass(frozen=True, eq=False, slots=True)
class Reference(Node):
    """Data, by name alone."""

    name: Name


@dataclass(frozen=True, eq=False, slots=True)
class Index(Node):
    """An element of an array: `a{i}`, `a{i,j}`."""

    array: DataPath
    indices: tuple[Expression, ...]


@dataclass(frozen=True, eq=False, slots=True)
class Component(Node):
    """A component of a record: `p.trans`."""

    record: DataPath
    name: Name


DataPath: TypeAlias = Reference | Index | Component


@dataclass(frozen=True, eq=False, slots=True)
class FunctionCall(Node):
    """A function call in an expression."""

    name: Name
    arguments: tuple[Argument, ...]


@dataclass(frozen=True, eq=False, slots=True)
class LateFunctionCall(Node):
    """Lenient: `%"name"%(...)` as an operand, which RAPID does not have."""

    routine: Expression
    arguments: tuple[Argument, ...]


@dataclass(frozen=True, eq=False, slots=True)
class Aggregate(Node):
    """`[a, b, c]`: a record or an array, told by its context."""

    elements: tuple[Expression, ...]


LiteralValue: TypeAlias = "float | str | bool | tuple[LiteralValue, ...]"


@dataclass(frozen=True, eq=False, slots=True)
class LiteralAggregate(Node):
    """An aggregate of literals only, kept as one value without a node per number."""

    value: tuple[LiteralValue, ...]


@dataclass(frozen=True, eq=False, slots=True)
class Unary(Node):
    """`-x`, `+x`, `NOT x`; the operator is folded to upper case."""

    operator: str
    operand: Expression
    not_after_operator: bool = False
    """Lenient: a sign or NOT where the strict grammar has none, as in `x * -2`."""


@dataclass(frozen=True, eq=False, slots=True)
class Binary(Node):
    """Two operands and an operator, folded to upper case: `+`, `<>`, `DIV`, `AND`."""

    left: Expression
    operator: str
    operator_start: int
    right: Expression


@dataclass(frozen=True, eq=False, slots=True)
class Parenthesised(Node):
    """`(x)`, kept because `P (x);` means a call with one argument."""

    inner: Expression


@dataclass(frozen=True, eq=False, slots=True)
class Placeholder(Node):
    """Unfinished code such as `<EXP>`; `kind` is the word inside."""

    kind: str


Expression: TypeAlias = (
    Number
    | String
    | Bool
    | Reference
    | Index
    | Component
    | FunctionCall
    | LateFunctionCall
    | Aggregate
    | LiteralAggregate
    | Unary
    | Binary
    | Parenthesised
    | Placeholder
)


@dataclass(frozen=True, eq=False, slots=True)
class Required(Node):
    """A required argument, positional or named (`Par := x`)."""

    value: Expression
    name: Name | None = None


@dataclass(frozen=True, eq=False, slots=True)
class Optional(Node):
    r"""An optional argument: `\Par := x`, or a switch `\Par`."""

    name: Name
    value: Expression | None


@dataclass(frozen=True, eq=False, slots=True)
class Conditional(Node):
    r"""`\Par?q`: pass \Par if the caller's own optional parameter q is present."""

    name: Name
    present: Name


Argument: TypeAlias = Required | Optional | Conditional
