"""The signals of a controller that stays on, as clients read and set them."""

from __future__ import annotations

import math

from rapidsim.controller.cell.description import SignalDeclaration, SignalKind
from rapidsim.simulation.live.controller import LiveController
from rapidsim.simulation.live.states import RefusalReason, RequestRefused


def declared(live: LiveController) -> tuple[SignalDeclaration, ...]:
    """All declared signals."""
    return live.options.io.signals


def find(live: LiveController, name: str) -> SignalDeclaration:
    """Return a signal by name, in any case.

    Raises:
        RequestRefused: If no such signal is declared.
    """
    for one in declared(live):
        if one.name.lower() == name.lower():
            return one
    raise RequestRefused(RefusalReason.NO_SIGNAL, f"there is no signal {name}")


def value_of(live: LiveController, name: str) -> float:
    """The value of a signal."""
    return live.cell.signals.read(name)


def write(live: LiveController, name: str, value: float) -> None:
    """Change a signal and dispatch all effects.

    Raises:
        RequestRefused: If it is unknown, a system output, or its kind or limits forbid the value.
    """
    signal = find(live, name)
    if signal.status is not None:
        raise RequestRefused(
            RefusalReason.READ_ONLY, f"{signal.name} shows a state of the controller"
        )
    low, high = limits(signal)
    whole = signal.kind in (SignalKind.AI, SignalKind.AO) or value == math.floor(value)
    if not (low <= value <= high and whole):
        raise RequestRefused(RefusalReason.VALUE, f"{signal.name} cannot be {value:.10g}")
    live.change_signal(signal.name, value)
    live.settle()


def limits(signal: SignalDeclaration) -> tuple[float, float]:
    """The lowest and the highest value a signal may be set to."""
    low, high = signal.lowest, signal.highest
    match signal.kind:
        case SignalKind.DI | SignalKind.DO:
            return 0.0, 1.0
        case SignalKind.GI | SignalKind.GO:
            return 0.0 if low is None else low, 2.0**32 - 1 if high is None else high
        case _:
            return -math.inf if low is None else low, math.inf if high is None else high
