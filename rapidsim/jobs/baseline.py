"""Findings that were there before: a file that lists them, so that only new ones count.

A finding is known by its rule, its routine and the text of its statement, not by its line, so that
work elsewhere in the file does not bring it back. Equal ones are counted.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

from rapidsim.diagnostics import Diagnostic
from rapidsim.files import InputError, input_text

_SCHEMA = 1
Key = tuple[str, str, str]
"""Code, routine, statement."""


def finding_key(diagnostic: Diagnostic) -> Key:
    """What a finding is known by; blanks and the case of nothing but them do not matter."""
    span = diagnostic.span
    text = "" if span is None else " ".join(span.source.line(span.line).split())
    return diagnostic.violation.code, diagnostic.routine or "", text


def baseline_text(diagnostics: Iterable[Diagnostic]) -> str:
    """A baseline of findings, as JSON that reads well in a comparison of versions."""
    counts = Counter(finding_key(diagnostic) for diagnostic in diagnostics)
    rows = [
        {"code": code, "routine": routine, "statement": statement, "count": count}
        for (code, routine, statement), count in sorted(counts.items())
    ]
    lines = ",\n".join(f"    {json.dumps(row, ensure_ascii=False)}" for row in rows)
    return f'{{\n  "schema": {_SCHEMA},\n  "findings": [\n{lines}\n  ]\n}}\n'


def read_baseline(file: Path) -> Counter[Key]:
    """The findings of a baseline with how many there are of each.

    Raises:
        InputError: If there is no such file, or it is not a baseline.
    """
    if not file.exists():
        raise InputError(f"the baseline {file} does not exist", "`--update-baseline` writes it")
    try:
        table = json.loads(input_text(file))
        if table["schema"] != _SCHEMA:
            raise InputError(f"{file} is a baseline of another version of rapidsim")
        rows = table["findings"]
        return Counter(
            {
                (str(row["code"]), str(row["routine"]), str(row["statement"])): int(row["count"])
                for row in rows
            }
        )
    except (ValueError, KeyError, TypeError, OverflowError, RecursionError) as error:
        reason = "it is nested too deeply" if isinstance(error, RecursionError) else error
        help = "remove it, and `rapidsim check --baseline` writes a new one"
        raise InputError(f"{file} is not a baseline of rapidsim: {reason}", help) from error


def told_apart(
    diagnostics: Iterable[Diagnostic], known: Counter[Key]
) -> tuple[tuple[Diagnostic, ...], tuple[Diagnostic, ...]]:
    """Findings that are new, and those that are known.

    Of equal findings the first ones are the known ones.
    """
    left = Counter(known)
    new: list[Diagnostic] = []
    old: list[Diagnostic] = []
    for diagnostic in sorted(diagnostics, key=lambda one: one.order):
        key = finding_key(diagnostic)
        is_known = left[key] > 0
        left[key] -= is_known
        (old if is_known else new).append(diagnostic)
    return tuple(new), tuple(old)
