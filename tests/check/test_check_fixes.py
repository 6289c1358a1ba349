"""Safe fixes change no program: all of them at once, on every module of the fixtures and corpus."""

from __future__ import annotations

from pathlib import Path

import pytest
from check_helper import CORPUS, FIXTURES

from rapidsim.analysis.checker import check
from rapidsim.analysis.rules.table import detectors_of
from rapidsim.analysis.suppressions import without_suppressed
from rapidsim.cli.fixes import choose_fixes
from rapidsim.diagnostics import Diagnostic, Severity, Source
from rapidsim.export.text_edits import edited_text
from rapidsim.files import MODULE_SUFFIXES, decode
from rapidsim.syntax import tree
from rapidsim.syntax.parser import parse
from rapidsim.syntax.printer import print_module

FILES = sorted(
    file
    for folder in (FIXTURES, CORPUS)
    for file in folder.rglob("*")
    if file.suffix in MODULE_SUFFIXES
)


def found_in(text: str) -> tuple[tree.File, tuple[Diagnostic, ...]]:
    parsed = parse(Source("m.mod", text))
    found = check([parsed.file], detectors_of(lambda rule: True)).diagnostics
    everything = (*parsed.diagnostics, *found)
    return parsed.file, without_suppressed(everything, [parsed.file])


def printed(file: tree.File) -> str:
    return "\n".join(print_module(module) for module in file.modules)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_all_safe_fixes_together_leave_the_program_as_it_is(path: Path) -> None:
    text, _ = decode(path.read_bytes())
    before, found = found_in(text)
    edits = choose_fixes(found, unsafe=False).edits.get("m.mod", [])
    fixed = edited_text(text, edits)
    after, left = found_in(fixed)
    assert not choose_fixes(left, unsafe=False).edits, "a second round finds more to do"
    errors = [one for one in found if one.severity is Severity.ERROR]
    still = [one for one in left if one.severity is Severity.ERROR]
    assert len(still) <= len(errors)
    # Quaternions alone become other numbers, and those no longer than their rounding.
    if not errors and not any(one.violation.code == "M501" for one in found):
        assert printed(after) == printed(before)
