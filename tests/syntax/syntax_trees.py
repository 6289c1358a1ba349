"""Syntax trees out of thin air, as the parser would have made them, and how two compare.

Trees are drawn rule by rule of the grammar, so that each can be written down. What only damaged
text gives (`InvalidStatement`) is not drawn.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from typing import Protocol, TypeAlias, TypeVar

from hypothesis import strategies as st

from rapidsim.diagnostics import Source
from rapidsim.syntax import literals, tree

T = TypeVar("T")
Drawn: TypeAlias = tree.ParameterDeclaration | tree.OptionalGroup | tree.Placeholder

PLACES = {"start", "end", "source", "operator_start", "header_end"}
NAMES = ("x", "Count", "p10", "MoveL", "q_2", "größe", "E9", "Ex", "to1", "endif_", "f")
OPTIONS = ("V", "Conc", "To", "ERROR", "x")
TYPES = ("num", "robtarget", "Order")
NUMBERS = ("0", "1", "7.", ".5", "2.50", "9E+09", "1e-3", "0x1F", "0b101", "0o17")
EXPRESSION_DEPTH = 3
STATEMENT_DEPTH = 2
MOST = 3
"""Parts of a list."""

characters = st.characters(exclude_categories=["Cs"])
texts = st.text(characters, max_size=12)
# What a dnum holds; an infinity is written as a number that is too large, and reported.
numbers = st.floats(allow_nan=False, allow_infinity=False)


def shape(node: object) -> object:
    """A tree without places: comparable, because nodes themselves compare by identity."""
    if isinstance(node, tuple):
        return tuple(shape(part) for part in node)
    if isinstance(node, tree.Node):
        parts = [shape(getattr(node, f.name)) for f in fields(node) if f.name not in PLACES]
        return (type(node).__name__, *parts)
    return (type(node).__name__, node)


@st.composite
def modules(draw: st.DrawFn) -> tree.Module:
    """Any module."""
    return Drawing(Hypothesis(draw)).module()


class Choice(Protocol):
    """What decides what is drawn."""

    def of(self, values: Sequence[T]) -> T:
        """One of several values."""
        ...

    def literal(self) -> float | str | bool:
        """The value of a literal."""
        ...

    def text(self) -> str:
        """Any characters."""
        ...


@dataclass(frozen=True)
class Hypothesis:
    """Leaves the choice to Hypothesis, which looks for the simplest that fails."""

    draw: st.DrawFn

    def of(self, values: Sequence[T]) -> T:
        return self.draw(st.sampled_from(values))

    def literal(self) -> float | str | bool:
        return self.draw(st.one_of(numbers, texts, st.booleans()))

    def text(self) -> str:
        return self.draw(texts)


@dataclass
class Sequence64:
    """The same choices in every version of everything: a congruential sequence.

    Source: Knuth, The Art of Computer Programming, 3.3.4, the multiplier and increment of MMIX.
    """

    state: int = 1

    def of(self, values: Sequence[T]) -> T:
        self.state = (self.state * 6364136223846793005 + 1442695040888963407) % 2**64
        return values[(self.state >> 33) % len(values)]

    def literal(self) -> float | str | bool:
        values: tuple[float | str | bool, ...] = (0.0, -2.5, 9e9, "", "a", True, False)
        return self.of(values)

    def text(self) -> str:
        return self.of(("", "a", 'say "x"', "b\\c"))


@dataclass(frozen=True)
class Drawing:
    """Draws node after node; the depth that is left bounds what is inside."""

    choice: Choice

    def one(self, *makers: Callable[[], T]) -> T:
        """What one of several makes."""
        return self.choice.of(makers)()

    def of(self, values: Sequence[T]) -> T:
        """One of several values."""
        return self.choice.of(values)

    def some(self, make: Callable[[], T], least: int = 0) -> tuple[T, ...]:
        """Several of a kind."""
        return tuple(make() for _ in range(self.of(range(least, MOST + 1))))

    def maybe(self, make: Callable[[], T]) -> T | None:
        """One or none."""
        return make() if self.flag() else None

    def flag(self) -> bool:
        return self.of((False, True))

    def name(self, names: Sequence[str] = NAMES) -> tree.Name:
        return tree.Name(0, 0, self.of(names))

    def placeholder(self, *kinds: str) -> tree.Placeholder:
        return tree.Placeholder(0, 0, self.of(kinds))

    # --- expressions, loosest first, as in the grammar

    def expression(self, depth: int = EXPRESSION_DEPTH) -> tree.Expression:
        if depth and self.flag():
            return self.binary(self.expression, ("OR", "XOR"), self.disjunct, depth)
        return self.disjunct(depth)

    def disjunct(self, depth: int) -> tree.Expression:
        if depth and self.flag():
            return tree.Unary(0, 0, "NOT", self.conjunction(depth - 1))
        return self.conjunction(depth)

    def conjunction(self, depth: int) -> tree.Expression:
        if depth and self.flag():
            return self.binary(self.conjunction, ("AND",), self.conjunct, depth)
        return self.relation(depth)

    def conjunct(self, depth: int) -> tree.Expression:
        if depth and self.flag():
            return tree.Unary(0, 0, "NOT", self.conjunct(depth - 1), True)
        return self.relation(depth)

    def relation(self, depth: int) -> tree.Expression:
        if depth and self.flag():
            return self.binary(self.sum, ("=", "<>", "<", "<=", ">", ">="), self.sum, depth)
        return self.sum(depth)

    def sum(self, depth: int) -> tree.Expression:
        if depth and self.flag():
            if self.flag():
                return tree.Unary(0, 0, self.of("+-"), self.signed(depth - 1))
            return self.binary(self.sum, ("+", "-"), self.signed, depth)
        return self.product(depth)

    def signed(self, depth: int) -> tree.Expression:
        if depth and self.flag():
            return tree.Unary(0, 0, self.of("+-"), self.signed(depth - 1), True)
        return self.product(depth)

    def product(self, depth: int) -> tree.Expression:
        if depth and self.flag():
            return self.binary(self.product, ("*", "/", "DIV", "MOD"), self.factor, depth)
        return self.operand(depth)

    def factor(self, depth: int) -> tree.Expression:
        if depth and self.flag():
            return tree.Unary(0, 0, self.of("+-"), self.factor(depth - 1), True)
        return self.operand(depth)

    def binary(
        self,
        left: Callable[[int], tree.Expression],
        operators: Sequence[str],
        right: Callable[[int], tree.Expression],
        depth: int,
    ) -> tree.Binary:
        return tree.Binary(0, 0, left(depth - 1), self.of(operators), 0, right(depth - 1))

    def operand(self, depth: int) -> tree.Expression:
        leaves: list[Callable[[], tree.Expression]] = [
            self.number,
            self.string,
            self.boolean,
            self.reference,
        ]
        if not depth:
            return self.one(*leaves)
        inside = depth - 1
        makers: list[Callable[[], tree.Expression]] = [
            *leaves,
            lambda: self.path(depth),
            lambda: tree.FunctionCall(0, 0, self.name(), self.arguments(inside)),
            lambda: tree.LateFunctionCall(0, 0, self.expression(inside), self.arguments(inside)),
            lambda: tree.Parenthesised(0, 0, self.expression(inside)),
            lambda: self.aggregate(inside),
            lambda: tree.LiteralAggregate(0, 0, self.literals(inside)),
            lambda: self.placeholder("EXP", "DIM"),
        ]
        return self.one(*makers)

    def number(self) -> tree.NumberLiteral:
        text = self.of(NUMBERS)
        return tree.NumberLiteral(0, 0, text, literals.number(text))

    def string(self) -> tree.StringLiteral:
        return tree.StringLiteral(0, 0, self.choice.text())

    def boolean(self) -> tree.BoolLiteral:
        return tree.BoolLiteral(0, 0, self.flag())

    def reference(self) -> tree.DataReference:
        return tree.DataReference(0, 0, self.name())

    def path(self, depth: int) -> tree.DataPath:
        if not depth:
            return self.reference()
        inside = depth - 1
        makers: list[Callable[[], tree.DataPath]] = [
            self.reference,
            lambda: tree.Index(
                0, 0, self.path(inside), self.some(lambda: self.expression(inside), 1)
            ),
            lambda: tree.ComponentAccess(0, 0, self.path(inside), self.name()),
        ]
        return self.one(*makers)

    def aggregate(self, depth: int) -> tree.Aggregate:
        """With one element at least that is no literal, or none at all."""
        elements = self.some(lambda: self.expression(depth))
        return tree.Aggregate(0, 0, (*elements, self.reference()) if elements else ())

    def literals(self, depth: int) -> tuple[tree.LiteralValue, ...]:
        return self.some(lambda: self.literal(depth), 1)

    def literal(self, depth: int) -> tree.LiteralValue:
        if depth and self.flag():
            return self.literals(depth - 1)
        return self.choice.literal()

    def arguments(self, depth: int) -> tuple[tree.Argument, ...]:
        return self.some(lambda: self.argument(depth))

    def argument(self, depth: int) -> tree.Argument:
        makers: list[Callable[[], tree.Argument]] = [
            lambda: tree.RequiredArgument(0, 0, self.expression(depth)),
            lambda: tree.RequiredArgument(0, 0, self.placeholder("ARG", "*")),
            lambda: tree.RequiredArgument(0, 0, self.expression(depth), self.name()),
            lambda: tree.OptionalArgument(
                0, 0, self.name(OPTIONS), self.maybe(lambda: self.expression(depth))
            ),
            lambda: tree.ConditionalArgument(0, 0, self.name(OPTIONS), self.name()),
        ]
        return self.one(*makers)

    # --- statements

    def body(self, depth: int = STATEMENT_DEPTH) -> tree.Body:
        return self.some(lambda: self.statement(depth))

    def statement(self, depth: int) -> tree.Statement:
        flat: list[Callable[[], tree.Statement]] = [
            self.simple,
            self.simple,
            lambda: tree.CompactIf(0, 0, self.expression(), self.simple()),
            lambda: tree.CompactIf(0, 0, self.expression(), self.placeholder("SMT")),
            lambda: tree.Label(0, 0, self.name()),
            lambda: tree.Empty(0, 0),
            lambda: self.placeholder("SMT"),
            self.data,
        ]
        if not depth:
            return self.one(*flat)
        blocks: list[Callable[[], tree.Statement]] = [
            lambda: self.conditional(depth - 1),
            lambda: self.counting(depth - 1),
            lambda: tree.While(0, 0, self.expression(), self.body(depth - 1), self.flag()),
            lambda: self.test(depth - 1),
        ]
        return self.one(*flat, *blocks)

    def simple(self) -> tree.Statement:
        makers: list[Callable[[], tree.Statement]] = [
            lambda: tree.Assignment(0, 0, self.target(), self.expression(), 0, self.flag()),
            lambda: tree.Call(0, 0, self.name(), self.arguments(EXPRESSION_DEPTH)),
            self.call_in_parentheses,
            lambda: tree.LateCall(0, 0, self.expression(), self.arguments(EXPRESSION_DEPTH)),
            lambda: tree.Goto(0, 0, self.name()),
            lambda: tree.Return(0, 0, self.maybe(self.expression)),
            lambda: tree.Raise(0, 0, self.maybe(self.expression)),
            lambda: tree.Exit(0, 0),
            lambda: tree.Retry(0, 0),
            lambda: tree.TryNext(0, 0),
            lambda: tree.Connect(0, 0, self.target(), self.one(self.name, self.expression)),
        ]
        return self.one(*makers)

    def target(self) -> tree.DataPath | tree.Placeholder:
        return self.one(lambda: self.path(EXPRESSION_DEPTH), lambda: self.placeholder("VAR"))

    def call_in_parentheses(self) -> tree.Call:
        """With a list that nobody could take for one expression in parentheses."""
        arguments = self.arguments(EXPRESSION_DEPTH)
        if len(arguments) == 1 and isinstance(arguments[0], tree.RequiredArgument):
            arguments = (*arguments, tree.OptionalArgument(0, 0, self.name(OPTIONS), None))
        return tree.Call(0, 0, self.name(), arguments, True)

    def conditional(self, depth: int) -> tree.If:
        first = tree.Branch(0, 0, self.expression(), self.body(depth))
        more = self.some(
            lambda: self.one(
                lambda: tree.Branch(0, 0, self.expression(), self.body(depth), self.flag()),
                lambda: tree.Branch(0, 0, self.placeholder("EIT"), ()),
            )
        )
        return tree.If(0, 0, (first, *more), self.maybe(lambda: self.body(depth)))

    def counting(self, depth: int) -> tree.For:
        first, last = self.expression(), self.expression()
        return tree.For(
            0, 0, self.name(), first, last, self.maybe(self.expression), self.body(depth)
        )

    def test(self, depth: int) -> tree.Test:
        cases = self.some(
            lambda: self.one(
                lambda: tree.Case(0, 0, self.some(self.expression, 1), self.body(depth)),
                lambda: tree.Case(0, 0, (self.expression(),), self.body(depth), self.expression()),
                lambda: tree.Case(0, 0, (self.placeholder("CSE"),), ()),
            )
        )
        return tree.Test(0, 0, self.expression(), cases, self.maybe(lambda: self.body(depth)))

    # --- what modules hold

    def data(self) -> tree.Data:
        value = self.maybe(self.expression)
        return tree.Data(
            *(0, 0, self.of((None, "LOCAL", "TASK")), self.of(("VAR", "PERS", "CONST"))),
            *(self.name(TYPES), self.name(), self.dimensions(), value),
            value is not None and self.flag(),
        )

    def dimensions(self) -> tuple[tree.Expression, ...]:
        return self.some(self.expression) if self.flag() else ()

    def local(self) -> str | None:
        return "LOCAL" if self.flag() else None

    def module(self) -> tree.Module:
        attributes = self.some(lambda: self.name(("SYSMODULE", "NOVIEW", "READONLY")))
        items = self.some(self.item)
        return tree.Module(0, 0, Source("drawn", ""), self.name(), attributes, items)

    def item(self) -> tree.Item:
        makers: list[Callable[[], tree.Item]] = [
            self.data,
            lambda: tree.RecordType(0, 0, self.local(), self.name(), self.some(self.field)),
            lambda: tree.AliasType(0, 0, self.local(), self.name(TYPES), self.name()),
            lambda: self.placeholder("TDN", "DDN", "RDN"),
            self.proc,
            self.func,
            lambda: tree.Trap(0, 0, self.local(), self.name(), (), *self.clauses(), 0, False),
        ]
        return self.one(*makers)

    def field(self) -> tree.ComponentDeclaration | tree.Placeholder:
        makers: list[Callable[[], tree.ComponentDeclaration | tree.Placeholder]] = [
            lambda: tree.ComponentDeclaration(
                0, 0, self.name(TYPES), self.name(), self.dimensions()
            ),
            lambda: self.placeholder("TDN"),
        ]
        return self.one(*makers)

    def proc(self) -> tree.Proc:
        parameters = self.parameters()
        bare = not parameters and self.flag()
        return tree.Proc(0, 0, self.local(), self.name(), parameters, *self.clauses(), 0, bare)

    def func(self) -> tree.Func:
        parameters = self.parameters()
        bare = not parameters and self.flag()
        local, name = self.local(), self.name()
        body, backward, error, undo = self.clauses()
        return tree.Func(
            *(0, 0, local, name, parameters, body, backward, error, undo, 0, bare),
            self.name(TYPES),
        )

    def clauses(
        self,
    ) -> tuple[tree.Body, tree.Body | None, tree.ErrorHandler | None, tree.Body | None]:
        return self.body(), self.maybe(self.body), self.maybe(self.handler), self.maybe(self.body)

    def handler(self) -> tree.ErrorHandler:
        numbers = self.maybe(lambda: self.some(self.expression, 1))
        return tree.ErrorHandler(0, 0, numbers, self.body())

    def parameters(self) -> tuple[Drawn, ...]:
        makers: list[Callable[[], Drawn]] = [
            self.parameter,
            lambda: self.placeholder("PAR"),
            lambda: tree.OptionalGroup(0, 0, self.some(self.parameter, 1)),
        ]
        return self.some(lambda: self.one(*makers))

    def parameter(self) -> tree.ParameterDeclaration:
        mode = self.of(("IN", "INOUT", "VAR", "PERS"))
        stars = self.of(range(4))
        return tree.ParameterDeclaration(0, 0, mode, self.name(TYPES), self.name(), stars)
