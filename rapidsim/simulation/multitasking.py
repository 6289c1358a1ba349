"""Run several tasks on one clock: load them with the data they share, run them to their end."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial

from rapidsim.controller.cell.cell import Cell
from rapidsim.interpreter.limits import RUNNING_DEPTH, recursion_limit
from rapidsim.interpreter.linking.loader import FatalError, Task, load
from rapidsim.interpreter.runtime.shared_persistents import SharedPersistents, shared_persistents
from rapidsim.language.moves import Place
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import End
from rapidsim.simulation.scheduler import Scheduler
from rapidsim.simulation.shared_access import ScheduledAccess
from rapidsim.simulation.task_run import TaskOutcome, TaskRun, run_to_end


def run_all_tasks(runs: Sequence[TaskRun], cell: Cell, options: RunOptions) -> list[TaskOutcome]:
    """Run all tasks on one clock until those that count have ended or one of them fails.

    Args:
        runs: The tasks; those due at the same time run in this order.
        cell: The state that they share.
        options: Limits of the run.

    Returns:
        Outcome of each task; a background task ends with the run.
    """
    scheduler = Scheduler()
    cell.attach_scheduler(scheduler)
    programs = [run.setup.program for run in runs]
    written = [run.setup.written for run in runs]
    shared = shared_persistents(programs, ScheduledAccess(scheduler), written)
    # Every task has its data before the first one runs: they may be shared.
    loaded = [_loaded(run, shared) for run in runs]
    outcomes: dict[str, TaskOutcome] = {}
    neighbours = {run.setup.name.lower(): run.controller.coordination for run in runs}
    for run in runs:
        run.controller.coordination.neighbours = neighbours

    def execute(run: TaskRun, task: Callable[[], Task]) -> None:
        outcome = run_to_end(run, task, options, partial(_resting, run, runs, scheduler))
        outcomes[run.setup.name] = outcome
        ended_s = run.controller.clock.pointer_s()
        cell.task_ended(run.setup.name, ended_s, failed=outcome.end is End.ERROR)
        if outcome.ends_all or outcome.end in (End.ERROR, End.TIME_LIMIT):
            scheduler.stop()
            stopped_s = run.controller.clock.pointer_s()
            for other in runs:
                if other is not run:
                    other.controller.coordination.stop_robot(stopped_s)

    for run, task in zip(runs, loaded, strict=True):
        scheduler.add(run.controller.clock, partial(execute, run, task), counts=run.setup.counts)
    with recursion_limit(RUNNING_DEPTH):
        scheduler.run()
    return [
        outcomes.get(run.setup.name) or _left_running(task)
        for run, task in zip(runs, loaded, strict=True)
    ]


def _left_running(task: Callable[[], Task]) -> TaskOutcome:
    """Outcome of a task that is still running when the run ends."""
    with suppress(FatalError):
        return TaskOutcome(End.ENDED, task=task())
    return TaskOutcome(End.ENDED)


def _loaded(run: TaskRun, shared: SharedPersistents) -> Callable[[], Task]:
    """Load a task now; an error in its initial values is raised when the task begins."""
    try:
        task = load(run.setup.program, run.controller.concerns, shared)
    except FatalError as error:
        failure = error
    else:
        return lambda: task

    def fail() -> Task:
        raise failure

    return fail


def _resting(
    run: TaskRun, runs: Sequence[TaskRun], scheduler: Scheduler
) -> list[tuple[str, Place]]:
    """Other tasks that wait for something that only a task can do, and their positions."""
    resting = scheduler.resting(run.controller.clock)
    return [
        (one.setup.name, one.controller.clock.place)
        for one in runs
        if one.controller.clock in resting
    ]
