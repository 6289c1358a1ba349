"""Diagnostics, fixes, suppression, lenses, hints, folds, selections, tokens."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest
from laws import some
from lsp_documents import HERE, MARK, applied, ask, at, opened
from lsprotocol import types as lsp

from rapidsim.diagnostics import all_rules
from rapidsim.lsp.background import RunAnswer, findings_of_moves, run_of
from rapidsim.lsp.code_actions import FIX_ALL, resolve_fix_all
from rapidsim.lsp.diagnostics import diagnostics_of
from rapidsim.lsp.editor_session import OpenDocument, text_changes
from rapidsim.lsp.programs import job_of_file
from rapidsim.lsp.run_results import RunMove, RunResults, RunSummary
from rapidsim.lsp.semantic_tokens import SemanticTokenEncoder, difference
from rapidsim.lsp.token_pieces import MODIFIERS, TYPES
from rapidsim.report.pages.rules import programs
from rapidsim.workspace.changes import changed_text

FAULTY = """MODULE m
  CONST num unused:=1;
  PROC main()
    VAR num n
    n:=undefind;
    work 1,2;
    RETURN;
    n:=2;
  ENDPROC
  PROC work(num a)
    undefined:=a;
  ENDPROC
  VAR num undefined;
ENDMODULE
"""
CODE_ACTION = lsp.TEXT_DOCUMENT_CODE_ACTION


def found_in(text: str) -> list[lsp.Diagnostic]:
    document, _ = opened(text)
    return diagnostics_of(document.document, document.findings)


def test_diagnostics() -> None:
    by_code = {one.code: one for one in found_in(FAULTY)}
    assert {"E103", "N201", "T302", "F401"} <= set(by_code)
    undefined = by_code["N201"]
    assert undefined.severity is lsp.DiagnosticSeverity.Error
    assert undefined.range == lsp.Range(lsp.Position(4, 7), lsp.Position(4, 15))
    assert undefined.source == "rapidsim"
    assert undefined.message == "`undefind` is not declared\ndid you mean `undefined`?"
    assert undefined.code_description is not None
    assert undefined.code_description.href.startswith("file://")
    assert undefined.data == {
        "name": "undefined-name",
        "cf": "ABB 40128",
        "fix": "replace it by `undefined`",
    }
    assert by_code["F401"].tags == [lsp.DiagnosticTag.Unnecessary]
    related = by_code["T302"].related_information
    assert related is not None
    assert [one.location.range.start.line for one in related] == [9]


def test_diagnostics_of_all_rules() -> None:
    """Findings of each rule's example are in the text, whatever they are."""
    for rule in some(all_rules(), 5):
        for program in programs(rule, "bad.mod"):
            document, _ = opened(program.decode("latin-1").replace(MARK, ""))
            lines = document.document.lines
            for one in diagnostics_of(document.document, document.findings):
                assert one.range.start.line <= one.range.end.line < len(lines.starts)


def actions(text: str, line: int, only: list[str] | None = None) -> list[lsp.CodeAction]:
    document, _ = opened(text)
    place = lsp.Range(lsp.Position(line, 0), lsp.Position(line, 99))
    context = lsp.CodeActionContext([], only=only)
    found = ask(CODE_ACTION, document, range=place, context=context)
    assert isinstance(found, list)
    return found


def edited(text: str, edit: lsp.WorkspaceEdit | None) -> str:
    assert edit is not None
    assert edit.changes is not None
    return applied(text, list(edit.changes[HERE.uri]))


def test_a_fix() -> None:
    fix, *_ = [one for one in actions(FAULTY, 4) if one.title == "Replace it by `undefined`"]
    assert fix.is_preferred is False
    assert "n:=undefined;" in edited(FAULTY, fix.edit)


def test_suppression() -> None:
    suppress = next(one for one in actions(FAULTY, 4) if one.title == "Suppress N201 here")
    text = edited(FAULTY, suppress.edit)
    assert "n:=undefind; ! rapidsim: ignore[N201]\n" in text
    assert "N201" not in [one.code for one in found_in(text)]
    assert "E160" not in [one.code for one in found_in(text)]


