"""An expression on its way to Python: its node, and what is still owed to it.

A num is rounded once, where an arithmetic expression is consumed; until then the node computes in
doubles. Counters of FOR loops, and sums and products of them, stay Python integers, which index
arrays fastest; they become floats where they leave such expressions.
"""

from __future__ import annotations

import ast
from enum import Enum

from rapidsim.interpreter.codegen.ast_builder import At
from rapidsim.interpreter.runtime.arithmetic import MAX_DOUBLE, MAX_INTEGER, MAX_STRING
from rapidsim.language.single import LARGEST_SINGLE, SPLIT
from rapidsim.values import dataclass


class Owed(Enum):
    """What must be done to a result before anybody sees it."""

    NOTHING = "nothing"
    SINGLE = "round to single"
    CHECKED_SINGLE = "round to single, which may overflow"
    CHECKED_DOUBLE = "check the range of a dnum"
    STRING = "check the length of a string"


@dataclass(frozen=True, slots=True)
class Interval:
    """The integers between two bounds, both included."""

    low: int
    high: int
    size: str = ""
    """The Python variable with the size of an array, where none of them is larger than that."""

    @property
    def exact(self) -> bool:
        """Whether a single holds each of them."""
        return self.low >= -MAX_INTEGER and self.high <= MAX_INTEGER


@dataclass(slots=True)
class Code:
    """One expression."""

    node: ast.expr
    owed: Owed = Owed.NOTHING
    may_raise: bool = False
    calls: bool = False
    """Contains a call that may change variables or the place that is reported."""
    integer: Interval | None = None
    """Where it is an integer: of which size. Literals are written as floats all the same."""
    literal: float | None = None
    """The value, where it is a literal."""

    def as_integer(self, at: At) -> ast.expr:
        """The node as a Python integer; only where `integer` is known."""
        return self.node if self.literal is None else at.constant(int(self.literal))

    @property
    def stays_integer(self) -> bool:
        """Whether the node is a Python integer at run time."""
        return self.integer is not None and self.literal is None


def finished(code: Code, at: At) -> Code:
    """Pay what is owed: the node then has the value that RAPID would store."""
    if code.stays_integer and code.integer is not None:
        if not code.integer.exact:
            return Code(_rounded(code.node, at), calls=code.calls, may_raise=code.may_raise)
        whole = at.operation(code.node, ast.Add(), at.constant(0.0))
        return Code(whole, calls=code.calls, may_raise=code.may_raise)
    if code.owed is Owed.NOTHING:
        return code
    if code.owed is Owed.SINGLE:
        node: ast.expr = _rounded(code.node, at)
    elif code.owed is Owed.CHECKED_SINGLE:
        node = _in_range(code.node, LARGEST_SINGLE, _split(at.name("_x"), at), at)
    elif code.owed is Owed.CHECKED_DOUBLE:
        node = _in_range(code.node, MAX_DOUBLE, at.name("_x"), at)
    else:
        length = at.call("_len", [at.named("_s", code.node)])
        fits = at.compare(length, (ast.LtE(), at.constant(MAX_STRING)))
        node = at.choice(fits, at.name("_s"), at.call("_too_long", [at.name("_s")]))
    return Code(node, may_raise=code.may_raise or code.owed is not Owed.SINGLE, calls=code.calls)


def comparable(code: Code, at: At) -> Code:
    """As `finished`, but integers stay what they are: equal ints and floats compare equal."""
    exact = code.stays_integer and code.integer is not None and code.integer.exact
    return code if exact else finished(code, at)


def _rounded(node: ast.expr, at: At) -> ast.expr:
    """`(_t := (_x := node) * SPLIT) - (_t - _x)`: see `language.single`."""
    return _split(at.named("_x", node), at)


def _split(x: ast.expr, at: At) -> ast.expr:
    """The same, once `_x` is set or where `x` sets it."""
    scaled = at.operation(x, ast.Mult(), at.constant(SPLIT))
    rest = at.operation(at.name("_t"), ast.Sub(), at.name("_x"))
    return at.operation(at.named("_t", scaled), ast.Sub(), rest)


def _in_range(node: ast.expr, limit: float, value: ast.expr, at: At) -> ast.expr:
    """A value made from `_x`, the node, or ERR_OVERFLOW where that is beyond the limit or none."""
    test = at.compare(
        at.constant(-limit), (ast.LtE(), at.named("_x", node)), (ast.LtE(), at.constant(limit))
    )
    return at.choice(test, value, at.call("_overflow", [at.name("_x")]))
