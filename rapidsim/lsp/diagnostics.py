"""Findings as diagnostics of the protocol."""

from __future__ import annotations

from collections.abc import Sequence

from lsprotocol import types as lsp

from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.lsp.view import Document, View

SOURCE = "rapidsim"
_SEVERITIES = {
    Severity.ERROR: lsp.DiagnosticSeverity.Error,
    Severity.WARNING: lsp.DiagnosticSeverity.Warning,
    Severity.NOTE: lsp.DiagnosticSeverity.Information,
}
_UNNECESSARY = frozenset({"E160", "F401", "N204", "N205"})
"""Rules about text without effect, which editors fade."""


def diagnostics_of(document: Document, findings: Sequence[Diagnostic]) -> list[lsp.Diagnostic]:
    """Return the findings in a document as the protocol has them."""
    return [diagnostic_of(document, one) for one in findings]


def diagnostic_of(document: Document, finding: Diagnostic) -> lsp.Diagnostic:
    """Return one finding; one without a position is shown at the beginning of the text."""
    span, rule = finding.span, finding.violation.rule
    return lsp.Diagnostic(
        range=document.range(0, 0) if span is None else document.range(span.start, span.end),
        message=finding.message if finding.help is None else f"{finding.message}\n{finding.help}",
        severity=_SEVERITIES[finding.severity],
        code=finding.code,
        code_description=lsp.CodeDescription(rule.path("page.md").as_uri()),
        source=SOURCE,
        tags=[lsp.DiagnosticTag.Unnecessary] if finding.code in _UNNECESSARY else None,
        related_information=_related(document.view, finding),
        data=_data(finding),
    )


def _related(view: View, finding: Diagnostic) -> list[lsp.DiagnosticRelatedInformation] | None:
    found = [
        lsp.DiagnosticRelatedInformation(view.location(one.span), one.message)
        for one in finding.related
    ]
    return found or None


def _data(finding: Diagnostic) -> dict[str, lsp.LSPAny]:
    """Facts for clients: the name of the rule, the controller's number, whether a fix exists."""
    fix = finding.fix
    return {
        "name": finding.violation.name,
        "cf": finding.violation.cf,
        "fix": None if fix is None else fix.title,
    }
