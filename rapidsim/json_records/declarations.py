"""Declarations of JSON records: frozen classes whose fields are the keys, in their order.

A docstring below a field is its description in the schema. A class variable is a key with a
constant value.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from dataclasses import MISSING
from enum import Enum
from functools import cache
from types import NoneType, UnionType
from typing import (
    Annotated,
    Any,
    ClassVar,
    TypeAlias,
    TypeVar,
    Union,
    get_args,
    get_origin,
    get_type_hints,
)

from rapidsim.values import value_class

_UNIONS = (Union, UnionType)
_ARRAYS = (tuple, Sequence)


class ValueForm(Enum):
    """Forms of values other than the usual one."""

    INLINE = "inline"
    """The keys of the record or the mapping, without a key for itself."""
    LENIENT = "lenient"
    """A value that saved outputs may lack; it is empty then."""
    OPTIONAL = "optional"
    """A value that is omitted where it is the default; without a default, where it is None."""
    ROUNDED = "rounded"
    """A number with 8 decimals; null if it is not finite."""


Rounded: TypeAlias = Annotated[float, ValueForm.ROUNDED]
"""A number of a run, which is rounded, so that the files of two machines are equal."""
T = TypeVar("T")
OrAbsent: TypeAlias = Annotated[T | None, ValueForm.OPTIONAL]
"""A value whose key is omitted where it is None."""
Lenient: TypeAlias = Annotated[T, ValueForm.LENIENT]
"""A value that saved outputs may lack, because an older version wrote them."""


class NumberRange(Enum):
    """Ranges of numbers."""

    ABOVE_ZERO = "above 0"
    NOT_NEGATIVE = "not negative"
    LEVEL = "value of a signal"
    """A number, or true or false."""


AboveZero: TypeAlias = Annotated[float, NumberRange.ABOVE_ZERO]
NotNegative: TypeAlias = Annotated[float, NumberRange.NOT_NEGATIVE]
Level: TypeAlias = Annotated[float, NumberRange.LEVEL]


@value_class(frozen=True, slots=True)
class Valid:
    """Condition on a value, and the message for a value that does not satisfy it."""

    holds: Callable[[Any], bool]
    problem: str
    """Format of the message, in which `{}` is the value."""


def whole_number(least: int, most: int) -> Valid:
    """Return the condition that a number is whole and within limits, which are included."""
    problem = f"a whole number from {least} to {most} is needed"
    return Valid(lambda value: least <= value <= most and value == int(value), problem)


@value_class(frozen=True, slots=True)
class OneOf:
    """Messages for a text that is none of the words of an enumeration or a literal."""

    problem: str
    """Format of the message, in which `{}` is the text."""
    lists_words: bool = False
    """Whether a help line lists the words."""
    folds_case: bool = True


def noun(text: str, *, folds_case: bool = True) -> OneOf:
    """Return the messages for words that a noun with its article names, such as `a type`."""
    return OneOf(f"`{{}}` is not {text}", lists_words=True, folds_case=folds_case)


@value_class(frozen=True, slots=True)
class Required:
    """Message for a required value that is missing, empty or invalid."""

    problem: str
    of_table: bool = False
    """Whether the message is about the table, not about the key."""


@value_class(frozen=True, slots=True)
class Needs:
    """A key that the table must have for this one, and the message if it lacks it."""

    key: str
    problem: str


@value_class(frozen=True, slots=True)
class Excludes:
    """A key that the table must not have in addition to this one, and the message if it has."""

    key: str
    problem: str


@value_class(frozen=True, slots=True)
class OutputRecord:
    """The object that a command prints with `--format json`."""

    schema: ClassVar[int] = 1
    """Grows when a key changes its meaning or is removed; new keys may be added at any time."""


@value_class(frozen=True, slots=True)
class Key:
    """Key of a field that has another name in Python."""

    name: str


@value_class(frozen=True, slots=True)
class RecordField:
    """One field of a record."""

    name: str
    key: str
    type: Any
    """The type with its marks."""
    is_constant: bool
    is_inline: bool
    is_lenient: bool
    is_optional: bool
    """Whether it is omitted where it is the default."""
    default: object
    """`MISSING` if there is none."""


@cache
def record_fields(record: Any) -> tuple[RecordField, ...]:
    """Return the fields of a record, constants included, in the order of the declaration."""
    types = get_type_hints(record, include_extras=True)
    declared = {field.name: field for field in dataclasses.fields(record) if field.init}
    found = []
    for name, type_ in types.items():
        is_constant = get_origin(type_) is ClassVar
        if not is_constant and name not in declared:
            continue
        marks = getattr(type_, "__metadata__", ())
        is_inline = ValueForm.INLINE in marks
        is_optional = is_inline or ValueForm.OPTIONAL in marks
        default = MISSING if is_constant or is_inline else declared[name].default
        found.append(
            RecordField(
                name=name,
                key=next((one.name for one in marks if isinstance(one, Key)), name),
                type=get_args(type_)[0] if is_constant else type_,
                is_constant=is_constant,
                is_inline=is_inline,
                is_lenient=ValueForm.LENIENT in marks,
                is_optional=is_optional,
                default=None if is_optional and default is MISSING else default,
            )
        )
    return tuple(found)


def is_record(type_: object) -> bool:
    """Whether a type is a record."""
    return isinstance(type_, type) and dataclasses.is_dataclass(type_)


def marks_of(type_: Any) -> tuple[Any, tuple[Any, ...]]:
    """Return a type without its marks, and these."""
    if get_origin(type_) is Annotated:
        return type_.__origin__, type_.__metadata__
    return type_, ()


def alternatives(type_: Any) -> tuple[tuple[Any, ...], bool]:
    """Return the types that a value may have but None, and whether it may be None."""
    if get_origin(type_) not in _UNIONS:
        return (type_,), False
    types = get_args(type_)
    return tuple(one for one in types if one is not NoneType), NoneType in types


def item_type(type_: Any) -> Any:
    """Return the type of the items of an array; None if the type is no array."""
    return get_args(type_)[0] if get_origin(type_) in _ARRAYS else None


def item_count(type_: Any) -> int | None:
    """Return the number of items of an array; None if it may vary."""
    items = get_args(type_)
    return None if get_origin(type_) is not tuple or Ellipsis in items else len(items)


def value_type(type_: Any) -> Any:
    """Return the type of the values of an object without declared keys; None for other types."""
    return get_args(type_)[1] if get_origin(type_) is Mapping else None
