"""Arithmetic of generated code: integers beyond and below exact ones, positions, FOR counters."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import islice
from typing import Any

import pytest

from rapidsim.language import error_numbers as errors
from rapidsim.language.data import Orient, Pos
from rapidsim.language.errors import RapidError
from rapidsim.language.single_precision import LARGEST_SINGLE, single
from rapidsim.library import arithmetic
from rapidsim.library.arithmetic import (
    MAX_INTEGER,
    WHOLE_FROM,
    count,
    iteration_count,
    steps,
    turns_of,
)

HUGE = 10**400


@pytest.mark.parametrize(
    ("left", "right", "quotient", "remainder"),
    [(14, 4, 3, 2), (-14, 4, -3, -2), (14, -4, -3, 2), (-14, -4, 3, -2), (0, 5, 0, 0),
     (3, 4, 0, 3), (-3, 4, 0, -3), (-4, 2, -2, 0), (2**24 + 1, 2, 2**23, 1)],
)  # fmt: skip
def test_quotients_are_truncated_and_remainders_have_the_sign_of_the_left(
    left: int, right: int, quotient: int, remainder: int
) -> None:
    assert arithmetic.integer_quotient(float(left), float(right)) == quotient
    assert arithmetic.integer_remainder(float(left), float(right)) == remainder
    assert arithmetic.whole_quotient(left, right) == quotient
    assert arithmetic.whole_remainder(left, right) == remainder
    if right > 0:
        assert arithmetic.literal_quotient(left, right) == quotient


@pytest.mark.parametrize(
    ("function", "operator"),
    [(arithmetic.integer_quotient, "DIV"), (arithmetic.integer_remainder, "MOD")],
)
@pytest.mark.parametrize(
    ("left", "right", "errno", "message"),
    [
        (1.5, 2.0, errors.ERR_INT_NOTVAL, "{} takes integers, not 1.5"),
        (4.0, 0.5, errors.ERR_INT_NOTVAL, "{} takes integers, not 0.5"),
        (4.0, 0.0, errors.ERR_DIVZERO, "4 {} 0"),
        (0.5, 0.0, errors.ERR_INT_NOTVAL, "{} takes integers, not 0.5"),
    ],
)
def test_what_cannot_be_divided(
    function: Callable[[float, float], float],
    operator: str,
    left: float,
    right: float,
    errno: int,
    message: str,
) -> None:
    with pytest.raises(RapidError) as caught:
        function(left, right)
    assert caught.value.errno == errno
    assert message.format(operator) in str(caught.value)


@pytest.mark.parametrize(
    ("exact", "rounded"),
    [(7, 7), (-7, -7), (2**24, 2**24), (2**24 + 1, 2**24), (2**24 + 3, 2**24 + 4),
     (-(2**24) - 3, -(2**24) - 4), (10**20, int(single(1e20)))],
)  # fmt: skip
def test_integers_are_rounded_to_num(exact: int, rounded: int) -> None:
    assert arithmetic.single_integer(exact) == rounded
    assert arithmetic.checked_integer(exact) == rounded
    assert arithmetic.double_integer(exact) == exact


def test_integers_are_rounded_to_double_or_too_large() -> None:
    assert arithmetic.double_integer(2**53 + 1) == 2**53
    assert arithmetic.double_integer(-(10**30)) == int(-1e30)
    largest = int(LARGEST_SINGLE)
    assert arithmetic.checked_integer(largest) == largest
    assert arithmetic.checked_integer(-largest) == -largest
    cases: list[tuple[Callable[[int], int], int, str]] = [
        (arithmetic.double_integer, HUGE, "INF"),
        (arithmetic.double_integer, -HUGE, "-INF"),
        (arithmetic.single_integer, HUGE, "INF"),
        (arithmetic.single_integer, 10**308, "1E+308"),
        (arithmetic.checked_integer, 10**39, "1E+39"),
        (arithmetic.checked_integer, -(10**39), "-1E+39"),
    ]
    for function, value, said in cases:
        with pytest.raises(RapidError, match="too large") as caught:
            function(value)
        assert caught.value.errno == errors.ERR_OVERFLOW
        assert f"the result {said} is" in str(caught.value)


def test_a_string_is_too_long_by_its_length() -> None:
    with pytest.raises(RapidError, match="the string has 81 characters, 80 are allowed") as caught:
        arithmetic.too_long("x" * 81)
    assert caught.value.errno == errors.ERR_STRTOOLNG


def test_the_number_from_which_all_are_whole() -> None:
    """Generated code adds and subtracts it: what is left of a number is its whole part, or not."""
    for n in (0.0, 1.0, 2.0**24 + 1.0, WHOLE_FROM - 1.0):
        assert (n + WHOLE_FROM) - WHOLE_FROM == n
    for n in (0.5, 2.0**30 + 0.25, 1e-9):
        assert (n + WHOLE_FROM) - WHOLE_FROM != n
    assert single(float(MAX_INTEGER - 1)) == MAX_INTEGER - 1
    assert single(float(MAX_INTEGER + 1)) == MAX_INTEGER


def test_positions_have_components_of_num() -> None:
    a, b = Pos(1.0, 2.5, -3.0), Pos(0.1, 2.0, 4.0)
    tenth = single(0.1)
    assert arithmetic.add_positions(a, b) == Pos(single(1.1), 4.5, 1.0)
    assert arithmetic.subtract_positions(a, b) == Pos(single(0.9), 0.5, -7.0)
    assert arithmetic.negate_position(a) == Pos(-1.0, -2.5, 3.0)
    assert arithmetic.scale_position(a, 0.1) == Pos(tenth, 0.25, single(-0.3))
    assert arithmetic.scaled_position(2.0, a) == Pos(2.0, 5.0, -6.0)
    assert arithmetic.divide_position(a, 10.0) == Pos(tenth, 0.25, single(-0.3))
    assert arithmetic.cross_product(a, Pos(4.0, 5.0, 6.0)) == Pos(30.0, -18.0, -5.0)
    with pytest.raises(RapidError, match="a position divided by 0") as caught:
        arithmetic.divide_position(a, 0.0)
    assert caught.value.errno == errors.ERR_DIVZERO


def test_orientations_are_composed_in_their_order() -> None:
    half = math.sqrt(0.5)
    about_x, about_z = Orient(half, half, 0.0, 0.0), Orient(half, 0.0, 0.0, half)
    product = arithmetic.compose_orientations(about_x, about_z)
    assert product == pytest.approx((0.5, 0.5, -0.5, 0.5))
    assert tuple(product) == tuple(map(single, product))
    for a, b in ((about_x, Orient(1.0, 1.0, 0.0, 0.0)), (Orient(0.0, 0.0, 0.0, 0.0), about_x)):
        with pytest.raises(RapidError) as caught:
            arithmetic.compose_orientations(a, b)
        assert caught.value.errno == errors.ERR_ILLQUAT


BEYOND = float(MAX_INTEGER)
COUNTS: list[tuple[tuple[Any, ...], list[int]]] = [
    ((1, 3.0), [1, 2, 3]),
    ((3, 1.0), [3, 2, 1]),
    ((1, 1.0), [1]),
    ((1, 3.9), [1, 2, 3]),
    ((1, -1.5), [1, 0, -1]),
    ((1, 6.0, 2), [1, 3, 5]),
    ((1, 7.0, 2), [1, 3, 5, 7]),
    ((5, 0.0, -2), [5, 3, 1]),
    ((5, 1.0, -2), [5, 3, 1]),
    ((1, 5.0, -1), []),
    ((5, 1.0, 1), []),
    # Beyond exact integers a counter stands where one is lost, and goes on where two are not.
    ((MAX_INTEGER - 1, BEYOND), [MAX_INTEGER - 1, MAX_INTEGER]),
    ((MAX_INTEGER - 1, BEYOND + 2.0), [MAX_INTEGER - 1, *[MAX_INTEGER] * 5]),
    ((MAX_INTEGER + 2, BEYOND + 6.0, 2), [MAX_INTEGER + 2, MAX_INTEGER + 4, MAX_INTEGER + 6]),
    ((-MAX_INTEGER - 2, -BEYOND - 4.0, -2), [-MAX_INTEGER - 2, -MAX_INTEGER - 4]),
    ((-MAX_INTEGER + 1, -BEYOND - 4.0, -1), [-MAX_INTEGER + 1, *[-MAX_INTEGER] * 5]),
    ((MAX_INTEGER - 2, BEYOND + 4.0, 4), [MAX_INTEGER - 2, MAX_INTEGER + 2]),
    ((MAX_INTEGER + 2, BEYOND), [MAX_INTEGER + 2, MAX_INTEGER]),
    ((2, 4.0, 0), [2] * 6),
    ((4, 2.0, 0), []),
    ((2, math.inf, MAX_INTEGER), [2, MAX_INTEGER + 2, 2 * MAX_INTEGER, 3 * MAX_INTEGER]),
]


@pytest.mark.parametrize(("arguments", "values"), COUNTS)
def test_a_counter_has_the_values_of_the_controller(
    arguments: tuple[Any, ...], values: list[int]
) -> None:
    made = list(islice(count(*arguments), 6))
    assert made[: len(values)] == values
    assert len(made) == (len(values) if len(values) < 4 or arguments[1] < math.inf else 6)


@pytest.mark.parametrize(
    ("arguments", "values"),
    [
        ((1.0, 2.0), [1.0, 2.0]),
        ((2.5, 1.0), [2.5, 1.5]),
        ((1.0, 2.0, 0.5), [1.0, 1.5, 2.0]),
        ((2.0, 1.0, -0.5), [2.0, 1.5, 1.0]),
        ((0.0, 1.0, -0.5), []),
        ((0.0, 0.3, 0.1), [0.0, single(0.1), single(0.2), single(single(0.2) + single(0.1))]),
        ((1.0, 1.0, 0.0), [1.0] * 6),
    ],
)
def test_other_counters_add_singles(arguments: tuple[float, ...], values: list[float]) -> None:
    first, last, *rest = arguments
    step = single(rest[0]) if rest else None
    found = list(islice(steps(first, last, step), 6))
    assert found[: len(values)] == values[: len(found)]
    assert len(found) >= len(values) - 1


def test_iterations_are_known_in_advance_where_counters_are_exact() -> None:
    assert turns_of(count(1, 10.0, 3)) == 4
    assert turns_of(count(1, BEYOND + 10.0, 3)) == math.inf
    values = range(2, 20, 3)
    i = 8
    assert iteration_count(values, "i") == 3
    assert iteration_count(values, "never_assigned") == 0
    i = 7
    assert iteration_count(values, "i") == 0
    assert i == 7
