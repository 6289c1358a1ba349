"""Bring findings into order, pick some by code, and merge those that repeat."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from rapidsim.diagnostics import Diagnostic


@dataclass(frozen=True, slots=True)
class Finding:
    """A diagnostic and the later ones that say the same of other places."""

    first: Diagnostic
    repeats: tuple[Diagnostic, ...] = ()


def merged(diagnostics: Iterable[Diagnostic], *, merge: bool = True) -> tuple[Finding, ...]:
    """Findings in order of file and place; equal messages of one rule in one file become one."""
    ordered = sorted(diagnostics, key=_order)
    if not merge:
        return tuple(Finding(diagnostic) for diagnostic in ordered)
    alike: dict[tuple[str, str, str], list[Diagnostic]] = {}
    for diagnostic in ordered:
        violation = diagnostic.violation
        key = (diagnostic.order[0], violation.code, violation.message)
        alike.setdefault(key, []).append(diagnostic)
    return tuple(Finding(first, tuple(repeats)) for first, *repeats in alike.values())


def selected(
    diagnostics: Iterable[Diagnostic], select: Sequence[str], ignore: Sequence[str]
) -> tuple[Diagnostic, ...]:
    """The diagnostics that selectors leave.

    Args:
        diagnostics: What was found.
        select: Codes, beginnings of codes such as `K6`, or names of rules; none selects all.
        ignore: The same, taken away afterwards.
    """
    return tuple(
        diagnostic
        for diagnostic in diagnostics
        if (not select or any(_matches(diagnostic, one) for one in select))
        and not any(_matches(diagnostic, one) for one in ignore)
    )


def _matches(diagnostic: Diagnostic, selector: str) -> bool:
    violation = diagnostic.violation
    return violation.code.startswith(selector.upper()) or violation.name == selector.lower()


def _order(diagnostic: Diagnostic) -> tuple[str, int, str, str]:
    return (*diagnostic.order, diagnostic.violation.code, diagnostic.violation.message)
