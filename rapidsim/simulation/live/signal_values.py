"""What signals may be, and what system outputs show."""

from __future__ import annotations

import math

from rapidsim.controller.cell.description import SignalDeclaration, SignalKind, Status
from rapidsim.simulation.live.states import Mode, Motors


def status_value(
    status: Status | None, *, executes: bool, failed: bool, motors: Motors, mode: Mode
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
        case Status.ERROR:
            return float(failed)
        case Status.MOTOR_ON | Status.MOTOR_ON_STATE:
            return float(motors is Motors.ON)
        case Status.MOTOR_OFF | Status.MOTOR_OFF_STATE:
            return float(motors is Motors.OFF)
        case Status.AUTO_ON:
            return float(mode is Mode.AUTO)
        case Status.RUN_CHAIN_OK | Status.EMERGENCY_STOP:
            return None


def limits(signal: SignalDeclaration) -> tuple[float, float]:
    """Between what a signal may be set."""
    low, high = signal.lowest, signal.highest
    match signal.kind:
        case SignalKind.DI | SignalKind.DO:
            return 0.0, 1.0
        case SignalKind.GI | SignalKind.GO:
            return 0.0 if low is None else low, 2.0**32 - 1 if high is None else high
        case _:
            return -math.inf if low is None else low, math.inf if high is None else high
