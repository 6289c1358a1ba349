"""Test signals: positions and speeds of axes as a controller samples them.

A run has no motors: torques, forces and resolver readings are 0, which the run reports. No manual
lists the signals 4000 to 4003; programs use them for position [deg], speed [deg/s], torque [Nm] and
external torque [Nm] of an axis, and 201 to 212 for the readings of a force sensor.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "TestSignDefine",
"TestSignRead", "TestSignReset"; public programs that log axes with these signals.
"""

from __future__ import annotations

import math
from types import MappingProxyType

from rapidsim.language.annotations import MecUnit, Num, TestSignalNum, Var
from rapidsim.language.controller import Controller
from rapidsim.language.equipment import AxisQuantity, AxisSignals
from rapidsim.language.error_numbers import (
    ERR_ARGVALERR,
    ERR_AXIS_PAR,
    ERR_UNIT_PAR,
    rapid_error,
)
from rapidsim.library.mechanical_units import system_unit_named
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait

CHANNELS = 12
LONGEST_SAMPLE_S = 5.0
"""No served controller remembers its motion for longer than twice this."""
_SAMPLED = MappingProxyType({4000.0: AxisQuantity.POSITION, 4001.0: AxisQuantity.SPEED})


def define_test_signal(
    controller: Controller,
    channel: Num,
    signal_id: TestSignalNum,
    mech_unit: Var[MecUnit],
    axis: Num,
    sample_time: Num,
) -> None:
    """Sample an axis for one of twelve channels: its position (4000) or its speed (4001)."""
    number = _channel(channel)
    unit = system_unit_named(controller, mech_unit)
    if not unit.axes:
        raise rapid_error(ERR_UNIT_PAR, f"there is no mechanical unit {unit.name} in this run")
    if not (1 <= axis <= len(unit.axes) and axis == math.floor(axis)):
        raise rapid_error(
            ERR_AXIS_PAR, f"{unit.name} has axes 1 to {len(unit.axes)}; {axis:g} is none of them"
        )
    quantity = _SAMPLED.get(signal_id)
    if quantity is None:
        controller.fidelity.not_simulated(f"the test signal {signal_id:g}", "it reads 0")
        controller.axis_signals.stop_sampling(number)
        return
    if sample_time > LONGEST_SAMPLE_S:
        controller.fidelity.not_simulated(
            f"TestSignDefine with a SampleTime of {sample_time:g} s", f"{LONGEST_SAMPLE_S:g} s"
        )
    interval_s = min(max(sample_time, 0.0), LONGEST_SAMPLE_S)
    controller.axis_signals.sample_axis(number, unit, int(axis) - 1, quantity, interval_s)


def read_test_signal(controller: Controller, channel: Num) -> Num:
    """Value of a channel: the last sample, or a mean over 4 ms for shorter intervals."""
    number = _channel(channel)
    value = controller.axis_signals.last_sample(number)
    if value is None:
        controller.fidelity.not_simulated(
            f"TestSignRead of channel {number}, which has no signal that is simulated", "0"
        )
        return 0.0
    return value


def reset_test_signals(controller: AxisSignals) -> None:
    """Stop sampling for all channels."""
    controller.stop_all_sampling()


def _channel(channel: float) -> int:
    if not (1 <= channel <= CHANNELS and channel == math.floor(channel)):
        raise rapid_error(
            ERR_ARGVALERR, f"there is no channel {channel:g} for test signals; 1..{CHANNELS} are"
        )
    return int(channel)


AXIS_SIGNALS = table(
    routine("TestSignDefine", define_test_signal),
    routine("TestSignRead", read_test_signal, does=Trait.READ_CELL),
    routine("TestSignReset", reset_test_signals),
)
