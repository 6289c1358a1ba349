"""Findings about statements of the tree, repeated for the bulk statements that they represent."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from operator import itemgetter

from rapidsim.analysis.names.name_violations import (
    AssumedData,
    UndefinedName,
    UnresolvedReference,
    UnseenName,
)
from rapidsim.diagnostics import Diagnostic, Severity, Span
from rapidsim.syntax import tree
from rapidsim.values import value_class

_OF_EACH_USE = (UndefinedName, UnseenName, UnresolvedReference, AssumedData)
"""Violations that follow from a name alone, so they apply wherever the name is used."""


def repeat_findings(
    files: Sequence[tree.File], findings: Sequence[Diagnostic]
) -> tuple[Diagnostic, ...] | None:
    """Return the findings about all statements, in order; None if one cannot be repeated.

    Args:
        files: The files of a task.
        findings: The findings about the statements of their trees, in order.
    """
    runs = {file.source.file: _Runs(file) for file in files}
    repeated: list[Diagnostic] = []
    for one in findings:
        spans = tuple(_spans(one))
        touched = [of for span in spans if (of := runs[span.file].around(span)) is not None]
        if not touched:
            continue
        if not touched[0].may_repeat(one, spans):
            return None
        repeated += (_moved(one, where) for where in touched[0].repetitions())
    if not repeated:
        return tuple(findings)
    position = {file.source.file: k for k, file in reversed(list(enumerate(files)))}
    every = [*findings, *repeated]
    every.sort(key=lambda one: (position.get(one.order[0], -1), one.order[1]))
    return tuple(every)


@value_class(frozen=True, slots=True, eq=False)
class _Moves:
    """Bulk moves, or declarations, that a statement of the tree represents."""

    run: tree.BulkStatements

    def may_repeat(self, finding: Diagnostic, spans: Iterable[Span]) -> bool:
        """Whether what a finding says of the statement follows from what is behind its target."""
        like = self.run.like
        if not (isinstance(finding.violation, _OF_EACH_USE) and isinstance(like, tree.Call)):
            return False
        begin = like.arguments[0].end
        return all(begin <= span.start and span.end <= like.end for span in spans)

    def repetitions(self) -> Iterator[Callable[[Span], Span]]:
        """Yield functions that map spans in the statement to those in each that it represents."""
        for row in self.run.rows():
            yield partial(_in_row, row)


@value_class(frozen=True, slots=True, eq=False)
class _Calls:
    """Calls between bulk moves that one of the tree represents."""

    of: tuple[tuple[tree.RepeatedCall, tree.BulkStatements], ...]

    def may_repeat(self, finding: Diagnostic, spans: Iterable[Span]) -> bool:
        """Whether what a finding says of the call follows from its text and the move before."""
        # A run needs no rules.
        from rapidsim.analysis.rules.motion.zones import OutputInZone

        if finding.severity is Severity.ERROR:
            # What such a call would have done to the moves after it is not known.
            return False
        like, move = self.of[0][0].like, self.of[0][0].move
        is_whole_move = isinstance(finding.violation, OutputInZone)
        return isinstance(finding.violation, (*_OF_EACH_USE, OutputInZone)) and all(
            (like.start <= span.start and span.end <= like.end)
            or (is_whole_move and (span.start, span.end) == (move.start, move.end))
            for span in spans
        )

    def repetitions(self) -> Iterator[Callable[[Span], Span]]:
        """Yield functions that map spans in the call, and that of the move, to each repetition."""
        for call, run in self.of:
            for row, before in zip(call.rows(), call.moves_before.tolist(), strict=True):
                move = run.like if before == 0 else next(run.rows(slice(before - 1, before)))
                yield partial(_in_call, row, call.move, move)


class _Runs:
    """Bulk statements of a file, by position."""

    def __init__(self, file: tree.File) -> None:
        """Sort the bulk statements, and the representatives of the calls between, by position."""
        runs = [run for module in file.modules for run in module.runs]
        calls: dict[tree.Call, list[tuple[tree.RepeatedCall, tree.BulkStatements]]] = {}
        for run in runs:
            for one in run.between:
                calls.setdefault(one.like, []).append((one, run))
        found: list[tuple[int, int, _Moves | _Calls]] = [
            *((run.like.start, run.end, _Moves(run)) for run in runs),
            *((like.start, like.end, _Calls(tuple(of))) for like, of in calls.items()),
        ]
        self._found = sorted(found, key=itemgetter(0))

    def around(self, span: Span) -> _Moves | _Calls | None:
        """Return the statements, or their representative, at either end of a span."""
        for offset in (span.start, max(span.start, span.end - 1)):
            position = bisect_right(self._found, offset, key=itemgetter(0)) - 1
            if position >= 0 and offset < self._found[position][1]:
                return self._found[position][2]
        return None


def _spans(finding: Diagnostic) -> Iterator[Span]:
    if finding.span is not None:
        yield finding.span
    for related in finding.related:
        yield related.span
    for edit in finding.fix.edits if finding.fix else ():
        yield edit.span


def _in_row(row: tree.BulkRow, span: Span) -> Span:
    """Map a span in the statement of the tree to a row that it represents."""
    return Span(span.source, row.moved(span.start), row.moved(span.end))


def _in_call(row: tree.BulkRow, move: tree.Node, its_move: tree.Node, span: Span) -> Span:
    """Map a span in a call of the tree, or that of the move before it, to a repetition."""
    if span.start == move.start:
        return Span(span.source, its_move.start, its_move.end)
    return _in_row(row, span)


def _moved(finding: Diagnostic, moved: Callable[[Span], Span]) -> Diagnostic:
    """Return a finding about the statement in the tree, moved to one that it represents."""
    assert finding.span is not None
    fix = finding.fix
    if fix is not None:
        fix = replace(fix, edits=tuple(replace(edit, span=moved(edit.span)) for edit in fix.edits))
    related = tuple(replace(one, span=moved(one.span)) for one in finding.related)
    return replace(finding, span=moved(finding.span), related=related, fix=fix)
