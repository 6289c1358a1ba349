"""Hover, definition, references, highlights, rename, call hierarchy, symbols."""

from __future__ import annotations

import pytest
from lsp_documents import HERE, applied, ask, at, line_texts, opened, texts_of
from lsprotocol import types as lsp

from rapidsim.analysis.occurrences.rename import RenameRefusedError
from rapidsim.lsp import call_hierarchy, outline
from rapidsim.lsp.positions import Encoding

PROGRAM = """MODULE cell
  RECORD part
    num width;
    string label;
  ENDRECORD
  ALIAS num millimetres;
  CONST robtarget p10:=[[600,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS part gear:=[12,"g"];
  VAR millimetres gap;
  PROC main()
    VAR num n;
    n:=half(gear.width);
    place n\\where:=p10;
    FOR i FROM 1 TO 3 DO
      gear.width:=i;
    ENDFOR
    again:
    IF n>9 GOTO again;
  ENDPROC
  PROC place(num count\\robtarget where)
    IF Present(where) MoveL where,v100,z10,tool0;
    WaitTime count;
  ENDPROC
  FUNC num half(num x)
    RETURN x/2;
  ENDFUNC
ENDMODULE
"""
DEFINITION, REFERENCES = lsp.TEXT_DOCUMENT_DEFINITION, lsp.TEXT_DOCUMENT_REFERENCES
HOVER, RENAME = lsp.TEXT_DOCUMENT_HOVER, lsp.TEXT_DOCUMENT_RENAME


def marked(text: str, place: str) -> str:
    """The program with the mark in a passage that has one."""
    assert text.count(place.replace("^", "")) >= 1
    return text.replace(place.replace("^", ""), place, 1)


def hovered(place: str) -> str:
    found = at(HOVER, marked(PROGRAM, place))
    assert isinstance(found, lsp.Hover)
    assert isinstance(found.contents, lsp.MarkupContent)
    return found.contents.value


@pytest.mark.parametrize(
    ("place", "line"),
    [
        ("n:=ha^lf(gear", "FUNC num half(num x)"),
        ("(ge^ar.width)", 'PERS part gear:=[12,"g"];'),
        ("gear.wid^th:=i", "num width;"),
        ("PERS pa^rt", "RECORD part"),
        ("VAR milli^metres gap", "ALIAS num millimetres;"),
        ("n\\whe^re:=p10", "PROC place(num count\\robtarget where)"),
        ("where:=p1^0", PROGRAM.splitlines()[6].strip()),
        ("width:=i^;", "FOR i FROM 1 TO 3 DO"),
        ("GOTO aga^in", "again:"),
        ("Present(whe^re)", "PROC place(num count\\robtarget where)"),
        ("pla^ce n", "PROC place(num count\\robtarget where)"),
    ],
)
def test_definition(place: str, line: str) -> None:
    document, position = opened(marked(PROGRAM, place))
    found = ask(DEFINITION, document, position=position)
    assert isinstance(found, list)
    assert line_texts(document, [one.range for one in found]) == [line]


@pytest.mark.parametrize("place", ["Move^L where", "v1^00", "VAR nu^m n", "F^OR i", "1^2,"])
def test_predefined_names_have_no_definition(place: str) -> None:
    assert at(DEFINITION, marked(PROGRAM, place)) == []


def test_type_definition() -> None:
    document, position = opened(marked(PROGRAM, "PERS part ge^ar"))
    found = ask(lsp.TEXT_DOCUMENT_TYPE_DEFINITION, document, position=position)
    assert isinstance(found, list)
    assert line_texts(document, [one.range for one in found]) == ["RECORD part"]


@pytest.mark.parametrize(
    ("place", "count"),
    [
        ("gear.wid^th:=i", 3),
        ("PERS pa^rt", 2),
        ("whe^re:=p10", 4),
        ("ro^btarget p10", 2),
        ("FOR ^i FROM", 2),
        ("ag^ain:", 2),
        ("MODULE ce^ll", 1),
    ],
)
def test_references(place: str, count: int) -> None:
    found = at(REFERENCES, marked(PROGRAM, place), context=lsp.ReferenceContext(True))
    assert isinstance(found, list)
    assert len(found) == count


