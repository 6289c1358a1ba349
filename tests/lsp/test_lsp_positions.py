"""Positions of the protocol: every encoding, every line end, characters of several units."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples
from lsprotocol.types import Position

from rapidsim.lsp.positions import Encoding, LineTable
from rapidsim.lsp.uris import Uris, path_of, uri_of

TEXTS = st.text(alphabet=st.sampled_from(list("ab\r\n\té°𝔸💡")), max_size=40)


@examples()
@given(TEXTS, st.sampled_from(list(Encoding)))
def test_an_offset_is_found_again(text: str, encoding: Encoding) -> None:
    table = LineTable(text, encoding)
    for offset in range(len(text) + 1):
        found = table.offset(table.position(offset))
        # Between CR and LF there is no position; the end of the line is before both.
        inside = offset > 0 and text[offset - 1 : offset + 1] == "\r\n"
        assert found == (offset - 1 if inside else offset)


@examples()
@given(TEXTS, st.sampled_from(list(Encoding)), st.integers(0, 9), st.integers(0, 30))
def test_any_position_is_in_the_text(text: str, encoding: Encoding, line: int, column: int) -> None:
    assert 0 <= LineTable(text, encoding).offset(Position(line, column)) <= len(text)


@pytest.mark.parametrize(
    ("encoding", "column"), [(Encoding.UTF8, 5), (Encoding.UTF16, 3), (Encoding.UTF32, 2)]
)
def test_an_astral_character_counts_as_the_client_counts(encoding: Encoding, column: int) -> None:
    table = LineTable("a💡b", encoding)
    assert table.position(2) == Position(0, column)
    assert table.offset(Position(0, column)) == 2
    # A position inside the character means its start.
    if encoding is not Encoding.UTF32:
        assert table.offset(Position(0, 2)) == 1


def test_cr_cr_lf_is_two_line_ends() -> None:
    table = LineTable("a\r\r\nb\r\nc\rd\ne")
    assert table.starts == (0, 2, 4, 7, 9, 11)
    assert table.position(4) == Position(2, 0)
    assert table.offset(Position(1, 5)) == 2


def test_positions_past_the_ends_mean_the_ends() -> None:
    table = LineTable("ab\ncd\n")
    assert table.offset(Position(0, 99)) == 2
    assert table.offset(Position(99, 0)) == 6


@pytest.mark.parametrize(
    ("uri", "path"),
    [
        ("file:///c%3A/Robot/a%20b.mod", "C:\\Robot\\a b.mod"),
        ("file:///C:/Robot/a.mod", "C:\\Robot\\a.mod"),
        ("file://server/share/a.mod", "\\\\server\\share\\a.mod"),
        ("untitled:Untitled-1", "untitled:Untitled-1"),
    ],
)
def test_paths_of_windows(uri: str, path: str) -> None:
    assert path_of(uri, is_windows=True) == path


def test_uris_of_windows() -> None:
    assert uri_of("C:\\Robot\\a b.mod", is_windows=True) == "file:///C%3A/Robot/a%20b.mod"
    assert uri_of("\\\\server\\share\\a.mod", is_windows=True) == "file://server/share/a.mod"


def test_paths_of_others() -> None:
    assert path_of("file:///tmp/%C3%A9%23.mod", is_windows=False) == "/tmp/é#.mod"
    assert uri_of("/tmp/é#.mod", is_windows=False) == "file:///tmp/%C3%A9%23.mod"


def test_a_uri_keeps_the_spelling_of_its_client() -> None:
    uris = Uris()
    uris.learn("file:///c%3A/a.mod", "C:\\a.mod")
    assert uris.uri("C:\\a.mod") == "file:///c%3A/a.mod"
    assert uris.path("file:///c%3A/a.mod") == "C:\\a.mod"


def test_a_bad_uri_is_its_own_path() -> None:
    assert path_of("file://[") == "file://["
