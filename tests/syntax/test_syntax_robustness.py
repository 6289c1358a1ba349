"""No text makes the parser fail, and what it returns always fits the text."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples

from rapidsim.diagnostics import Source
from rapidsim.syntax import tree
from rapidsim.syntax.lexer import lex
from rapidsim.syntax.parser import Parsed, parse

PROGRAMS = sorted((Path(__file__).parent / "programs").iterdir())
WORDS_AND_MARKS = """
    MODULE ENDMODULE PROC ENDPROC FUNC ENDFUNC TRAP ENDTRAP RECORD ENDRECORD ALIAS LOCAL TASK VAR
    PERS CONST IF THEN ELSEIF ELSE ENDIF FOR FROM TO STEP DO ENDFOR WHILE ENDWHILE TEST CASE
    DEFAULT ENDTEST GOTO RETURN RAISE EXIT RETRY TRYNEXT CONNECT WITH ERROR UNDO BACKWARD NOT AND
    OR XOR DIV MOD TRUE FALSE INOUT SYSMODULE num x main p10 MoveL 1 .5 9E9 0xFF "text" "open
    := = <> <= >= < > + - * / ( ) [ ] { } , ; : . \\ ? | % [1,2] [[1],["a"]] ! # € <SMT> <EXP>
    <VAR> <TDN> <EIT> <CSE> ELS EDNIF
"""
VOCABULARY = WORDS_AND_MARKS.split()

token_soup = st.lists(st.sampled_from([*VOCABULARY, "\n", ";\n"]), max_size=60).map(" ".join)
statements = token_soup.map(lambda soup: f"MODULE m\nPROC p()\n{soup}\nENDPROC\nENDMODULE\n")
characters = st.text(max_size=200)


def sound(text: str) -> Parsed:
    """Parse a text and check what holds for every text."""
    parsed = parse(Source("soup", text))
    assert parsed.file.modules or parsed.diagnostics
    for diagnostic in parsed.diagnostics:
        assert diagnostic.span is not None
        assert 0 <= diagnostic.span.start <= diagnostic.span.end <= len(text)
        assert diagnostic.violation.message
    for module in parsed.file.modules:
        assert 0 <= module.start <= module.end <= len(text)
        for item in module.items:
            assert module.start <= item.start <= item.end <= module.end
    return parsed


@given(st.one_of(token_soup, statements, characters))
@examples(300)
def test_no_text_makes_it_fail(text: str) -> None:
    sound(text)


@pytest.mark.parametrize("rest", ["x y[1", "x y[n", "x y[", "x:=y[1,n", "x y[1;"])
def test_a_file_may_end_in_an_index(rest: str) -> None:
    """The brace in place of a bracket is not put in place of the end."""
    sound(f"MODULE m\n  PROC p()\n    {rest}")


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.name)
def test_a_file_cut_anywhere_is_read_to_the_cut(program: Path) -> None:
    text = program.read_text()
    starts = lex(text).starts
    for cut in starts[1 :: max(1, len(starts) // 60)]:
        parsed = sound(text[:cut])
        assert parsed.diagnostics or "ENDMODULE" in text[:cut].upper()


@given(st.one_of(token_soup, characters))
@examples(200)
def test_tokens_comments_and_blanks_are_the_text(text: str) -> None:
    tokens = lex(text)
    pieces = [(start, end) for start, end in zip(tokens.starts, tokens.ends, strict=True)]
    pieces += [(comment.start, comment.start + len(comment.text)) for comment in tokens.comments]
    position = 0
    for start, end in sorted(pieces):
        between = text[position:start]
        assert not between.strip("\0\x1a\ufeff" + between_blanks(between)) or "%%%" in between
        position = end
    assert position == len(text) or not text[position:].strip()


def between_blanks(text: str) -> str:
    """The blank characters in a text."""
    return "".join(character for character in text if character.isspace())


@pytest.mark.parametrize(
    "text",
    [
        "x:=" + "(" * 5000 + "1" + ")" * 5000 + ";",
        "x:=" + "1+" * 5000 + "1;",
        "x:=" + "-" * 5000 + "1;",
        "x" + ".a" * 5000 + ":=1;",
        "x:=" + "[" * 5000,
        "IF a THEN " * 5000,
        "FOR i FROM 1 TO 2 DO " * 300 + "ENDFOR " * 300,
        "P " + "a{" * 5000 + "1" + "}" * 5000 + ";",
    ],
    ids=["parentheses", "sums", "signs", "components", "brackets", "ifs", "loops", "indices"],
)
def test_deep_nesting_is_reported_and_not_built(text: str) -> None:
    parsed = sound(f"MODULE m\nPROC p()\n{text}\nENDPROC\nENDMODULE\n")
    assert any(d.violation.code == "E108" for d in parsed.diagnostics)
    assert depth(parsed.file.modules) < 1000


def test_more_errors_than_anyone_reads_end_the_reading() -> None:
    text = "MODULE m\nPROC p()\n" + "x:=)(;\n" * 1000 + "ENDPROC\nENDMODULE\n"
    assert len(sound(text).diagnostics) <= 201


@pytest.mark.parametrize(
    ("text", "storage", "operator"),
    [("VIAR bool b:=a AND c;", "VAR", "AND"), ("cosnt num b:=a DVI c;", "CONST", "DIV")],
)
def test_a_misspelt_word_is_the_word_it_is_taken_for(
    text: str, storage: str, operator: str
) -> None:
    (module,) = sound(f"MODULE m\n{text}\nENDMODULE\n").file.modules
    (data,) = module.items
    assert isinstance(data, tree.Data)
    assert data.storage == storage
    assert isinstance(data.value, tree.Binary)
    assert data.value.operator == operator


def depth(part: object) -> int:
    """How deep the tree is."""
    deepest = 0
    todo = [(part, 0)]
    while todo:
        node, level = todo.pop()
        deepest = max(deepest, level)
        if isinstance(node, tuple):
            todo += [(child, level) for child in node]
        elif isinstance(node, tree.Node):
            slots = {slot for kind in type(node).__mro__ for slot in getattr(kind, "__slots__", ())}
            todo += [(getattr(node, slot), level + 1) for slot in slots if slot != "__weakref__"]
    return deepest
