"""One function for each rule of the grammar: from the rule's children to a node of the tree.

Every function takes the offsets of the first and past the last character, then the children in the
order of the grammar. If these are the fields of a node in order, the node's class itself is the
function. Words and marks that the grammar keeps are passed as `tree.Name`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias, TypeVar

from rapidsim.diagnostics import Source
from rapidsim.syntax import tree

Build: TypeAlias = Callable[..., Any]
"""Signature `build(start, end, *children)`; the grammar defines the children."""

T = TypeVar("T")
Dimensions: TypeAlias = "tuple[tree.Expression, ...] | None"
Clause: TypeAlias = "tuple[str, tree.Node, tree.Body | tree.ErrorHandler]"
Parameters: TypeAlias = (
    "tuple[tree.ParameterDeclaration | tree.OptionalGroup | tree.Placeholder, ...]"
)


class Head(NamedTuple):
    """The head of a routine; `type` is None unless it is a function."""

    end: int
    scope: str | None
    type: tree.Name | None
    name: tree.Name
    parameters: Parameters
    parentheses_missing: bool


def _children(start: int, end: int, *children: T) -> tuple[T, ...]:
    """A list rule: its value is its children."""
    return children


class Builder:
    """Builds the modules of one source, and records facts that are known only while building."""

    def __init__(self, source: Source) -> None:
        """Build nodes of a source."""
        self.source = source
        self.text = source.text
        self.line_end = "\n" if "\n" in source.text else "\r"
        self.cut_calls: list[int] = []
        """Offsets of arguments that must be statements: the semicolon before them is missing."""
        self.repeated_clauses: list[tuple[str, tree.Node]] = []
        """Second ERROR, UNDO and BACKWARD clauses, by keyword."""

    # --- modules and declarations

    def module(
        self,
        start: int,
        end: int,
        name: tree.Name,
        attributes: tuple[tree.Name, ...] | None,
        items: tuple[tree.Item, ...],
    ) -> tree.Module:
        """MODULE."""
        return tree.Module(start, end, self.source, name, attributes or (), items)

    def record(self, start: int, end: int, local: tree.Name | None, *parts: Any) -> tree.RecordType:
        """RECORD."""
        return tree.RecordType(start, end, _word(local), *parts)

    def field(
        self, start: int, end: int, type: tree.Name, name: tree.Name, dimensions: Dimensions
    ) -> tree.ComponentDeclaration:
        """A component of a record."""
        return tree.ComponentDeclaration(start, end, type, name, dimensions or ())

    def alias(self, start: int, end: int, local: tree.Name | None, *names: tree.Name) -> tree.Node:
        """ALIAS."""
        return tree.AliasType(start, end, _word(local), *names)

    def data(
        self,
        start: int,
        end: int,
        scope: tree.Name | None,
        storage: tree.Name,
        type: tree.Name,
        name: tree.Name,
        dimensions: Dimensions,
        value: tree.Expression | None,
        *,
        equals_sign: bool = False,
    ) -> tree.Data:
        """A data declaration."""
        kept = storage.text.upper()
        return tree.Data(
            start, end, _word(scope), kept, type, name, dimensions or (), value, equals_sign
        )

    def data_equals(self, *parts: Any) -> tree.Data:
        """A data declaration with `=` for `:=`."""
        return self.data(*parts, equals_sign=True)

    # --- routines

    def proc_head(
        self,
        start: int,
        end: int,
        local: tree.Name | None,
        name: tree.Name,
        parameters: Parameters | None,
    ) -> Head:
        """PROC up to its body."""
        return Head(end, _word(local), None, name, parameters or (), parameters is None)

    def func_head(
        self,
        start: int,
        end: int,
        local: tree.Name | None,
        type: tree.Name,
        name: tree.Name,
        parameters: Parameters | None,
    ) -> Head:
        """FUNC up to its body."""
        return Head(end, _word(local), type, name, parameters or (), parameters is None)

    def trap_head(self, start: int, end: int, local: tree.Name | None, name: tree.Name) -> Head:
        """TRAP up to its body."""
        return Head(end, _word(local), None, name, (), False)

    def proc(
        self, start: int, end: int, head: Head, body: tree.Body, clauses: tuple[Clause, ...]
    ) -> tree.Proc:
        """PROC."""
        return tree.Proc(start, end, *self._routine(head, body, clauses))

    def func(
        self, start: int, end: int, head: Head, body: tree.Body, clauses: tuple[Clause, ...]
    ) -> tree.Func:
        """FUNC."""
        assert head.type is not None
        fields = (*self._routine(head, body, clauses), head.type)
        return tree.Func(start, end, *fields)

    def trap(
        self, start: int, end: int, head: Head, body: tree.Body, clauses: tuple[Clause, ...]
    ) -> tree.Trap:
        """TRAP."""
        return tree.Trap(start, end, *self._routine(head, body, clauses))

    def _routine(self, head: Head, body: tree.Body, clauses: tuple[Clause, ...]) -> tuple[Any, ...]:
        """Return the fields of a `tree.RoutineNode` after its offsets."""
        found: dict[str, Any] = {}
        for keyword, place, clause in clauses:
            if keyword in found:
                self.repeated_clauses.append((keyword, place))
            else:
                found[keyword] = clause
        return (
            head.scope,
            head.name,
            head.parameters,
            body,
            found.get("BACKWARD"),
            found.get("ERROR"),
            found.get("UNDO"),
            head.end,
            head.parentheses_missing,
        )

    def backward(self, start: int, end: int, body: tree.Body) -> Clause:
        """The BACKWARD clause."""
        return "BACKWARD", tree.Node(start, end), body

    def undo(self, start: int, end: int, body: tree.Body) -> Clause:
        """The UNDO clause."""
        return "UNDO", tree.Node(start, end), body

    def error(self, start: int, end: int, body: tree.Body) -> Clause:
        """The ERROR clause."""
        return "ERROR", tree.Node(start, end), tree.ErrorHandler(start, end, None, body)

    def error_long_jump(
        self, start: int, end: int, numbers: tuple[tree.Expression, ...], body: tree.Body
    ) -> Clause:
        """The ERROR clause with a list of error numbers."""
        return "ERROR", tree.Node(start, end), tree.ErrorHandler(start, end, numbers, body)

    def parameters(
        self, start: int, end: int, *parts: tree.ParameterDeclaration | tree.OptionalGroup | None
    ) -> tuple[tree.ParameterDeclaration | tree.OptionalGroup, ...]:
        """A parameter list in its parentheses; its only part is None if it is empty."""
        return tuple(part for part in parts if part is not None)

    def parameter(
        self,
        start: int,
        end: int,
        mode: tree.Name | None,
        type: tree.Name,
        name: tree.Name,
        stars: tuple[tree.Name, ...] | None,
    ) -> tree.ParameterDeclaration:
        """One parameter."""
        return tree.ParameterDeclaration(
            start, end, _word(mode) or "IN", type, name, len(stars or ())
        )

    def optional_group(
        self, start: int, end: int, *alternatives: tree.ParameterDeclaration | tree.Placeholder
    ) -> tree.OptionalGroup:
        """Optional parameters that exclude each other."""
        return tree.OptionalGroup(start, end, alternatives)

    def placeholder(self, start: int, end: int, placeholder: tree.Placeholder) -> tree.Placeholder:
        """A placeholder if an alias hides the terminal."""
        return placeholder

    # --- statements

    def assignment(
        self,
        start: int,
        end: int,
        target: tree.DataPath | tree.Placeholder,
        becomes: tree.Name,
        value: tree.Expression,
    ) -> tree.Assignment:
        """`:=`."""
        return tree.Assignment(start, end, target, value, becomes.start)

    def assignment_equals(
        self,
        start: int,
        end: int,
        target: tree.DataPath | tree.Placeholder,
        equal: tree.Name,
        value: tree.Expression,
    ) -> tree.Assignment:
        """`=` for `:=`."""
        return tree.Assignment(start, end, target, value, equal.start, True)

    def call(
        self, start: int, end: int, name: tree.Name, arguments: tuple[tree.Argument, ...] | None
    ) -> tree.Call:
        """A procedure call."""
        if arguments is None:
            return tree.Call(start, end, name, ())
        first = arguments[0]
        if (
            first.start > name.end
            and type(first) is tree.RequiredArgument
            and self.text.find(self.line_end, name.end, first.start) >= 0
            # A call that continues on the next line is indented there.
            and self._indent(first.start) <= self._indent(start)
            and _may_be_a_statement(first, arguments[1:])
        ):
            self.cut_calls.append(first.start)
        return tree.Call(start, end, name, arguments)

    def _indent(self, at: int) -> int:
        """Number of blanks at the beginning of the line of an offset."""
        begin = self.text.rfind(self.line_end, 0, at) + 1
        line = self.text[begin : at + 1]
        return len(line) - len(line.lstrip())

    def call_in_parentheses(
        self,
        start: int,
        end: int,
        name: tree.Name,
        arguments: tuple[tree.Argument, ...] = (),
    ) -> tree.Call:
        """A procedure call with its list in parentheses."""
        return tree.Call(start, end, name, arguments, True)

    def late_call(
        self,
        start: int,
        end: int,
        routine: tree.Expression,
        arguments: tuple[tree.Argument, ...] | None,
    ) -> tree.LateCall:
        """A procedure call by name at run time."""
        return tree.LateCall(start, end, routine, arguments or ())

    def if_(
        self,
        start: int,
        end: int,
        first: tree.Branch,
        more: tuple[tree.Branch, ...],
        else_body: tree.Body | None,
    ) -> tree.If:
        """IF."""
        return tree.If(start, end, (first, *more), else_body)

    def branch_without_then(
        self, start: int, end: int, condition: tree.Expression, body: tree.Body
    ) -> tree.Branch:
        """ELSEIF without THEN."""
        return tree.Branch(start, end, condition, body, True)

    def branch_placeholder(self, start: int, end: int, gap: tree.Placeholder) -> tree.Branch:
        """`<EIT>`."""
        return tree.Branch(start, end, gap, ())

    def while_without_do(
        self, start: int, end: int, condition: tree.Expression, body: tree.Body
    ) -> tree.While:
        """WHILE without DO."""
        return tree.While(start, end, condition, body, True)

    def case_range(
        self,
        start: int,
        end: int,
        first: tree.Expression,
        last: tree.Expression,
        body: tree.Body,
    ) -> tree.Case:
        """`CASE 1 TO 5:`."""
        return tree.Case(start, end, (first,), body, last)

    def case_placeholder(self, start: int, end: int, gap: tree.Placeholder) -> tree.Case:
        """`<CSE>`."""
        return tree.Case(start, end, (gap,), ())

    # --- arguments

    def named(
        self, start: int, end: int, name: tree.Name, value: tree.Expression
    ) -> tree.RequiredArgument:
        """`Par := x`."""
        return tree.RequiredArgument(start, end, value, name)

    def star(self, start: int, end: int, mark: tree.Name) -> tree.RequiredArgument:
        """`*`, a target that is not taught yet."""
        return tree.RequiredArgument(start, end, tree.Placeholder(start, end, "*"))

    def function_call(
        self, start: int, end: int, name: tree.Name, arguments: tuple[tree.Argument, ...] | None
    ) -> tree.FunctionCall:
        """A function call."""
        return tree.FunctionCall(start, end, name, arguments or ())

    def late_function_call(
        self,
        start: int,
        end: int,
        routine: tree.Expression,
        arguments: tuple[tree.Argument, ...] | None,
    ) -> tree.LateFunctionCall:
        """A function call by name at run time."""
        return tree.LateFunctionCall(start, end, routine, arguments or ())

    # --- expressions

    def unary(
        self, start: int, end: int, operator: tree.Name, operand: tree.Expression
    ) -> tree.Unary:
        """A sign or NOT."""
        return tree.Unary(start, end, operator.text.upper(), operand)

    def unary_inside(
        self, start: int, end: int, operator: tree.Name, operand: tree.Expression
    ) -> tree.Unary:
        """A sign or NOT where the strict grammar has none."""
        return tree.Unary(start, end, operator.text.upper(), operand, True)

    def binary(
        self,
        start: int,
        end: int,
        left: tree.Expression,
        operator: tree.Name,
        right: tree.Expression,
    ) -> tree.Binary:
        """Two operands."""
        return tree.Binary(start, end, left, operator.text.upper(), operator.start, right)

    def aggregate(
        self, start: int, end: int, elements: tuple[tree.Expression, ...] | None
    ) -> tree.Aggregate | tree.LiteralAggregate:
        """An aggregate that the lexer did not recognise as one of literals.

        It may be one nevertheless: deeply nested, or with a comment in it.
        """
        values = tuple(_literal_value(element) for element in elements or ())
        literal = tuple(value for value in values if value is not None)
        if literal and len(literal) == len(values):
            return tree.LiteralAggregate(start, end, literal)
        return tree.Aggregate(start, end, elements or ())

    # --- rules whose children are the fields of a node, in order

    branch = tree.Branch
    compact_if = tree.CompactIf
    component = tree.ComponentAccess
    conditional = tree.ConditionalArgument
    connect = tree.Connect
    case = tree.Case
    empty = tree.Empty
    exit = tree.Exit
    for_ = tree.For
    goto = tree.Goto
    index = tree.Index
    label = tree.Label
    optional = tree.OptionalArgument
    parenthesised = tree.Parenthesised
    positional = tree.RequiredArgument
    raise_ = tree.Raise
    reference = tree.DataReference
    retry = tree.Retry
    return_ = tree.Return
    test = tree.Test
    trynext = tree.TryNext
    while_ = tree.While

    # --- lists

    arguments = staticmethod(_children)
    attributes = staticmethod(_children)
    body = staticmethod(_children)
    cases = staticmethod(_children)
    clauses = staticmethod(_children)
    dimensions = staticmethod(_children)
    elements = staticmethod(_children)
    elseif_branches = staticmethod(_children)
    fields = staticmethod(_children)
    file = staticmethod(_children)
    indices = staticmethod(_children)
    items = staticmethod(_children)
    numbers = staticmethod(_children)
    parenthesised_list = staticmethod(_children)
    stars = staticmethod(_children)
    values = staticmethod(_children)


def _word(word: tree.Name | None) -> str | None:
    return word.text.upper() if word else None


def _may_be_a_statement(
    first: tree.RequiredArgument, other_arguments: tuple[tree.Argument, ...]
) -> bool:
    r"""Whether an argument list alone on its line reads as an assignment or a call.

    `Stop` above `x:=1;` is a call with a named argument to the grammar, `Stop` above `Home\Fast;`
    one with two arguments; to the programmer each is two statements.
    """
    if first.name is not None:
        return not other_arguments
    return type(first.value) is tree.DataReference and not any(
        type(other) is tree.RequiredArgument for other in other_arguments
    )


def _literal_value(element: tree.Expression) -> tree.LiteralValue | None:
    match element:
        case (
            tree.NumberLiteral()
            | tree.StringLiteral()
            | tree.BoolLiteral()
            | tree.LiteralAggregate()
        ):
            return element.value
        case tree.Unary(operator="-", operand=tree.NumberLiteral(value=value)):
            return -value
        case tree.Unary(operator="+", operand=tree.NumberLiteral(value=value)):
            return value
        case _:
            return None
