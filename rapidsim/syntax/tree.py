"""The syntax tree: what a module says, nothing about what it means.

Nodes are values: frozen, compared by identity, so that analysis can key its side tables with them.
Each node knows its first and one-past-last character offset in the module's source; the optional
extra offsets name the places that messages point at. Names keep the case they were written in.
A statement or declaration ends before its semicolon.

The parser accepts more than RAPID allows; fields marked *lenient* record what was written so that
analysis can reject it with a better message than a parser could give.

Source: Technical reference manual RAPID Kernel, the syntax chapters.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

from rapidsim.diagnostics import Source, Span


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


# --- expressions


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

    array: Path
    indices: tuple[Expression, ...]


@dataclass(frozen=True, eq=False, slots=True)
class Component(Node):
    """A component of a record: `p.trans`."""

    record: Path
    name: Name


Path: TypeAlias = Reference | Index | Component


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


# --- arguments


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


# --- statements


@dataclass(frozen=True, eq=False, slots=True)
class Assignment(Node):
    """`target := value;`"""

    target: Path | Placeholder
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

    interrupt: Path | Placeholder
    trap: Name | Expression


@dataclass(frozen=True, eq=False, slots=True)
class Empty(Node):
    """A lone semicolon."""


@dataclass(frozen=True, eq=False, slots=True)
class Broken(Node):
    """A stretch of text the parser could not read; its diagnostic has been made."""


@dataclass(frozen=True, eq=False, slots=True)
class Run(Node):
    """Consecutive statements of one shape that differ only in numbers: generated paths.

    `template` is the first of them in full; row k of `rows` holds the numbers of statement k at the
    template's literals in order of writing, flattened.
    """

    template: Call
    rows: tuple[tuple[float, ...], ...]
    starts: tuple[int, ...]
    """Offset of each statement."""


# --- declarations


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
    | Run
    | Data
)
Body: TypeAlias = tuple[Statement, ...]


@dataclass(frozen=True, eq=False, slots=True)
class Field(Node):
    """One component of a RECORD declaration."""

    type: Name
    name: Name
    dimensions: tuple[Expression, ...] = ()
    """Lenient: components cannot be arrays."""


@dataclass(frozen=True, eq=False, slots=True)
class RecordType(Node):
    """RECORD ... ENDRECORD."""

    scope: str | None
    name: Name
    components: tuple[Field | Placeholder, ...]


@dataclass(frozen=True, eq=False, slots=True)
class AliasType(Node):
    """`ALIAS type name;`"""

    scope: str | None
    type: Name
    name: Name


@dataclass(frozen=True, eq=False, slots=True)
class Parameter(Node):
    """One parameter; `mode` is "IN", "INOUT", "VAR", "PERS" or "REF", `dimensions` its stars."""

    mode: str
    type: Name
    name: Name
    dimensions: int = 0


@dataclass(frozen=True, eq=False, slots=True)
class OptionalGroup(Node):
    r"""`\a | b`: optional parameters of which at most one is given."""

    alternatives: tuple[Parameter, ...]


@dataclass(frozen=True, eq=False, slots=True)
class ErrorHandler(Node):
    """The ERROR clause; `numbers` is the list of a long-jump handler."""

    numbers: tuple[Expression, ...] | None
    body: Body


@dataclass(frozen=True, eq=False, slots=True)
class RoutineNode(Node):
    """What PROC, FUNC and TRAP share."""

    scope: str | None
    name: Name
    parameters: tuple[Parameter | OptionalGroup | Placeholder, ...]
    body: Body
    backward: Body | None
    error: ErrorHandler | None
    undo: Body | None
    header_end: int
    """Offset just past the header, where the body begins."""
    parentheses_missing: bool
    """Lenient: `PROC name` without `()`."""


@dataclass(frozen=True, eq=False, slots=True)
class Proc(RoutineNode):
    """PROC."""


@dataclass(frozen=True, eq=False, slots=True)
class Func(RoutineNode):
    """FUNC with the type of its result."""

    type: Name


@dataclass(frozen=True, eq=False, slots=True)
class Trap(RoutineNode):
    """TRAP."""


Routine: TypeAlias = Proc | Func | Trap
Item: TypeAlias = RecordType | AliasType | Data | Proc | Func | Trap | Broken | Placeholder


@dataclass(frozen=True, eq=False)
class Module(Node):
    """One module with everything in it."""

    source: Source
    name: Name
    attributes: tuple[Name, ...]
    items: tuple[Item, ...]

    def span(self, node: Node) -> Span:
        """The place of a node of this module."""
        return Span(self.source, node.start, node.end)

    @cached_property
    def routines(self) -> tuple[Routine, ...]:
        """The routines, in order."""
        return tuple(item for item in self.items if isinstance(item, Proc | Func | Trap))


@dataclass(frozen=True, slots=True)
class Comment:
    """A comment from `!` to the end of its line, kept beside the tree for tools."""

    start: int
    text: str


@dataclass(frozen=True, slots=True)
class File:
    """What a file holds: its modules (several are allowed) and its comments."""

    source: Source
    modules: tuple[Module, ...]
    comments: tuple[Comment, ...]
