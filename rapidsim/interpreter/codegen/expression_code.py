"""An expression during translation: its Python node, and the rounding it still needs.

A num is rounded once, where an arithmetic expression is consumed; until then the node computes in
doubles. Integers remain Python integers, which are fastest for counting and indexing: FOR counters,
variables that `integer_inference` proves integer, sums and products of these. They become floats
where they are used otherwise, and are then rounded like floats, which few of them need.
"""

from __future__ import annotations

import ast
import math
from enum import Enum

from rapidsim.interpreter.codegen.ast_builder import AstBuilder
from rapidsim.interpreter.codegen.intervals import ANY, MAX_EXACT, Interval, rounded
from rapidsim.language.single_precision import LARGEST_SINGLE, SPLIT
from rapidsim.library.arithmetic import MAX_DOUBLE, MAX_INTEGER, MAX_STRING
from rapidsim.values import value_class


class DeferredCheck(Enum):
    """Check or rounding that a result needs before it can be observed."""

    NOTHING = "nothing"
    SINGLE = "round to single"
    CHECKED_SINGLE = "round to single, which may overflow"
    CHECKED_DOUBLE = "check the range of a dnum"
    STRING = "check the length of a string"


@value_class(slots=True)
class Code:
    """A translated expression."""

    node: ast.expr
    deferred: DeferredCheck = DeferredCheck.NOTHING
    may_raise: bool = False
    calls: bool = False
    """Contains a call that may change variables or the reported position."""
    integer: Interval | None = None
    """Interval of an integer expression, else None. Literals are written as floats nevertheless."""
    literal: float | None = None
    """Value of a literal, else None."""
    too_exact: bool = False
    """Whether it is an integer that would be rounded as a double."""
    integral: Interval | None = None
    """Interval of the integer value of a double; None if unknown."""
    most: float = math.inf
    """Upper bound of the magnitude of a double."""

    def __post_init__(self) -> None:
        """Derive the bounds of integers and literals."""
        if self.literal is not None:
            self.most = abs(self.literal)
        elif self.integer is not None and self.integer.is_double:
            self.most = float(max(-self.integer.low, self.integer.high))

    def as_integer(self, at: AstBuilder) -> ast.expr:
        """The node as a Python integer to compute with; requires `integer`."""
        if self.literal is not None:
            return at.constant(int(self.literal))
        if self.too_exact:
            return _same_magnitude(self, MAX_EXACT, "_double_integer", at)
        return self.node

    @property
    def stays_integer(self) -> bool:
        """Whether the node is a Python integer at run time."""
        return self.integer is not None and self.literal is None


def finished(code: Code, at: AstBuilder) -> Code:
    """Apply the deferred check; the node then has the value that RAPID would store."""
    exact = code.integral is not None and code.integral.exact
    if code.deferred is DeferredCheck.NOTHING or exact:
        if not code.stays_integer:
            return code
        whole = at.operation(code.node, ast.Add(), at.constant(0.0))
        return Code(whole, calls=code.calls, may_raise=code.may_raise)
    checked = code.deferred is not DeferredCheck.SINGLE
    if not checked or (
        code.deferred is DeferredCheck.CHECKED_SINGLE and code.most <= LARGEST_SINGLE
    ):
        node: ast.expr = _rounded(code.node, at)
    elif code.deferred is DeferredCheck.CHECKED_SINGLE:
        node = _in_range(code.node, LARGEST_SINGLE, _split(at.name("_x"), at), at)
    elif code.deferred is DeferredCheck.CHECKED_DOUBLE:
        node = _in_range(code.node, MAX_DOUBLE, at.name("_x"), at)
    else:
        length = at.call("_len", [at.named("_s", code.node)])
        fits = at.compare(length, (ast.LtE(), at.constant(MAX_STRING)))
        node = at.choice(fits, at.name("_s"), at.call("_too_long", [at.name("_s")]))
    return Code(node, may_raise=code.may_raise or checked, calls=code.calls)


def finished_integer(code: Code, at: AstBuilder) -> Code:
    """Like `finished`, but integers stay integers, and inferred ones are converted to integers."""
    if code.integer is None:
        paid = finished(code, at)
        node: ast.expr = at.call("_int", [paid.node])
        return Code(node, may_raise=paid.may_raise, calls=code.calls, integer=ANY)
    if code.literal is not None or code.deferred is DeferredCheck.NOTHING:
        node = at.constant(int(code.literal)) if code.literal is not None else code.node
        return Code(node, may_raise=code.may_raise, calls=code.calls, integer=code.integer)
    checked = code.deferred is DeferredCheck.CHECKED_SINGLE
    node = _same_magnitude(
        code, MAX_INTEGER, "_checked_integer" if checked else "_single_integer", at
    )
    may_raise = code.may_raise or checked
    return Code(node, may_raise=may_raise, calls=code.calls, integer=rounded(code.integer))


def comparable(code: Code, at: AstBuilder) -> Code:
    """Like `finished`, but integers stay integers: equal ints and floats compare equal."""
    return finished_integer(code, at) if code.stays_integer else finished(code, at)


def within(
    x: ast.Name | ast.NamedExpr, low: float | None, high: ast.expr | float | None, at: AstBuilder
) -> ast.expr:
    """Whether a number is between two bounds, either of which may be None.

    In CPython two comparisons of a name and a constant are cheaper than a chained one.
    """
    limit = high if isinstance(high, ast.expr) else at.constant(high)
    if low is None:
        return at.compare(x, (ast.LtE(), limit))
    enough = at.compare(x, (ast.GtE(), at.constant(low)))
    if high is None:
        return enough
    name = at.name((x.target if isinstance(x, ast.NamedExpr) else x).id)
    return at.both_or_either(ast.And(), enough, at.compare(name, (ast.LtE(), limit)))


def _same_magnitude(code: Code, most: int, default: str, at: AstBuilder) -> ast.expr:
    """Reduce an integer to a magnitude limit: within it unchanged, else by calling a function."""
    assert code.integer is not None
    low = None if code.integer.low >= -most else -most
    high = None if code.integer.high <= most else most
    if low is high is None:
        return code.node
    test = within(at.named("_x", code.node), low, high, at)
    return at.choice(test, at.name("_x"), at.call(default, [at.name("_x")]))


def _rounded(node: ast.expr, at: AstBuilder) -> ast.expr:
    """`(_t := (_x := node) * SPLIT) - (_t - _x)`: see `language.single_precision`."""
    return _split(at.named("_x", node), at)


def _split(x: ast.expr, at: AstBuilder) -> ast.expr:
    """Split `_x`, which is set already or by `x`, as in `_rounded`."""
    scaled = at.operation(x, ast.Mult(), at.constant(SPLIT))
    rest = at.operation(at.name("_t"), ast.Sub(), at.name("_x"))
    return at.operation(at.named("_t", scaled), ast.Sub(), rest)


def _in_range(node: ast.expr, limit: float, value: ast.expr, at: AstBuilder) -> ast.expr:
    """Value computed from `_x`, the node; ERR_OVERFLOW if that is beyond the limit or no number."""
    test = within(at.named("_x", node), -limit, limit, at)
    return at.choice(test, value, at.call("_overflow", [at.name("_x")]))
