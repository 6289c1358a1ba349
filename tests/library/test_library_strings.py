"""Strings and how values are written and read: exact texts, laws, refusals."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples
from library_controller import call

from rapidsim.language import error_numbers as errors
from rapidsim.language.data import (
    NO_EXTERNAL_AXES,
    UNUSED_AXIS,
    ConfData,
    Orient,
    Pos,
    RobTarget,
    ZoneData,
)
from rapidsim.language.errors import RapidError
from rapidsim.language.records import record_of
from rapidsim.language.reference import Box
from rapidsim.language.single_precision import single
from rapidsim.language.types import BOOL, DNUM, NUM, STRING, Alias, ArrayOf, Type

TEXTS: list[tuple[object, Type, str]] = [
    (0.0, NUM, "0"),
    (-0.0, NUM, "0"),
    (12.0, NUM, "12"),
    (3, NUM, "3"),
    (single(0.1), NUM, "0.1"),
    (single(1 / 3), NUM, "0.333333"),
    (single(3.1415926), NUM, "3.14159"),
    (single(1234567.0), NUM, "1.23457E+06"),
    (1000000.0, NUM, "1E+06"),
    (999999.0, NUM, "999999"),
    (single(0.00001), NUM, "1E-05"),
    (UNUSED_AXIS, NUM, "9E+09"),
    (0.1, DNUM, "0.1"),
    (1 / 3, DNUM, "0.333333333333333"),
    (4294967295.0, DNUM, "4294967295"),
    (0.5, Alias("speed", NUM), "0.5"),
    (True, BOOL, "TRUE"),
    (False, BOOL, "FALSE"),
    ("abc", STRING, '"abc"'),
    ('say "hi"', STRING, '"say ""hi"""'),
    ("C:\\x", STRING, '"C:\\\\x"'),
    (Pos(1.0, single(2.5), -3.0), record_of(Pos), "[1,2.5,-3]"),
    (Orient(1.0, 0.0, 0.0, 0.0), record_of(Orient), "[1,0,0,0]"),
    (ZoneData(True, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0), record_of(ZoneData), "[TRUE,0,0,0,0,0,0]"),
    ([1.0, 2.0], ArrayOf(NUM, (2,)), "[1,2]"),
    ([[1.0], [2.0]], ArrayOf(NUM, (2, 1)), "[[1],[2]]"),
    (
        RobTarget(Pos(1, 2, 3), Orient(1, 0, 0, 0), ConfData(0, -1, 0, 1), NO_EXTERNAL_AXES),
        record_of(RobTarget),
        "[[1,2,3],[1,0,0,0],[0,-1,0,1],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]]",
    ),
]


@pytest.mark.parametrize(("value", "of", "text"), TEXTS)
def test_value_as_text(value: object, of: Type, text: str) -> None:
    assert call("ValToStr", value, of=of) == text


@pytest.mark.parametrize(("value", "of", "text"), TEXTS)
def test_text_back_to_value(value: object, of: Type, text: str) -> None:
    target: object = list(value) if isinstance(value, list) else Box(value)
    assert call("StrToVal", text, target, of=of) is True
    read = target.value if isinstance(target, Box) else target
    assert call("ValToStr", read, of=of) == text


def test_text_to_value_reads_what_programs_hold() -> None:
    number: Box[float] = Box(0.0)
    for text, expected in {" 3.85 ": 3.85, ".5": 0.5, "5.": 5.0, "-1e2": -100.0, "+7": 7.0}.items():
        assert call("StrToVal", text, number, of=NUM) is True
        assert number.value == single(expected)
    flag: Box[bool] = Box(False)
    assert call("StrToVal", "true", flag, of=BOOL) is True
    assert flag.value is True
    place: Box[object] = Box(Pos(0.0, 0.0, 0.0))
    assert call("StrToVal", " [ 600, 500 , 225.3 ] ", place, of=record_of(Pos)) is True
    assert place.value == Pos(600.0, 500.0, single(225.3))
    assert isinstance(place.value, Pos)


