"""Tables of the station file that are declared as classes: the fields are the keys, in their order.

Types and marks of a field determine its valid values; see `json_records/declarations.py`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import MISSING
from datetime import datetime
from enum import EnumType
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal, TypeAlias, TypeVar, get_args, get_origin

from rapidsim.controller.cell.conditions import Condition, ConditionError, read_condition
from rapidsim.json_records.declarations import (
    Excludes,
    Needs,
    NumberRange,
    OneOf,
    RecordField,
    Required,
    Valid,
    alternatives,
    is_record,
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


def values_of(
    reader: Reader,
    kind: type,
    table: Table,
    path: str,
    *,
    defaults: Mapping[str, Any] = MappingProxyType({}),
    without: Sequence[str] = (),
) -> dict[str, Any]:
    """Return the valid values of a table by field; errors are collected in the reader.

    Args:
        reader: Reads the file.
        kind: The class that declares the table.
        table: The table.
        path: Its path in messages.
        defaults: Values of missing keys, by field.
        without: Keys that this table does not have.
    """
    fields = [field for field in record_fields(kind) if field.key not in without]
    reader.note_unknown_keys(path, table, [field.key for field in fields])
    read = ((field.name, _value(reader, field, table, path)) for field in fields)
    found = {**defaults, **{name: value for name, value in read if value is not None}}
    problems = (
        *_contradictions(fields, table, defaults, path),
        *_lacking(fields, found, table, path),
    )
    for problem in dict.fromkeys(problems):
        reader.wrong(*problem)
    return found


def read_record(reader: Reader, kind: type[T], table: Table, path: str) -> T | None:
    """Return a record; None if a required value is missing or invalid."""
    return as_record(kind, values_of(reader, kind, table, path))


def as_record(kind: type[T], values: Mapping[str, Any]) -> T | None:
    """Return the record with some values; None if it requires others."""
    return kind(**values) if _required(kind) <= values.keys() else None


def read_table(reader: Reader, station: Table, key: str, kind: type[T]) -> T:
    """Return a table that requires no values; those that it lacks, or all, are the defaults."""
    return kind(**values_of(reader, kind, reader.table(station, key), key))


def read_records(reader: Reader, station: Table, key: str, kind: type[T]) -> tuple[T, ...]:
    """Return the records of a list of tables; errors are collected in the reader."""
    records = [
        read_record(reader, kind, table, path) for path, table in reader.tables(station, key)
    ]
    return tuple(record for record in records if record is not None)


def _required(kind: type) -> set[str]:
    return {field.name for field in record_fields(kind) if field.default is MISSING}


def _contradictions(
    fields: Iterable[RecordField], table: Table, defaults: Iterable[str], path: str
) -> Iterator[tuple[str, str]]:
    """Yield the place and the message of each key that others forbid."""
    present = {*table, *defaults}
    for field in fields:
        for mark in marks_of(field.type)[1] if field.key in table else ():
            if (isinstance(mark, Needs) and mark.key not in present) or (
                isinstance(mark, Excludes) and mark.key in present
            ):
                yield f"{path}.{field.key}", mark.problem


def _lacking(
    fields: Iterable[RecordField], values: Mapping[str, Any], table: Table, path: str
) -> Iterator[tuple[str, str]]:
    """Yield the place and the message of each required value that a table lacks."""
    for field in fields:
        mark = _mark(marks_of(field.type)[1], Required)
        if field.name in values:
            continue
        if mark is not None:
            yield path if mark.of_table else f"{path}.{field.key}", mark.problem
        elif field.default is MISSING and field.key not in table:
            yield f"{path}.{field.key}", "is missing"


def _value(reader: Reader, field: RecordField, table: Table, path: str) -> Any:
    """Return the value of a field; None if it is missing or invalid."""
    key = field.key
    if key not in table:
        return None
    declared, marks = marks_of(field.type)
    type_, inner = marks_of(alternatives(declared)[0][0])
    # An empty text is the default of a text; a required text is missing.
    if table[key] == "" and (
        isinstance(field.default, str) or (type_ is str and _mark(marks, Required) is not None)
    ):
        return None
    value = _conversion(type_, (*marks, *inner))(reader, table, path, key)
    for mark in marks:
        if isinstance(mark, Valid) and value is not None and not mark.holds(value):
            reader.wrong(f"{path}.{key}", mark.problem.format(value))
            return None
    return int(value) if type_ is int and value is not None else value


def _conversion(type_: Any, marks: tuple[Any, ...]) -> Conversion:
    for mark in (*marks, type_):
        if isinstance(mark, ReadBy):
            return mark.read
        if mark in _CONVERSIONS:
            return _CONVERSIONS[mark]
    if is_record(type_):
        return partial(_nested, kind=type_)
    arguments = get_args(type_)
    if get_origin(type_) is Literal or isinstance(type_, EnumType):
        return partial(_choice, of=type_, message=_mark(marks, OneOf))
    return partial(Reader.numbers, count=None if Ellipsis in arguments else len(arguments))


def _nested(reader: Reader, table: Table, path: str, key: str, kind: type[T]) -> T | None:
    path = f"{path}.{key}"
    return read_record(reader, kind, reader.table(table, key, path), path)


def _choice(
    reader: Reader, table: Table, path: str, key: str, of: Any, message: OneOf | None
) -> Any:
    """Return the word or the member of a literal or an enumeration."""
    text = reader.text(table, path, key)
    if text is None:
        return None
    words = get_args(of) or tuple(str(one.value) for one in of)
    fold = str.lower if message and message.folds_case else str
    word = next((one for one in words if fold(one) == fold(text)), text)
    try:
        return of(word) if isinstance(of, type) else words[words.index(word)]
    except ValueError:
        problem = message.problem if message else f"`{{}}` is {_none_of(words)}"
        help = f"known: {', '.join(words)}" if message and message.lists_words else None
        reader.wrong(f"{path}.{key}", problem.format(text), help)
        return None


def _mark(marks: Iterable[object], kind: type[T]) -> T | None:
    """Return the first mark of a kind."""
    return next((mark for mark in marks if isinstance(mark, kind)), None)


def _none_of(words: Sequence[str]) -> str:
    if len(words) == 2:
        return f"neither `{words[0]}` nor `{words[1]}`"
    return f"none of {', '.join(f'`{one}`' for one in words)}"


def _condition(reader: Reader, table: Table, path: str, key: str) -> Condition | None:
    text = reader.text(table, path, key)
    if text is None:
        return None
    try:
        return read_condition(text)
    except ConditionError as error:
        reader.wrong(f"{path}.{key}", str(error))
        return None


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


def _paths(reader: Reader, table: Table, path: str, key: str) -> tuple[Path, ...]:
    files = (reader.inside(name, f"{path}.{key}") for name in reader.texts(table, path, key))
    return tuple(file for file in files if file is not None)


def _occurrences(reader: Reader, table: Table, path: str, key: str) -> tuple[int, ...] | None:
    """Return whole numbers from 1 up."""
    numbers = reader.numbers(table, path, key, None) or ()
    if all(number >= 1 and number == int(number) for number in numbers):
        return tuple(map(int, numbers)) or None
    reader.wrong(f"{path}.{key}", "whole numbers from 1 up are needed; the first time is 1")
    return None


def _date(reader: Reader, table: Table, path: str, key: str) -> datetime | None:
    """Return a date with a time, without a zone: it is what the controller's clock shows."""
    value = table[key]
    if isinstance(value, datetime):
        return value.replace(tzinfo=None)
    reader.wrong(f"{path}.{key}", "a date with a time is needed, as in 2025-03-01T06:00:00")
    return None


def _levels(reader: Reader, table: Table, path: str, key: str) -> dict[str, float] | None:
    """Return the values of signals by name; None if the table names none."""
    path = f"{path}.{key}"
    values = reader.table(table, key, path)
    levels = {name: reader.level(values, path, name) for name in values}
    return {name: level for name, level in levels.items() if level is not None} if values else None


_CONVERSIONS: Mapping[Any, Conversion] = {
    str: Reader.text,
    bool: Reader.flag,
    bytes: _bytes,
    float: Reader.number,
    int: Reader.number,
    Path: _path,
    tuple[Path, ...]: _paths,
    datetime: _date,
    Condition: _condition,
    tuple[str, ...]: Reader.texts,
    tuple[int, ...]: _occurrences,
    Mapping[str, float]: _levels,
    NumberRange.LEVEL: Reader.level,
    NumberRange.NOT_NEGATIVE: Reader.not_negative,
    NumberRange.ABOVE_ZERO: Reader.positive,
}
