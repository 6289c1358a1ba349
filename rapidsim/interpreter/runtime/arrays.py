"""Arrays at run time: nested lists, indices checked and counted from 1, values copied."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NoReturn

from rapidsim.analysis.literals import Value
from rapidsim.interpreter.runtime.references import Absent, not_present
from rapidsim.language.error_numbers import (
    ERR_ILLDIM,
    ERR_NOTEQDIM,
    ERR_NOTINTVAL,
    ERR_OUTOFBND,
    rapid_error,
)
from rapidsim.language.single_precision import single


def out_of_bounds(index: float, size: int) -> NoReturn:
    """Raise the error for an index that an array of `size` elements does not have."""
    index = single(float(index))
    if index != int(index):
        raise rapid_error(ERR_NOTINTVAL, f"an index must be an integer, not {index:g}")
    raise rapid_error(ERR_OUTOFBND, f"index {index:g} is outside the array, which has 1 to {size}")


class IndexTable(dict[float, int]):
    """Maps RAPID indices to Python's: checks bounds and integrality in one lookup.

    Equal integers and floats hash alike, so both kinds of num find their entry. An index may be
    passed before it is rounded to num: integers are in the table, anything else is missing.
    """

    def __missing__(self, index: float) -> int:
        """Return the entry of the index rounded to num; raise for any other."""
        rounded = single(index)
        if rounded not in self:
            out_of_bounds(rounded, len(self))
        return self[rounded]


class _AbsentTable(IndexTable):
    """Index table of an array parameter that is absent."""

    def __missing__(self, index: float) -> NoReturn:
        """Raise for every index."""
        not_present("of this routine")


class _IndexTables(dict[int, IndexTable]):
    def __missing__(self, size: int) -> IndexTable:
        table = self[size] = IndexTable((float(i + 1), i) for i in range(size))
        return table


INDEX_TABLES: Mapping[int, IndexTable] = _IndexTables()
"""Index tables by size of the array, each created on first use."""

_ABSENT_TABLE = _AbsentTable()


def index_table_of(array: list[Any] | Absent, depth: int) -> IndexTable:
    """Return the index table for one dimension of an array that the caller may have omitted.

    Args:
        array: Nested lists, or `ABSENT`.
        depth: The dimension, from 0.
    """
    if isinstance(array, Absent):
        return _ABSENT_TABLE
    for _ in range(depth):
        array = array[0]
    return INDEX_TABLES[len(array)]


def copy_array(array: list[Any] | Absent) -> list[Any]:
    """Copy an array so that it shares no list with the original; elements are immutable."""
    if isinstance(array, Absent):
        not_present("of this routine")
    if array and isinstance(array[0], list):
        return [copy_array(row) for row in array]
    return array[:]


def copied(value: Value) -> Value:
    """A copy that shares no mutable part: arrays are copied, the rest is immutable."""
    return copy_array(value) if isinstance(value, list) else value


def assign_array(target: list[Any], value: list[Any]) -> None:
    """Copy elements in place, so that references to the target stay valid.

    Raises:
        RapidError: ERR_NOTEQDIM when sizes differ, which only conformant arrays can cause.
    """
    if len(target) != len(value):
        raise rapid_error(
            ERR_NOTEQDIM, f"an array of {len(value)} cannot be assigned to one of {len(target)}"
        )
    if target and isinstance(target[0], list):
        for row, new in zip(target, value, strict=True):
            assign_array(row, new)
    else:
        target[:] = value


def dimension(array: list[Any] | Absent, number: float) -> float:
    """RAPID's Dim: the size of one dimension, counted from 1.

    Raises:
        RapidError: ERR_ILLDIM when the array has no such dimension.
    """
    if isinstance(array, Absent):
        not_present("of this routine")
    value: object = array
    remaining = number
    while remaining >= 2.0 and isinstance(value, list):
        value, remaining = value[0], remaining - 1.0
    if not number >= 1.0 or not isinstance(value, list):
        raise rapid_error(ERR_ILLDIM, f"the array has no dimension {number:g}")
    return float(len(value))