def test_references_without_the_declaration() -> None:
    found = at(REFERENCES, marked(PROGRAM, "ha^lf(num"), context=lsp.ReferenceContext(False))
    assert isinstance(found, list)
    assert len(found) == 1


def test_highlights_tell_writing_from_reading() -> None:
    found = at(lsp.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT, marked(PROGRAM, "ge^ar:=[12"))
    assert isinstance(found, list)
    write, read = lsp.DocumentHighlightKind.Write, lsp.DocumentHighlightKind.Read
    assert [one.kind for one in found] == [write, read, write]


@pytest.mark.parametrize(
    ("place", "words"),
    [
        ("Mo^veL where", ("MoveL [\\Conc] ToPoint", "Instruction, motion.", "`\\T: num` [s]")),
        ("p1^0:=", ("CONST robtarget p10 :=", "Position 600, 0, 800 mm", "rotation z, y, x")),
        ("gear.wi^dth", ("num width", "Component of part.")),
        ("PERS pa^rt", ("RECORD part", "- `string label`")),
        ("ha^lf(gear", ("FUNC num half(num x)", "Function of module cell.")),
        ("pla^ce n", ("PROC place(num count, \\robtarget where)",)),
        ("v1^00", ("CONST speeddata v100 := [100,500,5000,1000]", "Predefined")),
        ("VAR nu^m n", ("num", "Predefined type.")),
        ("VAR milli^metres gap", ("ALIAS num millimetres",)),
        ("FOR ^i", ("num i", "counter")),
    ],
)
def test_hover(place: str, words: tuple[str, ...]) -> None:
    text = hovered(place)
    assert [word for word in words if word not in text] == []


def test_nothing_to_hover() -> None:
    assert at(HOVER, marked(PROGRAM, "PRO^C main")) is None
    assert at(HOVER, "") is None


@pytest.mark.parametrize("encoding", list(Encoding))
def test_positions_behind_astral_characters(encoding: Encoding) -> None:
    text = 'MODULE m\n  PROC main()\n    TPWrite "💡é"\\Num:=va^lue; ! 𝔸\n  ENDPROC\n'
    text += "  VAR num value;\nENDMODULE\n"
    document, position = opened(text, encoding)
    found = ask(REFERENCES, document, position=position, context=lsp.ReferenceContext(True))
    assert isinstance(found, list)
    assert texts_of(document, [one.range for one in found]) == ["value", "value"]


def test_lines_that_end_in_cr_cr_lf() -> None:
    lines = ("MODULE m", "  VAR num a;", "  PROC main()", "    ^a:=1;", "  ENDPROC", "ENDMODULE")
    text = "\r\r\n".join(lines)
    document, position = opened(text)
    assert position.line == 6
    found = ask(DEFINITION, document, position=position)
    assert isinstance(found, list)
    assert [one.range.start.line for one in found] == [2]
    (highlight, _) = ask(lsp.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT, document, position=position)
    assert highlight.range.start == lsp.Position(2, 10)


def renamed(place: str, new: str) -> str:
    found = at(RENAME, marked(PROGRAM, place), new_name=new)
    assert isinstance(found, lsp.WorkspaceEdit)
    assert found.changes is not None
    (edits,) = found.changes.values()
    return applied(PROGRAM, list(edits))


def test_rename_a_component() -> None:
    text = renamed("gear.wid^th:=i", "breadth")
    assert text == PROGRAM.replace("width", "breadth")


def test_rename_an_optional_parameter() -> None:
    assert renamed("n\\whe^re:=p10", "spot") == PROGRAM.replace("where", "spot")


def test_rename_a_type() -> None:
    assert renamed("VAR milli^metres", "mm") == PROGRAM.replace("millimetres", "mm")


