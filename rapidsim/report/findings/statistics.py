"""How often each rule was broken."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from rapidsim.diagnostics import Diagnostic
from rapidsim.report.palette import Palette


def statistics(diagnostics: Iterable[Diagnostic], palette: Palette) -> str:
    """One line per rule, the most frequent first: count, code, name, whether `--fix` helps."""
    diagnostics = list(diagnostics)
    counts = Counter(one.violation.rule for one in diagnostics)
    fixable = Counter(one.violation.rule for one in diagnostics if one.fix is not None)
    widest = len(str(max(counts.values(), default=0)))
    rows = sorted(counts.items(), key=lambda row: (-row[1], row[0].code))
    return "".join(
        f"{count:>{widest}}  {palette.paint(rule.code, palette.of(rule.severity))} {rule.name}"
        f"{f'  ({fixable[rule]} with a fix)' if fixable[rule] else ''}\n"
        for rule, count in rows
    )
