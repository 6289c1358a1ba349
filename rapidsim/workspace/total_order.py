"""The order of findings, which depends on nothing but the findings."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import groupby

from rapidsim.diagnostics import Diagnostic


def in_total_order(findings: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Return findings by file, offset, code, message and whatever else they consist of."""
    coarse = sorted(findings, key=_place_and_code)
    # A message is composed only where the other keys are equal.
    groups = [list(group) for _, group in groupby(coarse, key=_place_and_code)]
    return tuple(
        one
        for group in groups
        for one in (group if len(group) == 1 else sorted(group, key=_contents))
    )


def _place_and_code(finding: Diagnostic) -> tuple[tuple[str, int], str]:
    return finding.order, finding.violation.rule.code


def _contents(finding: Diagnostic) -> tuple[str, int, str]:
    return finding.message, finding.span.end if finding.span else 0, repr(finding.related)
