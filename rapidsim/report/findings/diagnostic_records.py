"""Findings as records of JSON; lines and columns count from 1."""

from __future__ import annotations

from typing import Annotated

from rapidsim.diagnostics import Fix, Severity, Span
from rapidsim.json_records.declarations import ValueForm
from rapidsim.report.findings.merging import Finding
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class SourceRange:
    """A range of a file; all null without a position."""

    file: str | None
    """Name of the file as the user specified it."""
    line: int | None
    column: int | None
    end_line: int | None
    end_column: int | None
    """Column just past the last character."""


@value_class(frozen=True, slots=True)
class RelatedPlace:
    """Another place that explains a finding."""

    file: str
    line: int
    message: str


@value_class(frozen=True, slots=True)
class EditRecord:
    """Replacement of a range by a text."""

    range: Annotated[SourceRange, ValueForm.INLINE]
    text: str


@value_class(frozen=True, slots=True)
class FixRecord:
    """Edits that correct a finding."""

    title: str
    safe: bool
    """Whether `--fix` applies it; others need `--unsafe-fixes`."""
    edits: tuple[EditRecord, ...]


@value_class(frozen=True, slots=True)
class RepeatedPlace:
    """Place of a finding that was merged into another."""

    file: str
    line: int
    column: int


@value_class(frozen=True, slots=True)
class DiagnosticRecord:
    """A finding, with the places of the equal ones merged into it."""

    code: str
    """Code of its rule, such as `K601`; its meaning never changes."""
    name: str
    """Name of its rule, such as `unreachable-target`."""
    severity: Severity
    message: str
    range: Annotated[SourceRange, ValueForm.INLINE]
    related: tuple[RelatedPlace, ...]
    fix: FixRecord | None
    cf: str | None
    """Corresponding event number of the controller."""
    help: str | None
    """Suggestion; null if there is no known one."""
    routine: str | None
    """Routine that contains the place."""
    repeats: tuple[RepeatedPlace, ...]
    """Places of the findings merged into this one."""


def diagnostic_record(finding: Finding) -> DiagnosticRecord:
    """Return the record of a finding."""
    diagnostic = finding.first
    violation = diagnostic.violation
    return DiagnosticRecord(
        code=violation.code,
        name=violation.name,
        severity=diagnostic.severity,
        message=violation.message,
        range=_range(diagnostic.span),
        related=tuple(
            RelatedPlace(one.span.file, one.span.line, one.message) for one in diagnostic.related
        ),
        fix=_fix(diagnostic.fix) if diagnostic.fix else None,
        cf=violation.cf,
        help=violation.help,
        routine=diagnostic.routine,
        repeats=tuple(
            RepeatedPlace(one.span.file, one.span.line, one.span.column)
            for one in finding.repeats
            if one.span
        ),
    )


def _fix(fix: Fix) -> FixRecord:
    edits = tuple(EditRecord(_range(edit.span), edit.text) for edit in fix.edits)
    return FixRecord(fix.title, fix.safe, edits)


def _range(span: Span | None) -> SourceRange:
    if span is None:
        return SourceRange(None, None, None, None, None)
    return SourceRange(span.file, span.line, span.column, span.end_line, span.end_column)
