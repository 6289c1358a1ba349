r"""Interrupts: ordering, stopping, removing. CONNECT is a statement of the language.

\SingleSafe orders like \Single; that such an interrupt also waits while the program is stopped has
no meaning in a run, which never stops half-way.

Source: Technical reference manual RAPID Instructions, Functions and Data types.
"""

from __future__ import annotations

from rapidsim.language.annotations import (
    DioNum,
    IntNum,
    Num,
    SignalDi,
    SignalDo,
    SignalGi,
    SignalGo,
    Switch,
    Var,
)
from rapidsim.language.controller import Interrupts
from rapidsim.library.table import routine, table

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
    """Order an interrupt in so many seconds, again and again or once."""
    controller.order_timer(interrupt.value, time, single=single or single_safe)


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
    value = None if trigg_value == EDGE else trigg_value
    controller.order_signal(interrupt.value, signal.value.name, value, single=single or single_safe)


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
    controller.order_signal(interrupt.value, signal.value.name, None, single=once)


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
    """Keep all interrupts waiting."""
    controller.hold_interrupts(hold=True)


def i_enable(controller: Interrupts) -> None:
    """Serve interrupts again, those that waited first."""
    controller.hold_interrupts(hold=False)


_ONCE = r"\Single|\SingleSafe"

INTERRUPTS = table(
    routine("ITimer", i_timer, rf"{_ONCE} Time Interrupt"),
    routine("ISignalDI", i_signal_di, rf"{_ONCE} Signal TriggValue Interrupt"),
    routine("ISignalDO", i_signal_do, rf"{_ONCE} Signal TriggValue Interrupt"),
    routine("ISignalGI", i_signal_gi, rf"{_ONCE} Signal Interrupt"),
    routine("ISignalGO", i_signal_go, rf"{_ONCE} Signal Interrupt"),
    routine("IDelete", i_delete),
    routine("ISleep", i_sleep),
    routine("IWatch", i_watch),
    routine("IDisable", i_disable),
    routine("IEnable", i_enable),
)
