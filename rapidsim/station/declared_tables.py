"""Tables of the station file that are declared as classes: the fields are the keys, in their order.

Types and marks of a field determine its valid values; see `json_records/declarations.py`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import MISSING
from typing import Any, Literal, TypeAlias, TypeVar, get_args, get_origin

from rapidsim.controller.cell.conditions import Condition, ConditionError, read_condition
from rapidsim.json_records.declarations import (
    NumberRange,
    RecordField,
    alternatives,
    marks_of,
    record_fields,
)
from rapidsim.station.toml_reader import Reader, Table
from rapidsim.values import value_class

T = TypeVar("T")
Conversion: TypeAlias = Callable[[Reader, Table, str, str], Any]
"""Returns the value of a key of a table with a path; None if it is missing or invalid."""


@value_class(frozen=True, slots=True)
class ReadBy:
    """Mark of a value that is read by a function."""

    read: Conversion


@value_class(frozen=True, slots=True)
class AllAboveZero:
    """Mark of a list of numbers above 0."""

    subject: str
    """Name of the numbers in the message."""


def values_of(reader: Reader, kind: type, table: Table, path: str) -> dict[str, Any]:
    """Return the valid values of a table by field; errors are collected in the reader."""
    fields = record_fields(kind)
    reader.note_unknown_keys(path, table, [field.key for field in fields])
    found = ((field.name, _value(reader, field, table, path)) for field in fields)
    return {name: value for name, value in found if value is not None}


def read_records(
    reader: Reader, station: Table, key: str, kind: type[T], missing: str | None = None
) -> tuple[T, ...]:
    """Return the records of a list of tables; errors are collected in the reader.

    Args:
        reader: Reads the file.
        station: The table that has the list.
        key: Key of the list.
        kind: Class of the records.
        missing: Message where a required value is missing or invalid; None for one per missing key.
    """
    records = []
    for path, table in reader.tables(station, key):
        found = values_of(reader, kind, table, path)
        required = _required(kind)
        if required.keys() <= found.keys():
            records.append(kind(**found))
        elif missing:
            reader.wrong(path, missing)
        else:
            reader.require(path, table, required.values())
    return tuple(records)


def read_when(reader: Reader, table: Table, path: str, key: str) -> Condition | None:
    """Read a condition on signals; None if it is missing or invalid."""
    text = reader.text(table, path, key)
    if text is None:
        return None
    try:
        return read_condition(text)
    except ConditionError as error:
        reader.wrong(f"{path}.{key}", str(error))
        return None


def none_of(words: Sequence[str]) -> str:
    """Return the problem of a text that is none of some words."""
    if len(words) == 2:
        return f"neither `{words[0]}` nor `{words[1]}`"
    return f"none of {', '.join(f'`{one}`' for one in words)}"


def _value(reader: Reader, field: RecordField, table: Table, path: str) -> Any:
    """Return the value of a field; None if it is missing or invalid."""
    key = field.key
    if key not in table or (table[key] == "" and isinstance(field.default, str)):
        return None
    declared, marks = marks_of(field.type)
    type_, inner = marks_of(alternatives(declared)[0][0])
    for mark in (*marks, *inner, type_):
        if isinstance(mark, ReadBy):
            return mark.read(reader, table, path, key)
        if isinstance(mark, AllAboveZero):
            return _all_above_zero(reader, table, path, key, _count(type_), mark.subject)
        if mark in _CONVERSIONS:
            return _CONVERSIONS[mark](reader, table, path, key)
    if get_origin(type_) is Literal:
        return _word(reader, table, path, key, get_args(type_))
    return reader.numbers(table, path, key, _count(type_))


def _required(kind: type) -> dict[str, str]:
    """Return the keys of the required values by field."""
    return {one.name: one.key for one in record_fields(kind) if one.default is MISSING}


def _count(type_: Any) -> int | None:
    """Return the number of items of a tuple; None for any number."""
    return None if Ellipsis in get_args(type_) else len(get_args(type_))


def _all_above_zero(
    reader: Reader, table: Table, path: str, key: str, count: int | None, subject: str
) -> tuple[float, ...] | None:
    numbers = reader.numbers(table, path, key, count)
    if numbers and min(numbers) <= 0.0:
        reader.wrong(f"{path}.{key}", f"{subject} must be above 0")
        return None
    return numbers


def _word(reader: Reader, table: Table, path: str, key: str, words: tuple[str, ...]) -> str | None:
    text = reader.text(table, path, key)
    if text is None or text in words:
        return text
    reader.wrong(f"{path}.{key}", f"`{text}` is {none_of(words)}")
    return None


def _share(reader: Reader, table: Table, path: str, key: str) -> float | None:
    share = reader.positive(table, path, key)
    if share is not None and share > 1.0:
        reader.wrong(f"{path}.{key}", "a share is at most 1")
        return None
    return share


_CONVERSIONS: Mapping[Any, Conversion] = {
    str: Reader.text,
    bool: Reader.flag,
    float: Reader.number,
    Condition: read_when,
    tuple[str, ...]: Reader.texts,
    NumberRange.NOT_NEGATIVE: Reader.not_negative,
    NumberRange.ABOVE_ZERO: Reader.positive,
    NumberRange.SHARE: _share,
}
