"""Values: what expressions come to, as singles, strings, records and arrays."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from interpreter_cell import main, run, texts
from laws import examples

from rapidsim.language.single_precision import SPLIT, single

NUM = "VAR num x; VAR num y; VAR num z; VAR bool b; VAR string s;"


def shown(expression: str, data: str = "", before: str = "") -> str:
    """An expression as the program itself would print it."""
    (text,) = texts(main(f"{before}\nTPWrite ValToStr({expression});", data))
    return text


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        ("1 + 2 * 3", "7"),
        ("(1 + 2) * 3", "9"),
        ("-2 + 5", "3"),
        ("7 / 2", "3.5"),
        ("7 DIV 2", "3"),
        ("-7 DIV 2", "-3"),
        ("7 MOD 3", "1"),
        ("-7 MOD 3", "-1"),
        ("1 < 2", "TRUE"),
        ("2 <> 2", "FALSE"),
        ("TRUE XOR TRUE", "FALSE"),
        ("NOT FALSE AND FALSE", "TRUE"),
        ("FALSE OR TRUE AND TRUE", "TRUE"),
        ('"a" + "b" + "c"', '"abc"'),
        ('"a" = "a"', "TRUE"),
        ("0x10 + 1", "17"),
        ("[1,2,3] = [1,2,3]", "TRUE"),
    ],
)
def test_operators(expression: str, expected: str) -> None:
    if expression.startswith("["):
        data = "VAR pos p := [1,2,3];"
        assert shown("p = [1,2,3]", data) == expected
    else:
        assert shown(expression) == expected


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        ("p + q", "[5,7,9]"),
        ("q - p", "[3,3,3]"),
        ("p * 2", "[2,4,6]"),
        ("2 * p", "[2,4,6]"),
        ("p * q", "[-3,6,-3]"),
        ("-p", "[-1,-2,-3]"),
        ("r * r", "[-1,0,0,0]"),
    ],
)
def test_positions_and_orientations(expression: str, expected: str) -> None:
    data = "VAR pos p := [1,2,3]; VAR pos q := [4,5,6]; VAR orient r := [0,1,0,0];"
    assert shown(expression, data) == expected


def test_num_is_a_single() -> None:
    data = "VAR num x := 0.1; VAR num big := 16777216;"
    assert shown("x = 0.1", data) == "TRUE"
    assert shown("x * 3 = 0.3", data) == "TRUE"
    assert shown("big + 1 = big", data) == "TRUE"


def test_num_rounds_once_at_the_root() -> None:
    """Intermediate results keep their precision: (2**24 + 1) - 2**24 is 1 inside an expression."""
    data = "VAR num big := 16777216; VAR num next;"
    assert shown("big + 1 - big", data) == "1"
    assert shown("next - big", data, "next := big + 1;") == "0"


def test_dnum_keeps_its_precision() -> None:
    data = "VAR dnum x := 16777216;"
    assert shown("x + 1 - x", data) == "1"
    assert shown("x", data, "x := x + 1;") == "16777217"


@given(st.floats(width=32, allow_nan=False, allow_infinity=False))
def test_the_inline_rounding_keeps_singles(x: float) -> None:
    t = x * SPLIT
    assert t - (t - x) == x


@examples()
@given(st.floats(min_value=-3e38, max_value=3e38))
def test_single_is_what_a_store_to_four_bytes_gives(x: float) -> None:
    expected = float(np.float32(x))
    if abs(expected) >= 2.0**-126:
        assert single(x) == expected


@pytest.mark.parametrize(
    ("statement", "message"),
    [
        ("x := 1 / y;", "division by zero"),
        ("x := 5 DIV y;", "5 DIV 0"),
        ("x := 5 MOD y;", "5 MOD 0"),
        ("x := 2.5 DIV 1;", "DIV takes integers, not 2.5"),
        ("x := 3E38 * 10;", "too large"),
        ("z := a{4};", "index 4 is outside the array, which has 1 to 3"),
        ("y := 4; z := a{y};", "index 4 is outside the array, which has 1 to 3"),
        ("y := 1.5; z := a{y};", "an index must be an integer, not 1.5"),
        ("FOR i FROM 1 TO 4 DO z := a{i}; ENDFOR", "index 4 is outside"),
        ("FOR i FROM 1 TO 4 DO a{i - 1} := 0; ENDFOR", "index 0 is outside"),
        ("z := m{1, 3};", "index 3 is outside the array, which has 1 to 2"),
        ('FOR i FROM 1 TO 60 DO s := s + "ab"; ENDFOR', "the string has 82 characters"),
    ],
)
def test_what_has_no_value_is_an_error(statement: str, message: str) -> None:
    ran = run(main(statement, NUM + "VAR num a{3}; VAR num m{3, 2};"))
    assert ran.fatal is not None
    assert message in ran.fatal.error.message
    assert [(frame.routine, frame.line) for frame in ran.fatal.stack] == [("main", 4)]


def test_the_right_operand_is_evaluated_only_where_it_matters() -> None:
    assert shown("FALSE AND 1 / z > 0", NUM) == "FALSE"
    assert shown("TRUE OR 1 / z > 0", NUM) == "TRUE"


def test_counters_do_not_leak_integers() -> None:
    """A counter that is stored, passed or divided behaves as the num it is."""
    body = """
      FOR i FROM 1 TO 3 DO
        x := i;
        y := i / 2;
        z := z + i * i;
        TPWrite ValToStr(x) + ValToStr(y) + ValToStr(Trunc(i)) + ValToStr(i = 2);
      ENDFOR
      TPWrite ValToStr(z);
    """
    ran = run(main(body, NUM))
    assert ran.texts == ["10.51FALSE", "212TRUE", "31.53FALSE", "14"]
    assert isinstance(ran.task.value("x"), float)


def test_a_product_of_counters_beyond_singles_is_rounded() -> None:
    body = "FOR i FROM 4097 TO 4097 DO x := i * i; ENDFOR TPWrite ValToStr(x = 16785409);"
    ran = run(main(body, NUM))
    assert ran.task.value("x") == float(np.float32(4097 * 4097))


@pytest.mark.parametrize(
    ("header", "counted"),
    [
        ("1 TO 3", "123"),
        ("3 TO 1", "321"),
        ("1 TO 5 STEP 2", "135"),
        ("5 TO 1 STEP -2", "531"),
        ("5 TO 1 STEP 1", ""),
        ("1 TO n", "12"),
        ("1 TO -n", "10-1-2"),
        ("n TO 4", "234"),
        ("n TO 1", "21"),
        ("0.5 TO 2", "0.51.5"),
        ("1 TO 2 STEP 0.5", "11.52"),
        ("1 TO 2.9", "12"),
        ("-1 TO -2.9", "-1-2"),
        ("n TO 6 STEP n", "246"),
    ],
)
def test_for_counts(header: str, counted: str) -> None:
    body = f"FOR i FROM {header} DO s := s + ValToStr(i); ENDFOR TPWrite s;"
    assert texts(main(body, "VAR string s; VAR num n := 2;")) == [counted]


def test_aggregates_are_typed_by_their_place() -> None:
    data = "VAR pose f; VAR num a{2}; VAR pos p{2}; VAR num n := 4; VAR robtarget t;"
    body = """
      f := [[1, n, 3 + n], [1, 0, 0, 0]];
      TPWrite ValToStr(f);
      a := [n, n / 8];
      TPWrite ValToStr(a{2});
      p := [[1, 2, 3], [n, 0, 0]];
      TPWrite ValToStr(p{2});
      t := [[1, 2, 3], [1, 0, 0, 0], [0, 0, 0, 0], [9E9, 9E9, 9E9, 9E9, 9E9, 9E9]];
      TPWrite ValToStr(t.extax.eax_a = 9E9);
    """
    assert texts(main(body, data)) == ["[[1,4,7],[1,0,0,0]]", "0.5", "[4,0,0]", "TRUE"]


def test_components_are_assigned_without_touching_copies() -> None:
    data = "VAR pose f; VAR pose g; VAR pose many{2};"
    body = """
      VAR pose inner;
      f.trans.y := 5;
      g := f;
      g.trans.y := 6;
      many{2} := g;
      many{2}.rot.q1 := 1;
      many{2}.trans := [7, 8, 9];
      inner.trans := many{2}.trans;
      inner.trans.x := inner.trans.x + f.trans.y;
      TPWrite ValToStr(f);
      TPWrite ValToStr(g);
      TPWrite ValToStr(many{2});
      TPWrite ValToStr(inner.trans);
    """
    assert texts(main(body, data)) == [
        "[[0,5,0],[0,0,0,0]]",
        "[[0,6,0],[0,0,0,0]]",
        "[[7,8,9],[1,0,0,0]]",
        "[12,8,9]",
    ]


def test_arrays_are_copied_when_assigned() -> None:
    data = "VAR num a{3} := [1,2,3]; VAR num b{3}; VAR num m{2,2} := [[1,2],[3,4]]; VAR num w{2,2};"
    body = """
      b := a;
      b{1} := 10;
      w := m;
      w{2,1} := 30;
      TPWrite ValToStr(a{1}) + ValToStr(b{1}) + ValToStr(m{2,1}) + ValToStr(w{2,1});
      a := [7, 8, 9];
      a{1} := 0;
      a := [7, 8, 9];
      TPWrite ValToStr(a{1});
    """
    assert texts(main(body, data)) == ["110330", "7"]


def test_a_call_in_a_component_assignment_may_change_the_record() -> None:
    data = "VAR pos p;"
    more = "FUNC num f() p.y := 5; RETURN 1; ENDFUNC"
    assert texts(main("p.x := f(); TPWrite ValToStr(p);", data, more)) == ["[1,5,0]"]
