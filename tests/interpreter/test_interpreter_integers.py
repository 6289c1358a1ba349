"""Integers: counters, sizes, DIV and MOD, indices, instructions that count.

Generated code keeps integers as Python's where it can prove them, and leaves checks out where a
loop cannot leave the array. None of that may be seen.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from interpreter_cell import checked, main, run, texts

from rapidsim.interpreter.linking.translation import show_python
from rapidsim.language.single_precision import LARGEST_SINGLE

ARRAYS = """
PROC show(num value)
  TPWrite ValToStr(value);
ENDPROC
FUNC num sum_of(num list{*})
  VAR num sum;
  FOR i FROM 1 TO Dim(list, 1) DO sum := sum * 10 + list{i}; ENDFOR
  RETURN sum;
ENDFUNC
FUNC num down(num list{*})
  VAR num sum;
  FOR i FROM Dim(list, 1) TO 1 DO sum := sum * 10 + list{i}; ENDFOR
  RETURN sum;
ENDFUNC
FUNC num every_other(num list{*})
  VAR num sum;
  FOR i FROM Dim(list, 1) TO 1 STEP -2 DO sum := sum * 10 + list{i}; ENDFOR
  RETURN sum;
ENDFUNC
FUNC num pairs(num list{*})
  VAR num sum;
  FOR i FROM 1 TO Dim(list, 1) - 1 DO
    FOR j FROM i + 1 TO Dim(list, 1) DO sum := sum + list{i} * list{j}; ENDFOR
  ENDFOR
  RETURN sum;
ENDFUNC
FUNC num rows(num table{*,*})
  VAR num sum;
  FOR i FROM 1 TO Dim(table, 1) DO
    FOR j FROM 1 TO Dim(table, 2) DO sum := sum * 10 + table{i, j}; ENDFOR
  ENDFOR
  RETURN sum;
ENDFUNC
FUNC num too_far(num list{*})
  VAR num sum;
  FOR i FROM 1 TO Dim(list, 1) DO sum := sum + list{i + 1}; ENDFOR
  RETURN sum;
ENDFUNC
FUNC num other_array(num list{*}, num short{*})
  VAR num sum;
  FOR i FROM 1 TO Dim(list, 1) DO sum := sum + short{i}; ENDFOR
  RETURN sum;
ENDFUNC
FUNC num either_way(num a{*}, num b{*})
  VAR num sum;
  FOR i FROM Dim(a, 1) TO Dim(b, 1) DO sum := sum * 10 + i; ENDFOR
  RETURN sum;
ENDFUNC
FUNC num perhaps(\\num list{*})
  RETURN Dim(list, 1);
