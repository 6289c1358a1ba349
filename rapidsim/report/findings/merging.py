"""Sort findings, and merge repeated ones."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.values import value_class

_MOST_OF_A_RULE = 20
"""Findings of one rule in one file that are shown one by one."""


@value_class(frozen=True, slots=True)
class Finding:
    """A diagnostic, and the later ones with the same message at other places."""

    first: Diagnostic
    repeats: tuple[Diagnostic, ...] = ()


def merged(
    diagnostics: Iterable[Diagnostic], *, merge: bool = True, spoken: bool = True
) -> tuple[Finding, ...]:
    """Findings in order of file and place; equal messages of one rule in one file become one.

    Findings of different severity are never merged.

    From the 21st finding of a rule in a file on, all are merged: who moves a work
    object wants to know that 5,000 targets are out of reach, and not to read 5,000 findings.
    Programs that read findings, which are not `spoken`, get what is assumed one by one.
    """
    ordered = sorted(diagnostics, key=_order)
    if not merge:
        return tuple(Finding(diagnostic) for diagnostic in ordered)
    alike: dict[tuple[str, str, Severity, str], list[Diagnostic]] = {}
    for diagnostic in ordered:
        violation = diagnostic.violation
        key = (diagnostic.order[0], violation.code, diagnostic.severity, violation.message)
        if violation.is_reported_once and (spoken or not diagnostic.assumed):
            key = ("", violation.code, diagnostic.severity, "")
        alike.setdefault(key, []).append(diagnostic)
    shown: dict[tuple[str, str, Severity], list[list[Diagnostic]]] = {}
    for (file, code, severity, _), group in alike.items():
        of_rule = shown.setdefault((file, code, severity), [])
        if len(of_rule) < _MOST_OF_A_RULE:
            of_rule.append(group)
        else:
            of_rule[-1] += group
    findings = [
        _finding(group[0], sorted(group[1:], key=_order))
        for of_rule in shown.values()
        for group in of_rule
    ]
    return tuple(sorted(findings, key=lambda finding: _order(finding.first)))


def errors_first(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Findings in order of severity; those of one severity stay in their order."""
    order = list(Severity)
    return tuple(sorted(findings, key=lambda finding: order.index(finding.first.severity)))


def _finding(first: Diagnostic, repeats: Sequence[Diagnostic]) -> Finding:
    if first.violation.is_reported_once and repeats:
        told = first.violation.with_others([one.violation for one in repeats])
        first = replace(first, violation=told)
    return Finding(first, tuple(repeats))


def _order(diagnostic: Diagnostic) -> tuple[str, int, str, str]:
    return (*diagnostic.order, diagnostic.violation.code, diagnostic.violation.message)
