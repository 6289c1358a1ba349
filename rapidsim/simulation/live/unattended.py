"""Run of programs on a controller that fails, without clients: faults and system inputs act.

Only a controller that stays on can stop and start programs in the midst of a run. The run ends when
main has ended, a program has failed, or the programs have stopped and nothing will start them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

from rapidsim.controller.cell.faults import FailureKind
from rapidsim.controller.journal.events import EventKind
from rapidsim.language.errors import Stopped
from rapidsim.motion.numba_jit import jit_reconsidered
from rapidsim.simulation.live.controller import LiveController
from rapidsim.simulation.live.states import Cycle
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.progress import RunInProgress
from rapidsim.simulation.result_builder import FinishedRun
from rapidsim.simulation.results.simulation import End, Simulation
from rapidsim.simulation.run_findings import stopped_finding
from rapidsim.simulation.task_run import TaskSetup
from rapidsim.syntax.garbage_collection import gc_rarely

_STOPS = (
    FailureKind.EMERGENCY_STOP,
    FailureKind.GUARD_STOP,
    FailureKind.GENERAL_STOP,
    FailureKind.RESTART,
)
"""Faults that stop programs."""


def has_live_inputs(options: RunOptions) -> bool:
    """Whether the station has faults, or drives a system input."""
    driven = {name.lower() for name in options.io.written}
    inputs = (one.name.lower() for one in options.io.signals if one.action is not None)
    return bool(options.io.faults) or not driven.isdisjoint(inputs)


@gc_rarely()
@jit_reconsidered()
def run_unattended(
    setups: Sequence[TaskSetup],
    options: RunOptions,
    watch: Callable[[RunInProgress], None] | None = None,
) -> FinishedRun:
    """Run the programs of several tasks on a controller that stays on; see `simulate.run_tasks`.

    A contact of bodies does not end the run.

    Raises:
        InputError: If the speed limits of an arm's axes are unknown, or no task moves an arm.
    """
    live = LiveController(setups, options, keeps_all=True, has_clients=False)
    cycles, last_s = options.max_cycles, options.max_time_s
    try:
        if watch is not None:
            watch(RunInProgress(live.cell, lambda: [task.run for task in live.tasks.values()]))
        live.start(Cycle.ONCE)
        while live.now_s < last_s and not math.isinf(live.next_due_s):
            live.step(last_s)
            tasks = tuple(live.normal_tasks)
            if not all(task.has_pointer for task in tasks):
                break
            if all(task.has_ended for task in tasks):
                cycles -= 1
                if not cycles:
                    break
                live.start()
        _end_waits(live)
        end = _end(live, options)
    finally:
        live.cell.watchdog.is_needed = False
        live.switch_off()
        live.cell.watchdog.rest()
    finished = live.finished()
    run = finished.simulation
    if end is End.ERROR:
        return finished
    if end is End.STOPPED:
        first = next(task.place for task in live.normal_tasks)
        reason, place = live.stopped_by or (_last_stop(run), first)
        found = stopped_finding(Stopped(reason), place)
        run = replace(run, diagnostics=(*run.diagnostics, found))
    normal = {task.name for task in live.normal_tasks}
    ends = tuple(replace(one, end=end) if one.name in normal else one for one in run.tasks)
    return replace(finished, simulation=replace(run, tasks=ends, end=end))


def _end_waits(live: LiveController) -> None:
    """End the wait of the first task that executes although nothing is due any more."""
    executing = (task for task in live.normal_tasks if task.executes and not task.has_ended)
    if math.isinf(live.next_due_s) and (waiting := next(executing, None)) is not None:
        live.scheduler.end_wait(waiting.run.controller.clock)


def _last_stop(run: Simulation) -> str:
    """The fault that has stopped the programs last; without one, a system input has."""
    stops = (
        str(event.details["fault"])
        for event in reversed(run.events)
        if event.kind is EventKind.FAULT and event.details["fault"] in _STOPS
    )
    return next(stops, "a system input")


def _end(live: LiveController, options: RunOptions) -> End:
    tasks = tuple(live.normal_tasks)
    if not all(task.has_pointer for task in tasks):
        is_late = live.cell.watchdog.has_ended_the_run
        return End.TIME_LIMIT if is_late else End.ERROR
    if all(task.has_ended for task in tasks):
        return End.ENDED if options.max_cycles == 1 else End.CYCLE_LIMIT
    return End.TIME_LIMIT if live.now_s >= options.max_time_s else End.STOPPED
