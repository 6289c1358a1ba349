"""Rounding of the results of installed routines to single precision, as for every `num`.

Routines compute in Python's floats. A `num` that they return or write, by itself or in a record or
an array, by value or by reference, is rounded here and nowhere else; routines without a `num` in
their results are called directly. Data that may be of several types (`anytype`, `num` or `dnum`)
are rounded by the routine that writes them, which receives their type.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import accumulate, chain
from math import isfinite
from struct import Struct
from typing import Any, TypeAlias, TypeVar

from rapidsim.language.reference import Reference
from rapidsim.language.single_precision import LARGEST_SINGLE, SPLIT, single
from rapidsim.language.types import NUM, ArrayOf, Record, Type, resolved

Rounding: TypeAlias = Callable[[Any], Any]
Key = TypeVar("Key")


def rounding_of(of: Type) -> Rounding | None:
    """Rounding of values of a type to single precision; None if the type contains no `num`."""
    of = resolved(of)
    match of:
        case ArrayOf(element=element):
            return _of_elements(rounding_of(element), len(of.dimensions))
        case Record():
            return (_of_numbers(of) or _of_components(of)) if _has_numbers(of) else None
        case _:
            return single if of == NUM else None


def _has_numbers(record: Record) -> bool:
    return any(rounding_of(one.type) is not None for one in record.components)


def in_single(
    function: Callable[..., Any],
    result: Type | None,
    positional: Sequence[Type | None],
    options: Mapping[str, Type | None],
) -> Callable[..., Any]:
    """Wrap a routine's function so that its results are rounded to single precision.

    Args:
        function: The function as written.
        result: The type of its value; None without one.
        positional: For each argument by position, the type of the data that the function writes;
            None if it writes none.
        options: For each argument by keyword, the type of the data that the function writes.
    """
    given_back = _roundings(enumerate(positional))
    optional = _roundings(options.items())
    if given_back or optional:
        function = _giving_back(function, given_back, optional)
    rounding = None if result is None else rounding_of(result)
    if rounding is None:
        return function
    return _returning_number(function) if rounding is single else _returning(function, rounding)


def _roundings(types: Iterable[tuple[Key, Type | None]]) -> dict[Key, Rounding]:
    each = ((key, None if of is None else rounding_of(of)) for key, of in types)
    return {key: rounding for key, rounding in each if rounding is not None}


def _returning_number(function: Callable[..., Any]) -> Callable[..., Any]:
    def rounded(*arguments: Any, **options: Any) -> float:
        x: float = function(*arguments, **options)
        if not -LARGEST_SINGLE <= x <= LARGEST_SINGLE:
            return single(x)
        # The rounding of `single`, inlined to save a call for the most frequent results.
        t = x * SPLIT
        return t - (t - x)

    return rounded


def _returning(function: Callable[..., Any], rounding: Rounding) -> Callable[..., Any]:
    def rounded(*arguments: Any, **options: Any) -> Any:
        return rounding(function(*arguments, **options))

    return rounded


def _giving_back(
    function: Callable[..., Any],
    positional: Mapping[int, Rounding],
    optional: Mapping[str, Rounding],
) -> Callable[..., Any]:
    def rounded(*arguments: Any, **options: Any) -> Any:
        given = list(arguments)
        for position, rounding in positional.items():
            given[position] = _Rounded(given[position], rounding)
        for name, rounding in optional.items():
            if options.get(name) is not None:
                options[name] = _Rounded(options[name], rounding)
        return function(*given, **options)

    return rounded


class _Rounded:
    """Data by reference that rounds values written to it to single precision."""

    __slots__ = ("_data", "_rounding")

    def __init__(self, data: Reference[Any], rounding: Rounding) -> None:
        self._data = data
        self._rounding = rounding

    @property
    def value(self) -> Any:
        """The value of the data."""
        return self._data.value

    @value.setter
    def value(self, value: Any) -> None:
        self._data.value = self._rounding(value)


def _of_numbers(record: Record) -> Rounding | None:
    """Rounding of a record of numbers, or of records of numbers, in one step.

    Programs compute mostly with positions and targets.
    """
    inner = [resolved(one.type) for one in record.components]
    if all(of == NUM for of in inner):
        return _at_once(record, len(inner), ())
    parts = [
        of
        for of in inner
        if isinstance(of, Record) and all(resolved(one.type) == NUM for one in of.components)
    ]
    if len(parts) < len(inner):
        return None
    ends = list(accumulate(len(of.components) for of in parts))
    bounds = zip([0, *ends], ends, strict=False)
    places = [(of.python, slice(*bound)) for of, bound in zip(parts, bounds, strict=True)]
    return _at_once(record, ends[-1], places)


def _at_once(
    record: Record, count: int, parts: Sequence[tuple[type[tuple[object, ...]], slice]]
) -> Rounding:
    """Build the rounding of a record.

    Args:
        record: Its type.
        count: Number of its numbers.
        parts: The components and their positions among the numbers; empty if the numbers are the
            components.
    """
    packing = Struct(f"{count}f")
    python = record.python
    one_by_one = _of_components(record)

    def rounded(value: Any) -> Any:
        numbers = tuple(chain.from_iterable(value)) if parts else value
        try:
            singles = packing.unpack(packing.pack(*numbers))
        except OverflowError:
            return one_by_one(value)
        if not isfinite(sum(singles)):
            return one_by_one(value)
        if singles == numbers:
            return value
        if parts:
            singles = tuple([tuple.__new__(part, singles[place]) for part, place in parts])
        return tuple.__new__(python, singles)

    return rounded


def _of_components(record: Record) -> Rounding:
    parts = [rounding_of(one.type) for one in record.components]

    def rounded(value: Any) -> Any:
        return tuple.__new__(
            record.python,
            [one if part is None else part(one) for part, one in zip(parts, value, strict=True)],
        )

    return rounded


def _of_elements(part: Rounding | None, dimensions: int) -> Rounding | None:
    if part is None:
        return None
    inner = part if dimensions == 1 else _of_elements(part, dimensions - 1)
    assert inner is not None

    def rounded(value: Any) -> Any:
        return [inner(one) for one in value]

    return rounded
