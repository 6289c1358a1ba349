"""What a programmer reads about a broken file: the reports of `broken/`, kept as text.

`UPDATE_GOLDEN=1 pytest` writes them anew; read the difference before you keep it.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from rapidsim.diagnostics import Diagnostic, Source, Span
from rapidsim.syntax.parser import parse

BROKEN = sorted(
    path for path in (Path(__file__).parent / "broken").iterdir() if path.suffix != ".reports"
)


def line(diagnostic: Diagnostic) -> str:
    """A report in one line, with the texts that it underlines."""
    span, violation = diagnostic.span, diagnostic.violation
    assert span is not None
    place = f"{span.line}:{span.column} {underlined(span)}"
    text = f"{place} {violation.severity}[{violation.code}] {violation.message}"
    for related in diagnostic.related:
        text += f" ({related.message}: {related.span.line} {underlined(related.span)})"
    return text


def underlined(span: Span) -> str:
    """The text of a span, with its beginning and end if it is long."""
    text = repr(span.source.text[span.start : span.end])
    return text if len(text) <= 40 else f"{text[:18]}...{text[-18:]}"


def reports(text: str) -> list[str]:
    return [line(diagnostic) for diagnostic in parse(Source("broken", text)).diagnostics]


@pytest.mark.parametrize("program", BROKEN, ids=lambda program: program.name)
def test_reports_of_a_broken_file(program: Path) -> None:
    golden = program.with_suffix(".reports")
    found = "".join(f"{report}\n" for report in reports(program.read_text()))
    if os.environ.get("UPDATE_GOLDEN"):
        golden.write_text(found)
    assert found == golden.read_text()


def test_a_fix_can_be_applied() -> None:
    source = Source("m", "MODULE m\nPROC p()\nx:=1\nIF a THNE\ny:=2;\nENDIF\nENDPROC\nENDMODULE\n")
    text = source.text
    edits = [e for d in parse(source).diagnostics if d.fix for e in d.fix.edits]
    for edit in sorted(edits, key=lambda edit: -edit.span.start):
        text = text[: edit.span.start] + edit.text + text[edit.span.end :]
    assert not parse(Source("m", text)).diagnostics


def test_the_rest_of_a_broken_file_is_read() -> None:
    text = (Path(__file__).parent / "broken" / "beginner.mod").read_text()
    module = parse(Source("beginner", text)).file.modules[0]
    assert [routine.name.text for routine in module.routines] == ["main", "report"]