@pytest.mark.parametrize(
    ("text", "of", "before"),
    [
        ("", NUM, 1.0),
        ("abc", NUM, 1.0),
        ("1 2", NUM, 1.0),
        ("1e99", NUM, 1.0),
        ("nan", NUM, 1.0),
        ("0x10", NUM, 1.0),
        ("1_000", NUM, 1.0),
        ("1", BOOL, True),
        ("TRUEST", BOOL, True),
        ("abc", STRING, "s"),
        ('"' + "x" * 81 + '"', STRING, "s"),
        ("[1,2]", record_of(Pos), Pos(1.0, 1.0, 1.0)),
        ("[1,2,3,4]", record_of(Pos), Pos(1.0, 1.0, 1.0)),
        ("[1,2,3", record_of(Pos), Pos(1.0, 1.0, 1.0)),
        ("[1,2,3]]", record_of(Pos), Pos(1.0, 1.0, 1.0)),
        ("1,2,3", record_of(Pos), Pos(1.0, 1.0, 1.0)),
    ],
)
def test_text_that_is_no_value_changes_nothing(text: str, of: Type, before: object) -> None:
    cell = Box(before)
    assert call("StrToVal", text, cell, of=of) is False
    assert cell.value == before


@given(st.integers(-99999, 99999), st.integers(0, 5))
def test_text_of_short_numbers_reads_back_exactly(digits: int, decimals: int) -> None:
    value = single(digits / 10.0**decimals)
    cell: Box[float] = Box(0.0)
    assert call("StrToVal", call("ValToStr", value, of=NUM), cell, of=NUM) is True
    assert cell.value == value


@given(st.integers(-9999999, 9999999).filter(lambda n: abs(n) < 2**23), st.integers(0, 3))
def test_fixed_decimals_of_a_single_read_back(digits: int, decimals: int) -> None:
    """A num with as many decimals as it was written with is what was written, to 7 digits."""
    value = single(digits / 10.0**decimals)
    if abs(value) * 10.0**decimals < 2**23 / 10:
        assert float(call("NumToStr", value, float(decimals))) == digits / 10.0**decimals


@examples()
@given(st.text(alphabet=st.characters(codec="iso-8859-1"), max_size=20))
def test_every_string_reads_back(text: str) -> None:
    cell: Box[str] = Box("")
    literal = call("ValToStr", text, of=STRING)
    assert call("StrToVal", literal, cell, of=STRING) is True
    assert cell.value == text


FORMATTED = [
    (0.38521, 2.0, False, "0.39"),
    (0.38521, 2.0, True, "3.85E-01"),
    (0.3852138754655357, 4.0, False, "0.3852"),
    (1000.0, 0.0, False, "1000"),
    (-1.5, 1.0, False, "-1.5"),
    (0.0, 3.0, False, "0.000"),
    (16777216.0, 0.0, False, "16777216"),
    (2.0, 15.0, False, "2.000000000000000"),
]


@pytest.mark.parametrize(("value", "decimals", "exponent", "text"), FORMATTED)
def test_number_with_decimals(value: float, decimals: float, exponent: bool, text: str) -> None:
    assert call("NumToStr", single(value), decimals, exp=exponent) == text


def test_dnum_keeps_its_digits() -> None:
    assert call("DnumToStr", 0.3852138754655357, 12.0) == "0.385213875466"
    assert call("DnumToStr", 4294967295.0, 0.0) == "4294967295"


VALUES = [
    ("StrLen", ("Robotics",), 8.0),
    ("StrPart", ("Robotics", 1.0, 5.0), "Robot"),
    ("StrPart", ("Robotics", 8.0, 1.0), "s"),
    ("StrPart", ("Robotics", 3.0, 0.0), ""),
    ("StrFind", ("Robotics", 1.0, "aeiou"), 2.0),
    ("StrFind", ("Robotics", 3.0, "aeiou"), 4.0),
    ("StrFind", ("Robotics", 1.0, "xyz"), 9.0),
    ("StrMatch", ("Robotics", 1.0, "bo"), 3.0),
    ("StrMatch", ("Robotics", 4.0, "bo"), 9.0),
    ("StrMatch", ("load robot", 1.0, "ROBOT"), 11.0),
    ("StrMatch", ("load robot", 1.0, ""), 11.0),
    ("NumToStr", (2.5, 0.0), "2"),
    ("StrMap", ("Robotics", "aeiou", "AEIOU"), "RObOtIcs"),
    ("StrMemb", ("Robotics", 2.0, "aeiou"), True),
    ("StrMemb", ("Robotics", 3.0, "aeiou"), False),
    ("StrOrder", ("FIRST", "SECOND", "ABCDEFGHIJKLMNOPQRSTUVWXYZ"), True),
    ("StrOrder", ("FIRSTB", "FIRST", "ABCDEFGHIJKLMNOPQRSTUVWXYZ"), False),
    ("StrOrder", ("FIRST", "FIRST", "ABC"), True),
    ("DecToHex", ("99999999",), "5F5E0FF"),
    ("HexToDec", ("5F5E0FF",), "99999999"),
    ("StrDigCmp", ("4294967295", 1.0, "10"), False),
    ("StrDigCmp", ("9", 1.0, "10"), True),
    ("StrDigCalc", ("10", 4.0, "3"), "3"),
    ("StrDigCalc", ("10", 5.0, "3"), "1"),
]


