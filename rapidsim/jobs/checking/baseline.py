"""Known findings: a file that lists them, so that only new ones count.

A finding is identified by its rule, its routine and the text of its statement, not by its line, so
changes elsewhere in the file do not make it new. Equal findings are counted.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

from rapidsim.diagnostics import Diagnostic
from rapidsim.files import InputError, input_text
from rapidsim.json_records.encoding import json_of
from rapidsim.json_records.reading import read
from rapidsim.values import value_class

_SCHEMA = 1
_OF_TIME = "DR"
"""Families of rules that depend on a run or its time."""
_FIRST_MODEL = "1"
"""Motion model of baselines that name none."""
Key = tuple[str, str, str]
"""Code, routine, statement."""


@value_class(frozen=True, slots=True)
class KnownFinding:
    """Equal findings in the file of a baseline."""

    code: str
    routine: str
    statement: str
    count: int


@value_class(frozen=True, slots=True)
class BaselineFile:
    """The file of a baseline."""

    schema: int
    findings: tuple[KnownFinding, ...]
    motion_model: str = _FIRST_MODEL


@value_class(frozen=True, slots=True)
class Baseline:
    """Known findings."""

    counts: Counter[Key]
    """Number of findings of each key."""
    motion_model: str
    """Version of the motion model with which they were found."""

    def outdated(self, motion_model: str, findings: Iterable[Diagnostic]) -> str:
        """Warning that the baseline was made with another version, if that may matter; else ""."""
        codes = {code for code, _, _ in self.counts} | {one.violation.code for one in findings}
        if motion_model == self.motion_model or not any(code[0] in _OF_TIME for code in codes):
            return ""
        return (
            f"The baseline was made with motion model {self.motion_model}; this is "
            f"{motion_model}, which gives other times. `--update-baseline` recreates it."
        )


def finding_key(diagnostic: Diagnostic) -> Key:
    """Return the identity of a finding; differences in whitespace do not matter."""
    span = diagnostic.span
    text = "" if span is None else " ".join(span.source.line(span.line).split())
    return diagnostic.violation.code, diagnostic.routine or "", text


def baseline_text(diagnostics: Iterable[Diagnostic], motion_model: str) -> str:
    """Return a baseline of findings, as JSON with readable diffs."""
    counts = Counter(finding_key(diagnostic) for diagnostic in diagnostics)
    rows = [
        json_of(KnownFinding(code, routine, statement, count))
        for (code, routine, statement), count in sorted(counts.items())
    ]
    lines = ",\n".join(f"    {json.dumps(row, ensure_ascii=False)}" for row in rows)
    made = f'  "schema": {_SCHEMA},\n  "motion_model": {json.dumps(motion_model)},\n'
    return f'{{\n{made}  "findings": [\n{lines}\n  ]\n}}\n'


def read_baseline(file: Path) -> Baseline:
    """Read the output of `baseline_text`.

    Raises:
        InputError: If there is no such file, or it is not a baseline.
    """
    if not file.exists():
        raise InputError(f"the baseline {file} does not exist", "`--update-baseline` writes it")
    try:
        known = read(BaselineFile, json.loads(input_text(file)))
        if known.schema != _SCHEMA:
            raise InputError(f"{file} is a baseline of another version of rapidsim")
        counts = {(one.code, one.routine, one.statement): one.count for one in known.findings}
        return Baseline(Counter(counts), known.motion_model)
    except (ValueError, RecursionError) as error:
        reason = "it is nested too deeply" if isinstance(error, RecursionError) else error
        help = "remove it, and `rapidsim check --baseline` writes a new one"
        raise InputError(f"{file} is not a baseline of rapidsim: {reason}", help) from error


def split_by_baseline(
    diagnostics: Iterable[Diagnostic], baseline_counts: Counter[Key]
) -> tuple[tuple[Diagnostic, ...], tuple[Diagnostic, ...]]:
    """Split findings into new and known ones.

    Of equal findings, the first ones are known.
    """
    left = Counter(baseline_counts)
    new: list[Diagnostic] = []
    old: list[Diagnostic] = []
    for diagnostic in sorted(diagnostics, key=lambda one: one.order):
        key = finding_key(diagnostic)
        is_known = left[key] > 0
        left[key] -= is_known
        (old if is_known else new).append(diagnostic)
    return tuple(new), tuple(old)
