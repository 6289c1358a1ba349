"""Mathematics: numbers, trigonometry in degrees, counters, bits.

Results of functions of `num` are rounded when they return (`precision.py`); functions of `dnum`
keep double precision.

Source: Technical reference manual RAPID Instructions, Functions and Data types.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from rapidsim.language.annotations import ArgumentType, Bool, Dnum, InOut, Num, Switch
from rapidsim.language.error_numbers import (
    ERR_ARGVALERR,
    ERR_INT_MAXVAL,
    ERR_INT_NOTVAL,
    ERR_NUM_LIMIT,
    ERR_OVERFLOW,
    rapid_error,
)
from rapidsim.language.single_precision import LARGEST_EXACT_INTEGER, LARGEST_SINGLE, single
from rapidsim.language.types import DNUM, NUM, Type, resolved
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait

LARGEST_EXACT_DNUM = 4503599627370496.0
"""2**52: the largest whole number that dnum functions accept."""


def abs_(value: Num) -> Num:
    """The absolute value."""
    return abs(value)


def abs_dnum(value: Dnum) -> Dnum:
    """The absolute value."""
    return abs(value)


def sqrt(value: Num) -> Num:
    """The square root."""
    return sqrt_dnum(value)


def sqrt_dnum(value: Dnum) -> Dnum:
    """The square root."""
    if value < 0.0:
        raise rapid_error(ERR_ARGVALERR, f"no square root of {value:g}, which is negative")
    return math.sqrt(value)


def pow_(base: Num, exponent: Num) -> Num:
    """The base raised to the exponent."""
    return pow_dnum(base, exponent)


def pow_dnum(base: Dnum, exponent: Num) -> Dnum:
    """The base raised to the exponent."""
    if base == 0.0 and exponent <= 0.0:
        raise rapid_error(ERR_ARGVALERR, f"0 has no power {exponent:g}")
    if base < 0.0 and exponent != math.floor(exponent):
        raise rapid_error(ERR_ARGVALERR, f"{base:g} is negative and has no power {exponent:g}")
    return _finite(lambda: math.pow(base, exponent), f"{base:g} to the power {exponent:g}")


def exp(exponent: Num) -> Num:
    """The number e raised to the exponent."""
    return _finite(lambda: math.exp(exponent), f"e to the power {exponent:g}")


def sin(angle: Num) -> Num:
    """The sine of an angle [deg]."""
    return sin_dnum(angle)


def sin_dnum(angle: Dnum) -> Dnum:
    """The sine of an angle [deg]; exact at multiples of 90."""
    return (0.0, 1.0, 0.0, -1.0)[int(angle // 90.0) % 4] if angle % 90.0 == 0.0 else _sine(angle)


def cos(angle: Num) -> Num:
    """The cosine of an angle [deg]."""
    return cos_dnum(angle)


def cos_dnum(angle: Dnum) -> Dnum:
    """The cosine of an angle [deg]; exact at multiples of 90."""
    quarter = int(angle // 90.0) % 4
    return (1.0, 0.0, -1.0, 0.0)[quarter] if angle % 90.0 == 0.0 else _cosine(angle)


def tan(angle: Num) -> Num:
    """The tangent of an angle [deg]."""
    return tan_dnum(angle)


def tan_dnum(angle: Dnum) -> Dnum:
    """The tangent of an angle [deg]."""
    cosine = cos_dnum(angle)
    if cosine == 0.0:
        raise rapid_error(ERR_OVERFLOW, f"{angle:g} degrees have no tangent")
    return sin_dnum(angle) / cosine


def a_sin(value: Num) -> Num:
    """The angle [deg] in -90..90 with this sine."""
    return a_sin_dnum(value)


def a_sin_dnum(value: Dnum) -> Dnum:
    """The angle [deg] in -90..90 with this sine."""
    return math.degrees(math.asin(_within_one(value, "arcsine")))


def a_cos(value: Num) -> Num:
    """The angle [deg] in 0..180 with this cosine."""
    return a_cos_dnum(value)


def a_cos_dnum(value: Dnum) -> Dnum:
    """The angle [deg] in 0..180 with this cosine."""
    return math.degrees(math.acos(_within_one(value, "arccosine")))


def a_tan(value: Num) -> Num:
    """The angle [deg] in -90..90 with this tangent."""
    return math.degrees(math.atan(value))


def a_tan_dnum(value: Dnum) -> Dnum:
    """The angle [deg] in -90..90 with this tangent."""
    return math.degrees(math.atan(value))


def a_tan2(y: Num, x: Num) -> Num:
    """The angle [deg] in -180..180 of the point (x, y)."""
    return math.degrees(math.atan2(y, x))


def a_tan2_dnum(y: Dnum, x: Dnum) -> Dnum:
    """The angle [deg] in -180..180 of the point (x, y)."""
    return math.degrees(math.atan2(y, x))


def round_(val: Num, *, dec: Num | None = None) -> Num:
    """The nearest number with `Dec` decimals, halves away from zero."""
    return round_dnum(val, dec=dec)


def round_dnum(val: Dnum, *, dec: Num | None = None) -> Dnum:
    """The nearest number with `Dec` decimals, halves away from zero."""
    return _to_decimals(val, dec, lambda scaled: math.floor(scaled + 0.5))


def trunc(val: Num, *, dec: Num | None = None) -> Num:
    """The number truncated to `Dec` decimals."""
    return trunc_dnum(val, dec=dec)


def trunc_dnum(val: Dnum, *, dec: Num | None = None) -> Dnum:
    """The number truncated to `Dec` decimals."""
    return _to_decimals(val, dec, math.floor)


def max_(value1: Num, value2: Num) -> Num:
    """The larger of two numbers."""
    return max(value1, value2)


def min_(value1: Num, value2: Num) -> Num:
    """The smaller of two numbers."""
    return min(value1, value2)


def num_to_dnum(value: Num) -> Dnum:
    """The number as a dnum, unchanged."""
    return value


def dnum_to_num(value: Dnum, *, integer: Switch = False) -> Num:
    r"""The nearest `num`; with \Integer only whole numbers that a num holds exactly."""
    if abs(value) > LARGEST_SINGLE:
        raise rapid_error(ERR_NUM_LIMIT, f"{value:g} is beyond the range of num")
    if integer:
        _check_whole(value, LARGEST_EXACT_INTEGER, beyond=ERR_ARGVALERR)
    return value


def try_int(data_obj: Num | Dnum, *, of: ArgumentType = NUM) -> None:
    """Raise an error unless the value is a whole number within exact range."""
    _check_whole(data_obj, LARGEST_EXACT_INTEGER if resolved(of) == NUM else LARGEST_EXACT_DNUM)


def add(name: InOut[Num] | InOut[Dnum], add_value: Num | Dnum, *, of: ArgumentType = NUM) -> None:
    """Add a value to a variable."""
    name.value = _as(of, name.value + add_value)


def incr(name: InOut[Num] | InOut[Dnum], *, of: ArgumentType = NUM) -> None:
    """Add 1 to a variable."""
    name.value = _as(of, name.value + 1.0)


def decr(name: InOut[Num] | InOut[Dnum], *, of: ArgumentType = NUM) -> None:
    """Subtract 1 from a variable."""
    name.value = _as(of, name.value - 1.0)


def clear(name: InOut[Num] | InOut[Dnum]) -> None:
    """Set a variable to 0."""
    name.value = 0.0


def test_and_set(object_: InOut[Bool]) -> Bool:
    """Set a variable to TRUE; TRUE if it was FALSE before."""
    was_free = not object_.value
    object_.value = True
    return was_free


def _as(of: Type, value: float) -> float:
    return value if resolved(of) == DNUM else single(value)


def _sine(angle: float) -> float:
    # Reduced in degrees, where the reduction is exact.
    return math.sin(math.radians(math.fmod(angle, 360.0)))


def _cosine(angle: float) -> float:
    return math.cos(math.radians(math.fmod(angle, 360.0)))


def _within_one(value: float, function: str) -> float:
    if not -1.0 <= value <= 1.0:
        raise rapid_error(ERR_ARGVALERR, f"{value:.7g} has no {function}: it is not within -1..1")
    return value


def _finite(compute: Callable[[], float], subject: str) -> float:
    try:
        return compute()
    except OverflowError:
        raise rapid_error(ERR_OVERFLOW, f"{subject} is too large for any number") from None


def _to_decimals(
    value: float, decimals: float | None, round_value: Callable[[float], int]
) -> float:
    places = 0 if decimals is None else int(decimals)
    if not 0 <= places <= 15:
        raise rapid_error(ERR_ARGVALERR, f"{places} decimals; 0 to 15 are possible")
    scale = 10.0**places
    if abs(value) * scale > LARGEST_EXACT_DNUM:
        return value
    return math.copysign(round_value(abs(value) * scale) / scale, value)


def _check_whole(value: float, largest: float, beyond: float = ERR_INT_MAXVAL) -> None:
    if value != math.floor(value):
        raise rapid_error(ERR_INT_NOTVAL, f"{value:.7g} is not a whole number")
    if abs(value) > largest:
        raise rapid_error(beyond, f"{value:.7g} is larger than {largest:.0f}")


MATHEMATICS = table(
    routine("Abs", abs_),
    routine("AbsDnum", abs_dnum),
    routine("Sqrt", sqrt),
    routine("SqrtDnum", sqrt_dnum),
    routine("Pow", pow_),
    routine("PowDnum", pow_dnum),
    routine("Exp", exp),
    routine("Sin", sin, does=Trait.ANGLES),
    routine("SinDnum", sin_dnum, does=Trait.ANGLES),
    routine("Cos", cos, does=Trait.ANGLES),
    routine("CosDnum", cos_dnum, does=Trait.ANGLES),
    routine("Tan", tan, does=Trait.ANGLES),
    routine("TanDnum", tan_dnum, does=Trait.ANGLES),
    routine("ASin", a_sin),
    routine("ASinDnum", a_sin_dnum),
    routine("ACos", a_cos),
    routine("ACosDnum", a_cos_dnum),
    routine("ATan", a_tan),
    routine("ATanDnum", a_tan_dnum),
    routine("ATan2", a_tan2),
    routine("ATan2Dnum", a_tan2_dnum),
    routine("Round", round_),
    routine("RoundDnum", round_dnum),
    routine("Trunc", trunc),
    routine("TruncDnum", trunc_dnum),
    routine("Max", max_),
    routine("Min", min_),
    routine("NumToDnum", num_to_dnum),
    routine("DnumToNum", dnum_to_num),
    routine("TryInt", try_int, "DataObj|DataObj2"),
    routine("Add", add, "Name|Dname AddValue|AddDvalue", does=Trait.INSTANT),
    routine("Incr", incr, "Name|Dname", does=Trait.INSTANT | Trait.COUNT_UP),
    routine("Decr", decr, "Name|Dname", does=Trait.INSTANT),
    routine("Clear", clear, "Name|Dname", does=Trait.INSTANT),
    routine("TestAndSet", test_and_set, "Object"),
)
