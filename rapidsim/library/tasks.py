r"""Several tasks: waiting for each other, queries about each other, and synchronized motion.

Tasks in a list that are not in the run are not waited for, which the run reports.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "WaitSyncTask",
"SyncMoveOn", "SyncMoveOff", "SyncMoveUndo", "SyncMoveSuspend", "SyncMoveResume", "GetTaskName",
"TasksInSync", "TaskRunRob".
"""

from __future__ import annotations

from typing import Annotated

from rapidsim.language import types
from rapidsim.language.annotations import (
    Bool,
    Num,
    ParameterMode,
    String,
    Switch,
    TaskId,
    TspStatus,
    Var,
)
from rapidsim.language.controller import ClockService, Controller
from rapidsim.language.data import Tasks
from rapidsim.language.error_numbers import (
    ERR_ARGVALERR,
    ERR_SYNCMOVEOFF,
    ERR_SYNCMOVEON,
    ERR_TASKNAME,
    ERR_WAITSYNCTASK,
    rapid_error,
)
from rapidsim.language.tasks import SyncMoves, TaskService
from rapidsim.library.fidelity_notes import note_ignored_options
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait

SyncIdent = Annotated[object, next(one for one in types.OPAQUE if one.name == "syncident")]
TaskList = Annotated[list[Tasks], ParameterMode.PERS]
CHOSEN = 3.0
"""The constant TSP_STATUS_ACT."""


def wait_sync_task(
    controller: Controller,
    sync_id: Var[SyncIdent],
    task_list: TaskList,
    *,
    in_pos: Switch = False,
    time_out: Num | None = None,
) -> None:
    """Wait until all tasks of a list are at the same synchronization point."""
    tasks = _in_the_run(controller, "WaitSyncTask", task_list)
    name = _name_of(controller.clock)
    if len(tasks) < 2:
        controller.clock.wait(0.0, in_position=in_pos)
        return
    if not controller.tasks.meet(
        "WaitSyncTask", name, tasks, max_time=time_out, in_position=in_pos
    ):
        _out_of_time(ERR_WAITSYNCTASK, "WaitSyncTask", name, time_out)


def sync_move_on(
    controller: Controller,
    sync_id: Var[SyncIdent],
    task_list: TaskList,
    *,
    time_out: Num | None = None,
) -> None:
    """Wait for all tasks of a list at a stop point; then their robots move together."""
    tasks = _in_the_run(controller, "SyncMoveOn", task_list)
    name = _name_of(controller.clock)
    if len(tasks) > 1 and not controller.sync_moves.sync_move_on(name, tasks, max_time=time_out):
        _out_of_time(ERR_SYNCMOVEON, "SyncMoveOn", name, time_out)


def sync_move_off(
    controller: Controller, sync_id: Var[SyncIdent], *, time_out: Num | None = None
) -> None:
    """Wait for the tasks that move together at a stop point; then each moves alone."""
    name = _name_of(controller.clock)
    if controller.sync_moves.team and not controller.sync_moves.sync_move_off(
        name, max_time=time_out
    ):
        _out_of_time(ERR_SYNCMOVEOFF, "SyncMoveOff", name, time_out)


def sync_move_undo(controller: SyncMoves) -> None:
    """Return to independent moves without waiting for the others."""
    controller.leave_team()


def sync_move_suspend(controller: SyncMoves) -> None:
    """Move alone temporarily, on another path level."""
    controller.suspend_team()


def sync_move_resume(controller: SyncMoves) -> None:
    """Move together again after SyncMoveSuspend."""
    controller.resume_team()


def is_sync_move_on(controller: SyncMoves) -> Bool:
    """Whether the robot of the task moves together with others."""
    return bool(controller.team)


def tasks_in_sync(
    controller: SyncMoves, task_list: Annotated[list[Tasks], ParameterMode.INOUT]
) -> Num:
    """The number of tasks that move together; their names are stored in the list."""
    team = controller.team
    for index in range(len(task_list)):
        task_list[index] = Tasks(team[index] if index < len(team) else "")
    return float(len(team))


