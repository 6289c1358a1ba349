"""Run programs on robots: set up the virtual controller, run main, build the result."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

from rapidsim.analysis.program import Program
from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.journal.journal import Journal
from rapidsim.files import InputError
from rapidsim.interpreter.linking.loader import load
from rapidsim.motion.numba_jit import jit_reconsidered
from rapidsim.motion.robot.robot import Robot
from rapidsim.simulation.dry_run import dry_run, stopped_by_contact
from rapidsim.simulation.multitasking import run_all_tasks
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.progress import RunInProgress
from rapidsim.simulation.result_builder import FinishedRun, build_result
from rapidsim.simulation.results.simulation import (
    Simulation,
)
from rapidsim.simulation.task_run import (
    TaskSetup,
    prepare,
    require_limits,
    run_to_end,
)
from rapidsim.syntax.garbage_collection import gc_rarely


def simulate(program: Program, robot: Robot, *, options: RunOptions) -> Simulation:
    """Run a program.

    Args:
        program: A checked program.
        robot: The arm.
        options: Inputs and limits.

    Returns:
        The result. A program that stops with an error is a result, not an exception.

    Raises:
        InputError: If the speed limits of the arm's axes are unknown.
    """
    arm, start, place = options.with_axes(robot), options.start_joints_deg, options.world_from_base
    setup = TaskSetup(options.task, program, arm, start, place, queue=options.queue)
    return simulate_tasks((setup,), options)


def simulate_tasks(setups: Sequence[TaskSetup], options: RunOptions) -> Simulation:
    """Run the programs of several tasks on one clock; see `run_tasks`."""
    return run_tasks(setups, options).simulation


@gc_rarely()
@jit_reconsidered()
def run_tasks(
    setups: Sequence[TaskSetup],
    options: RunOptions,
    watch: Callable[[RunInProgress], None] | None = None,
) -> FinishedRun:
    """Run the programs of several tasks on one clock.

    Args:
        setups: The tasks; those due at the same time run in this order.
        options: Inputs and limits; those of a single robot or task have no effect here.
        watch: Receives the run before it begins.

    Raises:
        InputError: If the speed limits of an arm's axes are unknown, or no task moves an arm; if a
            contact is to end a run of which no dry run is possible.
    """
    if options.geometry is None or not options.geometry.stops:
        return _run(setups, options, watch)
    with dry_run(options) as (rehearsal, again):
        collisions = _run(setups, rehearsal, watch).simulation.collisions
    hits = () if collisions is None else collisions.hits
    if not hits or hits[0].time_s >= options.max_time_s:
        return _run(setups, again, watch)
    # A run is a function of its inputs: until the first contact it equals the dry run.
    ended = _run(setups, replace(again, max_time_s=hits[0].time_s), watch)
    return replace(ended, simulation=stopped_by_contact(ended.simulation))


def _run(
    setups: Sequence[TaskSetup],
    options: RunOptions,
    watch: Callable[[RunInProgress], None] | None,
) -> FinishedRun:
    """Run the programs to the end; see `run_tasks`."""
    arms = [setup.robot for setup in setups if setup.robot is not None]
    if not arms:
        raise InputError("no task moves a robot", "give one of them `motion = true`")
    for arm in arms:
        require_limits(arm, options)
    journal = Journal(setups[0].name)
    journals = (journal, *(journal.for_task(setup.name) for setup in setups[1:]))
    cell = Cell(options.cell, journal)
    try:
        runs = [
            prepare(setup, arms[0], cell, own, options)
            for setup, own in zip(setups, journals, strict=True)
        ]
        if watch is not None:
            watch(RunInProgress(cell, lambda: runs))
        if len(runs) == 1:
            only = runs[0]
            loading = partial(load, only.setup.program, only.controller.concerns)
            outcomes = [run_to_end(only, loading, options)]
        else:
            outcomes = run_all_tasks(runs, cell, options)
        time_s = max(run.controller.clock.end_time_s() for run in runs if run.setup.counts)
    finally:
        cell.watchdog.is_needed = False
        cell.close()
        cell.watchdog.rest()
    cell.detach_scheduler()
    return build_result(runs, outcomes, cell, time_s, options)
