r"""Comments that suppress findings: `! rapidsim: ignore[K601] reason`, and useless ones.

A comment after a statement applies to its line; one on a separate line applies to the next line
that is not a comment. `ignore-file[...]` applies to the whole file; without brackets, all rules are
meant.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator

from rapidsim.diagnostics import Diagnostic, Edit, Fix, Source, Span, Violation
from rapidsim.syntax import tree
from rapidsim.values import value_class

_COMMENT = re.compile(
    r"!+\s*rapidsim:\s*(?P<what>ignore-file|ignore)\b\s*(?:\[(?P<codes>[^\]]*)\])?", re.IGNORECASE
)


class UnusedSuppression(Violation, code="E160"):
    codes: str


@value_class(frozen=True, eq=False, slots=True)
class Suppression:
    """One suppressing comment."""

    span: Span
    codes: tuple[str, ...]
    """Codes, prefixes of codes or names of rules; empty for every rule."""
    line: int | None
    """The line that it applies to; None for the whole file."""

    def covers(self, diagnostic: Diagnostic) -> bool:
        """Whether it suppresses a finding."""
        span = diagnostic.span
        if span is None or span.source is not self.span.source:
            return False
        # A finding may span several lines; the comment is on its first or its last.
        if self.line is not None and self.line not in (span.line, span.end_line):
            return False
        return not self.codes or any(diagnostic.violation.rule.matches(code) for code in self.codes)


def is_suppressing(comment: tree.Comment) -> bool:
    """Whether a comment suppresses findings."""
    return _COMMENT.match(comment.text) is not None


def suppressions(files: Iterable[tree.File]) -> Iterator[Suppression]:
    """Yield the suppressing comments of files."""
    for file in files:
        for comment in file.comments:
            match = _COMMENT.match(comment.text)
            if match is None:
                continue
            codes = tuple(code for code in re.split(r"[,\s]+", match["codes"] or "") if code)
            line = None
            if match["what"].lower() == "ignore":
                line = _line_meant(file.source, comment.start)
            end = comment.start + len(comment.text.rstrip())
            yield Suppression(Span(file.source, comment.start, end), codes, line)


def without_suppressed(
    diagnostics: Iterable[Diagnostic],
    files: Iterable[tree.File],
    *,
    is_looked_for: Callable[[str], bool] = lambda code: True,
) -> tuple[Diagnostic, ...]:
    """Return the unsuppressed findings, and one for each comment that suppresses none.

    Args:
        diagnostics: The findings.
        files: The files with their comments.
        is_looked_for: Whether the rules of a code in a comment were checked. A comment for rules
            that were not checked is not useless.
    """
    all_comments = tuple(suppressions(files))
    if not all_comments:
        return tuple(diagnostics)
    by_line: dict[int | None, list[Suppression]] = {}
    for one in all_comments:
        by_line.setdefault(one.line, []).append(one)
    used: set[Suppression] = set()
    kept: list[Diagnostic] = []
    for diagnostic in diagnostics:
        span = diagnostic.span
        lines = {None} if span is None else {None, span.line, span.end_line}
        near = (one for line in lines for one in by_line.get(line, ()))
        covering = [one for one in near if one.covers(diagnostic)]
        used.update(covering)
        if not covering:
            kept.append(diagnostic)
    for one in all_comments:
        if one not in used and all(is_looked_for(code) for code in one.codes):
            shown = f": {', '.join(one.codes)}" if one.codes else ""
            fix = Fix("remove the comment", (Edit(_with_blanks(one.span), ""),))
            kept.append(Diagnostic(UnusedSuppression(shown), one.span, fix=fix))
    return tuple(sorted(kept, key=lambda diagnostic: diagnostic.order))


def _line_meant(source: Source, start: int) -> int:
    """Line that a comment applies to."""
    line, column = source.position(start)
    if source.line(line)[: column - 1].strip():
        return line
    for number in range(line + 1, len(source.line_starts) + 1):
        text = source.line(number).strip()
        if text and not text.startswith("!"):
            return number
    return line


def _with_blanks(span: Span) -> Span:
    """Span of a comment with the blanks before it."""
    text = span.source.text
    start = span.start
    while start > 0 and text[start - 1] in " \t":
        start -= 1
    return Span(span.source, start, span.end)