def get_task_name(
    controller: TaskService,
    *,
    task_no: Var[Num] | None = None,
    mec_task_no: Var[Num] | None = None,
) -> String:
    """The name of the task, and its number among all tasks and among those with a robot."""
    if task_no is not None:
        task_no.value = float(controller.task_number)
    if mec_task_no is not None:
        mec_task_no.value = float(controller.robot_number)
    return controller.task_name


def task_run_rob(controller: TaskService) -> Bool:
    """Whether the task controls a robot."""
    return controller.robot_number > 0


def task_run_mec(controller: TaskService) -> Bool:
    """Whether the task controls any mechanical unit; such units here belong to robots."""
    return controller.robot_number > 0


def motion_planner_no(controller: TaskService) -> Num:
    """The number of the motion planner of the task's robot, 0 without a robot."""
    return float(controller.robot_number)


def task_is_active(controller: Controller, task_ref: TaskId | String) -> Bool:
    """Whether a task of the system takes part in the run."""
    return _is_in_the_run(controller, "TaskIsActive", task_ref)


def task_is_executing(controller: Controller, task_ref: TaskId | String) -> Bool:
    """Whether a task of the system runs; in a run all tasks run until it ends."""
    return _is_in_the_run(controller, "TaskIsExecuting", task_ref)


def get_tsp_status(controller: Controller, task_ref: TaskId | String) -> TspStatus:
    """Whether a task is selected in the task selection panel, which all tasks of a run are."""
    _is_in_the_run(controller, "GetTSPStatus", task_ref)
    return CHOSEN


def _is_in_the_run(controller: Controller, function: str, task: object) -> bool:
    if not isinstance(task, str):
        note_ignored_options(controller.fidelity, function, {"TaskRef": task})
        return True
    if not controller.tasks.has_task(task):
        raise rapid_error(ERR_TASKNAME, f"there is no task {task} in this run")
    return True


def _in_the_run(controller: Controller, instruction: str, tasks: list[Tasks]) -> list[str]:
    """Names of a list, without tasks that are not in the run."""
    names = [task.taskname for task in tasks if task.taskname]
    present = [name for name in names if controller.tasks.has_task(name)]
    if present and controller.tasks.task_name.lower() not in {name.lower() for name in names}:
        raise rapid_error(
            ERR_ARGVALERR,
            f"{instruction}: {controller.tasks.task_name} is not in its own list of tasks",
        )
    missing = [name for name in names if not controller.tasks.has_task(name)]
    if missing:
        controller.fidelity.not_simulated(
            instruction, f"without {', '.join(missing)}, which this run does not have"
        )
    if len({name.lower() for name in present}) != len(present):
        raise rapid_error(ERR_ARGVALERR, f"{instruction}: a task appears twice in its list")
    return present


def _name_of(controller: ClockService) -> str:
    """Name of the synchronization point at the instruction's call."""
    return controller.place.arguments["syncid"]


def _out_of_time(number: float, instruction: str, name: str, seconds: float | None) -> None:
    raise rapid_error(number, f"{instruction} {name}: the others did not come within {seconds:g} s")


TASKS = table(
    routine("WaitSyncTask", wait_sync_task, r"\InPos SyncID TaskList \TimeOut"),
    routine("SyncMoveOn", sync_move_on, r"SyncID TaskList \TimeOut"),
    routine("SyncMoveOff", sync_move_off, r"SyncID \TimeOut"),
    routine("SyncMoveUndo", sync_move_undo, does=Trait.WAIT),
    routine("SyncMoveSuspend", sync_move_suspend, does=Trait.WAIT),
    routine("SyncMoveResume", sync_move_resume, does=Trait.WAIT),
    routine("IsSyncMoveOn", is_sync_move_on),
    routine("TasksInSync", tasks_in_sync, "TaskList"),
    routine("GetTaskName", get_task_name, r"\TaskNo \MecTaskNo", does=Trait.READ_TASK),
    routine("TaskRunRob", task_run_rob),
    routine("TaskRunMec", task_run_mec),
    routine("MotionPlannerNo", motion_planner_no),
    routine("TaskIsActive", task_is_active),
    routine("GetTSPStatus", get_tsp_status),
    routine("TaskIsExecuting", task_is_executing),
)
