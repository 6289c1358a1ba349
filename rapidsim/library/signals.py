r"""Inputs and outputs: reading, setting, pulsing, waiting.

Setting an output takes no time; \Sync, which waits until the hardware has followed, has no effect.

Source: Technical reference manual RAPID Instructions, Functions and Data types.
"""

from __future__ import annotations

import math

from rapidsim.language.annotations import (
    AnySignal,
    ArgumentType,
    Bool,
    DioNum,
    Dnum,
    Num,
    Ref,
    SignalAi,
    SignalAo,
    SignalDi,
    SignalDo,
    SignalGi,
    SignalGo,
    SignalOrName,
    Switch,
    Var,
)
from rapidsim.language.controller import Signals
from rapidsim.language.data import Signal
from rapidsim.language.error_numbers import (
    ERR_ALIASIO_DEF,
    ERR_ALIASIO_TYPE,
    ERR_ARGVALERR,
    ERR_GO_LIM,
    ERR_NO_ALIASIO_DEF,
    rapid_error,
)
from rapidsim.language.reference import Reference
from rapidsim.language.types import STRING
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait

DEFAULT_PULSE_S = 0.2
LEAST_PULSE_S = 0.001
LONGEST_DELAY_S = 2000.0
LONGEST_PULSE_S = 2000.0
LARGEST_GROUP_NUM = 8388607.0
"""A group of up to 23 signals fits a `num`."""
LARGEST_GROUP = 4294967295.0
"""A group of 32 signals fits a `dnum`."""


def set_do(
    controller: Signals,
    signal: Var[SignalDo],
    value: DioNum,
    *,
    s_delay: Num | None = None,
    sync: Switch = False,
) -> None:
    """Set a digital output, now or after a delay."""
    del sync
    _write(controller, signal, _digital(value), s_delay)


def set_(controller: Signals, signal: Var[SignalDo]) -> None:
    """Set a digital output to 1."""
    _write(controller, signal, 1.0)


def reset(controller: Signals, signal: Var[SignalDo]) -> None:
    """Set a digital output to 0."""
    _write(controller, signal, 0.0)


def invert_do(controller: Signals, signal: Var[SignalDo]) -> None:
    """Invert a digital output."""
    _write(controller, signal, 1.0 - _read(controller, signal))


def pulse_do(
    controller: Signals,
    signal: Var[SignalDo],
    *,
    high: Switch = False,
    p_length: Num | None = None,
) -> None:
    r"""Invert a digital output for a while; with \High, set it to 1 and then to 0."""
    length_s = DEFAULT_PULSE_S if p_length is None else p_length
    if not LEAST_PULSE_S <= length_s <= LONGEST_PULSE_S:
        raise rapid_error(
            ERR_ARGVALERR,
            f"a pulse of {length_s:g} s; {LEAST_PULSE_S:g}..{LONGEST_PULSE_S:g} are possible",
        )
    after = 0.0 if high else _read(controller, signal)
    _write(controller, signal, 1.0 - after)
    _write(controller, signal, after, length_s)


def set_ao(controller: Signals, signal: Var[SignalAo], value: Num) -> None:
    """Set an analog output."""
    _write(controller, signal, value)


def set_go(
    controller: Signals,
    signal: Var[SignalGo],
    value: Num | Dnum,
    *,
    s_delay: Num | None = None,
) -> None:
    """Set a group of outputs to the bits of a number."""
    if not (0.0 <= value <= LARGEST_GROUP and value == math.floor(value)):
        raise rapid_error(
            ERR_GO_LIM, f"{value:.10g} is not a group value; they are 0..{LARGEST_GROUP:.0f}"
        )
    _write(controller, signal, value, s_delay)


def d_input(controller: Signals, signal: Var[SignalDi]) -> DioNum:
    """The value of a digital input."""
    return _read(controller, signal)


def d_output(controller: Signals, signal: Var[SignalDo]) -> DioNum:
    """The value of a digital output."""
    return _read(controller, signal)


def a_input(controller: Signals, signal: Var[SignalAi]) -> Num:
    """The value of an analog input."""
    return _read(controller, signal)


def a_output(controller: Signals, signal: Var[SignalAo]) -> Num:
    """The value of an analog output."""
    return _read(controller, signal)


def g_input(controller: Signals, signal: Var[SignalGi]) -> Num:
    """The value of a group of inputs."""
    return _group_num(_read(controller, signal), signal.value)


def g_output(controller: Signals, signal: Var[SignalGo]) -> Num:
    """The value of a group of outputs."""
    return _group_num(_read(controller, signal), signal.value)


def g_input_dnum(controller: Signals, signal: Var[SignalGi]) -> Dnum:
    """The value of a group of inputs."""
    return _read(controller, signal)


def g_output_dnum(controller: Signals, signal: Var[SignalGo]) -> Dnum:
    """The value of a group of outputs."""
    return _read(controller, signal)


