"""Findings about statements of the tree, repeated for the bulk statements that they represent."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from rapidsim.analysis.names.name_violations import (
    AssumedData,
    UndefinedName,
    UnresolvedReference,
    UnseenName,
)
from rapidsim.diagnostics import Diagnostic, Span
from rapidsim.syntax import tree

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
        touched = [run for span in spans if (run := runs[span.file].around(span)) is not None]
        if not touched:
            continue
        run = touched[0]
        if not (isinstance(one.violation, _OF_EACH_USE) and _are_beyond_target(spans, run)):
            return None
        repeated += (_moved(one, row) for row in run.rows())
    if not repeated:
        return tuple(findings)
    position = {file.source.file: k for k, file in reversed(list(enumerate(files)))}
    every = [*findings, *repeated]
    every.sort(key=lambda one: (position.get(one.order[0], -1), one.order[1]))
    return tuple(every)


class _Runs:
    """Bulk statements of a file, by position."""

    def __init__(self, file: tree.File) -> None:
        """Sort the bulk statements by position."""
        runs = [run for module in file.modules for run in module.runs]
        self._runs = sorted(runs, key=lambda run: run.start)
        self._starts = [run.like.start for run in self._runs]

    def around(self, span: Span) -> tree.BulkStatements | None:
        """Return the bulk statements, or their representative, at either end of a span."""
        for offset in (span.start, max(span.start, span.end - 1)):
            position = bisect_right(self._starts, offset) - 1
            if position >= 0 and offset < self._runs[position].end:
                return self._runs[position]
        return None


def _spans(finding: Diagnostic) -> Iterator[Span]:
    if finding.span is not None:
        yield finding.span
    for related in finding.related:
        yield related.span
    for edit in finding.fix.edits if finding.fix else ():
        yield edit.span


def _are_beyond_target(spans: Iterable[Span], run: tree.BulkStatements) -> bool:
    """Whether spans are in the representative of bulk statements, after the target."""
    like = run.like
    if not isinstance(like, tree.Call):
        return False
    begin = like.arguments[0].end
    return all(begin <= span.start and span.end <= like.end for span in spans)


def _moved(finding: Diagnostic, row: tree.BulkRow) -> Diagnostic:
    """Return a finding about the statement in the tree, moved to a row that it represents."""

    def moved(span: Span) -> Span:
        return Span(span.source, row.moved(span.start), row.moved(span.end))

    assert finding.span is not None
    fix = finding.fix
    if fix is not None:
        fix = replace(fix, edits=tuple(replace(edit, span=moved(edit.span)) for edit in fix.edits))
    return replace(finding, span=moved(finding.span), fix=fix)
