"""Findings of a run of all tasks of a cell, as reported by a check."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from rapidsim.files import InputError
from rapidsim.jobs.checking.checked_program import LoadedProgram
from rapidsim.jobs.checking.load_tasks import LoadedTask
from rapidsim.jobs.checking.move_checks import of_unnamed_arm
from rapidsim.jobs.inputs.entry import require_entry
from rapidsim.jobs.inputs.job import Job
from rapidsim.module_files import TaskFiles
from rapidsim.reach.checked_moves import MOST_MOVES_FOR_ERRORS
from rapidsim.reach.dataflow.written_moves import written_move_count
from rapidsim.station.tasks import DEFAULT_TASK

if TYPE_CHECKING:
    from rapidsim.reach.trial_run import CellRun


def multitask_findings(
    job: Job, tasks: Sequence[tuple[TaskFiles, LoadedProgram]]
) -> CellRun | None:
    """Run all tasks as `rapidsim run` does, for a short time; None if that is impossible.

    Args:
        job: The job to check.
        tasks: Its tasks as read and loaded.
    """
    named = [
        LoadedTask(task.name or DEFAULT_TASK, one.program, written_move_count(one.files))
        for task, one in tasks
        if one.program is not None
    ]
    few_moves = sum(one.moves for one in named) <= MOST_MOVES_FOR_ERRORS
    if len(named) < len(tasks) or not few_moves:
        return None
    # A check of one task does not run several tasks, so these imports are deferred.
    from rapidsim.jobs.checking.target_attribution import attribute_to_targets
    from rapidsim.jobs.checking.task_setups import task_setups
    from rapidsim.jobs.inputs.run_options import run_options
    from rapidsim.reach.trial_run import run_all_tasks

    try:
        for one in named:
            require_entry(one.program, job.entry(one.name))
        bare = task_setups(named, job.station, job.arm(), job.open_robot)
    except InputError:
        return None
    setups = [replace(setup, entry=job.entry(setup.name)) for setup in bare]
    found = run_all_tasks(setups, run_options(job))
    if found is None or found.errors is None:
        return found
    errors = attribute_to_targets(found.errors, [one.program for one in named])
    return replace(found, errors=of_unnamed_arm(errors) if job.is_arm_guessed else errors)
