r"""Trigger data: events and their positions on the path of a TriggL, TriggJ or TriggC.

\Mode selects a controller's behaviour when the robot stops at a trigger position and restarts; a
run passes each position once. \Next is not simulated.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "TriggIO",
"TriggEquip", "TriggInt", "TriggCheckIO", "TriggRampAO", "TriggSpeed".
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import TypedDict, Unpack

from rapidsim.language.annotations import (
    AnySignal,
    Bool,
    Dnum,
    IntNum,
    Num,
    OpNum,
    OutputValue,
    Pers,
    SignalAo,
    SignalDo,
    SignalGo,
    Switch,
    TriggData,
    TriggMode,
    Var,
)
from rapidsim.language.controller import Controller, FidelityReporter, Signals
from rapidsim.language.data import Signal
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.language.path_events import (
    CheckSignal,
    FollowSpeed,
    RaiseInterrupt,
    RampOutput,
    SetOutput,
    Trigger,
)
from rapidsim.language.reference import Reference
from rapidsim.library.fidelity_notes import note_ignored_options
from rapidsim.library.signals import connected
from rapidsim.library.table import routine, table


class Inhibition(TypedDict, total=False):
    """Conditions under which a trigger has no effect."""

    inhib: Pers[Bool]
    inhib_set_value: Pers[OutputValue]
    mode: TriggMode


def trigg_io(
    controller: Controller,
    trigg_data: Var[TriggData],
    distance: Num,
    set_value: Num | Dnum,
    *,
    start: Switch = False,
    time: Switch = False,
    next_: Switch = False,
    d_op: Var[SignalDo] | None = None,
    g_op: Var[SignalGo] | None = None,
    a_op: Var[SignalAo] | None = None,
    proc_id: Num | None = None,
    d_o_delay: Num | None = None,
    **inhibition: Unpack[Inhibition],
) -> None:
    """Set an output: a distance before the end or after the start, or a time before the end."""
    note_ignored_options(controller.fidelity, "TriggIO", {r"\Next": next_, r"\ProcID": proc_id})
    output = _output(
        controller.signals,
        d_op or g_op or a_op,
        set_value,
        d_o_delay or 0.0,
        digital=d_op is not None,
    )
    trigg_data.value = Trigger(
        output, distance, from_start=start, by_time=time, **_inhibited(inhibition)
    )


def trigg_equip(
    controller: Controller,
    trigg_data: Var[TriggData],
    distance: Num,
    equip_lag: Num,
    set_value: Num | Dnum,
    *,
    start: Switch = False,
    next_: Switch = False,
    d_op: Var[SignalDo] | None = None,
    g_op: Var[SignalGo] | None = None,
    a_op: Var[SignalAo] | None = None,
    proc_id: Num | None = None,
    **inhibition: Unpack[Inhibition],
) -> None:
    """Set an output at a position, earlier by the lag of the equipment."""
    note_ignored_options(controller.fidelity, "TriggEquip", {r"\Next": next_, r"\ProcID": proc_id})
    output = _output(
        controller.signals, d_op or g_op or a_op, set_value, 0.0, digital=d_op is not None
    )
    trigg_data.value = Trigger(
        output, distance, from_start=start, lag_s=equip_lag, **_inhibited(inhibition)
    )


def trigg_int(
    controller: FidelityReporter,
    trigg_data: Var[TriggData],
    distance: Num,
    interrupt: Var[IntNum],
    *,
    start: Switch = False,
    time: Switch = False,
    next_: Switch = False,
    **inhibition: Unpack[Inhibition],
) -> None:
    """Raise an interrupt at a position."""
    note_ignored_options(controller, "TriggInt", {r"\Next": next_})
    action = RaiseInterrupt(interrupt.value)
    trigg_data.value = Trigger(
        action, distance, from_start=start, by_time=time, **_inhibited(inhibition)
    )


def trigg_check_io(
    controller: FidelityReporter,
    trigg_data: Var[TriggData],
    distance: Num,
    signal: Var[AnySignal],
    relation: OpNum,
    check_value: Num | Dnum,
    interrupt: Var[IntNum],
    *,
    start: Switch = False,
    next_: Switch = False,
    time: Switch = False,
    stop_move: Switch = False,
    inhib: Pers[Bool] | None = None,
    mode: TriggMode | None = None,
) -> None:
    """Check a signal at a position, and raise an interrupt if the condition is not met."""
    del mode
    note_ignored_options(controller, "TriggCheckIO", {r"\Next": next_})
    compare = _RELATIONS.get(relation)
    if compare is None:
        raise rapid_error(ERR_ARGVALERR, f"{relation:g} is not a relation of type opnum")
    name = connected(signal) if isinstance(signal.value, Signal) else ""
    action = CheckSignal(
        name, lambda now: compare(now, check_value), interrupt.value, stops=stop_move
    )
    trigg_data.value = Trigger(action, distance, from_start=start, by_time=time, inhibited=inhib)


def trigg_ramp_ao(
    controller: Controller,
    trigg_data: Var[TriggData],
    distance: Num,
    equip_lag: Num,
    a_output: Var[SignalAo],
    set_value: Num,
    ramp_length: Num,
    *,
    start: Switch = False,
    next_: Switch = False,
    time: Switch = False,
    **inhibition: Unpack[Inhibition],
) -> None:
    r"""Ramp an analog output from a position on, over a distance, or with \Time over a time."""
    note_ignored_options(controller.fidelity, "TriggRampAO", {r"\Next": next_})
    controller.signals.require_within(connected(a_output), set_value)
    action = RampOutput(connected(a_output), set_value, ramp_length, by_time=time)
    trigg_data.value = Trigger(
        action, distance, from_start=start, lag_s=equip_lag, **_inhibited(inhibition)
    )


def trigg_speed(
    controller: Controller,
    trigg_data: Var[TriggData],
    distance: Num,
    scale_lag: Num,
    a_op: Var[SignalAo],
    scale_value: Num,
    *,
    start: Switch = False,
    dip_lag: Num | None = None,
    err_do: Var[SignalDo] | None = None,
    **inhibition: Unpack[Inhibition],
) -> None:
    """Make an analog output follow the TCP speed from a position on."""
    note_ignored_options(
        controller.fidelity, "TriggSpeed", {r"\DipLag": dip_lag, r"\ErrDO": err_do}
    )
    action = FollowSpeed(connected(a_op), scale_value, scale_lag)
    trigg_data.value = Trigger(
        action, distance, from_start=start, lag_s=scale_lag, **_inhibited(inhibition)
    )


def trigg_data_reset(trigg_data: Var[TriggData]) -> None:
    """Clear trigger data."""
    trigg_data.value = None


def trigg_data_copy(source: Var[TriggData], destination: Var[TriggData]) -> None:
    """Copy trigger data."""
    destination.value = source.value


def trigg_data_valid(trigg_data: Var[TriggData]) -> Bool:
    """Whether trigger data are defined."""
    return trigg_data.value is not None


def _output(
    controller: Signals,
    signal: Reference[Signal] | None,
    value: float,
    delay_s: float,
    *,
    digital: bool,
) -> SetOutput:
    if signal is None:
        raise rapid_error(ERR_ARGVALERR, r"one of \DOp, \GOp and \AOp is needed")
    set_to = float(value != 0.0) if digital else value
    controller.require_within(connected(signal), set_to)
    return SetOutput(connected(signal), set_to, delay_s)


class _Inhibited(TypedDict):
    inhibited: Reference[bool] | None
    inhibited_value: Reference[object] | None


def _inhibited(options: Inhibition) -> _Inhibited:
    return {
        "inhibited": options.get("inhib"),
        "inhibited_value": options.get("inhib_set_value"),
    }


_RELATIONS: Mapping[float, Callable[[float, float], bool]] = MappingProxyType(
    {
        1.0: lambda a, b: a < b,
        2.0: lambda a, b: a <= b,
        3.0: lambda a, b: a == b,
        4.0: lambda a, b: a != b,
        5.0: lambda a, b: a > b,
        6.0: lambda a, b: a >= b,
    }
)
"""Relation by the constants LT to GTEQ."""

_WHERE = r"TriggData Distance"
_OUTPUT = r"\DOp|\GOp|\AOp|\ProcID SetValue|SetDvalue"
_INHIBITION = r"\Inhib \InhibSetValue \Mode"

TRIGGERS = table(
    routine("TriggIO", trigg_io, rf"{_WHERE} \Start|\Time|\Next {_OUTPUT} \DODelay {_INHIBITION}"),
    routine("TriggEquip", trigg_equip, rf"{_WHERE} \Start|\Next EquipLag {_OUTPUT} {_INHIBITION}"),
    routine("TriggInt", trigg_int, rf"{_WHERE} \Start|\Time|\Next Interrupt {_INHIBITION}"),
    routine(
        "TriggCheckIO",
        trigg_check_io,
        rf"{_WHERE} \Start|\Next|\Time Signal Relation CheckValue|CheckDvalue \StopMove Interrupt"
        r" \Inhib \Mode",
    ),
    routine(
        "TriggRampAO",
        trigg_ramp_ao,
        rf"{_WHERE} \Start|\Next EquipLag AOutput SetValue RampLength \Time {_INHIBITION}",
    ),
    routine(
        "TriggSpeed",
        trigg_speed,
        rf"{_WHERE} \Start ScaleLag AOp ScaleValue \DipLag \ErrDO {_INHIBITION}",
    ),
    routine("TriggDataReset", trigg_data_reset),
    routine("TriggDataCopy", trigg_data_copy),
    routine("TriggDataValid", trigg_data_valid),
)
