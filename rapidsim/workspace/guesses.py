"""Findings that rest on a guess of the parser, which are not reported."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Sequence

from rapidsim.analysis.passes.flow_violations import UnreachableCode
from rapidsim.diagnostics import Diagnostic, Span
from rapidsim.syntax import tree
from rapidsim.syntax.violations import UnclosedBlock


def without_guesses(
    findings: Sequence[Diagnostic], of_syntax: Sequence[Diagnostic], files: Sequence[tree.File]
) -> Iterator[Diagnostic]:
    """Yield the findings, without unreachable code in routines with an unclosed block.

    The repair inserts the end at the last possible position, so the statements after a RETURN seem
    to be in the block.
    """
    unclosed = [one.span for one in of_syntax if isinstance(one.violation, UnclosedBlock)]
    if not unclosed:
        yield from findings
        return
    starts = {
        file.source.file: [routine.start for module in file.modules for routine in module.routines]
        for file in files
    }

    def routine_around(span: Span | None) -> tuple[str, int] | None:
        """Return file and number of the last routine that begins before a position."""
        return None if span is None else (span.file, bisect_right(starts[span.file], span.start))

    broken = {routine_around(span) for span in unclosed}
    for one in findings:
        if not isinstance(one.violation, UnreachableCode) or routine_around(one.span) not in broken:
            yield one
