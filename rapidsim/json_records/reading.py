"""Records from JSON values, whose types are checked: they may come from a file of the user."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import MISSING
from enum import Enum
from functools import cache
from types import MappingProxyType
from typing import Any, TypeAlias, TypeVar, cast

from rapidsim.json_records.declarations import (
    RecordField,
    alternatives,
    is_record,
    item_count,
    item_type,
    marks_of,
    record_fields,
    value_type,
)

T = TypeVar("T")
Path: TypeAlias = "tuple[Path, str | int] | None"
"""Keys and indices that lead to a value, the last first."""
Conversion: TypeAlias = Callable[[Any, Path], Any]
_NAMES = {str: "text", bool: "true or false", int: "a whole number"}


class WrongValueError(ValueError):
    """A value that is not of the declared type; the message names its place."""

    def __init__(self, path: Path, problem: str) -> None:
        super().__init__(f"{_text(path)} {problem}")


class RecordReader:
    """Conversion of JSON values to records; unknown keys are ignored."""

    def __init__(self, custom: Mapping[type, Callable[[Any], Any]] = MappingProxyType({})) -> None:
        """Take the conversions of classes that are not converted field by field."""
        self._custom = custom
        self._fields: dict[Any, tuple[tuple[RecordField, Conversion], ...]] = {}

    def __call__(self, record: type[T], value: object, path: Path = None) -> T:
        """Read a record.

        Raises:
            WrongValueError: If a value is missing or not of the declared type.
        """
        found = _mapping(value, path)
        fields = self._fields.get(record) or self._derive(record)
        values: dict[str, Any] = {}
        for field, convert in fields:
            if field.is_inline:
                values[field.name] = convert(found, path)
            elif field.key in found:
                values[field.name] = convert(found[field.key], (path, field.key))
            elif field.default is not MISSING:
                values[field.name] = field.default
            else:
                raise WrongValueError((path, field.key), "is missing")
        return record(**values)

    def _derive(self, record: Any) -> tuple[tuple[RecordField, Conversion], ...]:
        fields = self._fields[record] = tuple(
            (field, self.conversion(field.type))
            for field in record_fields(record)
            if not field.is_constant
        )
        return fields

    def conversion(self, declared: Any) -> Conversion:
        """Return the conversion of JSON values to a type."""
        types, may_be_none = alternatives(marks_of(declared)[0])
        is_known = len(types) == 1 or types[0] in self._custom
        convert = self._single(types[0]) if is_known else _unchecked
        if may_be_none:
            return lambda value, path: None if value is None else convert(value, path)
        return convert

    def _single(self, declared: Any) -> Conversion:
        type_, _ = marks_of(declared)
        if (item := item_type(type_)) is not None:
            return _array(self.conversion(item), item_count(type_))
        if (of_values := value_type(type_)) is not None:
            return _object(self.conversion(of_values))
        if type_ is float:
            return _number
        if type_ in _NAMES:
            return _plain(type_)
        if type_ in self._custom:
            custom = self._custom[type_]
            return lambda value, _: custom(value)
        if isinstance(type_, type) and issubclass(type_, Enum):
            return _choice(type_)
        if is_record(type_):
            return lambda value, path: self(type_, value, path)
        return _unchecked


read = RecordReader()
"""Conversion of JSON values to a record."""


class _Partial:
    """Record whose values are read when they are used."""

    def __init__(self, record: Any, values: Mapping[str, object], path: Path) -> None:
        self._record = record
        self._values = values
        self._path = path

    def __getattr__(self, name: str) -> Any:
        field, convert, empty = _partial_fields(self._record)[name]
        if field.is_inline:
            return convert(self._values, self._path)
        value = self._values.get(field.key)
        if value is not None:
            return convert(value, (self._path, field.key))
        if empty is _NEEDED:
            raise WrongValueError((self._path, field.key), "is missing")
        return empty


_NEEDED = object()


@cache
def _partial_fields(record: Any) -> Mapping[str, tuple[RecordField, Conversion, object]]:
    """Return each field with its conversion and its value where the key is missing."""
    found: dict[str, tuple[RecordField, Conversion, object]] = {}
    for field in record_fields(record):
        types, may_be_none = alternatives(marks_of(field.type)[0])
        empty: object = None if may_be_none or field.is_optional else _NEEDED
        if field.is_lenient:
            empty = _empty(types[0])
        found[field.name] = field, _PARTIALLY.conversion(field.type), empty
    return found


def _empty(type_: Any) -> object:
    if is_record(type_):
        return _PARTIALLY(type_, {})
    return () if item_type(type_) else type_()


class _PartialRecordReader(RecordReader):
    def __call__(self, record: type[T], value: object, path: Path = None) -> T:
        return cast(T, _Partial(record, _mapping(value, path), path))


_PARTIALLY = _PartialRecordReader()


def read_partially(record: type[T], value: object, path: Path = None) -> T:
    """Return a record of which only the values that are used are read.

    So another version may have written it. `Lenient` values that it lacks are empty.

    Raises:
        WrongValueError: If it is not an object; on use, if a value is missing or wrong.
    """
    return _PARTIALLY(record, value, path)


def _mapping(value: object, path: Path) -> Mapping[str, object]:
    if not isinstance(value, Mapping):
        raise WrongValueError(path, "is not an object")
    return value


def _array(convert: Conversion, count: int | None) -> Conversion:
    def read_array(values: Any, path: Path) -> tuple[Any, ...]:
        if not isinstance(values, list | tuple):
            raise WrongValueError(path, "is not a list")
        if count not in (None, len(values)):
            raise WrongValueError(path, f"has {len(values)} items in place of {count}")
        return tuple(convert(one, (path, number)) for number, one in enumerate(values))

    return read_array


def _object(convert: Conversion) -> Conversion:
    def read_object(values: Any, path: Path) -> dict[str, Any]:
        return {key: convert(one, (path, key)) for key, one in _mapping(values, path).items()}

    return read_object


def _plain(kind: type) -> Conversion:
    def read_plain(value: Any, path: Path) -> Any:
        if type(value) is not kind:
            raise WrongValueError(path, f"is not {_NAMES[kind]}")
        return value

    return read_plain


def _choice(kind: type[Enum]) -> Conversion:
    def read_choice(value: Any, path: Path) -> Enum:
        try:
            return kind(value)
        except ValueError:
            names = ", ".join(str(one.value) for one in kind)
            raise WrongValueError(path, f"is `{value}`, and not one of {names}") from None

    return read_choice


def _number(value: Any, path: Path) -> float:
    if not isinstance(value, int | float):
        raise WrongValueError(path, "is not a number")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise WrongValueError(path, "is not a finite number")
    return number


def _unchecked(value: Any, _: Path) -> Any:
    return value


def _text(path: Path) -> str:
    """Return keys and indices as one text, such as `moves[3].start_s`."""
    if path is None:
        return "it"
    before, last = path
    begin = "" if before is None else _text(before)
    if isinstance(last, int):
        return f"{begin}[{last}]"
    return f"{begin}.{last}" if begin else last
