"""Nodes of statements, data declarations among them."""

from __future__ import annotations

from typing import TypeAlias

from rapidsim.syntax.tree.expressions import (
    Argument,
    DataPath,
    Expression,
    Name,
    Node,
    Placeholder,
    node,
)


@node
class Assignment(Node):
    """`target := value;`"""

    target: DataPath | Placeholder
    value: Expression
    operator_start: int
    equals_sign: bool = False
    """Lenient: `=` instead of `:=`."""


@node
class Call(Node):
    """A procedure or instruction call."""

    name: Name
    arguments: tuple[Argument, ...]
    in_parentheses: bool = False
    """Lenient: `P(a, b);`"""


@node
class LateCall(Node):
    """`%"name" + x% args;`"""

    routine: Expression
    arguments: tuple[Argument, ...]


@node
class Branch(Node):
    """One condition of an IF with its statements."""

    condition: Expression
    body: Body
    then_missing: bool = False
    """Lenient: ELSEIF without THEN."""


@node
class If(Node):
    """IF with its ELSEIF branches and ELSE."""

    branches: tuple[Branch, ...]
    otherwise: Body | None


@node
class CompactIf(Node):
    """`IF c statement;`"""

    condition: Expression
    statement: Statement


@node
class For(Node):
    """FOR with its read-only counter."""

    counter: Name
    first: Expression
    last: Expression
    step: Expression | None
    body: Body


@node
class While(Node):
    """WHILE."""

    condition: Expression
    body: Body
    do_missing: bool = False
    """Lenient: WHILE without DO."""


@node
class Case(Node):
    """One CASE of a TEST with its values."""

    values: tuple[Expression, ...]
    body: Body
    range_to: Expression | None = None
    """Lenient: `CASE 1 TO 5`, which RAPID does not have."""


@node
class Test(Node):
    """TEST with its cases and DEFAULT."""

    subject: Expression
    cases: tuple[Case, ...]
    default: Body | None


@node
class Label(Node):
    """`name:`"""

    name: Name


@node
class Goto(Node):
    """`GOTO name;`"""

    name: Name


@node
class Return(Node):
    """RETURN, with a value in a function."""

    value: Expression | None


@node
class Raise(Node):
    """RAISE, with an error number outside handlers."""

    number: Expression | None


@node
class Exit(Node):
    """EXIT."""


@node
class Retry(Node):
    """RETRY."""


@node
class TryNext(Node):
    """TRYNEXT."""


@node
class Connect(Node):
    """`CONNECT interrupt WITH trap;`; the trap may be late bound."""

    interrupt: DataPath | Placeholder
    trap: Name | Expression


@node
class Empty(Node):
    """A lone semicolon."""


@node
class InvalidStatement(Node):
    """Text that the parser could not read; its diagnostic exists already."""


@node
class Data(Node):
    """A data declaration. `scope` is "LOCAL", "TASK" or None; `storage` VAR, PERS or CONST."""

    scope: str | None
    storage: str
    type: Name
    name: Name
    dimensions: tuple[Expression, ...]
    value: Expression | None
    equals_sign: bool = False
    """Lenient: `=` instead of `:=`."""

    def take_value(self, edited: Data) -> None:
        """Take the value of an equal declaration, as a routine takes a body."""
        for name in ("end", "value"):
            object.__setattr__(self, name, getattr(edited, name))


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
    | InvalidStatement
    | Placeholder
    | Data
)
Body: TypeAlias = tuple[Statement, ...]
