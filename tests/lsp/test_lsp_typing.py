"""What helps while typing: completion, signatures, layout."""

from __future__ import annotations

import pytest
from lsp_documents import HERE, MARK, applied, ask, opened
from lsprotocol import types as lsp

from rapidsim.lsp.call_context import CallContext, call_context, statement_context
from rapidsim.lsp.completion import MOST_ITEMS, completions, resolve

PROGRAM = """MODULE cell
  RECORD part
    num width;
    pos where;
  ENDRECORD
  CONST robtarget pPick:=[[600,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  TASK PERS tooldata gripper:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  VAR signaldo doGrip;
  VAR part parts{3};
  VAR num count;
  PROC main()
    VAR num steps;
    TYPED
  ENDPROC
  PROC place(num n\\robtarget where|switch fast)
    FOR i FROM 1 TO 3 DO
      WaitTime i;
    ENDFOR
  ENDPROC
ENDMODULE
"""
SPACES = lsp.FormattingOptions(4, True)


def typed(text: str) -> str:
    """The program with a statement typed up to the mark, or to its end."""
    return PROGRAM.replace("TYPED", text if MARK in text else text + MARK)


def labels(text: str, *, snippets: bool = False) -> list[str]:
    document, position = opened(typed(text))
    found = completions(document.document, position, snippets=snippets)
    assert len(found.items) <= MOST_ITEMS
    return [one.label for one in found.items]


@pytest.mark.parametrize(
    ("text", "first"),
    [
        ("pla", "place"),
        ("Mov", "MoveAbsJ"),
        ("MoveL ", "pPick"),
        ("MoveL pPick,v1", "v10"),
        ("MoveL pPick,v100,z", "z0"),
        ("MoveL pPick,v100,z10,", "gripper"),
        ("SetDO ", "doGrip"),
        ("steps:=parts{1}.wi", "width"),
        ("steps:=parts{1}.where.", "x"),
        ("steps:=cou", "count"),
        ("IF ste^ THEN ENDIF", "steps"),
    ],
)
def test_completion_begins_with_what_fits(text: str, first: str) -> None:
    assert labels(text)[0] == first


@pytest.mark.parametrize(
    ("text", "options"),
    [
        ("place 1\\", ["where", "fast"]),
        ("place 1\\fast\\", ["where"]),
        ("MoveL pPick,v100\\", ["Conc", "ID", "V", "T", "Z", "Inpos", "WObj", "Corr", "TLoad"]),
        ("MoveL pPick,v100,z10,gripper\\W", ["WObj"]),
        ("steps:=CRobT(\\", ["Tool", "WObj", "TaskRef", "TaskName"]),
    ],
)
def test_options_behind_a_backslash(text: str, options: list[str]) -> None:
    found = labels(text)
    assert [one for one in options if one not in found] == []
    assert "pPick" not in found


@pytest.mark.parametrize("text", ['TPWrite "Mov', "! Mov", "steps:=1; ! Mov", '"'])
def test_nothing_in_strings_and_comments(text: str) -> None:
    assert labels(text) == []


def test_types_where_a_type_belongs() -> None:
    document, position = opened(PROGRAM.replace("  VAR num count;", "  VAR pa^"))
    found = completions(document.document, position)
    assert found.items[0].label == "part"
    document, position = opened(PROGRAM.replace("place(num n", "place(num n,robt^"))
    assert [one.label for one in completions(document.document, position).items] == ["robtarget"]


def test_a_counter_is_known_in_its_loop_only() -> None:
    document, position = opened(PROGRAM.replace("TYPED", "").replace("WaitTime i", "WaitTime ^i"))
    inside = [one.label for one in completions(document.document, position).items]
    assert "i" in inside
    assert "i" not in labels("steps:=")


def test_snippets_only_for_clients_that_have_them() -> None:
    assert "FOR ..." in labels("FO", snippets=True)
    assert "FOR ..." not in labels("FO")
    document, position = opened(typed("MoveL"))
    item = completions(document.document, position, snippets=True).items[0]
    assert item.insert_text == "MoveL ${1:ToPoint},${2:Speed},${3:Zone},${4:Tool};"


def test_resolve_adds_the_words_of_the_library() -> None:
    document, position = opened(typed("WaitTim"))
    item = completions(document.document, position).items[0]
    assert item.documentation is None
    resolved = resolve(item)
    assert isinstance(resolved.documentation, lsp.MarkupContent)
    assert "`Time: num` [s]" in resolved.documentation.value


