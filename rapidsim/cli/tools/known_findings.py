"""What a check judges by: a baseline of known findings."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rapidsim.diagnostics import Severity
from rapidsim.jobs.baseline import baseline_text, read_baseline
from rapidsim.jobs.check_many import together
from rapidsim.jobs.check_result import CheckResult
from rapidsim.jobs.job import Job
from rapidsim.output_files import whole_file
from rapidsim.values import dataclass


@dataclass(frozen=True, slots=True)
class Group:
    """Programs that are judged alike, and together: a baseline counts the findings of all."""

    result: CheckResult
    baseline: Path | None
    motion_model: str


@dataclass(frozen=True, slots=True)
class Judged:
    """What is left of the findings of a group."""

    result: CheckResult
    remarks: tuple[str, ...] = ()
    """A line each."""


def alike(
    jobs: Sequence[Job], results: Sequence[CheckResult], baselines: Sequence[Path | None]
) -> list[Group]:
    """The results of jobs, those with the same settings as one."""
    groups: dict[tuple[Path | None, Severity, bool, str], list[CheckResult]] = {}
    for job, result, baseline in zip(jobs, results, baselines, strict=True):
        settings = (baseline, result.fail_on, result.strict, job.station.model.version)
        groups.setdefault(settings, []).append(result)
    return [Group(together(group), file, model) for (file, *_, model), group in groups.items()]


def judged_with(group: Group, *, update: bool, create: bool) -> Judged:
    """What is new to the baseline of a group.

    Args:
        group: The group.
        update: Whether the baseline is written anew.
        create: Whether it is written if it does not exist.
    """
    file = group.baseline
    if file is None:
        return Judged(group.result)
    writes = update or (create and not file.exists())
    if writes:
        _write(file, group)
    against = read_baseline(file)
    outdated = against.outdated(group.motion_model, group.result.diagnostics)
    written = f"Written: {file} (baseline)" if writes else ""
    remarks = tuple(line for line in (written, outdated) if line)
    return Judged(group.result.against(against.known), remarks)


def _write(file: Path, group: Group) -> None:
    """Make all that was found known; what is not a baseline is not written over."""
    if file.exists():
        read_baseline(file)
    with whole_file(file) as temporary:
        text = baseline_text(group.result.diagnostics, group.motion_model)
        temporary.write_text(text, encoding="utf-8")
