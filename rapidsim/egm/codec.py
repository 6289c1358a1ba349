"""The subset of Protocol Buffers that EGM needs: messages described by tables, as nested dicts.

A well-maintained library exists, but code generated for clients requires a particular generation of
it in the same environment, and EGM uses a small, frozen part of the format: numbers, doubles,
nested messages. Input from the network is not trusted: unknown fields are skipped, and anything
that does not match its table is a `DecodeError`.

Source: Protocol Buffers documentation, "Encoding".
"""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator, Mapping
from enum import Enum
from types import MappingProxyType
from typing import Any, Final, TypeAlias

from rapidsim.values import value_class

Fields: TypeAlias = Mapping[str, Any]
"""A message: values by the names of its fields; missing fields were not sent."""


class FieldType(Enum):
    """Content of a field."""

    NUMBER = 0
    """A non-negative whole number, an enumeration value, or a truth value."""
    DOUBLE = 1
    DOUBLES = 2
    """Any number of doubles."""


@value_class(frozen=True, slots=True)
class FieldDescriptor:
    """A field of a message."""

    name: str
    holds: FieldType | MessageDescriptor
    required: bool = False


@value_class(frozen=True, slots=True)
class MessageDescriptor:
    """A message type: fields by number."""

    fields: Mapping[int, FieldDescriptor]


class DecodeError(Exception):
    """Bytes that are not a message of the table."""


_VARINT: Final = 0
_EIGHT_BYTES: Final = 1
_BLOCK: Final = 2
_FOUR_BYTES: Final = 5
_MOST_NUMBER: Final = 2**64
_DOUBLE: Final = struct.Struct("<d")
_DEEPEST: Final = 8


def message(
    **fields: tuple[int, FieldType | MessageDescriptor]
    | tuple[int, FieldType | MessageDescriptor, bool],
) -> MessageDescriptor:
    """A message type from its fields: number, content, whether required."""
    return MessageDescriptor(
        MappingProxyType(
            {given[0]: FieldDescriptor(name, *given[1:]) for name, given in fields.items()}
        )
    )


def encode(of: MessageDescriptor, fields: Fields) -> bytes:
    """A message as bytes; fields that are None or missing are omitted."""
    out = bytearray()
    for number, field in of.fields.items():
        value = fields.get(field.name)
        if value is None:
            continue
        match field.holds:
            case FieldType.NUMBER:
                _put_varint(out, number << 3 | _VARINT)
                _put_varint(out, int(value))
            case FieldType.DOUBLE:
                _put_varint(out, number << 3 | _EIGHT_BYTES)
                out += _DOUBLE.pack(value)
            case FieldType.DOUBLES:
                for one in value:
                    _put_varint(out, number << 3 | _EIGHT_BYTES)
                    out += _DOUBLE.pack(one)
            case MessageDescriptor() as inner:
                block = encode(inner, value)
                _put_varint(out, number << 3 | _BLOCK)
                _put_varint(out, len(block))
                out += block
    return bytes(out)


def decode(of: MessageDescriptor, data: bytes) -> dict[str, Any]:
    """Decode a message.

    Raises:
        DecodeError: If it does not match the table: truncated, malformed, with non-finite numbers,
            or without a required field.
    """
    return _decoded(of, data, 0)


def _decoded(of: MessageDescriptor, data: bytes, depth: int) -> dict[str, Any]:
    if depth > _DEEPEST:
        raise DecodeError("nested too deeply")
    read: dict[str, Any] = {}
    for number, wire, value in _records(data):
        field = of.fields.get(number)
        if field is None:
            continue
        match field.holds, wire:
            case FieldType.NUMBER, 0:
                read[field.name] = value
            case FieldType.DOUBLE, 1:
                read[field.name] = _double(value)
            case FieldType.DOUBLES, 1:
                read.setdefault(field.name, []).append(_double(value))
            case FieldType.DOUBLES, 2:
                # Packed, as in later generations of the format.
                if len(value) % 8:
                    raise DecodeError(f"{field.name}: {len(value)} bytes are not doubles")
                parts = (value[at : at + 8] for at in range(0, len(value), 8))
                read.setdefault(field.name, []).extend(map(_double, parts))
            case MessageDescriptor() as inner, 2:
                # A message may arrive in several parts.
                read[field.name] = read.get(field.name, {}) | _decoded(inner, value, depth + 1)
            case _:
                raise DecodeError(f"{field.name} is of another type")
    for field in of.fields.values():
        if field.required and field.name not in read:
            raise DecodeError(f"{field.name} is missing")
    return read


def _double(data: bytes) -> float:
    (value,) = _DOUBLE.unpack(data)
    if not math.isfinite(value):
        raise DecodeError("a number is not finite")
    return float(value)


def _records(data: bytes) -> Iterator[tuple[int, int, Any]]:
    """Number, type and value of each field."""
    at = 0
    while at < len(data):
        key, at = _varint(data, at)
        number, wire = key >> 3, key & 7
        if wire == _VARINT:
            value, at = _varint(data, at)
            yield number, wire, value
            continue
        if wire == _BLOCK:
            size, at = _varint(data, at)
        elif wire in (_EIGHT_BYTES, _FOUR_BYTES):
            size = 8 if wire == _EIGHT_BYTES else 4
        else:
            raise DecodeError(f"type {wire} of a field")
        if at + size > len(data):
            raise DecodeError("cut off")
        yield number, wire, data[at : at + size]
        at += size


def _varint(data: bytes, at: int) -> tuple[int, int]:
    """A number, and the offset after it."""
    value = shift = 0
    while True:
        if at >= len(data) or shift > 63:
            raise DecodeError("cut off")
        byte = data[at]
        value |= (byte & 0x7F) << shift
        at, shift = at + 1, shift + 7
        if byte < 0x80:
            return value % _MOST_NUMBER, at


def _put_varint(out: bytearray, value: int) -> None:
    while value > 0x7F:
        out.append(value & 0x7F | 0x80)
        value >>= 7
    out.append(value)
