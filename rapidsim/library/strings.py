"""String functions. Characters are counted from 1; a string holds at most 80.

Source: Technical reference manual RAPID Instructions, Functions and Data types. The rounding of
halves by NumToStr and the result of StrMatch for an empty pattern were measured on RobotStudio's
controller (CrossArm, a public project, probe of strings).
"""

from __future__ import annotations

import math
import re

from rapidsim.language.annotations import (
    AnyType,
    ArgumentType,
    Bool,
    Byte,
    Dnum,
    InOut,
    Num,
    OpCalc,
    OpNum,
    String,
    StringDig,
    Switch,
)
from rapidsim.language.error_numbers import (
    ERR_ARGVALERR,
    ERR_CALC_DIVZERO,
    ERR_CALC_NEG,
    ERR_CALC_OVERFLOW,
    ERR_INT_MAXVAL,
    ERR_INT_NOTVAL,
    rapid_error,
)
from rapidsim.language.types import NUM
from rapidsim.library.table import routine, table
from rapidsim.library.text import checked, parsed_value, string_text

_PLACE = re.compile(r"\{(\d+)\}")
_LATIN_1 = "iso-8859-1"
MAX_DECIMALS = 15
_DIVISION, _MODULUS = 3, 4
"""Indices of OpDiv and OpMod among the operations."""
_MAX_DIGITS_VALUE = 2**32 - 1
"""The largest value of a `stringdig`."""


def num_to_str(val: Num, dec: Num, *, exp: Switch = False) -> String:
    """A number with `Dec` decimals, halves to the even digit; in exponent notation if requested."""
    return dnum_to_str(val, dec, exp=exp)


def dnum_to_str(val: Dnum, dec: Num, *, exp: Switch = False) -> String:
    """A number with `Dec` decimals, halves to the even digit; in exponent notation if requested."""
    decimals = int(dec)
    if not 0 <= decimals <= MAX_DECIMALS:
        raise rapid_error(ERR_ARGVALERR, f"{decimals} decimals; 0 to {MAX_DECIMALS} are possible")
    return checked(f"{val:.{decimals}{'E' if exp else 'f'}}")


def str_format(
    str_: String,
    *,
    arg1: String | None = None,
    arg2: String | None = None,
    arg3: String | None = None,
    arg4: String | None = None,
    arg5: String | None = None,
    arg6: String | None = None,
    arg7: String | None = None,
    arg8: String | None = None,
) -> String:
    """A text with its placeholders {1} to {8} replaced; one without an argument is an error."""
    given = (arg1, arg2, arg3, arg4, arg5, arg6, arg7, arg8)

    def argument(place: re.Match[str]) -> str:
        number = int(place[1])
        found = given[number - 1] if 1 <= number <= len(given) else None
        if found is None:
            raise rapid_error(ERR_ARGVALERR, rf"StrFormat: there is no \Arg{number} for {place[0]}")
        return found

    return checked(_PLACE.sub(argument, str_))


def val_to_str(val: AnyType, *, of: ArgumentType = NUM) -> String:
    """A value in RAPID source notation; a string with its quotes."""
    return string_text(val, of)


def str_to_val(str_: String, val: InOut[AnyType], *, of: ArgumentType = NUM) -> Bool:
    """Read a value from text; FALSE if the text is no such value, and `val` is unchanged."""
    # An array is its own reference.
    value = parsed_value(str_, of, val if isinstance(val, list) else val.value)
    if value is None:
        return False
    if isinstance(val, list):
        assert isinstance(value, list)
        val[:] = value
    else:
        val.value = value
    return True


def str_len(str_: String) -> Num:
    """The number of characters in a string."""
    return float(len(str_))


def str_part(str_: String, ch_pos: Num, len_: Num) -> String:
    """The part of a string that begins at a position and has `Len` characters."""
    # Loops over characters call this most, so valid arguments cost only two comparisons.
    start = int(ch_pos) - 1
    end = start + int(len_)
    if 0 <= start == ch_pos - 1.0 and start <= end <= len(str_) > start:
        return str_[start:end]
    start = _position(str_, ch_pos, len(str_))
    raise rapid_error(
        ERR_ARGVALERR,
        f"no {int(len_)} characters from {start + 1} in a string of {len(str_)}",
    )


def str_find(str_: String, ch_pos: Num, set_: String, *, not_in_set: Switch = False) -> Num:
    """The position of the first character that is in a set; length + 1 without one."""
    for index in range(_position(str_, ch_pos, len(str_) + 1), len(str_)):
        if (str_[index] in set_) != not_in_set:
            return float(index + 1)
    return float(len(str_) + 1)


def str_match(str_: String, ch_pos: Num, pattern: String) -> Num:
    """The position where a pattern begins; length + 1 if it does not occur, or is empty."""
    found = str_.find(pattern, _position(str_, ch_pos, len(str_) + 1))
    return float(len(str_) + 1 if found < 0 or not pattern else found + 1)


def str_map(str_: String, from_map: String, to_map: String) -> String:
    """The string with the characters of one map replaced by those in the other map."""
    if len(from_map) != len(to_map):
        raise rapid_error(
            ERR_ARGVALERR, f"the maps have {len(from_map)} and {len(to_map)} characters"
        )
    return str_.translate(str.maketrans(from_map, to_map))


def str_memb(str_: String, ch_pos: Num, set_: String) -> Bool:
    """Whether the character at a position is in a set."""
    return str_[_position(str_, ch_pos, len(str_))] in set_


def str_order(str1: String, str2: String, order: String) -> Bool:
    """Whether two strings are in order; characters missing in `order` follow it."""

    def rank(text: str) -> list[tuple[int, int]]:
        places = [order.find(character) for character in text]
        return [
            (place, 0) if place >= 0 else (len(order), ord(character))
            for place, character in zip(places, text, strict=True)
        ]

    return rank(str1) <= rank(str2)


