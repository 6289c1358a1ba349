"""Nodes of statements, data declarations among them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from rapidsim.syntax.tree.expressions import Argument, DataPath, Expression, Name, Node, Placeholder


@dataclass(frozen=True, eq=False, slots=True)
class Assignment(Node):
    """`target := value;`"""

    target: DataPath | Placeholder
    value: Expression
    operator_start: int
    equals_sign: bool = False
    """Lenient: `=` was written for `:=`."""


@dataclass(frozen=True, eq=False, slots=True)
class Call(Node):
    """A procedure or instruction call."""

    name: Name
    arguments: tuple[Argument, ...]
    in_parentheses: bool = False
    """Lenient: `P(a, b);`"""


@dataclass(frozen=True, eq=False, slots=True)
class LateCall(Node):
    """`%"name" + x% args;`"""

    routine: Expression
    arguments: tuple[Argument, ...]


@dataclass(frozen=True, eq=False, slots=True)
class Branch(Node):
    """One condition of an IF with its statements."""

    condition: Expression
    body: Body
    then_missing: bool = False
    """Lenient: ELSEIF without THEN."""


@dataclass(frozen=True, eq=False, slots=True)
class If(Node):
    """IF with its ELSEIF branches and ELSE."""

    branches: tuple[Branch, ...]
    otherwise: Body | None


@dataclass(frozen=True, eq=False, slots=True)
class CompactIf(Node):
    """`IF c statement;`"""

    condition: Expression
    statement: Statement


@dataclass(frozen=True, eq=False, slots=True)
class For(Node):
    """FOR with its own read-only counter."""

    counter: Name
    first: Expression
    last: Expression
    step: Expression | None
    body: Body


@dataclass(frozen=True, eq=False, slots=True)
class While(Node):
    """WHILE."""

    condition: Expression
    body: Body
    do_missing: bool = False
    """Lenient: WHILE without DO."""


@dataclass(frozen=True, eq=False, slots=True)
class Case(Node):
    """One CASE of a TEST with its values."""

    values: tuple[Expression, ...]
    body: Body
    range_to: Expression | None = None
    """Lenient: `CASE 1 TO 5`, which RAPID does not have."""


@dataclass(frozen=True, eq=False, slots=True)
class Test(Node):
    """TEST with its cases and DEFAULT."""

    subject: Expression
    cases: tuple[Case, ...]
    default: Body | None


@dataclass(frozen=True, eq=False, slots=True)
class Label(Node):
    """`name:`"""

    name: Name


@dataclass(frozen=True, eq=False, slots=True)
class Goto(Node):
    """`GOTO name;`"""

    name: Name


@dataclass(frozen=True, eq=False, slots=True)
class Return(Node):
    """RETURN, with a value in a function."""

    value: Expression | None


@dataclass(frozen=True, eq=False, slots=True)
class Raise(Node):
    """RAISE, with an error number outside handlers."""

    number: Expression | None


@dataclass(frozen=True, eq=False, slots=True)
class Exit(Node):
    """EXIT."""


@dataclass(frozen=True, eq=False, slots=True)
class Retry(Node):
    """RETRY."""


@dataclass(frozen=True, eq=False, slots=True)
class TryNext(Node):
    """TRYNEXT."""


@dataclass(frozen=True, eq=False, slots=True)
class Connect(Node):
    """`CONNECT interrupt WITH trap;`; the trap may be late bound."""

    interrupt: DataPath | Placeholder
    trap: Name | Expression


@dataclass(frozen=True, eq=False, slots=True)
class Empty(Node):
    """A lone semicolon."""


@dataclass(frozen=True, eq=False, slots=True)
class Broken(Node):
    """A stretch of text the parser could not read; its diagnostic has been made."""


@dataclass(frozen=True, eq=False, slots=True)
class Data(Node):
    """A data declaration. `scope` is "LOCAL", "TASK" or None; `storage` VAR, PERS or CONST."""

    scope: str | None
    storage: str
    type: Name
    name: Name
    dimensions: tuple[Expression, ...]
    value: Expression | None
    equals_sign: bool = False
    """Lenient: `=` was written for `:=`."""


Statement: TypeAlias = (
    Assignment
    | Call
    | LateCall
    | If
    | CompactIf
    | For
    | While
    | Test
    | Label
    | Goto
    | Return
    | Raise
    | Exit
    | Retry
    | TryNext
    | Connect
    | Empty
    | Broken
    | Placeholder
    | Data
)
Body: TypeAlias = tuple[Statement, ...]
