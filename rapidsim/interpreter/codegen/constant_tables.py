"""Constants that are arrays of num."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from rapidsim.analysis.literals import Value
from rapidsim.analysis.program import DataSymbol, Storage
from rapidsim.interpreter.codegen.intervals import Interval
from rapidsim.language.types import NUM, ArrayOf, resolved
from rapidsim.library.arithmetic import MAX_INTEGER

_MOST_ELEMENTS = 1000
"""Maximum number of elements of a constant that are examined each time it is read."""


def constant_table(
    symbol: DataSymbol, indices: int, constant_value: Callable[[DataSymbol], Value]
) -> list[Any] | None:
    """Return the value of a CONST num array with this number of dimensions; None otherwise."""
    of = resolved(symbol.type)
    if symbol.storage is not Storage.CONST or symbol.node is None or not isinstance(of, ArrayOf):
        return None
    if resolved(of.element) != NUM or len(of.dimensions) != indices:
        return None
    value = constant_value(symbol)
    return value if isinstance(value, list) else None


def bounds_of(table: list[Any]) -> Interval | None:
    """Return the bounds of a small table of integer nums; None with a negative zero."""
    numbers = table
    while numbers and isinstance(numbers[0], list):
        numbers = [number for row in numbers for number in row]
    if not numbers or len(numbers) > _MOST_ELEMENTS:
        return None
    if not all(one.is_integer() and abs(one) <= MAX_INTEGER for one in numbers):
        return None
    signs = any(one == 0.0 and math.copysign(1.0, one) < 0.0 for one in numbers)
    return None if signs else Interval(int(min(numbers)), int(max(numbers)), signed=True)
