"""Mathematics and bits: exact values, single precision, refusals."""

import math
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st
from library_controller import call

from rapidsim.language import error_numbers as errors
from rapidsim.language.data import UNUSED_AXIS
from rapidsim.language.errors import RapidError
from rapidsim.language.reference import Box
from rapidsim.language.single_precision import LARGEST_SINGLE, single
from rapidsim.language.types import DNUM, NUM, Alias

singles = st.floats(width=32, allow_nan=False, allow_infinity=False)
normal_doubles = st.floats(
    min_value=-LARGEST_SINGLE, max_value=LARGEST_SINGLE, allow_nan=False
).filter(lambda x: x == 0.0 or abs(x) > 1.2e-38)


@given(normal_doubles)
def test_single_is_what_four_bytes_keep(x: float) -> None:
    assert single(x) == struct.unpack("f", struct.pack("f", x))[0]


@given(singles.filter(lambda x: x == 0.0 or abs(x) > 1.2e-38))
def test_a_single_stays_itself(x: float) -> None:
    assert single(x) == x


def test_the_mark_of_an_unused_axis_is_what_a_program_writes() -> None:
    assert single(9e9) == UNUSED_AXIS


@pytest.mark.parametrize("x", [1e39, -1e39, math.inf, math.nan])
def test_what_no_num_holds_is_an_overflow(x: float) -> None:
    with pytest.raises(RapidError, match="beyond the range of num") as caught:
        single(x)
    assert caught.value.errno == errors.ERR_OVERFLOW


VALUES = [
    ("Abs", (-2.5,), 2.5),
    ("Sqrt", (9.0,), 3.0),
    ("Sqrt", (2.0,), single(math.sqrt(2.0))),
    ("SqrtDnum", (2.0,), math.sqrt(2.0)),
    ("Pow", (2.0, 10.0), 1024.0),
    ("Pow", (-2.0, 3.0), -8.0),
    ("Exp", (0.0,), 1.0),
    ("Sin", (30.0,), 0.5),
    ("Sin", (180.0,), 0.0),
    ("Sin", (-90.0,), -1.0),
    ("Cos", (90.0,), 0.0),
    ("Cos", (60.0,), 0.5),
    ("Cos", (720.0,), 1.0),
    ("Tan", (45.0,), 1.0),
    ("ASin", (1.0,), 90.0),
    ("ACos", (-1.0,), 180.0),
    ("ATan", (1.0,), 45.0),
    ("ATan2", (1.0, -1.0), 135.0),
    ("ATan2", (0.0, -1.0), 180.0),
    ("ATan2Dnum", (-1.0, -1.0), -135.0),
    ("NumToDnum", (0.5,), 0.5),
    ("DnumToNum", (0.1,), single(0.1)),
    ("BitAnd", (12.0, 10.0), 8.0),
    ("BitOr", (12.0, 10.0), 14.0),
    ("BitXOr", (12.0, 10.0), 6.0),
    ("BitNeg", (15.0,), 240.0),
    ("BitLSh", (129.0, 1.0), 2.0),
    ("BitRSh", (129.0, 1.0), 64.0),
    ("BitCheck", (128.0, 8.0), True),
    ("BitCheck", (128.0, 7.0), False),
    ("BitAndDnum", (2.0**40 + 1.0, 2.0**40), 2.0**40),
    ("BitNegDnum", (0.0,), 2.0**52 - 1.0),
    ("BitLShDnum", (1.0, 51.0), 2.0**51),
    ("BitRShDnum", (2.0**51, 51.0), 1.0),
    ("BitCheckDnum", (2.0**51, 52.0), True),
]


@pytest.mark.parametrize(("name", "arguments", "expected"), VALUES)
def test_value(name: str, arguments: tuple[float, ...], expected: object) -> None:
    assert call(name, *arguments) == expected


ROUNDED = [
    ("Round", 0.3852138754655357, 3.0, 0.385),
    ("Round", 0.3852138754655357, 1.0, 0.4),
    ("Round", 0.3852138754655357, None, 0.0),
    ("Round", 2.5, None, 3.0),
    ("Round", -2.5, None, -3.0),
    ("Round", 0.125, 2.0, 0.13),
    ("Trunc", 0.3852138754655357, 3.0, 0.385),
    ("Trunc", 0.3852138754655357, 1.0, 0.3),
    ("Trunc", -0.9, None, 0.0),
    ("Trunc", 7.9, None, 7.0),
]


@pytest.mark.parametrize(("name", "value", "decimals", "expected"), ROUNDED)
def test_rounding(name: str, value: float, decimals: float | None, expected: float) -> None:
    assert call(name, single(value), dec=decimals) == single(expected)


@given(singles.filter(lambda x: abs(x) < 1e6), st.integers(0, 3))
def test_rounding_moves_half_a_step_at_most(x: float, decimals: int) -> None:
    rounded = call("RoundDnum", x, dec=float(decimals))
    assert abs(rounded - x) <= 0.5 * 10.0**-decimals * (1.0 + 1e-9)
    assert abs(call("TruncDnum", x, dec=float(decimals))) <= abs(x)