@pytest.mark.parametrize(
    ("line", "suppressed"),
    [
        ("    n:=undefind; ! why", "    ! rapidsim: ignore[N201]\n    n:=undefind; ! why"),
        (
            "    n:=undefind; ! rapidsim: ignore[K601] x",
            "    n:=undefind; ! rapidsim: ignore[K601,N201] x",
        ),
    ],
)
def test_suppression_next_to_other_comments(line: str, suppressed: str) -> None:
    text = FAULTY.replace("    n:=undefind;", line)
    suppress = next(one for one in actions(text, 4) if one.title == "Suppress N201 here")
    text = edited(text, suppress.edit)
    assert suppressed in text
    assert "N201" not in [one.code for one in found_in(text)]


def test_fix_all_that_is_safe() -> None:
    (action,) = actions(FAULTY, 0, only=["source.fixAll"])
    assert action.kind == FIX_ALL
    document, _ = opened(FAULTY)
    text = edited(FAULTY, resolve_fix_all(document.document, document.findings))
    assert "VAR num n;" in text
    assert "undefind" in text, "a guess is no safe fix"


def test_actions_of_other_kinds_are_not_offered() -> None:
    assert actions(FAULTY, 4, only=["refactor"]) == []
    assert {one.kind for one in actions(FAULTY, 4, only=["quickfix"])} == {"quickfix"}


MOVES = """MODULE m
  PROC main()
    MoveL p1,v100,z10,tool0;
    MoveL p1,v100,z10,tool0;
    SetDO do1,1;
    work 1,"a";
  ENDPROC
  PROC work(num count,string label)
  ENDPROC
  CONST robtarget p1:=[[600,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
ENDMODULE
"""


def with_run(text: str) -> OpenDocument:
    """A document after a run of its two moves."""
    document, _ = opened(text)
    starts = [text.index("MoveL"), text.rindex("MoveL")]
    end = len("MoveL p1,v100,z10,tool0")
    corner = "stop(corner path failure)"
    moves = [
        RunMove(starts[0], starts[0] + end, "p1", 0.0, 1.5, corner, "late", (1.0,) * 6, (0,) * 4),
        RunMove(starts[1], starts[1] + end, "p1", 1.5, 1.75, "stop", "", (2.0,) * 6, (0,) * 4),
    ]
    summary = RunSummary("main", "ended", 1.75, 2)
    document.program.take_run(RunAnswer(summary, {document.path: tuple(moves)}))
    return document


def hints(document: OpenDocument) -> list[str]:
    whole = lsp.Range(lsp.Position(0, 0), lsp.Position(99, 0))
    found = ask(lsp.TEXT_DOCUMENT_INLAY_HINT, document, range=whole)
    assert isinstance(found, list)
    return [str(one.label) for one in found]


def test_hints() -> None:
    assert hints(opened(MOVES)[0]) == ["Value:", "count:", "label:"]
    times = ["1.50 s, the corner is a stop", "0.25 s"]
    assert hints(with_run(MOVES))[3:] == times


def test_a_programmed_stop_needs_no_reason(tmp_path: Path) -> None:
    program = tmp_path / "m.mod"
    program.write_text(
        "MODULE m\n  CONST jointtarget j:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        "  PROC main()\n    MoveAbsJ j,v500,fine,tool0;\n    MoveAbsJ j,v500,z10,tool0;\n"
        "    WaitTime 1;\n    MoveAbsJ j,v500,fine,tool0;\n  ENDPROC\nENDMODULE\n"
    )
    found = job_of_file(str(program))
    assert found is not None
    moves = run_of(found, "main", "").moves[str(program)]
    assert [bool(one.corner_reason) for one in moves] == [False, True, False]


