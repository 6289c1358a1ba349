"""The second process: checks of moves and runs of a frozen text, never awaited by typing.

One request is worked on at a time. A new check replaces one that waits; the result of a check
whose text has changed meanwhile is discarded by its number.
"""

from __future__ import annotations

import asyncio
import tempfile
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import replace
from multiprocessing import get_context
from typing import TypeVar

from rapidsim.diagnostics import Diagnostic
from rapidsim.files import InputError
from rapidsim.jobs.checking.check_files import check_job
from rapidsim.jobs.inputs.job import Job
from rapidsim.language.moves import Place
from rapidsim.lsp.run_results import RunMove, RunSummary
from rapidsim.values import value_class
from rapidsim.workspace.workspace import is_of_text

T = TypeVar("T")
MOST_WALL_S = 60.0
"""Maximum wall-clock time [s] of a check or a run."""
_MOST_TIME_S = 3600.0
"""Virtual time at which a run ends."""


@value_class(frozen=True, slots=True)
class RunAnswer:
    """A run as the second process returns it."""

    summary: RunSummary
    moves: dict[str, tuple[RunMove, ...]]


class Background:
    """The second process, which is started when it is first needed."""

    def __init__(self) -> None:
        """Start nothing."""
        self._pool: ProcessPoolExecutor | None = None
        self._turn = asyncio.Lock()
        self._number = 0

    async def check(self, job: Job) -> tuple[Diagnostic, ...] | None:
        """Return the findings about moves and runs; None if a later check replaces this one."""
        self._number += 1
        number = self._number
        async with self._turn:
            if number != self._number:
                return None
            found = await self._call(findings_of_moves, job)
        return found or () if number == self._number else None

    async def run(self, job: Job, entry: str, recording: str, report: str = "") -> RunAnswer:
        """Run a procedure; with a path, write a recording or a report."""
        async with self._turn:
            answer = await self._call(run_of, job, entry, recording, report)
        return answer or RunAnswer(
            RunSummary(entry, "error", 0.0, 0, "the process of the run has ended unexpectedly"), {}
        )

    def discard_check(self) -> None:
        """Discard the result of a check under way: the text has changed."""
        self._number += 1

    def close(self) -> None:
        """End the process."""
        if self._pool is None:
            return
        processes = list((self._pool._processes or {}).values())
        for process in processes:
            process.terminate()
        # Its thread must have ended, or it may close what Python writes to at its exit.
        self._pool.shutdown(cancel_futures=True)
        self._pool = None

    async def _call(self, function: Callable[..., T], *arguments: object) -> T | None:
        if self._pool is None:
            self._pool = ProcessPoolExecutor(1, mp_context=get_context("spawn"))
        loop = asyncio.get_running_loop()
        try:
            return await loop.run_in_executor(self._pool, function, *arguments)
        except BrokenProcessPool:
            # Out of memory, or killed; the next request starts another.
            self._pool = None
            return None


def findings_of_moves(job: Job) -> tuple[Diagnostic, ...]:
    """Return the findings of a check that need an arm or a run."""
    request = replace(job.request, max_wall_s=MOST_WALL_S)
    try:
        found = check_job(replace(job, request=request)).diagnostics
    except InputError:
        # No arm of that name, for instance: the command line reports it.
        return ()
    return tuple(one for one in found if not is_of_text(one.code))


def run_of(job: Job, entry: str, recording: str, report: str = "") -> RunAnswer:
    """Run a procedure of a job; files that it writes go to a folder that is deleted."""
    # NumPy and the motion of the arm are imported by this process alone.
    from rapidsim.jobs.running.run_files import ProgramRejectedError, run_job  # noqa: PLC0415

    with tempfile.TemporaryDirectory(prefix="rapidsim-", ignore_cleanup_errors=True) as home:
        request = replace(
            job.request,
            entry=entry,
            home=home,
            max_wall_s=MOST_WALL_S,
            max_time_s=_MOST_TIME_S,
        )
        try:
            finished = run_job(replace(job, request=request))
            simulation = finished.simulation
            written = ""
            if recording or report:
                from rapidsim.api.run import run_of as as_api  # noqa: PLC0415

                run = as_api(finished)
                if report:
                    run.report(report)
                if recording:
                    written = str(run.record(recording))
        except ProgramRejectedError as error:
            return RunAnswer(RunSummary(entry, "error", 0.0, 0, f"cannot run: {error}"), {})
        except InputError as error:
            problem = f"{error.message}: {error.help}" if error.help else error.message
            return RunAnswer(RunSummary(entry, "error", 0.0, 0, problem), {})
    moves: dict[str, list[RunMove]] = {}
    for move in simulation.moves:
        span = move.place.span
        moves.setdefault(span.file, []).append(
            RunMove(
                start=span.start,
                end=span.end,
                to=_target(move.place),
                start_s=move.start_s,
                end_s=move.end_s,
                corner=move.corner.value,
                corner_reason="" if move.move.zone.finep else move.corner_reason,
                joints_deg=tuple(float(one) * 57.29577951308232 for one in move.joints),
                conf=tuple(map(int, move.conf)),
            )
        )
    summary = RunSummary(
        entry, simulation.end.value, simulation.time_s, len(simulation.moves), recording=written
    )
    return RunAnswer(summary, {path: tuple(of) for path, of in moves.items()})


def _target(place: Place) -> str:
    """Return the target of the move at a place as the program writes it; empty if computed."""
    from rapidsim.simulation.results.time_shares import argument  # noqa: PLC0415

    return argument(place, "topoint", "tojointpos") or ""
