"""Measures the parts of `rapidsim run --timings`."""

from __future__ import annotations

from time import process_time

from rapidsim.report.run.timings import RunTimings
from rapidsim.simulation.progress import RunInProgress


class RunTimer:
    """Processor time since its creation, with the instants between the parts."""

    def __init__(self, *, is_reported: bool) -> None:
        """Begin with reading."""
        self._is_reported = is_reported
        self._began_s = self._executes_s = self._ended_s = process_time()
        self._solving_s = self._planning_s = 0.0
        self._run: RunInProgress | None = None

    def watch(self, run: RunInProgress) -> None:
        """Begin with the run."""
        self._run = run
        self._executes_s = process_time()

    def end_run(self) -> None:
        """Begin with the output."""
        self._ended_s = process_time()
        assert self._run is not None
        costs = [task.member.costs for task in self._run.tasks()]
        self._solving_s = sum(one.solving_s for one in costs)
        self._planning_s = sum(one.planning_s for one in costs)

    def timings(self) -> RunTimings | None:
        """Return the parts until now; None if they are not to be reported."""
        if not self._is_reported:
            return None
        ran_s = self._ended_s - self._executes_s
        return RunTimings(
            reading_s=self._executes_s - self._began_s,
            solving_s=self._solving_s,
            planning_s=self._planning_s,
            program_s=ran_s - self._solving_s - self._planning_s,
            recording_s=process_time() - self._ended_s,
        )
