"""Output of a check: the findings in one of six formats."""

from __future__ import annotations

import json
from collections.abc import Sequence

from rapidsim import __version__
from rapidsim.cli.terminal import Terminal
from rapidsim.cli.tools.findings_text import findings_text
from rapidsim.jobs.checking.check_result import CheckResult
from rapidsim.report.findings.merging import Finding
from rapidsim.report.findings.text import concise

FORMATS = ("full", "concise", "json", "sarif", "github", "junit")
SPOKEN_FORMATS = ("full", "concise")
"""Formats that a person reads; a summary follows."""


def checked_text(
    format: str,
    findings: Sequence[Finding],
    result: CheckResult,
    terminal: Terminal,
    *,
    is_ok: bool,
) -> str:
    """The findings as text that ends in a line end, where there is any.

    Args:
        format: One of `FORMATS`.
        findings: What is shown.
        result: What was checked.
        terminal: Where it is shown.
        is_ok: Whether nothing fails the check.
    """
    match format:
        case "full":
            return findings_text(findings, terminal)
        case "concise":
            return concise(findings, terminal.palette)
        case "sarif":
            from rapidsim.report.findings.sarif import sarif

            return _json(sarif(findings, __version__))
        case "github":
            from rapidsim.report.findings.github import github

            return github(findings)
        case "junit":
            from rapidsim.report.findings.junit import junit

            return junit(findings, result.files)
        case _:
            from rapidsim.json_records.encoding import json_of
            from rapidsim.report.findings.check_report import check_report

            return _json(json_of(check_report(findings, result, is_ok=is_ok)))


def _json(value: object) -> str:
    return f"{json.dumps(value, indent=2, allow_nan=False)}\n"
