"""System inputs: signals whose change to 1 causes an action of the controller.

Those that start programs or switch motors on act in automatic mode only.

Source: Technical reference manual System parameters, "System Input".
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from types import MappingProxyType
from typing import Final, Protocol

from rapidsim.controller.cell.description import SignalDeclaration, SystemAction
from rapidsim.language.error_log import WARNING, LoggedError
from rapidsim.simulation.live.panel import Panel, PanelEvent
from rapidsim.simulation.live.states import (
    Cycle,
    Motors,
    OperatingMode,
    RefusalReason,
    RequestRefused,
    StopMode,
)

_CYCLES: Final = MappingProxyType({"CYCLE": Cycle.ONCE, "CONT": Cycle.FOREVER})
_REJECTED: Final = MappingProxyType(
    {
        SystemAction.MOTORS_ON: 140.0,
        SystemAction.START: 142.0,
        SystemAction.START_AT_MAIN: 143.0,
    }
)
"""Numbers, in domain 2, of entries about rejected actions, from memory."""
_OTHERS_REJECTED: Final = 148.0
_AUTOMATIC_ONLY: Final = frozenset(
    {
        SystemAction.START,
        SystemAction.START_AT_MAIN,
        SystemAction.MOTORS_ON,
        SystemAction.MOTORS_ON_AND_START,
    }
)


class Commanded(Protocol):
    """The controller that system inputs command."""

    panel: Panel

    def soon(self, act: Callable[[], None]) -> None:
        """Do something at the present time, outside of all programs."""
        ...

    def start(self, cycle: Cycle | None = None) -> None:
        """Start the programs."""
        ...

    def stop(self, how: StopMode = StopMode.STOP) -> None:
        """Stop the programs."""
        ...

    def reset_pointers(self) -> None:
        """Set the program pointers to main."""
        ...

    def restart(self, *, cold: bool) -> None:
        """Restart the controller."""
        ...

    def log_error(self, entry: LoggedError) -> None:
        """Put an entry into the event log."""
        ...


@dataclass(eq=False)
class SystemInputs:
    """The system inputs of a cell, as a `cell.SignalListener`."""

    owner: Commanded
    inputs: Mapping[str, SignalDeclaration]
    """Signals with an action, by folded name."""

    def listens_to(self, signal: str) -> bool:
        """Whether a signal is a system input."""
        return signal.lower() in self.inputs

    def signal_changed(self, signal: str, old: float, value: float, now_s: float) -> None:
        """Carry the action out if the signal has become 1."""
        del now_s
        if value and not old:
            self.owner.soon(partial(self._act, self.inputs[signal.lower()]))

    def _act(self, signal: SignalDeclaration) -> None:
        action = signal.action
        assert action is not None
        try:
            is_automatic = self.owner.panel.mode is OperatingMode.AUTO
            if action in _AUTOMATIC_ONLY and not is_automatic:
                raise RequestRefused(RefusalReason.STATE, "the mode is not automatic")
            _ACTIONS[action](self.owner, _CYCLES.get(signal.cycle.upper()))
        except RequestRefused as refusal:
            number = _REJECTED.get(action, _OTHERS_REJECTED)
            title, texts = f"{action} rejected", (signal.name, refusal.message)
            self.owner.log_error(LoggedError(2.0, number, WARNING, title, texts))


def _start(owner: Commanded, cycle: Cycle | None) -> None:
    owner.start(cycle)


def _start_at_main(owner: Commanded, cycle: Cycle | None) -> None:
    owner.reset_pointers()
    owner.start(cycle)


def _motors_on_and_start(owner: Commanded, cycle: Cycle | None) -> None:
    owner.panel.set_motors(Motors.ON)
    owner.start(cycle)


_ACTIONS: Final[Mapping[SystemAction, Callable[[Commanded, Cycle | None], None]]] = (
    MappingProxyType(
        {
            SystemAction.START: _start,
            SystemAction.START_AT_MAIN: _start_at_main,
            SystemAction.STOP: lambda owner, _: owner.stop(),
            SystemAction.QUICK_STOP: lambda owner, _: owner.stop(StopMode.QUICK),
            SystemAction.SOFT_STOP: lambda owner, _: owner.stop(),
            SystemAction.STOP_AT_CYCLE_END: lambda owner, _: owner.stop(StopMode.CYCLE),
            SystemAction.STOP_AT_INSTRUCTION_END: lambda owner, _: owner.stop(StopMode.INSTRUCTION),
            SystemAction.MOTORS_ON: lambda owner, _: owner.panel.set_motors(Motors.ON),
            SystemAction.MOTORS_OFF: lambda owner, _: owner.panel.set_motors(Motors.OFF),
            SystemAction.MOTORS_ON_AND_START: _motors_on_and_start,
            SystemAction.RESET_EMERGENCY_STOP: lambda owner, _: owner.panel.handle(
                PanelEvent.CONFIRM
            ),
            SystemAction.POINTER_TO_MAIN: lambda owner, _: owner.reset_pointers(),
            SystemAction.RESTART: lambda owner, _: owner.restart(cold=False),
        }
    )
)
