"""Conversion of RAPID values to text and back.

A `num` is written with 6 significant digits, a `dnum` with 15, exponents as `1E+06`; records and
arrays in source notation.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "ValToStr",
"StrToVal", "TPWrite"; the number of digits was measured on controllers.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence

from rapidsim.language.error_numbers import ERR_STRTOOLNG, rapid_error
from rapidsim.language.errors import RapidError
from rapidsim.language.single_precision import nearest_single, single
from rapidsim.language.types import BOOL, DNUM, NUM, STRING, ArrayOf, Record, Type, resolved
from rapidsim.library.arithmetic import MAX_STRING

_NUMBER = re.compile(r"[+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:E[+-]?\d+)?", re.IGNORECASE)
_STRING = re.compile(r'"((?:[^"\\]|""|\\\\|\\[0-9A-Fa-f]{2})*)"')
_ESCAPE = re.compile(r'""|\\\\|\\([0-9A-Fa-f]{2})')
_CONTROL = re.compile(r"[\x00-\x1f\x7f]")
_BLANKS = re.compile(r"\s*")


def checked(text: str) -> str:
    """Return the text itself.

    Raises:
        RapidError: ERR_STRTOOLNG, if the text is longer than a string can be.
    """
    if len(text) > MAX_STRING:
        raise rapid_error(
            ERR_STRTOOLNG, f"the string has {len(text)} characters; {MAX_STRING} are possible"
        )
    return text


def number_text(value: float) -> str:
    """A `num` with 6 significant digits: `12`, `0.333333`, `1E+06`."""
    return f"{value + 0.0:.6G}"


def dnum_text(value: float) -> str:
    """A `dnum` with 15 significant digits."""
    return f"{value + 0.0:.15G}"


def element_count(value: object) -> int:
    """Return the number of elements of an array; 1 for other values."""
    count = 1
    while isinstance(value, list):
        count *= len(value)
        value = value[0] if value else None
    return count


def value_text(value: object, of: Type) -> str:
    """A value of any type in source notation, numbers rounded as by ValToStr."""
    return _text(value, of, _rounded_leaf)


def string_text(value: object, of: Type) -> str:
    """A value of any type as a string.

    Raises:
        RapidError: ERR_STRTOOLNG, if it is longer than a string can be.
    """
    count = element_count(value)
    if count > MAX_STRING:
        raise rapid_error(
            ERR_STRTOOLNG, f"the string has more than {count} characters; {MAX_STRING} are possible"
        )
    return checked(value_text(value, of))


def source_text(value: object, of: Type) -> str:
    """A value as an initial value, which reads back as exactly the same value.

    Numbers have as many digits as necessary, control characters their codes.
    """
    return _text(value, of, _exact_leaf)


def _text(value: object, of: Type, leaf_text: Callable[[object, Type], str]) -> str:
    """Text of a value with its atomic parts written by `leaf_text`."""
    of = resolved(of)
    match value:
        case tuple() if isinstance(of, Record):
            parts = zip(value, of.components, strict=True)
            return "[" + ",".join(_text(part, c.type, leaf_text) for part, c in parts) + "]"
        case list() if isinstance(of, ArrayOf):
            element = _element(of)
            return "[" + ",".join(_text(part, element, leaf_text) for part in value) + "]"
        case _:
            return leaf_text(value, of)


def _rounded_leaf(value: object, of: Type) -> str:
    match value:
        case bool():
            return "TRUE" if value else "FALSE"
        case int() | float():
            return dnum_text(value) if of == DNUM else number_text(value)
        case str():
            return '"' + value.replace("\\", "\\\\").replace('"', '""') + '"'
        case _:
            raise TypeError(f"a value of type {of.name} has no text")


def _exact_leaf(value: object, of: Type) -> str:
    match value:
        case str():
            return _CONTROL.sub(lambda c: f"\\{ord(c[0]):02X}", _rounded_leaf(value, of))
        case float() if of == DNUM:
            return next(text for text in _digits(value, 15, 17) if float(text) == value)
        case float():
            return next(
                text for text in _digits(value, 6, 9) if nearest_single(float(text)) == value
            )
        case _:
            return _rounded_leaf(value, of)


def _digits(value: float, least: int, most: int) -> Iterator[str]:
    """Yield a number with an increasing number of significant digits; the last is always exact."""
    return (f"{value + 0.0:.{digits}G}" for digits in range(least, most + 1))


def parsed_number(text: str) -> float | None:
    """The `num` that a text represents, surrounding blanks allowed; None if it is no number."""
    value = parsed_value(text, NUM, 0.0)
    return value if isinstance(value, float) else None


def parsed_value(text: str, of: Type, sample: object) -> object | None:
    """The value of a type that a text represents; None if it represents none.

    Args:
        text: Source notation, as after `:=` in a program.
        of: The type of the data.
        sample: A value of that type, which determines the sizes of arrays.
    """
    try:
        value, end = _parse(text, _skip(text, 0), of, sample)
    except (ValueError, RapidError):
        return None
    return value if _skip(text, end) == len(text) else None


def _parse(text: str, at: int, of: Type, sample: object) -> tuple[object, int]:
    of = resolved(of)
    if isinstance(of, Record):
        assert isinstance(sample, tuple)
        part_types = [component.type for component in of.components]
        parts, end = _parse_parts(text, at, part_types, sample)
        return tuple.__new__(of.python, parts), end
    if isinstance(of, ArrayOf):
        assert isinstance(sample, list)
        return _parse_parts(text, at, [_element(of)] * len(sample), sample)
    if of == BOOL:
        for word, value in (("TRUE", True), ("FALSE", False)):
            if text[at : at + len(word)].upper() == word:
                return value, at + len(word)
    elif of in (NUM, DNUM):
        if number := _NUMBER.match(text, at):
            read = float(number[0])
            return single(read) if of == NUM else read, number.end()
    elif of == STRING and (literal := _STRING.match(text, at)):
        return checked(_ESCAPE.sub(_unescaped, literal[1])), literal.end()
    raise ValueError(f"no {of.name} at {at}")


def _parse_parts(
    text: str, at: int, types: Sequence[Type], samples: Sequence[object]
) -> tuple[list[object], int]:
    parts = []
    for index, (of, sample) in enumerate(zip(types, samples, strict=True)):
        at = _expect(text, at, "," if index else "[")
        value, at = _parse(text, at, of, sample)
        parts.append(value)
    return parts, _expect(text, at, "]")


def _expect(text: str, at: int, mark: str) -> int:
    at = _skip(text, at)
    if text[at : at + 1] != mark:
        raise ValueError(f"no {mark} at {at}")
    return at + 1 if mark == "]" else _skip(text, at + 1)


def _skip(text: str, at: int) -> int:
    blanks = _BLANKS.match(text, at)
    return blanks.end() if blanks else at


def _unescaped(escape: re.Match[str]) -> str:
    return chr(int(escape[1], 16)) if escape[1] else escape[0][0]


def _element(of: ArrayOf) -> Type:
    inner = of.dimensions[1:]
    return ArrayOf(of.element, inner) if inner else of.element