def test_di(controller: Signals, signal: Var[SignalDi]) -> Bool:
    """Whether a digital input is 1."""
    return _read(controller, signal) == 1.0


def valid_io(signal: Var[AnySignal]) -> Bool:
    """Whether a signal can be used, which every connected signal can."""
    return isinstance(signal.value, Signal) and bool(signal.value.name)


def alias_io(
    controller: Signals,
    from_signal: Ref[SignalOrName],
    to_signal: Var[AnySignal],
    *,
    of: ArgumentType = STRING,
    to: ArgumentType = STRING,
) -> None:
    """Make a signal variable an alias of a signal, passed as the data or by its name."""
    source = from_signal if isinstance(from_signal, str | Signal) else from_signal.value
    name = source.name if isinstance(source, Signal) else source
    if not isinstance(name, str) or not isinstance(to_signal.value, Signal):
        raise rapid_error(ERR_ALIASIO_TYPE, "AliasIO connects signals only")
    if isinstance(source, Signal) and of != to:
        told = f"{source.name or 'a signal'} is a {of.name}; a {to.name} cannot mean it"
        raise rapid_error(ERR_ALIASIO_TYPE, told)
    if not isinstance(source, Signal) and controller.is_missing(name):
        raise rapid_error(ERR_ALIASIO_DEF, f"`{name}` is no signal of the cell")
    if to_signal.value.is_configured:
        told = f"{to_signal.value.name} is itself a signal of the cell; AliasIO connects variables"
        raise rapid_error(ERR_ALIASIO_DEF, told)
    to_signal.value = Signal(name)


def alias_io_reset(signal: Var[AnySignal]) -> None:
    """Remove the alias of a signal variable."""
    if not isinstance(signal.value, Signal) or signal.value.is_configured:
        raise rapid_error(ERR_NO_ALIASIO_DEF, "AliasIO has connected nothing there")
    signal.value = Signal("")


def connected(signal: Reference[Signal]) -> str:
    """Name of the signal that a variable refers to.

    Raises:
        RapidError: ERR_NO_ALIASIO_DEF, if it refers to none.
    """
    if not signal.value.name:
        raise rapid_error(ERR_NO_ALIASIO_DEF, "the signal variable is connected to no signal")
    return signal.value.name


def _read(controller: Signals, signal: Reference[Signal]) -> float:
    return controller.read_signal(connected(signal))


def _write(
    controller: Signals, signal: Reference[Signal], value: float, delay_s: float | None = None
) -> None:
    if delay_s is not None and not 0.0 <= delay_s <= LONGEST_DELAY_S:
        raise rapid_error(
            ERR_ARGVALERR, f"a delay of {delay_s:g} s; 0..{LONGEST_DELAY_S:g} are possible"
        )
    controller.write_signal(connected(signal), value, delay_s=delay_s or 0.0)


def _digital(value: float) -> float:
    # RAPID's rule: 0 is low, every other value is high.
    return 0.0 if value == 0.0 else 1.0


def _group_num(value: float, signal: Signal) -> float:
    if value > LARGEST_GROUP_NUM:
        raise rapid_error(
            ERR_GO_LIM, f"{signal.name} is {value:.0f}, more than a num holds; use the Dnum form"
        )
    return value


SIGNALS = table(
    routine("SetDO", set_do, r"\SDelay|\Sync Signal Value", does=Trait.OUTPUT),
    routine("Set", set_, does=Trait.OUTPUT | Trait.SWITCH_ON),
    routine("Reset", reset, does=Trait.OUTPUT | Trait.SWITCH_OFF),
    routine("InvertDO", invert_do, does=Trait.OUTPUT),
    routine("PulseDO", pulse_do, r"\High \PLength Signal", does=Trait.OUTPUT),
    routine("SetAO", set_ao, does=Trait.OUTPUT),
    routine("SetGO", set_go, r"\SDelay Signal Value|Dvalue", does=Trait.OUTPUT),
    routine("DInput", d_input, does=Trait.READ_CELL),
    routine("DOutput", d_output, does=Trait.READ_CELL),
    routine("AInput", a_input, does=Trait.READ_CELL),
    routine("AOutput", a_output, does=Trait.READ_CELL),
    routine("GInput", g_input, does=Trait.READ_CELL),
    routine("GOutput", g_output, does=Trait.READ_CELL),
    routine("GInputDnum", g_input_dnum, does=Trait.READ_CELL),
    routine("GOutputDnum", g_output_dnum, does=Trait.READ_CELL),
    routine("TestDI", test_di, does=Trait.READ_CELL),
    routine("ValidIO", valid_io, does=Trait.READ_ARGUMENT),
    routine("AliasIO", alias_io),
    routine("AliasIOReset", alias_io_reset),
)
