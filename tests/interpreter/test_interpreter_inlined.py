"""Functions that are done in place do what the functions do, refusals included."""

from __future__ import annotations

import pytest
from interpreter_cell import main, run

ROUTINES = """
FUNC string part(string text, num place, num length)
  RETURN StrPart(text, place, length);
ENDFUNC
FUNC num magnitude(num value)
  IF value <= 0 RETURN 0 - value;
  RETURN value;
ENDFUNC
FUNC string shown(num value, num decimals)
  RETURN NumToStr(value, decimals);
ENDFUNC
"""
DATA = """
VAR string text := "abcde";
VAR string empty := "";
VAR num values{7} := [0, -0.0, 2.5, -3.5, 1E-30, 3E38, 16777215];
VAR num one := 1;
"""
COUNT = "FOR i FROM {first} TO 7 DO TPWrite {said}; ENDFOR"
ENDS = "FOR i FROM 7 TO {first} STEP -1 DO TPWrite {said}; ENDFOR"


@pytest.mark.parametrize("loop", [COUNT, ENDS])
@pytest.mark.parametrize("first", [-1, 1])
@pytest.mark.parametrize(
    ("in_place", "called"),
    [
        ("StrPart(text, i, 1)", "part(text, i, 1)"),
        ("StrPart(text, i + 1, 1)", "part(text, i + 1, 1)"),
        ("StrPart(text, 2 - i, 1)", "part(text, 2 - i, 1)"),
        ("StrPart(empty, i, 1)", "part(empty, i, 1)"),
        ("StrPart(StrPart(text, i, 1), 1, 1)", "part(part(text, i, 1), 1, 1)"),
        ("StrPart(text + text, i, 1)", "part(text + text, i, 1)"),
        ("StrPart(text, i, i)", "part(text, i, i)"),
        ("NumToStr(values{i}, 0)", "shown(values{i}, 0)"),
        ("NumToStr(values{i}, 3)", "shown(values{i}, 3)"),
        ("NumToStr(i, 2)", "shown(i, 2)"),
        ("NumToStr(i, 16)", "shown(i, 16)"),
        ("NumToStr(i, one)", "shown(i, one)"),
        ("ValToStr(Abs(values{i}))", "ValToStr(magnitude(values{i}))"),
        ("ValToStr(Abs(3 - i))", "ValToStr(magnitude(3 - i))"),
        ("ValToStr(Sqrt(i) / 3)", "ValToStr(Pow(i, 0.5) / 3)"),
    ],
)
def test_in_place_is_as_called(in_place: str, called: str, first: int, loop: str) -> None:
    bodies = [loop.format(first=first, said=one) for one in (in_place, called)]
    ran = [run(main(body, DATA, ROUTINES)) for body in bodies]
    texts = [one.texts for one in ran]
    refused = [one.fatal and one.fatal.error.message for one in ran]
    if "Pow" not in called:
        assert refused[0] == refused[1]
    assert bool(refused[0]) == bool(refused[1])
    assert texts[0] == texts[1]


@pytest.mark.parametrize(
    ("value", "message"), [("-1", "no square root of -1, which is negative"), ("-0.0", "")]
)
def test_roots_that_are_none(value: str, message: str) -> None:
    ran = run(main("TPWrite ValToStr(Sqrt(n));", f"VAR num n := {value};"))
    assert message in (ran.fatal.error.message if ran.fatal else "")
    assert bool(message) == (ran.fatal is not None)
