"""Comparison of a check with a baseline of known findings."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rapidsim.diagnostics import Severity
from rapidsim.jobs.checking.baseline import baseline_text, read_baseline
from rapidsim.jobs.checking.batch_check import merge_results
from rapidsim.jobs.checking.check_result import CheckResult
from rapidsim.jobs.inputs.job import Job
from rapidsim.output_files import whole_file
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class BaselineGroup:
    """Programs that are judged alike, and together: a baseline counts the findings of all."""

    result: CheckResult
    baseline: Path | None
    motion_model: str


@value_class(frozen=True, slots=True)
class NewFindings:
    """The findings of a group that its baseline lacks."""

    result: CheckResult
    remarks: tuple[str, ...] = ()
    """A line each."""


def group_by_settings(
    jobs: Sequence[Job], results: Sequence[CheckResult], baselines: Sequence[Path | None]
) -> list[BaselineGroup]:
    """The results of jobs, those with the same settings as one."""
    groups: dict[tuple[Path | None, Severity, bool, str], list[CheckResult]] = {}
    for job, result, baseline in zip(jobs, results, baselines, strict=True):
        settings = (baseline, result.fail_on, result.strict, job.station.model.version)
        groups.setdefault(settings, []).append(result)
    return [
        BaselineGroup(merge_results(group), file, model)
        for (file, *_, model), group in groups.items()
    ]


def compare_with_baseline(group: BaselineGroup, *, update: bool, create: bool) -> NewFindings:
    """Compare a group with its baseline.

    Args:
        group: The group.
        update: Whether the baseline is overwritten.
        create: Whether it is written if it does not exist.
    """
    file = group.baseline
    if file is None:
        return NewFindings(group.result)
    writes = update or (create and not file.exists())
    if writes:
        _write(file, group)
    against = read_baseline(file)
    outdated = against.outdated(group.motion_model, group.result.diagnostics)
    written = f"Written: {file} (baseline)" if writes else ""
    remarks = tuple(line for line in (written, outdated) if line)
    return NewFindings(group.result.against(against.counts), remarks)


def _write(file: Path, group: BaselineGroup) -> None:
    """Make all that was found known; what is not a baseline is not written over."""
    if file.exists():
        read_baseline(file)
    with whole_file(file) as temporary:
        text = baseline_text(group.result.diagnostics, group.motion_model)
        temporary.write_text(text, encoding="utf-8")
