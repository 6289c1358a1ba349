"""Tables of the station file that are declared as classes: the fields are the keys, in their order.

Types and marks of a field determine its valid values; see `json_records/declarations.py`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import MISSING
from enum import EnumType
from functools import partial
from pathlib import Path
from typing import Any, Literal, TypeAlias, TypeVar, get_args, get_origin

from rapidsim.controller.cell.conditions import Condition, ConditionError, read_condition
from rapidsim.json_records.declarations import (
    Noun,
    NumberRange,
    RecordField,
    Valid,
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


def values_of(reader: Reader, kind: type, table: Table, path: str) -> dict[str, Any]:
    """Return the valid values of a table by field; errors are collected in the reader."""
    fields = record_fields(kind)
    reader.note_unknown_keys(path, table, [field.key for field in fields])
    found = ((field.name, _value(reader, field, table, path)) for field in fields)
    return {name: value for name, value in found if value is not None}


def read_records(reader: Reader, station: Table, key: str, kind: type[T]) -> tuple[T, ...]:
    """Return the records of a list of tables; errors are collected in the reader."""
    required = _required(kind)
    records = []
    for path, table in reader.tables(station, key):
        found = values_of(reader, kind, table, path)
        reader.require(path, table, required.values())
        if required.keys() <= found.keys():
            records.append(kind(**found))
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


def _value(reader: Reader, field: RecordField, table: Table, path: str) -> Any:
    """Return the value of a field; None if it is missing or invalid."""
    key = field.key
    # An empty text in place of a text with a default is that default.
    if key not in table or (table[key] == "" and isinstance(field.default, str)):
        return None
    declared, marks = marks_of(field.type)
    type_, inner = marks_of(alternatives(declared)[0][0])
    value = _conversion(type_, (*marks, *inner))(reader, table, path, key)
    for mark in marks:
        if isinstance(mark, Valid) and value is not None and not mark.holds(value):
            reader.wrong(f"{path}.{key}", mark.problem)
            return None
    return int(value) if type_ is int and value is not None else value


def _conversion(type_: Any, marks: tuple[Any, ...]) -> Conversion:
    for mark in (*marks, type_):
        if isinstance(mark, ReadBy):
            return mark.read
        if mark in _CONVERSIONS:
            return _CONVERSIONS[mark]
    arguments = get_args(type_)
    if get_origin(type_) is Literal or isinstance(type_, EnumType):
        return partial(
            _choice, of=type_, noun=next((m for m in marks if isinstance(m, Noun)), None)
        )
    return partial(Reader.numbers, count=None if Ellipsis in arguments else len(arguments))


def _required(kind: type) -> dict[str, str]:
    """Return the keys of the required values by field."""
    return {one.name: one.key for one in record_fields(kind) if one.default is MISSING}


def _choice(reader: Reader, table: Table, path: str, key: str, of: Any, noun: Noun | None) -> Any:
    """Return the word or the member of a literal or an enumeration."""
    text = reader.text(table, path, key)
    if text is None:
        return None
    words = get_args(of) or tuple(str(one.value) for one in of)
    word = text.lower() if noun and noun.folds_case else text
    try:
        return of(word) if isinstance(of, type) else words[words.index(word)]
    except ValueError:
        problem = f"not {noun.text}" if noun else _none_of(words)
        help = f"known: {', '.join(words)}" if noun else None
        reader.wrong(f"{path}.{key}", f"`{text}` is {problem}", help)
        return None


def _none_of(words: Sequence[str]) -> str:
    if len(words) == 2:
        return f"neither `{words[0]}` nor `{words[1]}`"
    return f"none of {', '.join(f'`{one}`' for one in words)}"


def _bytes(reader: Reader, table: Table, path: str, key: str) -> bytes | None:
    text = reader.text(table, path, key)
    try:
        return None if text is None else text.encode("iso-8859-1")
    except UnicodeEncodeError:
        reader.wrong(f"{path}.{key}", "the controller sends ISO 8859-1, which lacks some of this")
        return None


def _path(reader: Reader, table: Table, path: str, key: str) -> Path | None:
    name = reader.text(table, path, key)
    return None if name is None else reader.inside(name, f"{path}.{key}")


_CONVERSIONS: Mapping[Any, Conversion] = {
    str: Reader.text,
    bool: Reader.flag,
    bytes: _bytes,
    float: Reader.number,
    int: Reader.number,
    Path: _path,
    Condition: read_when,
    tuple[str, ...]: Reader.texts,
    NumberRange.NOT_NEGATIVE: Reader.not_negative,
    NumberRange.ABOVE_ZERO: Reader.positive,
}
