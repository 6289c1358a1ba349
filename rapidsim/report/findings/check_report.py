"""The object of `rapidsim check --format json`. Imported only where it is printed."""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.jobs.checking.check_result import CheckResult
from rapidsim.json_records.declarations import OrAbsent, OutputRecord
from rapidsim.report.findings.diagnostic_records import DiagnosticRecord, diagnostic_record
from rapidsim.report.findings.merging import Finding
from rapidsim.report.findings.statistics import RuleCount
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class UncheckedInstruction:
    """A move that was not checked."""

    file: str
    line: int
    reason: str


@value_class(frozen=True, slots=True)
class CheckCoverage:
    """Numbers of move instructions by kind of check."""

    moves: int
    checked: int
    by_value: int
    """Moves whose targets are known before the program runs."""
    by_run: int
    """Moves that a run of main executed."""
    unchecked: tuple[UncheckedInstruction, ...]
    main_left_out: OrAbsent[str]
    """Reason why main was not run for errors that only a run meets; absent if it was."""
    paths: int
    """Moves among the checked ones that lead the TCP on a line or arc."""
    paths_checked: int
    """Those whose path was checked, not only its end."""
    unchecked_paths: tuple[UncheckedInstruction, ...]


@value_class(frozen=True, slots=True)
class CheckReport(OutputRecord):
    """The object that `rapidsim check --format json` prints."""

    ok: bool
    """Whether nothing fails the check: the exit code is 0."""
    qualifications: tuple[str, ...]
    """Phrases on parts that were not checked or are not simulated; with --strict they fail it."""
    files: int
    """Number of files that were read."""
    diagnostics: tuple[DiagnosticRecord, ...]
    coverage: CheckCoverage
    statistics: OrAbsent[tuple[RuleCount, ...]] = None
    """With --statistics: violations of each rule, the most frequent first."""
    diff: OrAbsent[str] = None
    """With --diff: the changes that --fix would make."""


def check_report(
    findings: Sequence[Finding],
    result: CheckResult,
    *,
    is_ok: bool,
    counts: tuple[RuleCount, ...] | None = None,
    differences: str | None = None,
) -> CheckReport:
    """Return the findings as a record.

    Args:
        findings: What is shown.
        result: What was checked.
        is_ok: Whether nothing fails the check.
        counts: Violations of each rule, if requested.
        differences: Changes that fixes would make, if requested.
    """
    coverage = result.coverage
    unchecked, unchecked_paths = (
        tuple(UncheckedInstruction(one.span.file, one.span.line, one.reason) for one in moves)
        for moves in (coverage.unchecked, coverage.unchecked_paths)
    )
    return CheckReport(
        ok=is_ok,
        qualifications=result.qualifications,
        files=len(result.files),
        diagnostics=tuple(map(diagnostic_record, findings)),
        coverage=CheckCoverage(
            moves=coverage.moves,
            checked=coverage.checked,
            by_value=coverage.by_value,
            by_run=coverage.by_run,
            unchecked=unchecked,
            main_left_out=coverage.main_left_out or None,
            paths=coverage.paths,
            paths_checked=coverage.paths_checked,
            unchecked_paths=unchecked_paths,
        ),
        statistics=counts,
        diff=differences,
    )
