"""The layout of a text changes white space and the case of reserved words, and nothing else."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples, some
from syntax_trees import shape

from rapidsim.diagnostics import Source
from rapidsim.files import decode
from rapidsim.syntax.formatting import Style, WordCase, format_text, formatting_edits
from rapidsim.syntax.lexer import lex
from rapidsim.syntax.parser import parse

ROOT = Path(__file__).parents[2]
HERE = Path(__file__).parent / "formatting"
_LINE_END = re.compile(r"\r+\n|\n|\r")
PROGRAMS = sorted(
    path
    for folder in ("programs", "tests")
    for path in (ROOT / folder).rglob("*")
    if path.suffix in (".mod", ".sys")
)


def tokens_of(text: str) -> list[tuple[str, str]]:
    """Tokens without case of reserved words, and without white space in aggregates."""
    tokens = lex(text)
    written = [
        (kind, text[start:end])
        for kind, start, end in zip(tokens.kinds, tokens.starts, tokens.ends, strict=True)
    ]
    return [
        (kind, word if kind in ("NAME", "STRING") else re.sub(r"\s", "", word).upper())
        for kind, word in written
    ]


def assert_only_laid_out(before: str, after: str) -> None:
    assert tokens_of(after) == tokens_of(before)
    comments = [[one.text.rstrip() for one in lex(text).comments] for text in (before, after)]
    assert comments[0] == comments[1]
    assert _LINE_END.findall(after) == _LINE_END.findall(before)


@pytest.mark.parametrize("program", some(PROGRAMS, 8), ids=lambda path: path.name)
def test_a_layout_keeps_tree_comments_and_line_ends(program: Path) -> None:
    text, _ = decode(program.read_bytes())
    after = format_text(text)
    assert_only_laid_out(text, after)
    assert format_text(after) == after
    before, again = (parse(Source("x", one)) for one in (text, after))
    assert [one.code for one in again.diagnostics] == [one.code for one in before.diagnostics]
    if not before.diagnostics:
        # Words of the language are in the tree as they are written.
        shapes = [str(shape(one.file.modules)).upper() for one in (before, again)]
        assert shapes[0] == shapes[1]


def test_a_text_in_its_layout() -> None:
    text, wanted = ((HERE / f"messy.{end}").read_text() for end in ("mod", "expected"))
    assert format_text(text) == wanted


_LINES = st.sampled_from(
    [
        *("MODULE m", "ENDMODULE", "PROC p(num a)", "proc q(", "  num b)", "ENDPROC", "ERROR"),
        *("IF a=1 THEN", "ELSEIF b THEN", "ELSE", "ENDIF", "IF a GOTO x;", "x:", "TEST a"),
        *("CASE 1,2:", "DEFAULT:", "ENDTEST", "FOR i FROM 1 TO 3 DO", "ENDFOR", "a:=[true,", "1];"),
        *(
            "  ! words",
            "! more",
            "",
            "\t ",
            "while b do",
            "endwhile",
            "RECORD r",
            "ENDRECORD",
            "num c;",
        ),
        *('TPWrite "ENDIF";', "UNDO", "LOCAL FUNC num f(num x)", "RETURN x;", "ENDFUNC", "%%%"),
    ]
)
_ENDS = st.sampled_from(["\n", "\r\n", "\r\r\n", "\r"])


@given(st.lists(st.tuples(st.text(" \t", max_size=3), _LINES, _ENDS), max_size=25))
@examples(400)
def test_half_typed_texts_are_laid_out_once_and_for_all(lines: list[tuple[str, str, str]]) -> None:
    text = "".join(blanks + line + end for blanks, line, end in lines)
    after = format_text(text)
    assert_only_laid_out(text, after)
    assert format_text(after) == after


@pytest.mark.parametrize("text", ['a:="no end;\n  b:=1;\n', "a:=§;\n   b:=2;\n"])
def test_what_is_no_rapid_is_left_alone(text: str) -> None:
    assert formatting_edits(text) == ()


def test_words_may_stay_as_written() -> None:
    text = "module m\nendmodule\n"
    assert format_text(text, Style(words=WordCase.KEEP)) == text
    assert format_text(text) == "MODULE m\nENDMODULE\n"


@pytest.mark.parametrize("indent", [2, 3, 4])
def test_the_indentation_is_what_the_text_uses_most(indent: int) -> None:
    unit = " " * indent
    lines = ["MODULE m", "#PROC p()", "##IF a THEN", "b:=1;", "##ENDIF", "#ENDPROC", "ENDMODULE"]
    text = "".join(f"{line}\n" for line in lines).replace("#", unit)
    assert format_text(text) == text.replace("\nb:=1", f"\n{unit * 3}b:=1")
    assert format_text(text, Style(indent=1)).splitlines()[3] == "   b:=1;"
