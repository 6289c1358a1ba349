"""Arithmetic where Python's operators differ from RAPID's; called by generated code.

RAPID's num has single precision; generated code rounds the result of each arithmetic expression
inline with the three float operations of `language.single_precision`. The functions here do the
rest: integer division, positions and orientations, errors, the values of FOR counters.

Source: Technical reference manual RAPID Overview, "Expressions".
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable, Iterator
from typing import NoReturn

from rapidsim.frames import quaternion
from rapidsim.frames.vectors import crossed
from rapidsim.language.data import Orient, Pos
from rapidsim.language.error_numbers import (
    ERR_DIVZERO,
    ERR_INT_NOTVAL,
    ERR_OVERFLOW,
    ERR_STRTOOLNG,
    rapid_error,
)
from rapidsim.language.single_precision import LARGEST_SINGLE, SPLIT, single
from rapidsim.library.poses import require_unit

MAX_DOUBLE = 1.7976931348623157e308
MAX_INTEGER = 2**24
"""Limit up to which single precision represents every integer."""
WHOLE_FROM = 2.0**52
"""From here on every double is an integer, so adding and subtracting this rounds to one."""
MAX_STRING = 80
"""Maximum number of characters of a RAPID string."""


def overflow(x: float) -> NoReturn:
    """Raise an error for a result beyond the largest number."""
    raise rapid_error(ERR_OVERFLOW, f"the result {x:G} is too large")


def too_long(text: str) -> NoReturn:
    """Raise an error for a string of more than 80 characters."""
    raise rapid_error(
        ERR_STRTOOLNG, f"the string has {len(text)} characters, {MAX_STRING} are allowed"
    )


def _not_integers(left: float, right: float, operator: str) -> NoReturn:
    for operand in (left, right):
        if operand % 1.0:
            raise rapid_error(ERR_INT_NOTVAL, f"{operator} takes integers, not {operand:g}")
    raise rapid_error(ERR_DIVZERO, f"{left:g} {operator} 0")


def integer_quotient(left: float, right: float) -> float:
    """DIV: the quotient of integers, truncated."""
    if left % 1.0 or right % 1.0 or not right:
        _not_integers(left, right, "DIV")
    quotient = abs(int(left)) // abs(int(right))
    return float(quotient if (left < 0.0) == (right < 0.0) else -quotient)


def integer_remainder(left: float, right: float) -> float:
    """MOD: the remainder of DIV, with the sign of the left operand."""
    if left % 1.0 or right % 1.0 or not right:
        _not_integers(left, right, "MOD")
    return math.fmod(left, right)


def whole_quotient(left: int, right: int) -> int:
    """DIV of integers."""
    return int(integer_quotient(float(left), float(right)))


def literal_quotient(left: int, right: int) -> int:
    """DIV by a positive literal, also for negative dividends and beyond exact integers."""
    return int(left // float(right)) if left >= 0 else whole_quotient(left, right)


def whole_remainder(left: int, right: int) -> int:
    """MOD of integers."""
    return int(integer_remainder(float(left), float(right)))


def double_integer(x: int) -> int:
    """An integer as doubles would have computed it."""
    double = _as_double(x)
    if math.isinf(double):
        overflow(double)
    return int(double)


def single_integer(x: int) -> int:
    """A sum of integers rounded to num."""
    double = _as_double(x)
    scaled = double * SPLIT
    rounded = scaled - (scaled - double)
    if not math.isfinite(rounded):
        overflow(double)
    return int(rounded)


def checked_integer(x: int) -> int:
    """Like `single_integer`, for results that may exceed the range of num."""
    if not -LARGEST_SINGLE <= x <= LARGEST_SINGLE:
        overflow(_as_double(x))
    return single_integer(x)


def _as_double(x: int) -> float:
    try:
        return float(x)
    except OverflowError:
        return math.inf if x > 0 else -math.inf


def add_positions(a: Pos, b: Pos) -> Pos:
    """The sum, each component a single."""
    return Pos(single(a[0] + b[0]), single(a[1] + b[1]), single(a[2] + b[2]))


def subtract_positions(a: Pos, b: Pos) -> Pos:
    """The difference, each component a single."""
    return Pos(single(a[0] - b[0]), single(a[1] - b[1]), single(a[2] - b[2]))


def negate_position(a: Pos) -> Pos:
    """The opposite position."""
    return Pos(-a[0], -a[1], -a[2])


def scale_position(a: Pos, factor: float) -> Pos:
    """The position times a number, each component a single."""
    return Pos(single(a[0] * factor), single(a[1] * factor), single(a[2] * factor))


def scaled_position(factor: float, a: Pos) -> Pos:
    """Like `scale_position`, with the number on the left."""
    return scale_position(a, factor)


def divide_position(a: Pos, divisor: float) -> Pos:
    """The position divided by a number, each component a single."""
    if not divisor:
        raise rapid_error(ERR_DIVZERO, "a position divided by 0")
    return Pos(single(a[0] / divisor), single(a[1] / divisor), single(a[2] / divisor))


def cross_product(a: Pos, b: Pos) -> Pos:
    """The vector product, each component a single."""
    return Pos(*(single(component) for component in crossed(a, b)))


def compose_orientations(a: Orient, b: Orient) -> Orient:
    """The product of rotations: b in the frame rotated by a, each component a single.

    Raises:
        RapidError: ERR_ILLQUAT if either is not a valid orientation.
    """
    require_unit(a)
    require_unit(b)
    return Orient(*(single(component) for component in quaternion.multiply(a, b)))


def count(first: int, last: float, step: int | None = None) -> Iterable[int]:
    """The values of a FOR counter with an integer start and a literal integer step.

    Without STEP the step is 1, or -1 when the end is below the start.
    """
    if step is None:
        step = 1 if last >= first else -1
    if abs(first) > MAX_INTEGER:
        return _count_on((), first, last, step)
    bounded = min(max(last, -MAX_INTEGER), MAX_INTEGER)
    end = math.floor(bounded) + 1 if step > 0 else math.ceil(bounded) - 1
    values = range(first, end, step) if step else ()
    if bounded == last and step:
        return values
    after = int(single(float(values[-1] + step))) if values else first
    return _count_on(values, after, last, step)


def _count_on(values: Iterable[int], after: int, last: float, step: int) -> Iterator[int]:
    """Count beyond the exact integers of single precision, rounding as the controller does."""
    yield from values
    while after <= last if step >= 0 else after >= last:
        yield after
        after = int(single(float(after + step)))


def turns_of(values: Iterable[float]) -> float:
    """Return the number of iterations of a FOR; infinite if not known in advance."""
    return len(values) if isinstance(values, range) else math.inf


def iteration_count(values: range, counter: str) -> int:
    """Number of FOR iterations up to and including the current one, from the counter's name."""
    now: int = sys._getframe(1).f_locals.get(counter, values.start - values.step)
    return values.index(now) + 1 if now in values else 0


def steps(first: float, last: float, step: float | None = None) -> Iterator[float]:
    """The values of any other FOR counter, each the previous one plus the step, as singles."""
    if step is None:
        step = 1.0 if last >= first else -1.0
    value = float(first)
    while value <= last if step >= 0 else value >= last:
        yield value
        value = single(value + step)
