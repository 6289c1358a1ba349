"""Findings as text and JSON: carets stand under their place, repeats become one."""

import json
import re
import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples

from rapidsim.analysis.names.name_violations import UndefinedName
from rapidsim.analysis.rules.control_flow.conditions import ConstantCondition
from rapidsim.diagnostics import Diagnostic, Edit, Fix, Related, Rule, Source, Span
from rapidsim.findings.reach_and_motion_data import UnreachableTarget
from rapidsim.findings.runs import UncaughtError
from rapidsim.jobs.inputs.selectors import is_selected
from rapidsim.json_records.encoding import json_of
from rapidsim.report.findings.diagnostic_records import diagnostic_record
from rapidsim.report.findings.merging import merged
from rapidsim.report.findings.source_frame import printable, shown_line
from rapidsim.report.findings.text import concise, full, summary_line
from rapidsim.report.palette import COLOURED, PLAIN


def span(text: str, part: str, occurrence: int = 0, *, file: str = "a.mod") -> Span:
    start = -1
    for _ in range(occurrence + 1):
        start = text.index(part, start + 1)
    return Span(Source(file, text), start, start + len(part))


def shown(*diagnostics: Diagnostic, width: int = 80) -> str:
    return full(merged(diagnostics), PLAIN, width=width)


def test_a_finding_with_everything() -> None:
    text = "MODULE a\n  PERS num n:=1;\n  PROC main()\n    n:=p10;\n  ENDPROC\nENDMODULE\n"
    diagnostic = Diagnostic(
        UndefinedName("p10", "p1"),
        span(text, "p10"),
        (
            Related(span(text, "n", 0), "declared here"),
            Related(span("x\n", "x", file="b.sys"), "and"),
        ),
        Fix("Write 1", (Edit(span(text, "p10"), "1"),)),
        routine="main",
    )
    assert shown(diagnostic) == (
        "error[N201] undefined-name: `p10` is not declared (cf. ABB 40128)\n"
        " --> a.mod:4:8 in main\n"
        "  |\n"
        "4 |     n:=p10;\n"
        "  |        ^^^\n"
        "  |\n"
        "2 |   PERS num n:=1;\n"
        "  |        ^ declared here\n"
        " ::: b.sys:1:1\n"
        "  |\n"
        "1 | x\n"
        "  | ^ and\n"
        "  = help: did you mean `p1`?\n"
        "  = fix: Write 1\n\n"
    )


def test_carets_stand_under_tabs_and_wide_characters() -> None:
    for text, part in (
        ("\t\tx:=1;", "x"),
        ("a\tb", "b"),
        ('TPWrite "日本語"+y;', "y"),
        ("e\u0301 := z", "z"),
        ("  \x1b[31m bad", "bad"),
    ):
        line = shown_line(span(text, part), 60)
        cells = 0
        for character in line.text[: line.text.index(part)]:
            cells += 2 if character in "日本語" else 0 if character == "\u0301" else 1
        assert cells == line.caret_start
        assert line.caret_end == line.caret_start + len(part)
        assert "\x1b" not in line.text


def test_long_lines_are_cut_around_the_place() -> None:
    text = "x" * 300 + "HERE" + "y" * 300
    line = shown_line(span(text, "HERE"), 60)
    assert len(line.text) == 60
    assert line.text[line.caret_start : line.caret_end] == "HERE"
    assert line.text.startswith("...")
    assert line.text.endswith("...")


@given(
    st.text(st.characters(blacklist_characters="\r\n")),
    st.integers(0),
    st.integers(0),
    st.integers(20, 200),
)
def test_carets_never_leave_the_width(text: str, start: int, length: int, width: int) -> None:
    start = min(start, len(text))
    end = min(start + length, len(text))
    line = shown_line(Span(Source("a.mod", text), start, end), width)
    assert 0 <= line.caret_start < line.caret_end <= width + 1


@examples()
@given(st.text())
def test_text_of_a_program_steers_no_terminal(text: str) -> None:
    shown = printable(text)
    assert len(shown) == len(text)
    assert all(one.isprintable() or unicodedata.category(one) == "Zs" for one in shown)


def test_a_place_over_several_lines_shows_its_first() -> None:
    text = "IF a THEN\n  b;\nENDIF\n"
    assert "IF a THEN\n  | ^^^^^^^^^\n" in shown(
        Diagnostic(ConstantCondition("a"), span(text, text.strip()))
    )


def test_a_finding_at_the_end_of_the_text() -> None:
    text = "MODULE a\n"
    place = Span(Source("a.mod", text), len(text), len(text))
    assert "2 |\n  | ^\n" in shown(Diagnostic(ConstantCondition("a"), place))


def test_a_finding_without_a_place() -> None:
    diagnostic = Diagnostic(ConstantCondition("FALSE"), None)
    message = "this condition is always FALSE"
    assert shown(diagnostic) == f"warning[F402] constant-condition: {message}\n\n"
    assert concise(merged([diagnostic]), PLAIN) == f"warning[F402] {message}\n"
    assert json_of(diagnostic_record(merged([diagnostic])[0]))["file"] is None


