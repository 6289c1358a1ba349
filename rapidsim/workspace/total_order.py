"""The order of findings, which depends on nothing but the findings."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import groupby, pairwise
from operator import attrgetter

from rapidsim.diagnostics import Diagnostic

_ORDER = attrgetter("order")


def in_total_order(findings: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Return findings by file, offset, code, message and whatever else they consist of."""
    found = sorted(findings, key=_ORDER)
    repeated = {one.order for one, other in pairwise(found) if one.order == other.order}
    if not repeated:
        return tuple(found)
    listed: list[Diagnostic] = []
    for place, findings in groupby(found, key=_ORDER):
        group = list(findings)
        listed += _of_one_place(group) if place in repeated else group
    return tuple(listed)


def _of_one_place(findings: list[Diagnostic]) -> list[Diagnostic]:
    # A message is composed only where the other keys are equal.
    if len({_code(one) for one in findings}) == len(findings):
        return sorted(findings, key=_code)
    return sorted(findings, key=_contents)


def _code(finding: Diagnostic) -> str:
    return finding.violation.rule.code


def _contents(finding: Diagnostic) -> tuple[str, str, int, str]:
    end = finding.span.end if finding.span else 0
    return _code(finding), finding.message, end, repr(finding.related)
