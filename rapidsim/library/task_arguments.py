r"""Task that an instruction names by its \TaskRef or \TaskName."""

from __future__ import annotations

import re

from rapidsim.language.data import Signal
from rapidsim.language.error_numbers import ERR_TASKNAME, rapid_error
from rapidsim.language.reference import Reference
from rapidsim.language.tasks import TaskService


def named_task(task_ref: Reference[object] | None, task_name: str | None) -> str | None:
    """Name of the task; None without either argument."""
    if task_name is None and task_ref is not None and isinstance(task_ref.value, Signal):
        # A controller has a `taskid` for each task, named after it: T_ROB1Id.
        return re.sub(r"Id$", "", task_ref.value.name, flags=re.IGNORECASE)
    return task_name


def means_another(
    controller: TaskService, task_ref: Reference[object] | None, task_name: str | None
) -> bool:
    """Whether the arguments name a task other than the calling one.

    Raises:
        RapidError: ERR_TASKNAME, if the run has no task of that name.
    """
    meant = named_task(task_ref, task_name)
    if meant is None:
        return False
    if not controller.has_task(meant):
        raise rapid_error(ERR_TASKNAME, f"there is no task {meant} in this run")
    return meant.lower() != controller.task_name.lower()