def str_to_byte(
    con_str: String,
    *,
    hex_: Switch = False,
    okt: Switch = False,
    bin_: Switch = False,
    char: Switch = False,
) -> Byte:
    """Read a byte in decimal notation, or in the notation of a switch."""
    if char:
        if len(con_str) != 1:
            raise rapid_error(ERR_ARGVALERR, f'"{con_str}" is not one character')
        return float(con_str.encode(_LATIN_1, "replace")[0])
    base = 16 if hex_ else 8 if okt else 2 if bin_ else 10
    value = _whole(con_str, base)
    if value > 255:
        raise rapid_error(ERR_ARGVALERR, f'"{con_str}" is {value}; a byte holds at most 255')
    return float(value)


def byte_to_str(
    bit_data: Byte,
    *,
    hex_: Switch = False,
    okt: Switch = False,
    bin_: Switch = False,
    char: Switch = False,
) -> String:
    """Write a byte in decimal notation, or with leading zeros in the notation of a switch."""
    if not (0 <= bit_data <= 255 and bit_data == math.floor(bit_data)):
        raise rapid_error(ERR_ARGVALERR, f"{bit_data:.7g} is not a byte; bytes are 0..255")
    value = int(bit_data)
    if char:
        return chr(value)
    return format(value, "02X" if hex_ else "03o" if okt else "08b" if bin_ else "d")


def dec_to_hex(str_: String) -> String:
    """A whole number, converted from decimal to hexadecimal digits."""
    return format(_whole(str_, 10), "X")


def hex_to_dec(str_: String) -> String:
    """A whole number, converted from hexadecimal to decimal digits."""
    return str(_whole(str_, 16))


def str_dig_cmp(str_dig1: StringDig, relation: OpNum, str_dig2: StringDig) -> Bool:
    """Compare two whole numbers written in digits."""
    a, b = _digits(str_dig1), _digits(str_dig2)
    outcomes = (a < b, a <= b, a == b, a != b, a > b, a >= b)
    return outcomes[_choice(relation, len(outcomes), "relation")]


def str_dig_calc(str_dig1: StringDig, operation: OpCalc, str_dig2: StringDig) -> StringDig:
    """Compute with two whole numbers written in digits."""
    a, b = _digits(str_dig1), _digits(str_dig2)
    chosen = _choice(operation, 5, "operation")
    if chosen == _MODULUS and b == 0:
        raise rapid_error(ERR_INT_NOTVAL, f"{a} has no remainder by 0")
    if chosen == _DIVISION and b == 0:
        raise rapid_error(ERR_CALC_DIVZERO, f"{a} divided by 0")
    result = (a + b, a - b, a * b, a // (b or 1), a % (b or 1))[chosen]
    if result < 0:
        raise rapid_error(ERR_CALC_NEG, f"the result {result} is negative")
    if result > _MAX_DIGITS_VALUE:
        raise rapid_error(ERR_CALC_OVERFLOW, f"the result {result} exceeds {_MAX_DIGITS_VALUE}")
    return str(result)


def _position(text: str, position: float, last: int) -> int:
    """A character position as an index from 0."""
    if not (1 <= position <= last and position == math.floor(position)):
        raise rapid_error(
            ERR_ARGVALERR, f"no position {position:.7g} in a string of {len(text)} characters"
        )
    return int(position) - 1


def _whole(text: str, base: int, default: float = ERR_ARGVALERR) -> int:
    digits = text.strip()
    try:
        # Python would also accept underscores, signs and prefixes.
        if digits.isalnum() and digits.isascii():
            return int(digits, base)
    except ValueError:
        pass
    raise rapid_error(default, f'"{text}" is no whole number to base {base}')


def _digits(text: str) -> int:
    value = _whole(text, 10, ERR_INT_NOTVAL)
    if value > _MAX_DIGITS_VALUE:
        raise rapid_error(ERR_INT_MAXVAL, f"{value} exceeds {_MAX_DIGITS_VALUE}")
    return value


def _choice(value: float, count: int, subject: str) -> int:
    if not (1 <= value <= count and value == math.floor(value)):
        raise rapid_error(ERR_ARGVALERR, f"{value:.7g} is no {subject}")
    return int(value) - 1


_BASES = r"\Hex|\Okt|\Bin|\Char"

STRINGS = table(
    routine(
        "StrFormat",
        str_format,
        r"Str \Arg1 \Arg2 \Arg3 \Arg4 \Arg5 \Arg6 \Arg7 \Arg8",
    ),
    routine("NumToStr", num_to_str),
    routine("DnumToStr", dnum_to_str),
    routine("ValToStr", val_to_str),
    routine("StrToVal", str_to_val, "Str Val"),
    routine("StrLen", str_len, "Str"),
    routine("StrPart", str_part, "Str ChPos Len"),
    routine("StrFind", str_find, r"Str ChPos Set \NotInSet"),
    routine("StrMatch", str_match, "Str ChPos Pattern"),
    routine("StrMap", str_map, "Str FromMap ToMap"),
    routine("StrMemb", str_memb, "Str ChPos Set"),
    routine("StrOrder", str_order),
    routine("StrToByte", str_to_byte, f"ConStr {_BASES}"),
    routine("ByteToStr", byte_to_str, f"BitData {_BASES}"),
    routine("DecToHex", dec_to_hex, "Str"),
    routine("HexToDec", hex_to_dec, "Str"),
    routine("StrDigCmp", str_dig_cmp),
    routine("StrDigCalc", str_dig_calc),
)
