"""Safe fixes change no program: all of them at once, on every module of rules and corpus."""

from __future__ import annotations

import pytest
from check_helper import CORPUS

from rapidsim.analysis.passes.checker import check
from rapidsim.analysis.rules.table import detectors_of
from rapidsim.analysis.suppressions import without_suppressed
from rapidsim.diagnostics import Diagnostic, Severity, Source, all_rules
from rapidsim.files import decode
from rapidsim.jobs.checking.fixes import choose_fixes
from rapidsim.module_files import MODULE_SUFFIXES
from rapidsim.report.pages.rules import programs
from rapidsim.syntax import tree
from rapidsim.syntax.parser import parse
from rapidsim.syntax.printer import print_module
from rapidsim.text_edits import edited_text

PROGRAMS = {
    str(file.relative_to(CORPUS)): file.read_bytes()
    for file in sorted(CORPUS.rglob("*"))
    if file.suffix in MODULE_SUFFIXES
} | {
    f"{rule.code}-{file}-{number}": program
    for rule in all_rules()
    for file in ("bad", "good")
    for number, program in enumerate(programs(rule, f"{file}.mod"))
    if program
}


def found_in(text: str) -> tuple[tree.File, tuple[Diagnostic, ...]]:
    parsed = parse(Source("m.mod", text))
    found = check([parsed.file], detectors_of(lambda rule: True)).diagnostics
    everything = (*parsed.diagnostics, *found)
    return parsed.file, without_suppressed(everything, [parsed.file])


def printed(file: tree.File) -> str:
    return "\n".join(print_module(module) for module in file.modules)


@pytest.mark.parametrize("program", PROGRAMS.values(), ids=PROGRAMS.keys())
def test_all_safe_fixes_together_leave_the_program_as_it_is(program: bytes) -> None:
    text, _ = decode(program)
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