def test_repeats_become_one_finding() -> None:
    text = "p;\nq;\np;\np;\n"
    findings = [Diagnostic(ConstantCondition("p"), span(text, "p", n)) for n in (2, 0, 1)]
    findings.append(Diagnostic(ConstantCondition("q"), span(text, "q")))
    first, second = merged(findings)
    assert (first.first.span and first.first.span.line, len(first.repeats)) == (1, 2)
    assert second.repeats == ()
    assert "and 2 more like it, on lines 3, 4" in shown(*findings)
    assert "a.mod:1:1: warning[F402] this condition is always p (and 2 more)" in concise(
        merged(findings), PLAIN
    )
    assert json_of(diagnostic_record(first))["repeats"] == [
        {"file": "a.mod", "line": 3, "column": 1},
        {"file": "a.mod", "line": 4, "column": 1},
    ]
    assert len(merged(findings, merge=False)) == 4
    assert summary_line(merged(findings), files=1, seconds=None) == "Found 4 warnings in 1 file."


@pytest.mark.parametrize("by_default", [False, True])
def test_only_a_guessed_arm_is_called_one(by_default: bool) -> None:
    text = "p;\nq;\np;\n"
    target = UnreachableTarget("p", "an arm", "too far", "move it closer", by_default)
    found = shown(*(Diagnostic(target, span(text, "p", n)) for n in (0, 1)))
    assert ("nothing names the arm" in found) is by_default
    assert ("move it closer" in found) is not by_default
    assert ("1 more target" in found) is by_default
    assert "and 1 more like it" in found


def test_rules_are_selected_by_code_family_and_name() -> None:
    def chosen(*selectors: list[str]) -> list[str]:
        return [code for code in ("N201", "F402") if is_selected(Rule(code), *selectors)]

    assert chosen(["N2"]) == ["N201"]
    assert chosen(["constant-condition", "n201"]) == ["N201", "F402"]
    assert chosen([], ["N", "F"]) == []
    assert chosen(["N", "F4"], ["constant-condition"]) == ["N201"]
    assert chosen(["N"], [], ["constant-condition"]) == ["N201", "F402"]
    assert chosen() == ["N201", "F402"]


def test_json_holds_what_the_text_does() -> None:
    text = "n:=p10;"
    fix = Fix("Write 1", (Edit(span(text, "p10"), "1"),))
    related = (Related(span(text, "n"), "this"),)
    [finding] = merged(
        [Diagnostic(UndefinedName("p10", "p1"), span(text, "p10"), related, fix, "main")]
    )
    report = json.loads(json.dumps(json_of(diagnostic_record(finding)), allow_nan=False))
    place = {"file": "a.mod", "line": 1, "column": 4, "end_line": 1, "end_column": 7}
    assert report == {
        "code": "N201",
        "name": "undefined-name",
        "severity": "error",
        "message": "`p10` is not declared",
        **place,
        "related": [{"file": "a.mod", "line": 1, "message": "this"}],
        "fix": {"title": "Write 1", "safe": True, "edits": [{**place, "text": "1"}]},
        "cf": "ABB 40128",
        "help": "did you mean `p1`?",
        "routine": "main",
        "repeats": [],
    }


def test_colours_change_nothing_but_colour() -> None:
    text = "n:=p10;"
    findings = merged([Diagnostic(UndefinedName("p10", "p1"), span(text, "p10"))])
    coloured = full(findings, COLOURED, width=80)
    assert coloured != full(findings, PLAIN, width=80)
    plain = coloured
    for code in (*vars_of(COLOURED), "\x1b[0m"):
        plain = plain.replace(code, "")
    assert plain == full(findings, PLAIN, width=80)


def vars_of(palette: object) -> tuple[str, ...]:
    return tuple(getattr(palette, name) for name in palette.__dataclass_fields__)  # type: ignore[attr-defined]


@pytest.mark.parametrize("width", [40, 60, 80])
def test_a_message_breaks_between_words_and_keeps_its_units(width: int) -> None:
    """Only where there is a width to keep; in a pipe it is one line."""
    text = "MODULE a\n  n:=p10;\nENDMODULE\n"
    told = "the path fails at 22 % (280.2 mm): axis 3 goes to 63.0 deg, 8.0 deg past 55.0 deg"
    findings = merged([Diagnostic(UncaughtError(told), span(text, "p10"))])
    broken = full(findings, PLAIN, width=width, headlines=width).splitlines()
    assert max(map(len, broken)) <= width
    assert full(findings, PLAIN, width=width).splitlines()[0].endswith(told)
    assert told in " ".join(broken)
    assert not [line for line in broken if re.match(r"(mm|deg|%)", line)]
    coloured = full(findings, COLOURED, width=width, headlines=width)
    assert COLOURED.map_plain_text(str, coloured) == coloured
    assert re.sub(r"\x1b\[[0-9;]*m", "", coloured).splitlines() == broken


def test_the_summary_line_counts() -> None:
    assert summary_line([], files=2, seconds=0.5) == "Found nothing wrong in 2 files (0.50 s)."
    findings = merged(
        [Diagnostic(UndefinedName("a"), None), Diagnostic(ConstantCondition("b"), None)]
    )
    assert summary_line(findings, files=1, seconds=None) == "Found 1 error and 1 warning in 1 file."
