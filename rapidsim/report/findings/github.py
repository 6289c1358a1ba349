"""Findings as workflow commands, which GitHub shows at the lines of a pull request.

Source: GitHub documentation, "Workflow commands for GitHub Actions", "Setting an error message".
"""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.report.findings.merging import Finding

_COMMANDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.NOTE: "notice"}
_DATA = str.maketrans({"%": "%25", "\r": "%0D", "\n": "%0A"})
_PROPERTY = str.maketrans({"%": "%25", "\r": "%0D", "\n": "%0A", ":": "%3A", ",": "%2C"})


def github(findings: Sequence[Finding]) -> str:
    """One command a line; findings that were merged have one each."""
    diagnostics = (one for finding in findings for one in (finding.first, *finding.repeats))
    return "".join(f"{_command(one)}\n" for one in diagnostics)


def _command(diagnostic: Diagnostic) -> str:
    violation = diagnostic.violation
    properties = {"title": f"{violation.code} {violation.name}"}
    if (span := diagnostic.span) is not None:
        properties = {"file": span.file, "line": str(span.line), "col": str(span.column)}
        properties["endLine"] = str(span.end_line)
        if span.end_line == span.line:
            properties["endColumn"] = str(span.end_column)
        properties["title"] = f"{violation.code} {violation.name}"
    shown = ",".join(f"{name}={value.translate(_PROPERTY)}" for name, value in properties.items())
    text = violation.message if violation.help is None else f"{violation.message}\n{violation.help}"
    return f"::{_COMMANDS[diagnostic.severity]} {shown}::{text.translate(_DATA)}"
