"""Findings as a JUnit report, which nearly every CI server shows: a file is a suite of tests."""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree import ElementTree

from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.report.findings.merging import Finding
from rapidsim.report.findings.source_frame import printable


def junit(findings: Sequence[Finding], files: Sequence[str]) -> str:
    """An XML document.

    Args:
        findings: Errors and warnings are failed tests, notes go to the output of their suite.
        files: All files that were checked; one without findings is a test that passed.
    """
    diagnostics = [one for finding in findings for one in (finding.first, *finding.repeats)]
    root = ElementTree.Element("testsuites", name="rapidsim check")
    named = dict.fromkeys((*files, *(_file(one) for one in diagnostics)))
    for file in named:
        root.append(_suite(file, [one for one in diagnostics if _file(one) == file]))
    for count in ("tests", "failures", "errors"):
        root.set(count, str(sum(int(suite.get(count, "0")) for suite in root)))
    ElementTree.indent(root)
    text = ElementTree.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="utf-8"?>\n{text}\n'


def _suite(file: str, diagnostics: Sequence[Diagnostic]) -> ElementTree.Element:
    suite = ElementTree.Element("testsuite", name=_clean(file))
    failed = [one for one in diagnostics if one.severity is not Severity.NOTE]
    for diagnostic in failed:
        violation = diagnostic.violation
        line = diagnostic.span.line if diagnostic.span else 0
        name = f"{violation.code} {violation.name}" + (f" line {line}" if line else "")
        case = ElementTree.SubElement(suite, "testcase", name=name, classname=_clean(file))
        message = _clean(violation.message)
        failure = ElementTree.SubElement(
            case, "failure", type=diagnostic.severity.value, message=message
        )
        failure.text = _text(diagnostic)
    if not failed:
        ElementTree.SubElement(suite, "testcase", name="check", classname=_clean(file))
    notes = [_text(one) for one in diagnostics if one.severity is Severity.NOTE]
    if notes:
        ElementTree.SubElement(suite, "system-out").text = "\n".join(notes)
    suite.set("tests", str(max(1, len(failed))))
    suite.set("failures", str(len(failed)))
    suite.set("errors", "0")
    return suite


def _file(diagnostic: Diagnostic) -> str:
    return diagnostic.span.file if diagnostic.span else "program"


def _text(diagnostic: Diagnostic) -> str:
    violation = diagnostic.violation
    place = f"{_file(diagnostic)}:"
    if diagnostic.span:
        place += f"{diagnostic.span.line}:{diagnostic.span.column}:"
    help = f"\n  help: {violation.help}" if violation.help else ""
    text = f"{place} {diagnostic.severity.value}[{violation.code}] {violation.message}{help}"
    return "\n".join(_clean(line) for line in text.split("\n"))


def _clean(text: str) -> str:
    """Text without what XML 1.0 cannot hold."""
    return printable(text)
