"""Intervals of integers, and arithmetic on them.

Only this module decides which expressions are computed in Python integers: `integer_inference`
queries it for the variables of a program, the translation of expressions for each subexpression.

An expression that could be a negative zero in floats, such as `-x` for x = 0, is excluded: the sign
may be printed. FOR counters and literals never have such a sign.
"""

from __future__ import annotations

from collections.abc import Iterable

from rapidsim.language.single_precision import LARGEST_SINGLE
from rapidsim.library.arithmetic import MAX_INTEGER
from rapidsim.values import value_class

LARGEST = int(LARGEST_SINGLE)
MAX_EXACT = 2**53
"""Limit up to which a double represents every integer."""
_BOUNDS = (-LARGEST, -MAX_INTEGER, -1, 0, 1, MAX_INTEGER, LARGEST)
"""Bounds to which the interval of a growing variable is widened."""


@value_class(frozen=True, slots=True)
class Interval:
    """The integers between two bounds, both included."""

    low: int
    high: int
    size: str = ""
    """Python variable with an array size that is an upper bound; empty without one."""
    signed: bool = False
    """Whether it is computed from variables, whose zeros would have signs as floats.

    Expressions computed from these count as raising if they may raise as floats: under an ERROR
    clause a loop takes one more tick if its condition may raise.
    """

    @property
    def exact(self) -> bool:
        """Whether single precision represents each integer of the interval exactly."""
        return self.low >= -MAX_INTEGER and self.high <= MAX_INTEGER

    @property
    def is_double(self) -> bool:
        """Whether a double represents each integer between the bounds exactly."""
        return self.low >= -MAX_EXACT and self.high <= MAX_EXACT


ONE = Interval(1, 1)
ANY = Interval(-LARGEST, LARGEST)


def combined(operator: str, a: Interval, b: Interval) -> Interval | None:
    """Return the interval of a sum, difference or product; None if the result is no integer."""
    signed = a.signed or b.signed
    if operator in ("DIV", "MOD"):
        a, b = rounded(a), rounded(b)
    match operator:
        case "+":
            return Interval(a.low + b.low, a.high + b.high, signed=signed)
        case "-":
            return Interval(a.low - b.high, a.high - b.low, signed=signed)
        case "*":
            if signed and (_meet(a, b) or _meet(b, a)):
                return None
            products = [x * y for x in (a.low, a.high) for y in (b.low, b.high)]
            return Interval(min(products), max(products), signed=signed)
        case "DIV":
            return _quotient(a, b)
        case "MOD" if a.low >= 0:
            rest = max(abs(b.low), abs(b.high)) - 1
            return Interval(0, min(a.high, max(rest, 0)), signed=signed)
        case _:
            return None


def negated(a: Interval) -> Interval | None:
    """Return the interval of the negation; None if it could be a negative zero."""
    if a.signed and a.low <= 0 <= a.high:
        return None
    return Interval(-a.high, -a.low, signed=a.signed)


def rounded(a: Interval) -> Interval:
    """The interval after rounding to num."""
    if a.exact:
        return a
    low = a.low if a.low >= -MAX_INTEGER else -LARGEST
    high = a.high if a.high <= MAX_INTEGER else LARGEST
    return Interval(low, high, signed=a.signed)


def widened(a: Interval, b: Interval) -> Interval:
    """Interval that contains both; growing bounds jump far, so that few iterations are needed."""
    low = a.low if a.low <= b.low else max(one for one in _BOUNDS if one <= b.low)
    high = a.high if a.high >= b.high else min(one for one in _BOUNDS if one >= b.high)
    return Interval(low, high, signed=True)


def hull(intervals: Iterable[Interval]) -> Interval:
    """Return the hull of one or more intervals."""
    every = list(intervals)
    low, high = min(one.low for one in every), max(one.high for one in every)
    return Interval(low, high, signed=any(one.signed for one in every))


def step_direction(first: Interval, last: Interval | None) -> int:
    """The step of a FOR without STEP: 1 up, -1 down, 0 if only known at run time."""
    if last is None:
        return 0
    if last.low >= first.high:
        return 1
    return -1 if last.high < first.low else 0


def counted(first: Interval, last: Interval | None, step: int) -> Interval:
    """The interval of a FOR counter.

    Args:
        first: The start value.
        last: The end value; None if it may be fractional or beyond the integers exact in a single.
        step: Result of `step_direction`, or the literal STEP.
    """
    if last is None:
        # Steps of 1 stop at MAX_INTEGER: the next integer is no num.
        last = Interval(-MAX_INTEGER, MAX_INTEGER) if first.exact and abs(step) <= 1 else ANY
    if step > 0:
        return Interval(first.low, max(first.low, last.high), last.size, first.signed)
    if step < 0:
        return Interval(min(first.high, last.low), first.high, first.size, first.signed)
    both = hull((first, last))
    return Interval(both.low, both.high, signed=first.signed)


def _meet(a: Interval, b: Interval) -> bool:
    """Whether a zero and a negative factor are possible."""
    return a.low <= 0 <= a.high and b.low < 0


def _quotient(a: Interval, b: Interval) -> Interval:
    signed = a.signed or b.signed
    if a.low >= 0 and b.low > 0:
        return Interval(a.low // b.high, a.high // b.low, signed=signed)
    most = max(-a.low, a.high)
    return Interval(-most, most, signed=signed)
