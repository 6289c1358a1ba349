"""Findings at addresses of spaced texts become findings at offsets of the written ones."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from operator import attrgetter

from rapidsim.diagnostics import Diagnostic, Edit, Fix, Related, Span, Violation
from rapidsim.syntax.violations import UnclosedBlock
from rapidsim.workspace.spaced_source import SpacedSource


def placed(findings: Iterable[Diagnostic], source: SpacedSource) -> Iterator[Diagnostic]:
    """Yield the findings in a file, by offset, with all their places in the files as written."""
    written, pieces = source.written, source.shifts()
    begin = end = shift = 0
    for one in sorted(findings, key=attrgetter("order")):
        span = one.span
        if span is None:
            yield one
            continue
        # Most findings lie in one piece.
        while span.start > end + shift and (piece := next(pieces, None)):
            begin, (end, shift) = end, piece
        if begin + shift <= span.start and span.end <= end + shift:
            place = Span(written, span.start - shift, span.end - shift)
        else:
            place = span.written
        related = one.related
        if not related and one.fix is None:
            yield Diagnostic(one.violation, place, (), None, one.routine, one.assumed)
            continue
        related = tuple([Related(other.span.written, other.message) for other in related])
        fix = None if one.fix is None else _fix(one.fix)
        violation = _of_line(one.violation, related)
        yield Diagnostic(violation, place, related, fix, one.routine, one.assumed)


def _fix(fix: Fix) -> Fix:
    edits = tuple(Edit(one.span.written, one.text) for one in fix.edits)
    return Fix(fix.title, edits, fix.safe)


def _of_line(violation: Violation, related: tuple[Related, ...]) -> Violation:
    """The violation with the present number of the line that it names."""
    if isinstance(violation, UnclosedBlock) and related:
        return UnclosedBlock(violation.block, violation.closer, related[0].span.line)
    return violation
