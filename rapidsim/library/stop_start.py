r"""Stopping the robot on its path, restarting it, and paths in between.

ProcerrRecovery in a trap raises its error at the statement that the trap interrupts or, if that is
a computing loop, at the next statement that can fail: \SyncOrgMoveInst and \SyncLastMoveInst are
equal.

StopMove brakes as a stopped program does, \Quick as fast as the axes can; both stay on the
path.

A run without a server ends when its program stops: the robot then executes its queued moves, so
that TriggStopProc notes a robot that is off its path.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "StopMove",
"StartMove", "StorePath", "RestoPath", "ClearPath", "TriggStopProc".
"""

from __future__ import annotations

from rapidsim.language.annotations import Bool, Num, Pers, SignalDo, SignalGo, Switch, Var
from rapidsim.language.controller import ACCEPTED, Controller, ExecutionControl
from rapidsim.language.error_numbers import (
    ERR_PATH_STOP,
    ERR_PROCSIGNAL_OFF,
    rapid_error,
)
from rapidsim.language.errors import NotAllowed
from rapidsim.language.option_data import RestartData
from rapidsim.language.path_control import PathControl
from rapidsim.language.tasks import TaskService
from rapidsim.library.signals import connected
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait

_OWN_ROBOT = f"{ACCEPTED}: in the task of a robot it resets that robot's stop alone"
_NOTHING_CLEARED = "nothing is cleared"


def stop_move(
    controller: Controller, *, quick: Switch = False, all_motion_tasks: Switch = False
) -> None:
    """Stop the robot on its path; the program continues when it is at rest."""
    if _is_watching(controller, "StopMove", all_motion_tasks):
        controller.tasks.stop_robots(every=all_motion_tasks, quick=quick)
    else:
        controller.path_control.stop_move(quick=quick)


def start_move(controller: Controller, *, all_motion_tasks: Switch = False) -> None:
    """Restart the robot on its path."""
    if _is_watching(controller, "StartMove", all_motion_tasks):
        controller.tasks.start_robots(every=all_motion_tasks)
    else:
        controller.path_control.start_move()


def start_move_retry(controller: PathControl) -> None:
    """Restart the robot; the ERROR clause that calls it then behaves as with RETRY."""
    controller.start_move()


def stop_move_reset(controller: Controller, *, all_motion_tasks: Switch = False) -> None:
    """Cancel a StopMove: the robot continues."""
    if all_motion_tasks and controller.tasks.robot_number:
        controller.fidelity.not_simulated(r"StopMoveReset \AllMotionTasks", _OWN_ROBOT)
        all_motion_tasks = False
    if _is_watching(controller, "StopMoveReset", all_motion_tasks):
        controller.tasks.start_robots(every=all_motion_tasks)
    elif controller.path_control.is_stopped():
        controller.path_control.start_move()


def procerr_recovery(
    controller: Controller,
    *,
    sync_org_move_inst: Switch = False,
    sync_last_move_inst: Switch = False,
    proc_signal: Var[SignalDo] | None = None,
) -> None:
    """Stop the robot as a failing process does: ERR_PATH_STOP; StartMoveRetry continues."""
    if not (sync_org_move_inst or sync_last_move_inst):
        raise NotAllowed(r"ProcerrRecovery needs \SyncOrgMoveInst or \SyncLastMoveInst")
    if proc_signal is not None and not controller.signals.read_signal(proc_signal.value.name):
        raise rapid_error(ERR_PROCSIGNAL_OFF, f"`{proc_signal.value.name}` is 0: no process runs")
    controller.path_control.fail(
        rapid_error(ERR_PATH_STOP, "ProcerrRecovery stopped the robot on its path")
    )


def _is_watching(controller: Controller, instruction: str, all_motion_tasks: bool) -> bool:
    """Whether the task supervises other tasks because it has no robot."""
    if not controller.tasks.robot_number:
        return True
    if all_motion_tasks:
        raise NotAllowed(
            rf"{instruction} \AllMotionTasks in the task of a robot; it is for tasks that watch"
        )
    return False


def _path_of(controller: Controller, instruction: str) -> PathControl:
    """The path of the task's own robot."""
    if not controller.tasks.robot_number:
        raise NotAllowed(f"{instruction}: the task {controller.tasks.task_name} has no robot")
    return controller.path_control


def clear_path(controller: Controller) -> None:
    """Drop the rest of the path.

    In a task without a robot a controller continues, as supervising servers rely on; no source
    documents what it clears there.
    """
    if controller.tasks.robot_number:
        controller.path_control.clear_path()
    else:
        controller.fidelity.not_simulated("ClearPath in a task without a robot", _NOTHING_CLEARED)


def store_path(controller: Controller, *, keep_sync: Switch = False) -> None:
    r"""Store the rest of the path and begin a new one; with \KeepSync together with the team."""
    _path_of(controller, "StorePath").store_path(keep_sync=keep_sync)


def resto_path(controller: Controller) -> None:
    """Restore the stored path; StartMove continues on it."""
    _path_of(controller, "RestoPath").restore_path()


def path_level(controller: PathControl) -> Num:
    """The path level: 1 on the program's own path, one more for each StorePath."""
    return controller.path_level


def is_stop_move_act(
    controller: TaskService, *, from_move_task: Switch = False, from_non_move_task: Switch = False
) -> Bool:
    """Whether StopMove of the robot's own task, or of a task without a robot, is in force."""
    by_own, by_watcher = controller.is_robot_held()
    if from_move_task or from_non_move_task:
        return by_own if from_move_task else by_watcher
    return by_own or by_watcher


def trigg_stop_proc(
    controller: ExecutionControl,
    restart_ref: Pers[RestartData],
    shadow_do: Var[SignalDo],
    *,
    do1: Var[SignalDo] | None = None,
    go1: Var[SignalGo] | None = None,
    go2: Var[SignalGo] | None = None,
    go3: Var[SignalGo] | None = None,
    go4: Var[SignalGo] | None = None,
) -> None:
    """Set process signals to 0 at each stop of the program, and store their values."""
    process = tuple(None if one is None else connected(one) for one in (do1, go1, go2, go3, go4))
    controller.supervise(restart_ref, process, connected(shadow_do))


STOP_START = table(
    routine("StopMove", stop_move, does=Trait.HOLD_ROBOT, back="StartMove"),
    routine("StartMove", start_move, back="StartMove"),
    routine("StartMoveRetry", start_move_retry, does=Trait.LEAVE | Trait.RETRY, back="StartMove"),
    routine("StopMoveReset", stop_move_reset),
    routine(
        "ProcerrRecovery",
        procerr_recovery,
        r"\SyncOrgMoveInst|\SyncLastMoveInst \ProcSignal",
        does=Trait.HOLD_ROBOT,
    ),
    routine("ClearPath", clear_path, does=Trait.LEAVE_PATH),
    routine("StorePath", store_path, does=Trait.LEAVE_PATH),
    routine("RestoPath", resto_path, does=Trait.LEAVE_PATH),
    routine("PathLevel", path_level),
    routine("TriggStopProc", trigg_stop_proc, r"RestartRef \DO1 \GO1 \GO2 \GO3 \GO4 ShadowDO"),
    routine("IsStopMoveAct", is_stop_move_act, r"\FromMoveTask|\FromNonMoveTask"),
)
