r"""Waiting for inputs and outputs.

A wait ends at the instant when the signal has the value. \Visualize and its options show a window
on the FlexPendant, which a run does not need.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "WaitDI", "WaitAI",
"WaitGI".
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Unpack

from rapidsim.language.annotations import (
    Bool,
    DioNum,
    Dnum,
    Num,
    SignalAi,
    SignalAo,
    SignalDi,
    SignalDo,
    SignalGi,
    SignalGo,
    Switch,
    Var,
)
from rapidsim.language.controller import Controller, Signals
from rapidsim.language.data import Signal
from rapidsim.language.error_numbers import ERR_WAIT_MAXTIME, rapid_error
from rapidsim.language.reference import Reference
from rapidsim.library.signals import connected
from rapidsim.library.table import routine, table
from rapidsim.library.timing import Window, report_timeout, waited


def wait_di(
    controller: Controller,
    signal: Var[SignalDi],
    value: DioNum,
    *,
    max_time: Num | None = None,
    time_flag: Var[Bool] | None = None,
    **window: Unpack[Window],
) -> None:
    """Wait until a digital input has a value."""
    _wait_digital(controller, "WaitDI", signal, value, max_time, time_flag, window)


def wait_do(
    controller: Controller,
    signal: Var[SignalDo],
    value: DioNum,
    *,
    max_time: Num | None = None,
    time_flag: Var[Bool] | None = None,
    **window: Unpack[Window],
) -> None:
    """Wait until a digital output has a value."""
    _wait_digital(controller, "WaitDO", signal, value, max_time, time_flag, window)


def wait_ai(
    controller: Controller,
    signal: Var[SignalAi],
    value: Num,
    *,
    lt: Switch = False,
    gt: Switch = False,
    max_time: Num | None = None,
    value_at_timeout: Var[Num] | None = None,
    **window: Unpack[Window],
) -> None:
    """Wait until an analog input equals a value, is below it, or above it."""
    condition = _within(controller.signals, signal, value, lt=lt, gt=gt)
    _wait_value(controller, "WaitAI", signal, condition, max_time, value_at_timeout, window)


def wait_ao(
    controller: Controller,
    signal: Var[SignalAo],
    value: Num,
    *,
    lt: Switch = False,
    gt: Switch = False,
    max_time: Num | None = None,
    value_at_timeout: Var[Num] | None = None,
    **window: Unpack[Window],
) -> None:
    """Wait until an analog output equals a value, is below it, or above it."""
    condition = _within(controller.signals, signal, value, lt=lt, gt=gt)
    _wait_value(controller, "WaitAO", signal, condition, max_time, value_at_timeout, window)


def wait_gi(
    controller: Controller,
    signal: Var[SignalGi],
    value: Num | Dnum,
    *,
    noteq: Switch = False,
    lt: Switch = False,
    gt: Switch = False,
    max_time: Num | None = None,
    value_at_timeout: Var[Num] | None = None,
    dvalue_at_timeout: Var[Dnum] | None = None,
    **window: Unpack[Window],
) -> None:
    """Wait until a group of inputs equals a value, differs from it, is below it, or above it."""
    condition = _within(controller.signals, signal, value, lt=lt, gt=gt, noteq=noteq)
    at_timeout = dvalue_at_timeout if value_at_timeout is None else value_at_timeout
    _wait_value(controller, "WaitGI", signal, condition, max_time, at_timeout, window)


def wait_go(
    controller: Controller,
    signal: Var[SignalGo],
    value: Num | Dnum,
    *,
    noteq: Switch = False,
    lt: Switch = False,
    gt: Switch = False,
    max_time: Num | None = None,
    value_at_timeout: Var[Num] | None = None,
    dvalue_at_timeout: Var[Dnum] | None = None,
    **window: Unpack[Window],
) -> None:
    """Wait until a group of outputs equals a value, differs from it, is below it, or above it."""
    condition = _within(controller.signals, signal, value, lt=lt, gt=gt, noteq=noteq)
    at_timeout = dvalue_at_timeout if value_at_timeout is None else value_at_timeout
    _wait_value(controller, "WaitGO", signal, condition, max_time, at_timeout, window)


def _within(
    controller: Signals,
    signal: Reference[Signal],
    value: float,
    *,
    lt: bool,
    gt: bool,
    noteq: bool = False,
) -> Callable[[float], bool]:
    """Condition of a wait; a value out of the signal's range is rejected."""
    controller.require_within(connected(signal), value)
    return _relation(value, lt=lt, gt=gt, noteq=noteq)


def _relation(value: float, *, lt: bool, gt: bool, noteq: bool = False) -> Callable[[float], bool]:
    if lt:
        return lambda now: now < value
    if gt:
        return lambda now: now > value
    if noteq:
        return lambda now: now != value
    return lambda now: now == value


def _wait_digital(
    controller: Controller,
    name: str,
    signal: Reference[Signal],
    value: float,
    max_time: float | None,
    time_flag: Reference[bool] | None,
    window: Window,
) -> None:
    wanted = _relation(0.0 if value == 0.0 else 1.0, lt=False, gt=False)
    in_time = _waited(controller, name, signal, wanted, max_time, window)
    report_timeout(in_time, time_flag, f"{name} {connected(signal)}", max_time)


def _wait_value(
    controller: Controller,
    name: str,
    signal: Reference[Signal],
    condition: Callable[[float], bool],
    max_time: float | None,
    at_timeout: Reference[float] | None,
    window: Window,
) -> None:
    if _waited(controller, name, signal, condition, max_time, window):
        return
    if at_timeout is not None:
        at_timeout.value = controller.signals.read_signal(connected(signal))
    raise rapid_error(
        ERR_WAIT_MAXTIME, f"{name} {connected(signal)} waited {max_time or 0.0:g} s in vain"
    )


def _waited(
    controller: Controller,
    name: str,
    signal: Reference[Signal],
    condition: Callable[[float], bool],
    max_time: float | None,
    window: Window,
) -> bool:
    def wait(limit_s: float | None) -> bool:
        return controller.signals.wait_for_signal(connected(signal), condition, max_time=limit_s)

    return waited(controller, name, window, wait, max_time)


_WINDOW = r"\Visualize \Header \Message|\MsgArray \Wrap \Icon \Image \VisualizeTime \UIActiveSignal"

SIGNAL_WAITS = table(
    routine("WaitDI", wait_di, rf"Signal Value \MaxTime \TimeFlag {_WINDOW}"),
    routine("WaitDO", wait_do, rf"Signal Value \MaxTime \TimeFlag {_WINDOW}"),
    routine("WaitAI", wait_ai, rf"Signal \LT|\GT Value|Dvalue \MaxTime \ValueAtTimeout {_WINDOW}"),
    routine("WaitAO", wait_ao, rf"Signal \LT|\GT Value|Dvalue \MaxTime \ValueAtTimeout {_WINDOW}"),
    routine(
        "WaitGI",
        wait_gi,
        rf"Signal \NOTEQ|\LT|\GT Value|Dvalue \MaxTime \ValueAtTimeout|\DvalueAtTimeout {_WINDOW}",
    ),
    routine(
        "WaitGO",
        wait_go,
        rf"Signal \NOTEQ|\LT|\GT Value|Dvalue \MaxTime \ValueAtTimeout|\DvalueAtTimeout {_WINDOW}",
    ),
)
