"""Values of system outputs."""

from __future__ import annotations

from rapidsim.controller.cell.description import Status
from rapidsim.simulation.live.panel import Panel
from rapidsim.simulation.live.states import ControllerState, OperatingMode

_EMERGENCY = (ControllerState.EMERGENCY_STOP, ControllerState.EMERGENCY_STOP_RELEASED)


def status_value(
    status: Status | None, *, executes: bool, failed: bool, panel: Panel
) -> float | None:
    """Return the value of a system output; None for other signals, and if it does not change.

    Args:
        status: The state that the output shows.
        executes: Whether its task executes; without a task, whether any does.
        failed: Whether a program has stopped with an error.
        panel: The state of the controller.
    """
    match status:
        case Status.TASK_EXECUTING | Status.CYCLE_ON:
            shown = executes
        case Status.ERROR | Status.EXECUTION_ERROR:
            shown = failed
        case Status.MOTOR_ON | Status.MOTOR_ON_STATE:
            shown = panel.state is ControllerState.MOTORS_ON
        case Status.MOTOR_OFF | Status.MOTOR_OFF_STATE:
            shown = panel.state is not ControllerState.MOTORS_ON
        case Status.AUTO_ON:
            shown = panel.mode is OperatingMode.AUTO
        case Status.RUN_CHAIN_OK:
            shown = panel.is_chain_closed
        case Status.EMERGENCY_STOP:
            shown = panel.state in _EMERGENCY
        case _:
            # Outputs of a robot's state are written as it moves.
            return None
    return float(shown)