@pytest.mark.parametrize(
    ("text", "active"),
    [
        ("MoveL ^", "ToPoint"),
        ("MoveL pPick,^", "Speed"),
        ("MoveL pPick,v100\\T:=^", "\\T"),
        ("MoveL pPick,v100\\T:=5,^", "Zone"),
        ("MoveL\\Conc,^", "ToPoint"),
        ("MoveL Offs(pPick,1,^", "YOffset"),
        ("MoveL Offs(pPick,1,2,3),^", "Speed"),
        ("place ^", "num n"),
        ("place 1\\where:=^", "\\robtarget where"),
        ("steps:=parts{^", None),
        ("steps:=^", None),
    ],
)
def test_signature_help(text: str, active: str | None) -> None:
    document, position = opened(typed(text))
    found = ask(lsp.TEXT_DOCUMENT_SIGNATURE_HELP, document, position=position)
    if active is None:
        assert found is None
        return
    assert isinstance(found, lsp.SignatureHelp)
    (signature,) = found.signatures
    assert signature.parameters is not None
    assert found.active_parameter is not None
    assert signature.active_parameter == found.active_parameter
    label = signature.parameters[found.active_parameter].label
    assert isinstance(label, tuple)
    assert signature.label[label[0] : label[1]] == active


def test_a_superfluous_argument_marks_no_parameter() -> None:
    document, position = opened(typed("WaitTime 1,2,^"))
    found = ask(lsp.TEXT_DOCUMENT_SIGNATURE_HELP, document, position=position)
    assert isinstance(found, lsp.SignatureHelp)
    assert found.active_parameter == len(found.signatures[0].parameters or ())


@pytest.mark.parametrize(
    ("text", "name", "required", "option"),
    [
        ("SetDO\\SDelay:=0.2,do1,", "SetDO", 1, None),
        ("IF a=1 SetDO do1,", "SetDO", 1, None),
        ("x:=f(1,g(2,", "g", 1, None),
        ("x:=f(1,[2,3],", "f", 2, None),
        ("CASE 1: SetDO do1,", "SetDO", 1, None),
        ("SetDO do1,1; SetDO ", "SetDO", 0, None),
    ],
)
def test_the_call_around_an_offset(text: str, name: str, required: int, option: str | None) -> None:
    statement = statement_context(text, len(text))
    found = call_context(statement.tokens, lambda key: key == "setdo")
    assert isinstance(found, CallContext)
    assert (found.name.text, found.required, found.option) == (name, required, option)


MESSY = "MODULE m\nproc main()\nif TRUE then\nx:=1;\nendif\nENDPROC\nVAR num x;\nENDMODULE\n"
NEAT = (
    "MODULE m\n    PROC main()\n        IF TRUE THEN\n            x:=1;\n        ENDIF\n"
    "    ENDPROC\n    VAR num x;\nENDMODULE\n"
)


def test_formatting() -> None:
    document, _ = opened(MESSY)
    edits = ask(lsp.TEXT_DOCUMENT_FORMATTING, document, options=SPACES)
    assert isinstance(edits, list)
    assert applied(MESSY, edits) == NEAT
    document, _ = opened(NEAT)
    assert ask(lsp.TEXT_DOCUMENT_FORMATTING, document, options=SPACES) == []


@pytest.mark.parametrize(("first", "last"), [(1, 2), (3, 3), (3, 5), (6, 6), (0, 7)])
def test_range_formatting_is_formatting_of_these_lines(first: int, last: int) -> None:
    document, _ = opened(MESSY)
    range_ = lsp.Range(lsp.Position(first, 0), lsp.Position(last, 99))
    edits = ask(lsp.TEXT_DOCUMENT_RANGE_FORMATTING, document, range=range_, options=SPACES)
    assert isinstance(edits, list)
    lines = applied(MESSY, edits).splitlines()
    for number, (before, after) in enumerate(
        zip(MESSY.splitlines(), NEAT.splitlines(), strict=True)
    ):
        assert lines[number] == (after if first <= number <= last else before)


def test_formatting_on_type_lays_out_the_line_before() -> None:
    text = "MODULE m\n    PROC main()\n        IF TRUE THEN\n      x:=1;\n"
    document, position = opened(text)
    edits = ask(
        lsp.TEXT_DOCUMENT_ON_TYPE_FORMATTING, document, position=position, ch="\n", options=SPACES
    )
    assert isinstance(edits, list)
    assert applied(text, edits).splitlines()[3] == "            x:=1;"
    assert HERE.uri == document.document.uri
