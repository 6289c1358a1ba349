"""Findings at addresses of spaced texts become findings at offsets of the written ones.

Most findings stay where they are, or move with the item that contains them. So those of each piece
of a text are kept until they or the place of the piece change.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator, Sequence
from operator import attrgetter

from rapidsim.diagnostics import Diagnostic, Edit, Fix, Related, Violation
from rapidsim.syntax.violations import UnclosedBlock
from rapidsim.values import value_class
from rapidsim.workspace.spaced_source import Piece, SpacedSource

_ORDER = attrgetter("order")


@value_class(frozen=True, slots=True, eq=False)
class _PlacedPiece:
    """The findings in one piece."""

    findings: Sequence[Diagnostic]
    """At their addresses, by address."""
    piece: Piece
    placed: Sequence[Diagnostic]
    """At their offsets."""


class FilePlaces:
    """The places of the findings in one file."""

    def __init__(self, source: SpacedSource) -> None:
        """Begin without findings."""
        self._source = source
        self._kept: dict[int, _PlacedPiece] = {}

    def placed(self, findings: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
        """Yield findings, by offset, with all their places in the files as written."""
        ordered = sorted(findings, key=_ORDER)
        starts = [one.order[1] for one in ordered]
        before, self._kept = self._kept, {}
        first = 0
        while first < len(ordered):
            piece = self._source.piece(starts[first])
            last = bisect_left(starts, piece.next_address, first)
            group = ordered[first:last]
            known = before.get(piece.address)
            if known is None or known.piece != piece or known.findings != group:
                known = _PlacedPiece(group, piece, [_placed(one, piece) for one in group])
            if all(_is_inside(one, piece) for one in group):
                self._kept[piece.address] = known
            yield from known.placed
            first = last


def _is_inside(finding: Diagnostic, piece: Piece) -> bool:
    """Whether a finding names no place outside of a piece, and no line."""
    if finding.span is None or isinstance(finding.violation, UnclosedBlock):
        return False
    spans = [finding.span, *(one.span for one in finding.related)]
    if finding.fix is not None:
        spans += [one.span for one in finding.fix.edits]
    return all(piece.contains(span) for span in spans)


def _placed(finding: Diagnostic, piece: Piece) -> Diagnostic:
    related = finding.related
    if related:
        related = tuple([Related(piece.placed(one.span), one.message) for one in related])
    return Diagnostic(
        _of_line(finding.violation, related) if related else finding.violation,
        None if finding.span is None else piece.placed(finding.span),
        related,
        None if finding.fix is None else _fix(finding.fix, piece),
        finding.routine,
        finding.assumed,
    )


def _fix(fix: Fix, piece: Piece) -> Fix:
    edits = tuple([Edit(piece.placed(one.span), one.text) for one in fix.edits])
    return Fix(fix.title, edits, fix.safe)


def _of_line(violation: Violation, related: tuple[Related, ...]) -> Violation:
    """The violation with the present number of the line that it names."""
    if isinstance(violation, UnclosedBlock) and related:
        return UnclosedBlock(violation.block, violation.closer, related[0].span.line)
    return violation
