"""Counts of the violations of each rule."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from rapidsim.diagnostics import Diagnostic, Rule
from rapidsim.report.palette import Palette
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class RuleCount:
    """Count of the violations of one rule."""

    code: str
    name: str
    count: int
    fixable: int
    """Number of the violations that have a fix."""


def rule_counts(diagnostics: Iterable[Diagnostic]) -> tuple[RuleCount, ...]:
    """Count the findings of each rule, the most frequent first."""
    diagnostics = list(diagnostics)
    counts = Counter(one.violation.rule for one in diagnostics)
    fixable = Counter(one.violation.rule for one in diagnostics if one.fix is not None)
    rows = sorted(counts.items(), key=lambda row: (-row[1], row[0].code))
    return tuple(RuleCount(rule.code, rule.name, count, fixable[rule]) for rule, count in rows)


def statistics(diagnostics: Iterable[Diagnostic], palette: Palette) -> str:
    """One line per rule, the most frequent first: count, code, name, whether `--fix` helps."""
    rows = rule_counts(diagnostics)
    widest = len(str(max((row.count for row in rows), default=0)))
    return "".join(
        f"{row.count:>{widest}}  {palette.paint(row.code, palette.of(Rule(row.code).severity))} "
        f"{row.name}{f'  ({row.fixable} with a fix)' if row.fixable else ''}\n"
        for row in rows
    )
