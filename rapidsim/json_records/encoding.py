"""Records as JSON values. The conversions of a class are derived at its first use."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from enum import Enum
from operator import attrgetter
from types import MappingProxyType
from typing import Any, TypeAlias

from rapidsim.json_records.declarations import (
    RecordField,
    ValueForm,
    alternatives,
    is_record,
    item_type,
    marks_of,
    record_fields,
    value_type,
)

DECIMALS = 8
"""Decimals of s, mm and degrees in JSON: more than needed, fewer than machines agree on."""
Conversion: TypeAlias = Callable[[Any], Any]


def written(value: float) -> float:
    """Return a number rounded for JSON, so that files of two machines are equal but for ties."""
    return round(value, DECIMALS) + 0.0


def number(value: float) -> float | None:
    """Return a rounded number; JSON has only finite ones, so others become null."""
    plain = float(value)
    return written(plain) if math.isfinite(plain) else None


class RecordEncoder:
    """Conversion of records, and of values of other classes, to JSON values."""

    def __init__(self, custom: Mapping[type, Conversion] = MappingProxyType({})) -> None:
        """Take the conversions of classes that are not converted field by field."""
        self._custom = custom
        self._fields: dict[type, tuple[tuple[RecordField, Conversion | None], ...]] = {}

    def __call__(self, record: object) -> dict[str, Any]:
        """Convert a record."""
        kind = type(record)
        fields = self._fields.get(kind) or self._derive(kind)
        values: dict[str, Any] = {}
        for field, convert in fields:
            value = getattr(record, field.name)
            if field.is_optional and value == field.default:
                continue
            if value is not None and convert is not None:
                value = convert(value)
            if field.is_inline:
                values.update(value)
            else:
                values[field.key] = value
        return values

    def _derive(self, kind: type) -> tuple[tuple[RecordField, Conversion | None], ...]:
        fields = self._fields[kind] = tuple(
            (field, self._conversion(field.type)) for field in record_fields(kind)
        )
        return fields

    def _conversion(self, declared: Any) -> Conversion | None:
        """Return the conversion of a type; None if its values are JSON values."""
        type_, marks = marks_of(declared)
        if ValueForm.ROUNDED in marks:
            return number
        types, may_be_none = alternatives(type_)
        # Of several types, all are records, whose classes select the fields, or none is.
        convert = next(filter(None, map(self._single, types)), None)
        return _or_none(convert) if convert and may_be_none else convert

    def _single(self, declared: Any) -> Conversion | None:
        type_, marks = marks_of(declared)
        if ValueForm.ROUNDED in marks:
            return number
        if (item := item_type(type_)) is not None:
            return _array(self._conversion(item))
        if (of_values := value_type(type_)) is not None:
            return _object(self._conversion(of_values))
        if type_ in self._custom:
            return self._custom[type_]
        if isinstance(type_, type) and issubclass(type_, Enum):
            return attrgetter("value")
        return self if is_record(type_) else None


def _array(convert: Conversion | None) -> Conversion:
    return list if convert is None else lambda values: [convert(one) for one in values]


def _object(convert: Conversion | None) -> Conversion:
    if convert is None:
        return dict
    return lambda values: {key: convert(one) for key, one in values.items()}


def _or_none(convert: Conversion) -> Conversion:
    return lambda value: None if value is None else convert(value)


json_of = RecordEncoder()
"""Conversion of a record to JSON values."""