ENDFUNC
"""
DATA = """
VAR num one_two_three{3} := [1, 2, 3];
VAR num two{2} := [7, 8];
VAR num table{2,3} := [[1, 2, 3], [4, 5, 6]];
VAR num n := -7;
VAR num half := 2.5;
VAR num huge := 1152921504606846976;
VAR num big_step := 3;
VAR dnum wide := 9007199254740991;
PERS num kept := 5;
VAR num count;
VAR string empty := "";
"""


def value(expression: str) -> str:
    (text,) = texts(main(f"show {expression};", DATA, ARRAYS))
    return text


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        ("n DIV 2", "-3"),
        ("n MOD 2", "-1"),
        ("7 DIV 2", "3"),
        ("-n DIV 2", "3"),
        ("-n MOD 4", "3"),
        ("7 DIV -2", "-3"),
        ("huge MOD 3", "1"),
        ("huge DIV 1024", "1.1259E+15"),
        ("(-n * 3 + 1) MOD 10 DIV 2", "1"),
        ("sum_of(one_two_three)", "123"),
        ("down(one_two_three)", "321"),
        ("every_other(one_two_three)", "31"),
        ("pairs(one_two_three)", "11"),
        ("rows(table)", "123456"),
        ("either_way(one_two_three, two)", "32"),
        ("either_way(two, one_two_three)", "23"),
        # Rounded to a num, these are 3 and 2.
        ("one_two_three{big_step - 1E-9}", "3"),
        ("one_two_three{2.00000001}", "2"),
        ("one_two_three{n + 9}", "2"),
    ],
)
def test_values(expression: str, expected: str) -> None:
    assert value(expression) == expected


@pytest.mark.parametrize(
    ("expression", "message"),
    [
        ("half MOD 2", "MOD takes integers, not 2.5"),
        ("(-half) DIV 2", "DIV takes integers, not -2.5"),
        ("n DIV (n - n)", "-7 DIV 0"),
        ("too_far(one_two_three)", "index 4 is outside the array, which has 1 to 3"),
        ("other_array(one_two_three, two)", "index 3 is outside the array, which has 1 to 2"),
        ("one_two_three{half - 0.25}", "an index must be an integer, not 2.25"),
        ("one_two_three{n}", "index -7 is outside the array, which has 1 to 3"),
        ("one_two_three{1E38 * 10 * big_step}", "is beyond the range of num"),
        ("perhaps()", "is used but was not given"),
    ],
)
def test_refusals(expression: str, message: str) -> None:
    ran = run(main(f"show {expression};", DATA, ARRAYS))
    assert ran.fatal is not None
    assert message in ran.fatal.error.message


def test_counters_divide_as_numbers_do() -> None:
    body = "FOR i FROM 0 TO 7 DO TPWrite NumToStr(i DIV 3, 0) + NumToStr(i MOD 3, 0); ENDFOR"
    assert texts(main(body)) == ["00", "01", "02", "10", "11", "12", "20", "21"]


def test_a_loop_to_the_length_of_an_empty_string_counts_down() -> None:
    body = 'FOR i FROM 1 TO StrLen(empty) DO TPWrite "" \\Num := i; ENDFOR'
    assert [text.strip() for text in texts(main(body, DATA))] == ["1", "0"]


def test_instructions_that_count() -> None:
    body = """
      VAR num own := 3;
      Incr own; Incr own; Decr own;
      Incr kept; Decr wide; Incr one_two_three{2};
      add_one own; add_to own;
      TPWrite ValToStr(own) + " " + ValToStr(kept) + " " + ValToStr(one_two_three{2});
      TPWrite ValToStr(wide);
      Clear own; Clear kept;
      TPWrite ValToStr(own) + ValToStr(kept);
      count := 16777216;
      Incr count;
      TPWrite ValToStr(count = 16777216);
    """
    more = """
      PROC add_one(INOUT num x) Incr x; ENDPROC
      PROC add_to(num x) Incr x; IF x <> 6 TPWrite "no"; ENDPROC
    """
    shown = ["5 6 3", "9.00719925474099E+15", "00", "TRUE"]
    assert texts(main(body, DATA, more)) == shown


def test_an_error_clause_counts_the_same_variable() -> None:
    body = """
      VAR num tries;
      count := 1 / tries;
      TPWrite ValToStr(tries);
    ERROR
      Incr tries;
      RETRY;
    """
    assert texts(main(body, DATA)) == ["1"]


@pytest.mark.parametrize(
    ("statements", "is_looked_at"),
    [
        ("FOR i FROM 1 TO 9 DO x := (i - 0.5) / 9; ENDFOR", False),
        ("FOR i FROM -9 TO -1 DO x := 0.5 / i; ENDFOR", False),
        ("FOR i FROM 0 TO 9 DO x := 0.5 / i; ENDFOR", True),
        ("FOR i FROM 1 TO 9 DO x := x / i; ENDFOR", True),
        ("FOR i FROM 1 TO 9 DO x := x + 1 / i; ENDFOR", True),
        ("FOR i FROM 1 TO 9 DO x := 0.5 * i * i; ENDFOR", False),
        ("FOR i FROM 1 TO 9 DO x := 1E38 * i; ENDFOR", True),
    ],
)
def test_only_what_may_be_too_large_is_looked_at(statements: str, is_looked_at: bool) -> None:
    python = show_python(checked(main(statements, "VAR num x;")))
    assert ("_overflow" in python) is is_looked_at


@pytest.mark.parametrize("quotient", ["x / i", "x / i - 1", "1 + x / i"])
def test_sums_beyond_the_largest_number_are_refused_when_divided(quotient: str) -> None:
    """A sum alone is not looked at."""
    ran = run(
        main(f"x := x + x; FOR i FROM 1 TO 1 DO x := {quotient}; ENDFOR", "VAR num x := 3E38;")
    )
    assert ran.fatal is not None
    assert "is too large" in ran.fatal.error.message


@pytest.mark.parametrize("first", ["7", "-7", "-8", "16777217", "3E38"])
def test_what_mod_leaves_is_exact(first: str) -> None:
    """And what is added to it; a fraction is not."""
    x = np.float32(first)
    rest = np.float32(math.fmod(x, 4))
    ran = run(
        main(
            "b := x MOD 4 + 1; c := (x MOD 4 - 1) * 3; d := x MOD 4 + 0.1; e := -(x MOD 4);",
            f"VAR num x := {first}; VAR num b; VAR num c; VAR num d; VAR num e;",
        )
    )
    values = [ran.task.value(name) for name in "bcde"]
    expected = [rest + 1, (rest - 1) * 3, np.float32(float(rest) + float(np.float32(0.1))), -rest]
    assert list(map(repr, values)) == [repr(float(one)) for one in expected]


@pytest.mark.parametrize("first", ["5", "6", "16777217", "1E20", "3E38"])
@pytest.mark.parametrize("divisor", [1, 2, 1024, 3])
def test_large_numbers_are_divided_as_doubles_are(first: str, divisor: int) -> None:
    """By a power of 2 in Python's own operator."""
    value = float(np.float32(first))
    ran = run(
        main(
            f"own := {first}; FOR i FROM 1 TO 2 DO own := own * i; ENDFOR x := own DIV {divisor};",
            "VAR num x;",
        ).replace("PROC main()", "PROC main() VAR num own;")
    )
    if value * 2 > LARGEST_SINGLE:
        assert ran.fatal is not None
    else:
        assert ran.task.value("x") == value * 2 // divisor