@given(st.floats(-1e4, 1e4))
def test_sine_and_cosine_lie_on_the_circle(angle: float) -> None:
    assert math.isclose(call("SinDnum", angle) ** 2 + call("CosDnum", angle) ** 2, 1.0)


@given(st.floats(-89.0, 89.0))
def test_arc_functions_undo(angle: float) -> None:
    assert math.isclose(call("ASinDnum", call("SinDnum", angle)), angle, abs_tol=1e-6)
    assert math.isclose(call("ATanDnum", call("TanDnum", angle)), angle, abs_tol=1e-9)


def test_counters_round_num_and_keep_dnum() -> None:
    counter: Box[float] = Box(2.0**24)
    call("Incr", counter, of=NUM)
    assert counter.value == 2.0**24
    call("Incr", counter, of=DNUM)
    assert counter.value == 2.0**24 + 1.0
    call("Add", counter, -1.0, of=DNUM)
    call("Decr", counter, of=Alias("count", NUM))
    assert counter.value == 2.0**24 - 1.0
    call("Clear", counter)
    assert counter.value == 0.0


def test_bits_of_variables() -> None:
    flags: Box[float] = Box(0.0)
    call("BitSet", flags, 8.0, of=NUM)
    assert flags.value == 128.0
    call("BitSet", flags, 52.0, of=DNUM)
    assert flags.value == 2.0**51 + 128.0
    call("BitClear", flags, 8.0, of=DNUM)
    assert flags.value == 2.0**51


@given(st.integers(0, 255), st.integers(0, 255))
def test_de_morgan(a: int, b: int) -> None:
    x, y = float(a), float(b)
    assert call("BitNeg", call("BitAnd", x, y)) == call(
        "BitOr", call("BitNeg", x), call("BitNeg", y)
    )


def test_test_and_set_takes_a_free_flag_once() -> None:
    flag: Box[bool] = Box(False)
    assert call("TestAndSet", flag) is True
    assert call("TestAndSet", flag) is False
    assert flag.value is True


REFUSED = [
    ("Sqrt", (-1.0,), {}, "ERR_ARGVALERR", "no square root of -1"),
    ("Pow", (-8.0, 0.5), {}, "ERR_ARGVALERR", "-8 is negative and has no power 0.5"),
    ("Pow", (0.0, -1.0), {}, "ERR_ARGVALERR", "0 has no power -1"),
    ("Pow", (10.0, 39.0), {}, "ERR_OVERFLOW", "beyond the range of num"),
    ("PowDnum", (10.0, 400.0), {}, "ERR_OVERFLOW", "10 to the power 400 is too large"),
    ("Exp", (1000.0,), {}, "ERR_OVERFLOW", "e to the power 1000 is too large"),
    ("Tan", (90.0,), {}, "ERR_OVERFLOW", "90 degrees have no tangent"),
    ("ACos", (1.5,), {}, "ERR_ARGVALERR", "1.5 has no arccosine: it is not within -1..1"),
    ("Round", (1.0,), {"dec": 16.0}, "ERR_ARGVALERR", "16 decimals"),
    ("DnumToNum", (0.5,), {"integer": True}, "ERR_INT_NOTVAL", "0.5 is not a whole number"),
    ("DnumToNum", (1e7,), {"integer": True}, "ERR_ARGVALERR", "larger than 8388608"),
    ("DnumToNum", (1e300,), {}, "ERR_NUM_LIMIT", "1e\\+300 is beyond the range of num"),
    ("TryInt", (0.5,), {}, "ERR_INT_NOTVAL", "0.5 is not a whole number"),
    ("BitAnd", (256.0, 1.0), {}, "ERR_ARGVALERR", "256 is not within 0..255"),
    ("BitAnd", (1.5, 1.0), {}, "ERR_NOTINTVAL", "1.5 is not a whole number"),
    ("BitCheck", (1.0, 9.0), {}, "ERR_ARGVALERR", "there is no bit 9; bits are 1..8"),
    ("BitLSh", (1.0, 9.0), {}, "ERR_ARGVALERR", "9 shift steps"),
]


@pytest.mark.parametrize(("name", "arguments", "options", "error", "message"), REFUSED)
def test_refusal(
    name: str,
    arguments: tuple[float, ...],
    options: dict[str, object],
    error: str,
    message: str,
) -> None:
    with pytest.raises(RapidError, match=message) as caught:
        call(name, *arguments, **options)
    assert caught.value.errno == errors.NUMBERS[error]
    assert "\n" not in caught.value.message


def test_error_numbers_are_stable_and_apart() -> None:
    numbers = list(errors.NUMBERS.values())
    assert len(set(numbers)) == len(numbers) == 231
    assert not any(1.0 <= n <= 90.0 or n >= errors.FIRST_BOOKED for n in numbers)
    # Released numbers never change: these three stand for all.
    assert (errors.ERR_ACC_TOO_LOW, errors.ERR_DIVZERO, errors.ERR_MOTIONSUP) == (
        20001.0,
        20056.0,
        20221.0,
    )
    assert errors.rapid_error(errors.ERR_DIVZERO, "").cf == "ABB 40194"
    assert errors.rapid_error(errors.ERR_WAIT_MAXTIME, "").cf is None
