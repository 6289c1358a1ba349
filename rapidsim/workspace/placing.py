"""Findings at addresses of spaced texts become findings at offsets of the written ones."""

from __future__ import annotations

from rapidsim.diagnostics import Diagnostic, Edit, Fix, Related, Span, Violation
from rapidsim.syntax.violations import UnclosedBlock


def placed(finding: Diagnostic) -> Diagnostic:
    """Return a finding with all its places in the files as they are written."""
    related = finding.related
    if related:
        related = tuple(Related(_placed(one.span), one.message) for one in related)
    return Diagnostic(
        _of_line(finding.violation, related) if related else finding.violation,
        None if finding.span is None else _placed(finding.span),
        related,
        None if finding.fix is None else _fix(finding.fix),
        finding.routine,
        finding.assumed,
    )


def _placed(span: Span) -> Span:
    source = span.source
    return Span(source.written, *source.offsets(span.start, span.end))


def _fix(fix: Fix) -> Fix:
    edits = tuple(Edit(_placed(one.span), one.text) for one in fix.edits)
    return Fix(fix.title, edits, fix.safe)


def _of_line(violation: Violation, related: tuple[Related, ...]) -> Violation:
    """The violation with the present number of the line that it names."""
    if isinstance(violation, UnclosedBlock) and related:
        return UnclosedBlock(violation.block, violation.closer, related[0].span.line)
    return violation
