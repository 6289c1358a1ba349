"""Jobs checked with what the command line has: processes, results kept, a word if broken off."""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.cli.interrupted import report_if_interrupted
from rapidsim.cli.terminal import echo
from rapidsim.cli.tools.watch_mode import watched_tasks
from rapidsim.jobs.cache.result_cache import ResultCache
from rapidsim.jobs.cache.result_store import store_of_user
from rapidsim.jobs.checking.batch_check import check_jobs
from rapidsim.jobs.checking.check_result import CheckResult
from rapidsim.jobs.inputs.job import Job


def checked_jobs(jobs: Sequence[Job], processes: int, *, uses_cache: bool) -> list[CheckResult]:
    """Return the results of jobs in order; print notes on their arms on stderr.

    Args:
        jobs: What is checked.
        processes: How many at a time.
        uses_cache: Whether results of earlier checks are used, and these kept.
    """
    kept = ResultCache(store_of_user() if uses_cache else None)
    done = 0

    def so_far() -> str:
        return f" after {done} of {len(jobs)} programs" if len(jobs) > 1 else ""

    results: list[CheckResult] = []
    notices: list[str] = []
    with report_if_interrupted(so_far):
        for checked in check_jobs(jobs, kept, processes, watched_tasks()):
            done += 1
            results.append(checked.result)
            notices += checked.notices
    for notice in dict.fromkeys(notices):
        echo(f"note: {notice}", err=True)
    kept.tidy()
    return results