def test_a_run_that_cannot_be_recorded_says_what_helps(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = tmp_path / "m.mod"
    program.write_text("MODULE m\n  PROC main()\n  ENDPROC\nENDMODULE\n")
    found = job_of_file(str(program))
    assert found is not None
    monkeypatch.setattr("rapidsim.extras.is_installed", lambda package: False)
    problem = run_of(found, "main", str(tmp_path / "m.rrd")).summary.problem
    assert problem.endswith('is not installed: pip install "rapidsim[view]"')


def test_times_follow_an_edit() -> None:
    document = with_run(MOVES)
    at_start = lsp.Range(lsp.Position(1, 0), lsp.Position(1, 0))
    event = lsp.TextDocumentContentChangePartial(at_start, "  ! new\n")
    program, text = document.program, document.document.text
    edits = text_changes(document.document.lines, [event])
    changed = changed_text(text, edits)
    moves = program.results.after(document.path, edits, changed).moves[document.path]
    assert [changed[one.start : one.end] for one in moves] == ["MoveL p1,v100,z10,tool0"] * 2
    inside = [replace(edits[0], start=moves[0].start - 3, end=moves[0].start)]
    assert len(program.results.after(document.path, inside, text).moves[document.path]) == 1


def test_lenses() -> None:
    document = with_run(MOVES)
    found = ask(lsp.TEXT_DOCUMENT_CODE_LENS, document)
    assert isinstance(found, list)
    assert [one.command.title for one in found] == ["Run", "Record", "1.750 s in the last run"]
    assert found[0].command.arguments == [HERE.uri, "main"]


def test_hover_of_a_target_that_a_run_reached() -> None:
    document = with_run(MOVES)
    place = document.document.lines.position(MOVES.index("p1,") + 1)
    found = ask(lsp.TEXT_DOCUMENT_HOVER, document, position=place)
    assert isinstance(found.contents, lsp.MarkupContent)
    assert "In the last run: joints 2.0, 2.0" in found.contents.value


def test_hover_says_once_what_two_moves_have_found(tmp_path: Path) -> None:
    program = tmp_path / "m.mod"
    program.write_text(
        "MODULE m\n  CONST robtarget far:=\n"
        "    [[9000,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        "  PROC main()\n    MoveJ far,v500,fine,tool0;\n    MoveL far,v500,fine,tool0;\n"
        "  ENDPROC\nENDMODULE\n"
    )
    job = job_of_file(str(program))
    assert job is not None
    found = findings_of_moves(job)
    assert [one.code for one in found] == ["K601", "K601"]
    assert len(list(RunResults({str(program): found}).about_target("far"))) == 1


def test_no_results_say_nothing() -> None:
    assert list(RunResults().about_target("p1")) == []


def test_folding() -> None:
    text = (
        "! one\n! two\nMODULE m\n  PROC main()\n    IF TRUE THEN\n      ;\n    ELSE\n      ;\n"
        "    ENDIF\n    FOR i FROM 1 TO 2 DO\n    ENDFOR\n  ERROR\n    TRYNEXT;\n  ENDPROC\n"
        "ENDMODULE\n"
    )
    document, _ = opened(text)
    found = ask(lsp.TEXT_DOCUMENT_FOLDING_RANGE, document)
    assert isinstance(found, list)
    lines = {(one.start_line, one.end_line) for one in found}
    assert {(0, 1), (2, 14), (3, 13), (4, 8), (9, 10), (11, 12)} <= lines


def test_selections_grow() -> None:
    text = 'MODULE m\n  PROC main()\n    TPWrite "a"\\Num:=co^unt;\n  ENDPROC\nENDMODULE\n'
    document, position = opened(text)
    (found,) = ask(lsp.TEXT_DOCUMENT_SELECTION_RANGE, document, positions=[position])
    texts = []
    while found is not None:
        table = document.document.lines
        start, end = table.offset(found.range.start), table.offset(found.range.end)
        texts.append(document.document.text[start:end])
        found = found.parent
    assert texts[:3] == ["count", "\\Num:=count", 'TPWrite "a"\\Num:=count']
    assert texts[-1] == document.document.text
    assert all(inner in outer for inner, outer in pairwise(texts))


def tokens(document: OpenDocument, data: list[int]) -> list[tuple[str, str, list[str]]]:
    """The texts of tokens, with kinds and modifiers."""
    line = column = 0
    found = []
    table, text = document.document.lines, document.document.text
    for k in range(0, len(data), 5):
        step, start, length, kind, bits = data[k : k + 5]
        line, column = line + step, start if step else column + start
        begin = table.offset(lsp.Position(line, column))
        end = table.offset(lsp.Position(line, column + length))
        modifiers = [name for bit, name in enumerate(MODIFIERS) if bits & 1 << bit]
        found.append((text[begin:end], TYPES[kind], modifiers))
    return found


def test_semantic_tokens() -> None:
    text = (
        "MODULE m\n  ! 💡 note\n  CONST num a:=1;\n  PROC main(num x)\n"
        '    TPWrite "💡"\\Num:=a+x;\n'
        "    doGrip:=[1,TRUE];\n  ENDPROC\n  TRAP t\n  ENDTRAP\nENDMODULE\n"
    )
    document, _ = opened(text)
    found = tokens(document, SemanticTokenEncoder().full(document.document)[1])
    assert found[:8] == [
        ("MODULE", "keyword", []),
        ("m", "namespace", ["declaration"]),
        ("! 💡 note", "comment", []),
        ("CONST", "keyword", []),
        ("num", "type", ["defaultLibrary"]),
        ("a", "variable", ["declaration", "readonly"]),
        ("1", "number", []),
        ("PROC", "keyword", []),
    ]
    assert ("TPWrite", "function", ["defaultLibrary"]) in found
    assert ("Num", "parameter", ["defaultLibrary"]) in found
    assert ('"💡"', "string", []) in found
    assert ("t", "event", ["declaration"]) in found
    assert found[-1] == ("ENDMODULE", "keyword", [])


def test_tokens_after_an_edit_are_those_of_a_new_document() -> None:
    document, _ = opened(MOVES)
    encoder = SemanticTokenEncoder()
    identifier, before = encoder.full(document.document)
    place = lsp.Range(lsp.Position(4, 4), lsp.Position(4, 4))
    workspace = document.program.workspace
    for new in ("count:=1; ", "! note\n    ", '"'):
        change = lsp.TextDocumentContentChangePartial(place, new)
        lines = document.program.view.lines(document.path)
        workspace.change(document.path, text_changes(lines, [change]))
        now = document.program.view.document(document.path)
        fresh = SemanticTokenEncoder().full(opened(now.text)[0].document)[1]
        identifier, edits = encoder.delta(now, identifier)
        for one in edits:
            assert isinstance(one, lsp.SemanticTokensEdit)
            before[one.start : one.start + one.delete_count] = one.data or []
        assert before == fresh


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("CONST robtarget p1", "PERS robtarget p1"),
        ("CONST robtarget p1", "CONST robtarget q1"),
        ("PROC work", "PROC job"),
        ("SetDO do1,1;", "VAR num p1;"),
        ("PROC main", "TRAP main"),
        ("MODULE m", "MODULE other"),
        ("ENDMODULE", "  VAR signaldo do1;\nENDMODULE"),
        ("  CONST robtarget p1", "  ALIAS num robtarget;\n  CONST robtarget p1"),
    ],
)
def test_tokens_follow_declarations(old: str, new: str) -> None:
    document, _ = opened(MOVES)
    encoder = SemanticTokenEncoder()
    encoder.full(document.document)
    changed = MOVES.replace(old, new)
    document.program.workspace.open(document.path, changed)
    now = document.program.view.document(document.path)
    fresh = SemanticTokenEncoder().full(opened(changed)[0].document)[1]
    assert encoder.full(now)[1] == fresh


def test_tokens_of_an_unknown_answer_are_sent_whole() -> None:
    document, _ = opened(MOVES)
    encoder = SemanticTokenEncoder()
    assert encoder.delta(document.document, "7")[1] == encoder.full(document.document)[1]


@pytest.mark.parametrize(
    ("before", "after"),
    [([], []), ([1, 2, 3], [1, 2, 3]), ([1, 1], [1, 1, 1]), ([1, 2, 3], [3]), ([], [1]), ([1], [])],
)
def test_the_difference_of_two_codes(before: list[int], after: list[int]) -> None:
    edits = difference(before, after)
    for one in edits:
        before = [*before[: one.start], *(one.data or ()), *before[one.start + one.delete_count :]]
    assert before == after
    assert len(edits) < 2


def test_tokens_of_a_range() -> None:
    place = lsp.Range(lsp.Position(7, 0), lsp.Position(7, 4))
    document, _ = opened(MOVES)
    found = ask(lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_RANGE, document, range=place)
    names = [text for text, _, _ in tokens(document, found.data)]
    assert "work" in names
    assert "SetDO" not in names
    assert at(lsp.TEXT_DOCUMENT_HOVER, f"{MARK}x") is None
