"""Findings at addresses of spaced texts become findings at offsets of the written ones.

Most findings stay where they are, or move with the item that contains them. So those of each piece
of a text are kept until they or the place of the piece change.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from operator import attrgetter

from rapidsim.diagnostics import Diagnostic, Edit, Fix, Related, Source, Span, Violation
from rapidsim.syntax.violations import UnclosedBlock
from rapidsim.values import value_class
from rapidsim.workspace.spaced_source import SpacedSource, TextPiece

_ORDER = attrgetter("order")


@value_class(frozen=True, slots=True, eq=False)
class _PlacedPiece:
    """The findings in one piece."""

    findings: Sequence[Diagnostic]
    """At their addresses, by address."""
    piece: TextPiece
    placed: list[Diagnostic]
    """At their offsets."""
    wide: Sequence[int]
    """Indices of findings that name places in other pieces, or lines."""


class FilePlaces:
    """The places of the findings in one file."""

    def __init__(self, source: SpacedSource) -> None:
        """Begin without findings."""
        self._source = source
        self._kept: dict[int, _PlacedPiece] = {}

    def placed(self, findings: Iterable[Diagnostic]) -> list[Diagnostic]:
        """Return findings, by offset, with all their places in the files as written."""
        ordered = sorted(findings, key=_ORDER)
        starts = [one.order[1] for one in ordered]
        before, self._kept = self._kept, {}
        placed: list[Diagnostic] = []
        first = 0
        while first < len(ordered):
            piece = self._source.piece(starts[first])
            last = bisect_left(starts, piece.next_address, first)
            group = ordered[first:last]
            known = before.get(piece.address)
            if known is None or known.piece != piece or known.findings != group:
                known = _place_all(group, piece)
            else:
                for index in known.wide:
                    known.placed[index] = _placed(group[index])
            self._kept[piece.address] = known
            placed += known.placed
            first = last
        return placed


def _place_all(findings: Sequence[Diagnostic], piece: TextPiece) -> _PlacedPiece:
    source, written, begin, end = piece.source, piece.source.written, piece.address, piece.end
    shift = piece.start - begin
    placed: list[Diagnostic] = []
    wide: list[int] = []
    for one in findings:
        span, related, fix = one.span, one.related, one.fix
        is_wide = span is None or span.end > end or isinstance(one.violation, UnclosedBlock)
        for other in related:
            place = other.span
            if place.start < begin or place.end > end or place.source is not source:
                is_wide = True
        for edit in () if fix is None else fix.edits:
            place = edit.span
            if place.start < begin or place.end > end or place.source is not source:
                is_wide = True
        if is_wide or span is None:
            wide.append(len(placed))
            placed.append(_placed(one))
            continue
        if related:
            places = [_moved(other.span, written, shift) for other in related]
            related = tuple(map(Related, places, [other.message for other in related]))
        if fix is not None:
            edits = [Edit(_moved(edit.span, written, shift), edit.text) for edit in fix.edits]
            fix = Fix(fix.title, tuple(edits), fix.safe)
        span = Span(written, span.start + shift, span.end + shift)
        placed.append(Diagnostic(one.violation, span, related, fix, one.routine, one.assumed))
    return _PlacedPiece(findings, piece, placed, wide)


def _moved(span: Span, source: Source, distance: int) -> Span:
    return Span(source, span.start + distance, span.end + distance)


def _placed(finding: Diagnostic) -> Diagnostic:
    """Return a finding with all its places, wherever they are, in files as written."""
    related = finding.related
    if related:
        related = tuple([Related(one.span.written, one.message) for one in related])
    return Diagnostic(
        _of_line(finding.violation, related) if related else finding.violation,
        None if finding.span is None else finding.span.written,
        related,
        None if finding.fix is None else _fix(finding.fix),
        finding.routine,
        finding.assumed,
    )


def _fix(fix: Fix) -> Fix:
    edits = tuple([Edit(one.span.written, one.text) for one in fix.edits])
    return Fix(fix.title, edits, fix.safe)


def addressed(finding: Diagnostic, source: SpacedSource) -> Diagnostic:
    """Return a finding in a text as written with its places in the spaced text."""
    return moved(
        finding, lambda span: Span(source, source.address(span.start), source.address(span.end))
    )


def moved(finding: Diagnostic, place: Callable[[Span], Span]) -> Diagnostic:
    """Return a finding with each of its spans replaced."""
    fix = finding.fix
    if fix is not None:
        fix = replace(fix, edits=tuple(Edit(place(one.span), one.text) for one in fix.edits))
    related = tuple(Related(place(one.span), one.message) for one in finding.related)
    span = None if finding.span is None else place(finding.span)
    return replace(finding, span=span, related=related, fix=fix)


def renumbered(finding: Diagnostic) -> Diagnostic:
    """Return a finding with the present number of the line that it names."""
    return replace(finding, violation=_of_line(finding.violation, finding.related))


def _of_line(violation: Violation, related: tuple[Related, ...]) -> Violation:
    """The violation with the present number of the line that it names."""
    if isinstance(violation, UnclosedBlock) and related:
        return UnclosedBlock(violation.block, violation.closer, related[0].span.line)
    return violation
