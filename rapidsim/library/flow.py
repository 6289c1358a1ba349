"""Instructions that stop the program, and queries of the system that it runs on.

Source: Technical reference manual RAPID Instructions, Functions and Data types.
"""

from __future__ import annotations

from rapidsim.language.annotations import Bool, String, Switch, SymNum
from rapidsim.language.controller import Controller, ExecutionControl
from rapidsim.language.equipment import robot_name
from rapidsim.language.errors import CycleEnded
from rapidsim.language.tasks import TaskService
from rapidsim.library.fidelity_notes import reject_in_undo
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait

OPERATING_AUTOMATIC = 1.0
"""The constant OP_AUTO."""
RUNNING_CONTINUOUSLY = 1.0
"""The constant RUN_CONT_CYCLE."""


def stop(
    controller: Controller, *, no_regain: Switch = False, all_move_tasks: Switch = False
) -> None:
    """Stop the task, or all, once the robot is at rest; it ends unless it can be restarted."""
    del no_regain
    reject_in_undo(controller, "Stop")
    controller.clock.wait(0.0, in_position=True)
    controller.execution.stop("Stop", every=all_move_tasks)


def break_(controller: ExecutionControl) -> None:
    """Stop the program at once; the run ends unless it can be restarted."""
    controller.stop("Break")


def exit_cycle() -> None:
    """End the cycle; the next one begins with main."""
    raise CycleEnded("ExitCycle")


def system_stop_action(
    controller: ExecutionControl,
    *,
    stop: Switch = False,
    stop_block: Switch = False,
    halt: Switch = False,
) -> None:
    """Stop the whole system; the run ends unless it can be restarted."""
    del stop, stop_block, halt
    controller.stop("SystemStopAction", every=True)


def op_mode() -> SymNum:
    """The operating mode; a run is in automatic mode."""
    return OPERATING_AUTOMATIC


def run_mode(*, main: Switch = False) -> SymNum:
    """The run mode; a run is continuous."""
    del main
    return RUNNING_CONTINUOUSLY


def rob_os() -> Bool:
    """Whether this is a real controller, not a virtual one."""
    return False


def rob_name(controller: TaskService) -> String:
    """The name of the task's robot; empty if it has no robot."""
    return robot_name(controller.robot_number) if controller.robot_number else ""


def non_motion_mode(*, main: Switch = False) -> Bool:
    """Whether the program runs without motion."""
    del main
    return False


def linked_m_exe() -> None:
    """Called by the controller's system module at start; has no effect on a program."""


FLOW = table(
    routine("Stop", stop, does=Trait.WAIT),
    routine("Break", break_, does=Trait.WAIT),
    routine("ExitCycle", exit_cycle, does=Trait.LEAVE),
    routine(
        "SystemStopAction",
        system_stop_action,
        r"\Stop|\StopBlock|\Halt",
        does=Trait.LEAVE | Trait.WAIT,
    ),
    routine("OpMode", op_mode),
    routine("RunMode", run_mode),
    routine("RobOS", rob_os),
    routine("RobName", rob_name),
    routine("NonMotionMode", non_motion_mode),
    routine("Linked_m_exe", linked_m_exe),
)
