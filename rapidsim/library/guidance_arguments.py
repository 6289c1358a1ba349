"""Arguments of EGM instructions: identity, sample time, bands, switches and signals.

Source: Application manual Externally Guided Motion.
"""

from __future__ import annotations

from typing import Annotated, Final, TypedDict

from rapidsim.language import types
from rapidsim.language.annotations import (
    Dnum,
    ParameterMode,
    SignalAi,
    SignalAo,
    SignalDi,
    SignalDo,
    SignalGi,
    Switch,
    Var,
)
from rapidsim.language.data import EgmMinMax
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.language.errors import NotAllowed
from rapidsim.language.guidance import Exchange
from rapidsim.language.reference import Reference
from rapidsim.library.motion import MoveOptions
from rapidsim.library.signals import connected

EgmIdent = Annotated[int | None, next(one for one in types.OPAQUE if one.name == "egmident")]
"""The number of an identity; None before EGMGetId."""
SAMPLE_MS: Final = 4.0
_LONGEST_SAMPLE_MS: Final = 1e6
JOINTS: Final = ("j1", "j2", "j3", "j4", "j5", "j6", "j7")
SIGNALS: Final = ("r1x", "r2y", "r3z", "r4rx", "r5ry", "r6rz")
EXTERNAL: Final = ("e1", "e2", "e3", "e4", "e5", "e6")
POSE_AXES: Final = ("x", "y", "z", "rx", "ry", "rz")


class ExchangeOptions(TypedDict, total=False):
    """Data and signals of the program that are exchanged with the sensor."""

    data_to_sensor: Annotated[list[Dnum], ParameterMode.INOUT]
    do_to_sensor: Var[SignalDo]
    di_from_sensor: Var[SignalDi]
    data_from_sensor: Annotated[list[Dnum], ParameterMode.INOUT]


class JointBands(ExchangeOptions, total=False):
    """Convergence band [deg] of each axis around its goal."""

    j1: EgmMinMax
    j2: EgmMinMax
    j3: EgmMinMax
    j4: EgmMinMax
    j5: EgmMinMax
    j6: EgmMinMax
    j7: EgmMinMax


class PoseBands(ExchangeOptions, total=False):
    """Convergence band [mm, deg] of each direction of the TCP around its goal."""

    x: EgmMinMax
    y: EgmMinMax
    z: EgmMinMax
    rx: EgmMinMax
    ry: EgmMinMax
    rz: EgmMinMax


class CorrectedOptions(MoveOptions, total=False):
    """Options of EGMMoveL and EGMMoveC in addition to target, speed, zone and tool."""

    no_corr: Switch


class AnalogInputs(TypedDict, total=False):
    """The analog inputs of EGMSetupAI."""

    ai_r1x: Var[SignalAi]
    ai_r2y: Var[SignalAi]
    ai_r3z: Var[SignalAi]
    ai_r4rx: Var[SignalAi]
    ai_r5ry: Var[SignalAi]
    ai_r6rz: Var[SignalAi]
    ai_e1: Var[SignalAi]
    ai_e2: Var[SignalAi]
    ai_e3: Var[SignalAi]
    ai_e4: Var[SignalAi]
    ai_e5: Var[SignalAi]
    ai_e6: Var[SignalAi]


class AnalogOutputs(TypedDict, total=False):
    """The analog outputs of EGMSetupAO."""

    ao_r1x: Var[SignalAo]
    ao_r2y: Var[SignalAo]
    ao_r3z: Var[SignalAo]
    ao_r4rx: Var[SignalAo]
    ao_r5ry: Var[SignalAo]
    ao_r6rz: Var[SignalAo]


class GroupInputs(TypedDict, total=False):
    """The group inputs of EGMSetupGI."""

    gi_r1x: Var[SignalGi]
    gi_r2y: Var[SignalGi]
    gi_r3z: Var[SignalGi]
    gi_r4rx: Var[SignalGi]
    gi_r5ry: Var[SignalGi]
    gi_r6rz: Var[SignalGi]
    gi_e1: Var[SignalGi]
    gi_e2: Var[SignalGi]
    gi_e3: Var[SignalGi]
    gi_e4: Var[SignalGi]
    gi_e5: Var[SignalGi]
    gi_e6: Var[SignalGi]


class JointSwitches(ExchangeOptions, total=False):
    """The axes that a sensor moves."""

    j1: Switch
    j2: Switch
    j3: Switch
    j4: Switch
    j5: Switch
    j6: Switch
    j7: Switch


class PoseSwitches(ExchangeOptions, total=False):
    """The directions in which a sensor moves the TCP."""

    x: Switch
    y: Switch
    z: Switch
    rx: Switch
    ry: Switch
    rz: Switch


def identity_number(egmid: Reference[int | None], instruction: str) -> int:
    """Number of an identity that EGMGetId created."""
    if egmid.value is None:
        raise NotAllowed(f"{instruction}: the EGM identity is not there; EGMGetId makes it")
    return egmid.value


def exchange_of(options: ExchangeOptions) -> Exchange:
    """Data and signals that an instruction exchanges with the sensor."""
    output, input_ = options.get("do_to_sensor"), options.get("di_from_sensor")
    return Exchange(
        options.get("data_to_sensor"),
        None if output is None else connected(output),
        options.get("data_from_sensor"),
        None if input_ is None else connected(input_),
    )


def sample_s(
    milliseconds: float | None, default_ms: float = SAMPLE_MS, step_ms: float = SAMPLE_MS
) -> float:
    """Sample time [s] of the sensor; SampleRate is a time as well."""
    value = default_ms if milliseconds is None else milliseconds
    if not step_ms <= value <= _LONGEST_SAMPLE_MS or value % step_ms:
        raise rapid_error(
            ERR_ARGVALERR, f"SampleRate is {value:g} ms; it must be a multiple of {step_ms:g} ms"
        )
    return value / 1000.0