@pytest.mark.parametrize(("name", "arguments", "expected"), VALUES)
def test_value(name: str, arguments: tuple[object, ...], expected: object) -> None:
    assert call(name, *arguments) == expected


def test_characters_outside_a_set() -> None:
    assert call("StrFind", "12 apples", 1.0, "0123456789", not_in_set=True) == 3.0


@given(st.integers(0, 255), st.sampled_from(["", "hex_", "okt", "bin_", "char"]))
def test_bytes_and_texts_undo_each_other(value: int, base: str) -> None:
    options = {base: True} if base else {}
    text = call("ByteToStr", float(value), **options)
    assert call("StrToByte", text, **options) == float(value)


def test_bytes_have_their_leading_zeros() -> None:
    assert call("ByteToStr", 10.0) == "10"
    assert call("ByteToStr", 10.0, hex_=True) == "0A"
    assert call("ByteToStr", 10.0, okt=True) == "012"
    assert call("ByteToStr", 10.0, bin_=True) == "00001010"
    assert call("ByteToStr", 10.0, char=True) == "\n"


REFUSED = [
    ("StrPart", ("abc", 2.0, 3.0), "ERR_ARGVALERR", "no 3 characters from 2 in a string of 3"),
    ("StrPart", ("abc", 0.0, 1.0), "ERR_ARGVALERR", "no position 0 in a string of 3"),
    ("StrPart", ("", 1.0, 0.0), "ERR_ARGVALERR", "no position 1"),
    ("StrFind", ("abc", 9.0, "x"), "ERR_ARGVALERR", "no position 9"),
    ("StrMap", ("abc", "ab", "x"), "ERR_ARGVALERR", "the maps have 2 and 1 characters"),
    ("StrToByte", ("300",), "ERR_ARGVALERR", "a byte holds at most 255"),
    ("StrToByte", ("1x",), "ERR_ARGVALERR", "no whole number to base 10"),
    ("DecToHex", ("-1",), "ERR_ARGVALERR", "no whole number"),
    ("ByteToStr", (256.0,), "ERR_ARGVALERR", "256 is not a byte"),
    ("NumToStr", (1.0, 16.0), "ERR_ARGVALERR", "16 decimals"),
    ("StrDigCalc", ("1", 4.0, "0"), "ERR_CALC_DIVZERO", "1 divided by 0"),
    ("StrDigCalc", ("1", 2.0, "2"), "ERR_CALC_NEG", "the result -1 is negative"),
    ("StrDigCalc", ("4294967295", 1.0, "1"), "ERR_CALC_OVERFLOW", "exceeds 4294967295"),
    ("StrDigCmp", ("1", 7.0, "2"), "ERR_ARGVALERR", "7 is no relation"),
]


@pytest.mark.parametrize(("name", "arguments", "error", "message"), REFUSED)
def test_refusal(name: str, arguments: tuple[object, ...], error: str, message: str) -> None:
    with pytest.raises(RapidError, match=message) as caught:
        call(name, *arguments)
    assert caught.value.errno == errors.NUMBERS[error]


def test_a_text_longer_than_a_string_is_refused() -> None:
    with pytest.raises(RapidError, match="80 are possible") as caught:
        call("ValToStr", [1234.0] * 20, of=ArrayOf(NUM, (20,)))
    assert caught.value.errno == errors.ERR_STRTOOLNG
    assert caught.value.cf == "ABB 40205"
