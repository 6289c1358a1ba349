"""The panel of a controller: motors, safety chain, operating mode, speed ratio.

Clients, system inputs and faults change the state of the controller by the same events; `NEXT` has
all transitions. That a request for motors on confirms a released emergency stop is our reading.

Source: Operating manual IRC5 with FlexPendant, "Recovering from emergency stops"; product manual
OmniCore, "Protective stop and emergency stop" (the automatic stop acts in automatic mode only).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum, auto
from types import MappingProxyType
from typing import Final, Protocol

from rapidsim.language.error_log import LoggedError
from rapidsim.simulation.live import event_log
from rapidsim.simulation.live.event_log import EventLog
from rapidsim.simulation.live.states import (
    ControllerState,
    Motors,
    OperatingMode,
    RefusalReason,
    RequestRefused,
    SafetyStop,
    StopMode,
)

_ON, _OFF = ControllerState.MOTORS_ON, ControllerState.MOTORS_OFF
_GUARD, _ESTOP = ControllerState.GUARD_STOP, ControllerState.EMERGENCY_STOP
_RELEASED = ControllerState.EMERGENCY_STOP_RELEASED


class PanelEvent(Enum):
    """Something that may change the state of a controller."""

    MOTORS_ON = auto()
    MOTORS_OFF = auto()
    CONFIRM = auto()
    """The release of an emergency stop is confirmed."""
    EMERGENCY_OPENED = auto()
    EMERGENCY_CLOSED = auto()
    GUARD_OPENED = auto()
    GUARD_CLOSED = auto()


NEXT: Final[Mapping[tuple[ControllerState, PanelEvent], ControllerState]] = MappingProxyType(
    {
        (_OFF, PanelEvent.MOTORS_ON): _ON,
        (_RELEASED, PanelEvent.MOTORS_ON): _ON,
        (_ON, PanelEvent.MOTORS_OFF): _OFF,
        (_RELEASED, PanelEvent.MOTORS_OFF): _OFF,
        (_RELEASED, PanelEvent.CONFIRM): _OFF,
        (_ON, PanelEvent.EMERGENCY_OPENED): _ESTOP,
        (_OFF, PanelEvent.EMERGENCY_OPENED): _ESTOP,
        (_GUARD, PanelEvent.EMERGENCY_OPENED): _ESTOP,
        (_RELEASED, PanelEvent.EMERGENCY_OPENED): _ESTOP,
        (_ESTOP, PanelEvent.EMERGENCY_CLOSED): _RELEASED,
        (_ON, PanelEvent.GUARD_OPENED): _GUARD,
        (_OFF, PanelEvent.GUARD_OPENED): _GUARD,
        (_GUARD, PanelEvent.GUARD_CLOSED): _OFF,
    }
)
"""The next state; no entry where an event has no effect."""
_REFUSALS: Final[Mapping[ControllerState, str]] = MappingProxyType(
    {
        _GUARD: "the guard stop is open",
        _ESTOP: "the emergency stop is not released",
    }
)
"""Why motors cannot be switched on, by state."""
LEAST_RATIO: Final = 1
"""The speed ratio [%] used in place of 0 %, which is not modelled: the robot would not move."""


class PanelOwner(Protocol):
    """The controller of a panel."""

    @property
    def now_s(self) -> float:
        """The virtual time [s]."""
        ...

    def stop(self, how: StopMode) -> None:
        """Stop the programs."""
        ...

    def apply_speed_ratio(self) -> None:
        """Use the speed ratio for later moves."""
        ...

    def panel_changed(self) -> None:
        """Handle a change of the controller's state, its mode, or the safety chain."""
        ...

    def log_error(self, entry: LoggedError) -> None:
        """Put an entry into the event log, which may raise interrupts."""
        ...


