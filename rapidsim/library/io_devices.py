r"""I/O devices and buses: their states, and switching devices on and off.

All devices run from the start. IODisable takes no time here and never fails; the signals of a
device that is switched off keep their values.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "IOUnitState",
"IOBusState", "IODisable", "GetSignalOrigin".
"""

from __future__ import annotations

from rapidsim.language.annotations import (
    AnySignal,
    BusState,
    IoUnitStateNum,
    Num,
    SignalOriginNum,
    String,
    Switch,
    Var,
)
from rapidsim.language.controller import ClockService
from rapidsim.language.data import Signal
from rapidsim.language.equipment import Equipment
from rapidsim.library.predefined import DATA
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait


def _named(name: str) -> float:
    """The value of a predefined constant."""
    value = DATA[name.lower()].value
    assert isinstance(value, float)
    return value


def io_enable(controller: Equipment, unit_name: String, max_time: Num) -> None:
    """Enable an I/O device."""
    del max_time
    controller.enable(unit_name, enabled=True)


def io_disable(controller: Equipment, unit_name: String, max_time: Num) -> None:
    """Disable an I/O device."""
    del max_time
    controller.enable(unit_name, enabled=False)


def io_unit_state(
    controller: Equipment, unit_name: String, *, phys: Switch = False, logic: Switch = False
) -> IoUnitStateNum:
    """The state of an I/O device: running, unless it has no contact or the program disabled it."""
    runs = controller.is_enabled(unit_name)
    if runs and not logic and not controller.has_contact(unit_name):
        return _named("IOUNIT_PHYS_STATE_ERROR" if phys else "IOUNIT_RUNERROR")
    if phys:
        return _named("IOUNIT_PHYS_STATE_RUNNING" if runs else "IOUNIT_PHYS_STATE_DEACTIVATED")
    if logic:
        return _named("IOUNIT_LOG_STATE_ENABLED" if runs else "IOUNIT_LOG_STATE_DISABLED")
    return _named("IOUNIT_RUNNING" if runs else "IOUNIT_DISABLE")


def io_bus_state(
    bus_name: String, state: Var[BusState], *, phys: Switch = False, logic: Switch = False
) -> None:
    """The state of an I/O bus: running."""
    del bus_name
    running = "IOBUS_PHYS_STATE_RUNNING" if phys else "BUSSTATE_RUN"
    state.value = _named("IOBUS_LOG_STATE_STARTED" if logic else running)


def io_bus_start(bus_name: String) -> None:
    """Start an I/O bus, which is already running."""
    del bus_name


def get_signal_origin(
    controller: ClockService, signal: Var[AnySignal], signal_name: Var[String]
) -> SignalOriginNum:
    """The origin of a signal, the configuration or AliasIO, and its name there."""
    of = signal.value
    name = of.name if isinstance(of, Signal) else ""
    signal_name.value = name
    if not name:
        return _named("SIGORIG_NONE")
    return _named("SIGORIG_CFG" if of.is_configured else "SIGORIG_ALIAS")


IO_DEVICES = table(
    routine("IOEnable", io_enable),
    routine("IODisable", io_disable),
    routine("IOUnitState", io_unit_state, r"UnitName \Phys|\Logic", does=Trait.READ_CELL),
    routine("IOBusState", io_bus_state, r"BusName State \Phys|\Logic"),
    routine("IOBusStart", io_bus_start),
    routine("GetSignalOrigin", get_signal_origin),
)
