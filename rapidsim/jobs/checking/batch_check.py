"""Check several programs, in several processes, with cached results of unchanged ones."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cache, partial
from typing import TYPE_CHECKING

from rapidsim.diagnostics import Diagnostic
from rapidsim.jobs.cache.finding_records import Record, StoredFindings, read_findings, record_of
from rapidsim.jobs.cache.result_cache import ResultCache, sources_of
from rapidsim.jobs.checking.check_result import CheckResult
from rapidsim.jobs.inputs.job import Job
from rapidsim.module_files import TaskFiles
from rapidsim.reach.checked_moves import Coverage, ReachReport
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.jobs.checking.check_files import TaskMoves
    from rapidsim.jobs.checking.checked_program import LoadedProgram
    from rapidsim.jobs.checking.watched_tasks import WatchedTasks
    from rapidsim.motion.robot.robot import Robot


@value_class(frozen=True, slots=True, eq=False)
class JobCheck:
    """Result of the check of a job."""

    result: CheckResult
    """Result without syntax trees."""
    notices: tuple[str, ...]
    """Notices about the arms that were used."""


def check_jobs(
    jobs: Sequence[Job],
    kept: ResultCache,
    processes: int = 1,
    open_tasks: WatchedTasks | None = None,
) -> Iterator[JobCheck]:
    """Check jobs independently and yield their results in order.

    Args:
        jobs: The jobs to check.
        kept: Cache of earlier results.
        processes: Number of jobs at a time; of a single job, number of its tasks.
        open_tasks: The tasks of a single job as they were at the last check; None checks once.
    """
    known = [kept.of_job(job) for job in jobs]
    left = [job for job, found in zip(jobs, known, strict=True) if found is None]
    records: Iterator[Record] = map(_job_record, left)
    if len(left) == 1:
        records = iter([_only(left[0], kept, processes, open_tasks if len(jobs) == 1 else None)])
    elif processes > 1:
        # Most checks are of one program, and do not pay for importing what starts processes.
        from rapidsim.jobs.cache.processes import in_processes

        records = in_processes(_job_record, left, processes)
    for job, found in zip(jobs, known, strict=True):
        yield _checked(job, found or kept.keep_job(job, next(records)))


def merge_results(results: Sequence[CheckResult]) -> CheckResult:
    """Merge results; a finding that several have at the same place appears once.

    The settings of the first result decide what fails the check.
    """
    if len(results) == 1:
        return results[0]
    return CheckResult(
        files=tuple(dict.fromkeys(file for one in results for file in one.files)),
        diagnostics=_distinct(found for one in results for found in one.diagnostics),
        trees=(),
        coverage=sum((one.coverage for one in results), Coverage()),
        known=_distinct(found for one in results for found in one.known),
        fail_on=results[0].fail_on,
        strict=results[0].strict,
    )


def _distinct(findings: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    distinct: dict[object, Diagnostic] = {}
    for one in findings:
        distinct.setdefault((one.order, one.code, one.message, one.assumed), one)
    return tuple(sorted(distinct.values(), key=lambda one: one.order))


def _checked(job: Job, stored: StoredFindings) -> JobCheck:
    files = tuple(file.name for file in job.files)
    result = CheckResult(
        files,
        stored.diagnostics,
        (),
        stored.coverage,
        fail_on=job.station.check.fails_from,
        strict=job.is_strict,
        arm=stored.arm,
    )
    return JobCheck(result, stored.notices)


def _only(job: Job, kept: ResultCache, processes: int, open_tasks: WatchedTasks | None) -> Record:
    """Return the record of a job; tasks without a cached record are checked in parallel."""
    if len(job.tasks) < 2:
        return _job_record(job, open_tasks)
    from rapidsim.jobs.checking.check_files import check_job

    observed = _ObservedJob(job)

    def moves_for(with_arm: Job) -> TaskMoves:
        # Findings of one task depend on the arm, and the arm on the targets of all tasks.
        asked = replace(job, robot=with_arm.robot)
        known = {task.name: record for task in job.tasks if (record := kept.of_task(asked, task))}
        left = [task for task in job.tasks if task.name not in known]
        if processes > 1 and len(left) > 1:
            from rapidsim.jobs.cache.processes import in_processes

            records = in_processes(partial(_task_record, asked), left, processes)
            for task, record in zip(left, records, strict=True):
                kept.keep_task(asked, task, record)
                known[task.name] = record

        def moves_of(
            task: TaskFiles, loaded: LoadedProgram, make: Callable[[], ReachReport]
        ) -> ReachReport:
            sources = [file.source for file in loaded.files]
            if task.name in known:
                found = read_findings(known[task.name], sources)
                observed.notices.extend(found.notices)
                return ReachReport(found.diagnostics, found.coverage)
            heard = len(observed.notices)
            report = make()
            kept.keep_task(asked, task, observed.record(report, heard))
            return report

        return moves_of

    return observed.record(check_job(observed.job, moves_for, open_tasks))


def _job_record(job: Job, open_tasks: WatchedTasks | None = None) -> Record:
    from rapidsim.jobs.checking.check_files import check_job

    observed = _ObservedJob(job)
    return observed.record(check_job(observed.job, open_tasks=open_tasks))


def _task_record(job: Job, task: TaskFiles) -> Record:
    from rapidsim.jobs.checking.check_files import moves_of_task

    observed = _ObservedJob(job)
    return observed.record(moves_of_task(observed.job, task))


class _ObservedJob:
    """A job during its check, with the notices of its arms, and whether the clock ended a run."""

    def __init__(self, job: Job) -> None:
        self.job = replace(job, open_robot=self._open)
        self.notices: list[str] = []
        self._open_robot = cache(job.open_robot)
        self._runs_ended = _runs_ended()

    def _open(self, name: str, scale: float | None) -> Robot:
        robot = self._open_robot(name, scale)
        self.notices.extend(robot.notices)
        return robot

    def record(self, result: CheckResult | ReachReport, count: int = 0) -> Record:
        """Return the record of a result, with the notices from an index on."""
        notices = tuple(dict.fromkeys(self.notices[count:]))
        lasts = _runs_ended() == self._runs_ended
        arm = result.arm if isinstance(result, CheckResult) else None
        return record_of(
            StoredFindings(result.diagnostics, result.coverage, notices, lasts, arm),
            sources_of(self.job),
        )


def _runs_ended() -> int:
    """Number of runs of this process that the wall-clock limit ended."""
    if "rapidsim.controller.cell.watchdog" not in sys.modules:
        # There was no run; importing the watchdog would import NumPy.
        return 0
    from rapidsim.controller.cell.watchdog import Watchdog

    return Watchdog.runs_ended
