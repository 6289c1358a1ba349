"""Whether the statements that stand for runs of alike ones can be held for all of them."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Iterator, Sequence

from rapidsim.diagnostics import Diagnostic, Span
from rapidsim.syntax import tree


def stand_for_all(files: Sequence[tree.File], found: Iterable[Diagnostic]) -> bool:
    """Whether no finding speaks of a statement that stands for others, or of these.

    Such a statement has alike ones on both sides. So what is not said of it, because of what it is
    or of what is beside it, is not said of any of those that it stands for.
    """
    stretches = {
        module.source.file: [(run.like.start, run.end) for run in module.runs]
        for file in files
        for module in file.modules
        if module.runs
    }
    return not any(
        _touches(stretches.get(span.file, []), span) for one in found for span in _places(one)
    )


def _places(one: Diagnostic) -> Iterator[Span]:
    if one.span is not None:
        yield one.span
    for related in one.related:
        yield related.span
    for edit in one.fix.edits if one.fix else ():
        yield edit.span


def _touches(stretches: Sequence[tuple[int, int]], span: Span) -> bool:
    """Whether a place lies in a stretch, or has one of its ends there."""
    for offset in (span.start, max(span.start, span.end - 1)):
        at = bisect_right(stretches, (offset, offset)) - 1
        for start, end in stretches[max(at, 0) : at + 2]:
            if start <= offset < end:
                return True
    return False
