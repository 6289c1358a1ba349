"""What system outputs show."""

from __future__ import annotations

from rapidsim.controller.cell.description import Status
from rapidsim.simulation.live.states import Motors, OperatingMode


def status_value(
    status: Status | None, *, executes: bool, failed: bool, motors: Motors, mode: OperatingMode
) -> float | None:
    """What a system output shows; None for other signals, and where it stays as it is.

    Args:
        status: What it is to show.
        executes: Whether its task executes; any, where it has none.
        failed: Whether a program has stopped with an error.
        motors: Now.
        mode: Now.
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
            # The safety chain never opens; what shows a robot's state is written as it moves.
            return None
