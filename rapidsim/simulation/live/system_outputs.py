"""Values of system outputs."""

from __future__ import annotations

from rapidsim.controller.cell.description import Status
from rapidsim.simulation.live.states import Motors, OperatingMode


def status_value(
    status: Status | None, *, executes: bool, failed: bool, motors: Motors, mode: OperatingMode
) -> float | None:
    """Return the value of a system output; None for other signals, and if it does not change.

    Args:
        status: The state that the output shows.
        executes: Whether its task executes; without a task, whether any does.
        failed: Whether a program has stopped with an error.
        motors: Current state of the motors.
        mode: Current operating mode.
    """
    match status:
        case None:
            return None
        case Status.TASK_EXECUTING | Status.CYCLE_ON:
            return float(executes)
        case Status.ERROR | Status.EXECUTION_ERROR:
            return float(failed)
        case Status.MOTOR_ON | Status.MOTOR_ON_STATE:
            return float(motors is Motors.ON)
        case Status.MOTOR_OFF | Status.MOTOR_OFF_STATE:
            return float(motors is Motors.OFF)
        case Status.AUTO_ON:
            return float(mode is OperatingMode.AUTO)
        case _:
            # The safety chain never opens; outputs of a robot's state are written as it moves.
            return None
