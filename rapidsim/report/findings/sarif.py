"""Findings as SARIF 2.1.0, which code scanning of GitHub, GitLab and editors read.

Source: OASIS Standard "Static Analysis Results Interchange Format (SARIF) Version 2.1.0".
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from pathlib import PurePath
from urllib.parse import quote

from rapidsim.diagnostics import Diagnostic, Fix, Rule, Severity, Span
from rapidsim.jobs.checking.baseline import finding_key
from rapidsim.report.findings.merging import Finding
from rapidsim.report.pages.rules import explanation, first_line, markdown

SCHEMA = (
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
)
_LEVELS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.NOTE: "note"}


def sarif(findings: Sequence[Finding], version: str) -> dict[str, object]:
    """A SARIF log with one run; merged findings are separate results.

    Args:
        findings: What was found.
        version: Of rapidsim.
    """
    diagnostics = [one for finding in findings for one in (finding.first, *finding.repeats)]
    used = sorted({one.violation.rule for one in diagnostics}, key=lambda rule: rule.code)
    numbers = {rule: k for k, rule in enumerate(used)}
    return {
        "$schema": SCHEMA,
        "version": "2.1.0",
        "runs": [
            {
                "tool": {
                    "driver": {
                        "name": "rapidsim",
                        "version": version,
                        "rules": [_rule(rule) for rule in used],
                    }
                },
                "columnKind": "unicodeCodePoints",
                "results": [_result(one, numbers[one.violation.rule]) for one in diagnostics],
            }
        ],
    }


def _rule(rule: Rule) -> dict[str, object]:
    page = markdown(rule)
    return {
        "id": rule.code,
        "name": rule.name,
        "shortDescription": {"text": first_line(rule)},
        "fullDescription": {"text": " ".join(explanation(rule).split())},
        "help": {"text": page, "markdown": page},
        "defaultConfiguration": {"level": _LEVELS[rule.severity]},
    }


def _result(diagnostic: Diagnostic, rule: int) -> dict[str, object]:
    violation = diagnostic.violation
    text = violation.message
    if help := violation.help:
        text += f". {help[0].upper()}{help[1:]}"
    result: dict[str, object] = {
        "ruleId": violation.code,
        "ruleIndex": rule,
        "level": _LEVELS[diagnostic.severity],
        "message": {"text": text},
    }
    if diagnostic.span is not None:
        location = _location(diagnostic.span)
        if diagnostic.routine is not None:
            location["logicalLocations"] = [{"name": diagnostic.routine, "kind": "function"}]
        result["locations"] = [location]
        key = "\n".join(finding_key(diagnostic))
        digest = hashlib.sha256(key.encode("utf-8", "surrogatepass")).hexdigest()
        result["partialFingerprints"] = {"statement/v1": digest[:32]}
    if diagnostic.related:
        result["relatedLocations"] = [
            {**_location(related.span), "id": k, "message": {"text": related.message}}
            for k, related in enumerate(diagnostic.related)
        ]
    if diagnostic.fix is not None:
        result["fixes"] = [_fix(diagnostic.fix)]
    return result


def _fix(fix: Fix) -> dict[str, object]:
    files = dict.fromkeys(edit.span.file for edit in fix.edits)
    return {
        "description": {"text": fix.title},
        "artifactChanges": [
            {
                "artifactLocation": {"uri": _uri(file)},
                "replacements": [
                    {
                        "deletedRegion": _region(edit.span),
                        "insertedContent": {"text": edit.text},
                    }
                    for edit in fix.edits
                    if edit.span.file == file
                ],
            }
            for file in files
        ],
    }


def _location(span: Span) -> dict[str, object]:
    return {
        "physicalLocation": {
            "artifactLocation": {"uri": _uri(span.file)},
            "region": _region(span),
        }
    }


def _region(span: Span) -> dict[str, object]:
    return {
        "startLine": span.line,
        "startColumn": span.column,
        "endLine": span.end_line,
        "endColumn": span.end_column,
    }


def _uri(file: str) -> str:
    path = PurePath(file)
    return path.as_uri() if path.is_absolute() else quote(path.as_posix())
