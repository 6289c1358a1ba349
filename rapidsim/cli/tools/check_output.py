"""Output of a check: the findings in one of six formats."""

from __future__ import annotations

import json
from collections.abc import Sequence

from rapidsim import __version__
from rapidsim.cli.terminal import Terminal
from rapidsim.cli.tools.findings_text import findings_text
from rapidsim.jobs.checking.check_result import CheckResult
from rapidsim.report.findings.merging import Finding
from rapidsim.report.findings.text import concise, diagnostic_json

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
            return _json(checked_json(findings, result, is_ok=is_ok))


def _json(value: object) -> str:
    return f"{json.dumps(value, indent=2, allow_nan=False)}\n"


def checked_json(
    findings: Sequence[Finding], result: CheckResult, *, is_ok: bool
) -> dict[str, object]:
    """The findings as JSON values.

    Args:
        findings: What is shown.
        result: What was checked.
        is_ok: Whether nothing fails the check.
    """
    coverage = result.coverage
    unchecked, unchecked_paths = (
        [{"file": move.span.file, "line": move.span.line, "reason": move.reason} for move in moves]
        for moves in (coverage.unchecked, coverage.unchecked_paths)
    )
    left_out = {"main_left_out": coverage.main_left_out} if coverage.main_left_out else {}
    return {
        "schema": 1,
        "ok": is_ok,
        "qualifications": list(result.qualifications),
        "files": len(result.files),
        "diagnostics": [diagnostic_json(finding) for finding in findings],
        "coverage": {
            "moves": coverage.moves,
            "checked": coverage.checked,
            "by_value": coverage.by_value,
            "by_run": coverage.by_run,
            "unchecked": unchecked,
            **left_out,
            "paths": coverage.paths,
            "paths_checked": coverage.paths_checked,
            "unchecked_paths": unchecked_paths,
        },
    }