@pytest.mark.parametrize(
    ("place", "new", "reason"),
    [
        ("pla^ce n", "half", "`half` is the name of a function"),
        ("pla^ce n", "IF", "reserved word"),
        ("pla^ce n", "2nd", "is no name"),
        ("pla^ce n", "a" * 33, "at most 32"),
        ("pla^ce n", "MoveL", "predefined"),
        ("pla^ce n", "n", "is declared in line 11"),
        ("VAR num ^n;", "p10", "is the name of a constant"),
        ("gear.wid^th:=i", "label", "has a component `label`"),
        ("ma^in()", "start", "the controller starts with"),
        ("Mo^veL where", "Go", "predefined"),
        ("to^ol0", "tool1", "predefined"),
        ("PROC pla^ce", "cell", "`cell` is declared in line 1 "),
    ],
)
def test_rename_refuses(place: str, new: str, reason: str) -> None:
    with pytest.raises(RenameRefusedError, match=reason):
        at(RENAME, marked(PROGRAM, place), new_name=new)


def test_rename_refuses_a_name_in_a_string() -> None:
    text = 'MODULE m\n PROC main()\n  %"job1"%;\n ENDPROC\n PROC jo^b1()\n ENDPROC\nENDMODULE\n'
    with pytest.raises(RenameRefusedError, match='the string "job1" may refer'):
        at(RENAME, text, new_name="other")


def test_rename_refuses_a_composed_name() -> None:
    text = (
        'MODULE m\n PROC main()\n  VAR num n;\n  %"job"+NumToStr(n,0)%;\n ENDPROC\n'
        " PROC jo^b1()\n ENDPROC\nENDMODULE\n"
    )
    with pytest.raises(RenameRefusedError, match='begin with "job"'):
        at(RENAME, text, new_name="other")


def test_rename_refuses_in_text_that_cannot_be_read() -> None:
    text = "MODULE m\n VAR num a^a;\n PROC main()\n  IF aa ) THEN ( aa;\n ENDPROC\nENDMODULE\n"
    with pytest.raises(RenameRefusedError, match="has an error"):
        at(RENAME, text, new_name="bb")


def test_prepare_rename() -> None:
    found = at(lsp.TEXT_DOCUMENT_PREPARE_RENAME, marked(PROGRAM, "gear.wid^th:=i"))
    assert isinstance(found, lsp.PrepareRenamePlaceholder)
    assert found.placeholder == "width"
    assert at(lsp.TEXT_DOCUMENT_PREPARE_RENAME, marked(PROGRAM, "EN^DMODULE")) is None
    with pytest.raises(RenameRefusedError):
        at(lsp.TEXT_DOCUMENT_PREPARE_RENAME, marked(PROGRAM, "v1^00"))


def test_call_hierarchy() -> None:
    document, position = opened(marked(PROGRAM, "pla^ce n"))
    items = ask(lsp.TEXT_DOCUMENT_PREPARE_CALL_HIERARCHY, document, position=position)
    assert isinstance(items, list)
    view = document.document.view
    (caller,) = call_hierarchy.incoming_calls(view, items[0])
    assert caller.from_.name == "main"
    assert line_texts(document, list(caller.from_ranges)) == ["place n\\where:=p10;"]
    callees = call_hierarchy.outgoing_calls(view, caller.from_)
    assert [one.to.name for one in callees] == ["half", "place"]


def test_call_hierarchy_of_the_routine_around() -> None:
    found = at(lsp.TEXT_DOCUMENT_PREPARE_CALL_HIERARCHY, marked(PROGRAM, "WaitT^ime"))
    assert isinstance(found, list)
    assert [one.name for one in found] == ["place"]


def test_document_symbols() -> None:
    document, _ = opened(PROGRAM)
    (module,) = ask(lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL, document)
    names = {one.name: [inner.name for inner in one.children or ()] for one in module.children}
    assert names["part"] == ["width", "label"]
    assert names["main"] == ["n"]
    for one in module.children:
        assert one.range.start.line <= one.selection_range.start.line <= one.range.end.line


def test_workspace_symbols() -> None:
    document, _ = opened(PROGRAM)
    view = document.document.view
    assert [one.name for one in outline.workspace_symbols(view, "pce")] == ["place"]
    assert {one.name for one in outline.workspace_symbols(view, "")} >= {"cell", "main", "gear"}
    assert HERE.uri == "untitled:m.mod"
