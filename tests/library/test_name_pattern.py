"""Patterns for names of data: what `re` matches, and never slowly."""

import re
from contextlib import suppress
from time import process_time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rapidsim.language.name_pattern import NamePattern, PatternError

ATOMS = (
    "a",
    "b",
    "A",
    ".",
    "\\.",
    "\\d",
    "\\W",
    "[ab]",
    "[^b]",
    "[a-c_]",
    "[]x]",
    "1",
    "_",
    "^",
    "$",
)


def _patterns() -> st.SearchStrategy[str]:
    return st.recursive(
        st.sampled_from(ATOMS),
        lambda inner: st.one_of(
            st.builds(
                "({}){}".format, inner, st.sampled_from(("", "*", "+", "?", "{2}", "{,2}", "{1,}"))
            ),
            st.builds("{}|{}".format, inner, inner),
            st.lists(inner, max_size=4).map("".join),
        ),
        max_leaves=8,
    )


@given(_patterns(), st.text("abAc1_.\nx", max_size=5))
def test_a_pattern_matches_what_the_library_matches(pattern: str, name: str) -> None:
    expected = re.fullmatch(pattern, name, re.IGNORECASE) is not None
    # `$` of the library also holds before a last line break, which no name has.
    if not (name.endswith("\n") and "$" in pattern):
        assert NamePattern(pattern).matches(name) is expected


@pytest.mark.parametrize(
    "pattern",
    [
        "(", ")", "*a", "a**", "a{2}{3}", "[a", "[b-a]", "\\", "(?=a)", "(?P<x>a)", "\\1", "\\q",
        "a{99999999999}", "a{3,2}", "((a{255}){255}){255}", "(" * 10_000, "(" * 60 + ")" * 60,
        "a" * 100_000,
    ],
)  # fmt: skip
def test_what_is_no_pattern_is_refused(pattern: str) -> None:
    with pytest.raises(PatternError):
        NamePattern(pattern)


@pytest.mark.parametrize(
    "pattern",
    ["(a|a)*!", "(a*)*b", "(.*a.{9}){3}b", "((a?){30}){8}a", "(.*.*.*.*){60}z"],
)
def test_no_pattern_takes_long(pattern: str) -> None:
    began_s = process_time()
    matcher = NamePattern(pattern)
    with suppress(PatternError):
        for number in range(500):
            assert not matcher.matches(f"{number:b}{'a' * 20}{number}!!")
    assert process_time() - began_s < 2.0
