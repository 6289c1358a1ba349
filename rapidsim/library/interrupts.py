r"""Interrupts: ordering, stopping, removing. CONNECT is a statement of the language.

\SingleSafe orders like \Single, and ISleep refuses such an interrupt; its delay while the program
is stopped has no effect, because a run does not stop between instructions.

Source: Technical reference manual RAPID Instructions, Functions and Data types.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from rapidsim.language.annotations import (
    AioTrigg,
    AnyType,
    DioNum,
    IntNum,
    Num,
    Pers,
    SignalAi,
    SignalAo,
    SignalDi,
    SignalDo,
    SignalGi,
    SignalGo,
    Switch,
    Var,
)
from rapidsim.language.controller import Controller, Interrupts
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.language.reference import Box, Reference
from rapidsim.library.signals import connected
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait

EDGE = 2.0
"""The constant `edge`: any change."""


def i_timer(
    controller: Interrupts,
    time: Num,
    interrupt: Var[IntNum],
    *,
    single: Switch = False,
    single_safe: Switch = False,
) -> None:
    """Order an interrupt after a time, repeatedly or once."""
    controller.order_timer(interrupt.value, time, single=single or single_safe)
    _keep(controller, interrupt, single_safe)


def i_signal_di(
    controller: Interrupts,
    signal: Var[SignalDi],
    trigg_value: DioNum,
    interrupt: Var[IntNum],
    *,
    single: Switch = False,
    single_safe: Switch = False,
) -> None:
    """Order an interrupt when a digital input changes to a value."""
    matches = _any_value if trigg_value == EDGE else _equals(trigg_value)
    name = connected(signal)
    controller.order_signal(interrupt.value, name, matches, single=single or single_safe)
    _keep(controller, interrupt, single_safe)


def i_signal_do(
    controller: Interrupts,
    signal: Var[SignalDo],
    trigg_value: DioNum,
    interrupt: Var[IntNum],
    *,
    single: Switch = False,
    single_safe: Switch = False,
) -> None:
    """Order an interrupt when a digital output changes to a value."""
    i_signal_di(controller, signal, trigg_value, interrupt, single=single, single_safe=single_safe)


def i_signal_gi(
    controller: Interrupts,
    signal: Var[SignalGi],
    interrupt: Var[IntNum],
    *,
    single: Switch = False,
    single_safe: Switch = False,
) -> None:
    """Order an interrupt when a group of inputs changes."""
    once = single or single_safe
    controller.order_signal(interrupt.value, connected(signal), _any_value, single=once)
    _keep(controller, interrupt, single_safe)


def i_signal_go(
    controller: Interrupts,
    signal: Var[SignalGo],
    interrupt: Var[IntNum],
    *,
    single: Switch = False,
    single_safe: Switch = False,
) -> None:
    """Order an interrupt when a group of outputs changes."""
    i_signal_gi(controller, signal, interrupt, single=single, single_safe=single_safe)


def i_signal_ai(
    controller: Controller,
    signal: Var[SignalAi],
    condition: AioTrigg,
    high_value: Num,
    low_value: Num,
    delta_value: Num,
    interrupt: Var[IntNum],
    *,
    single: Switch = False,
    single_safe: Switch = False,
    d_pos: Switch = False,
    d_neg: Switch = False,
) -> None:
    """Order an interrupt when an analog input is in a range and has changed by more than a delta.

    The change counts from the value at the order, then from that at the last interrupt.
    """
    if condition not in _RANGES:
        raise rapid_error(ERR_ARGVALERR, f"{condition:g} is not a condition of type aiotrigg")
    in_range = _RANGES[condition]
    for limit in (high_value, low_value):
        controller.signals.require_within(connected(signal), limit)
    last = controller.signals.read_signal(connected(signal))

    def matches(value: float) -> bool:
        nonlocal last
        change = value - last
        enough = abs(change) > delta_value or delta_value == 0.0
        wrong_way = (d_pos and change < 0.0) or (d_neg and change > 0.0)
        if not in_range(value, low_value, high_value) or not enough or wrong_way:
            return False
        last = value
        return True

    once = single or single_safe
    controller.interrupts.order_signal(interrupt.value, connected(signal), matches, single=once)
    _keep(controller.interrupts, interrupt, single_safe)


def i_signal_ao(
    controller: Controller,
    signal: Var[SignalAo],
    condition: AioTrigg,
    high_value: Num,
    low_value: Num,
    delta_value: Num,
    interrupt: Var[IntNum],
    *,
    single: Switch = False,
    single_safe: Switch = False,
    d_pos: Switch = False,
    d_neg: Switch = False,
) -> None:
    """Order an interrupt when an analog output is in a range; see `ISignalAI`."""
    i_signal_ai(
        controller,
        signal,
        condition,
        high_value,
        low_value,
        delta_value,
        interrupt,
        single=single,
        single_safe=single_safe,
        d_pos=d_pos,
        d_neg=d_neg,
    )


def i_pers(
    controller: Interrupts,
    name: Pers[AnyType],
    interrupt: Var[IntNum],
    *,
    single: Switch = False,
    single_safe: Switch = False,
) -> None:
    """Order an interrupt when a persistent changes.

    The trap runs at the next instruction after the change that moves, waits, reads or writes.
    """
    data = Box(name) if isinstance(name, list) else name
    controller.order_persistent(interrupt.value, data, single=single or single_safe)
    _keep(controller, interrupt, single_safe)


def _keep(controller: Interrupts, interrupt: Reference[float], single_safe: bool) -> None:
    r"""Exempt an interrupt that was ordered with \SingleSafe from ISleep."""
    if single_safe:
        controller.make_safe(interrupt.value)


def i_delete(controller: Interrupts, interrupt: Var[IntNum]) -> None:
    """Remove an interrupt and its order."""
    controller.delete_interrupt(interrupt.value)


def i_sleep(controller: Interrupts, interrupt: Var[IntNum]) -> None:
    """Switch an interrupt off."""
    controller.sleep_interrupt(interrupt.value, asleep=True)


def i_watch(controller: Interrupts, interrupt: Var[IntNum]) -> None:
    """Switch an interrupt on again."""
    controller.sleep_interrupt(interrupt.value, asleep=False)


def i_disable(controller: Interrupts) -> None:
    """Defer all interrupts."""
    controller.hold_interrupts(hold=True)


def i_enable(controller: Interrupts) -> None:
    """Enable interrupts again; deferred ones run first."""
    controller.hold_interrupts(hold=False)


def _equals(value: float) -> Callable[[float], bool]:
    return lambda now: now == value


def _any_value(now: float) -> bool:
    del now
    return True


_RANGES: Mapping[float, Callable[[float, float, float], bool]] = MappingProxyType(
    {
        1.0: lambda value, low, high: value > high,
        2.0: lambda value, low, high: value < high,
        3.0: lambda value, low, high: value > low,
        4.0: lambda value, low, high: value < low,
        5.0: lambda value, low, high: low < value < high,
        6.0: lambda value, low, high: not low <= value <= high,
        7.0: lambda value, low, high: True,
    }
)
"""By the constants AIO_ABOVE_HIGH to AIO_ALWAYS."""

_ONCE = r"\Single|\SingleSafe"
_ANALOG = r"Signal Condition HighValue LowValue DeltaValue \DPos|\DNeg Interrupt"

INTERRUPTS = table(
    routine("ITimer", i_timer, rf"{_ONCE} Time Interrupt"),
    routine("ISignalDI", i_signal_di, rf"{_ONCE} Signal TriggValue Interrupt"),
    routine("ISignalDO", i_signal_do, rf"{_ONCE} Signal TriggValue Interrupt"),
    routine("ISignalGI", i_signal_gi, rf"{_ONCE} Signal Interrupt"),
    routine("ISignalGO", i_signal_go, rf"{_ONCE} Signal Interrupt"),
    routine("ISignalAI", i_signal_ai, rf"{_ONCE} {_ANALOG}"),
    routine("ISignalAO", i_signal_ao, rf"{_ONCE} {_ANALOG}"),
    routine("IPers", i_pers, rf"{_ONCE} Name Interrupt"),
    routine("IDelete", i_delete, does=Trait.DISCONNECT),
    routine("ISleep", i_sleep),
    routine("IWatch", i_watch),
    routine("IDisable", i_disable, does=Trait.HOLD_INTERRUPTS, back="IEnable"),
    routine("IEnable", i_enable, back="IEnable"),
)