@dataclass(eq=False)
class Panel:
    """The panel; created with motors and mode, and the safety chain closed."""

    owner: PanelOwner
    log: EventLog
    state: ControllerState
    mode: OperatingMode
    speed_ratio: int = 100
    """Speed of later moves, in percent of the programmed speed."""
    open: dict[SafetyStop, int] = field(default_factory=dict)
    """Number of causes that open each part of the safety chain; without closed parts."""
    is_pressed: bool = False
    """Whether the operator has pressed the button of the emergency stop."""

    @property
    def is_chain_closed(self) -> bool:
        """Whether nothing keeps the motors from being switched on."""
        return SafetyStop.EMERGENCY not in self.open and not self._is_guard_open

    @property
    def refresh_percent(self) -> float:
        """Speed of later moves as the planner uses it [%]."""
        return float(max(self.speed_ratio, LEAST_RATIO))

    def set_motors(self, motors: Motors) -> None:
        """Switch the motors on, or off, which stops the programs.

        Raises:
            RequestRefused: On, while the safety chain is open.
        """
        if motors is Motors.OFF:
            self.handle(PanelEvent.MOTORS_OFF)
            return
        if not self.is_chain_closed:
            why = _REFUSALS.get(self.state, "the safety chain is open")
            raise RequestRefused(RefusalReason.STATE, why)
        self.handle(PanelEvent.MOTORS_ON)

    def handle(self, event: PanelEvent) -> None:
        """Change the state; a state other than motors on stops the programs."""
        state = NEXT.get((self.state, event), self.state)
        if state in (_ON, _OFF) and self._is_guard_open:
            state = _GUARD
        if state is self.state:
            return
        if self.state is _ON:
            self.owner.stop(StopMode.QUICK)
        self.state = state
        if (code := event_log.OF_STATE.get(state)) is not None:
            self.log.operational(code, self.owner.now_s, "")
        self.owner.panel_changed()

    def open_chain(self, stop: SafetyStop) -> None:
        """Open a part of the safety chain, once more if it is open already."""
        self.open[stop] = self.open.get(stop, 0) + 1
        if self.open[stop] == 1:
            self.owner.log_error(event_log.OF_CHAIN[stop])
            is_emergency = stop is SafetyStop.EMERGENCY
            if is_emergency or self._is_guard_open:
                opened = PanelEvent.GUARD_OPENED
                self.handle(PanelEvent.EMERGENCY_OPENED if is_emergency else opened)
            self.owner.panel_changed()

    def close_chain(self, stop: SafetyStop) -> None:
        """Close a part of the safety chain that was opened once."""
        self.open[stop] -= 1
        if not self.open[stop]:
            del self.open[stop]
            is_emergency = stop is SafetyStop.EMERGENCY
            closed = PanelEvent.GUARD_CLOSED
            self.handle(PanelEvent.EMERGENCY_CLOSED if is_emergency else closed)
            self.owner.panel_changed()

    def press_emergency_stop(self, *, is_pressed: bool) -> None:
        """Press the button of the emergency stop, or release it."""
        if is_pressed is self.is_pressed:
            return
        self.is_pressed = is_pressed
        change = self.open_chain if is_pressed else self.close_chain
        change(SafetyStop.EMERGENCY)

    def set_mode(self, mode: OperatingMode) -> None:
        """Turn the mode key, which stops the programs; to or from AUTO the motors are switched off.

        Raises:
            RequestRefused: Between AUTO and manual full speed: the key passes manual reduced speed.
        """
        if mode is self.mode:
            return
        if {mode, self.mode} == {OperatingMode.AUTO, OperatingMode.FULL}:
            raise RequestRefused(
                RefusalReason.STATE, "between AUTO and MANF the key goes through MANR"
            )
        self.owner.stop(StopMode.QUICK)
        is_automatic_involved = OperatingMode.AUTO in (mode, self.mode)
        if is_automatic_involved:
            self.handle(PanelEvent.MOTORS_OFF)
        self.mode = mode
        self.log.operational(event_log.OF_MODE[self.mode], self.owner.now_s, "")
        if is_automatic_involved:
            guard = self._is_guard_open
            self.handle(PanelEvent.GUARD_OPENED if guard else PanelEvent.GUARD_CLOSED)
        self.owner.panel_changed()

    def set_speed_ratio(self, percent: int) -> None:
        """Set the speed of later moves, in percent of the programmed speed.

        Raises:
            RequestRefused: Outside 0..100, or if the mode is not automatic.
        """
        if not 0 <= percent <= 100:
            raise RequestRefused(
                RefusalReason.VALUE, f"a speed ratio of {percent} %; 0..100 are possible"
            )
        if self.mode is not OperatingMode.AUTO:
            raise RequestRefused(
                RefusalReason.STATE, "the speed ratio is set in automatic mode only"
            )
        self.speed_ratio = percent
        self.owner.apply_speed_ratio()

    @property
    def _is_guard_open(self) -> bool:
        is_automatic = self.mode is OperatingMode.AUTO
        return SafetyStop.GENERAL in self.open or (
            is_automatic and SafetyStop.AUTOMATIC in self.open
        )
