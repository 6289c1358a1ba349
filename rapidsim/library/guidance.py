r"""Externally guided motion (EGM): a sensor moves the robot every few milliseconds.

The controller knows the sensor: a program over the network if the run permits it, signals, or none.

Source: Application manual Externally Guided Motion; Technical reference manual RAPID Instructions,
Functions and Data types, "EGMActJoint" and its like.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Annotated, Final, Unpack, cast, overload

from rapidsim.language import types
from rapidsim.language.annotations import (
    MecUnit,
    Num,
    Pers,
    String,
    Switch,
    Var,
)
from rapidsim.language.controller import Controller
from rapidsim.language.data import LoadData, Pose, Signal, ToolData, WobjData
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.language.guidance import (
    RAMP_DOWN,
    Activation,
    Exchange,
    Guidance,
    GuidanceTerms,
    PoseFrames,
    Purpose,
    SensorSetup,
)
from rapidsim.language.reference import Reference
from rapidsim.library.corrected_paths import CORRECTED_PATHS
from rapidsim.library.fidelity_notes import note_ignored_options
from rapidsim.library.guidance_arguments import (
    EXTERNAL,
    JOINTS,
    POSE_AXES,
    SIGNALS,
    AnalogInputs,
    AnalogOutputs,
    EgmIdent,
    GroupInputs,
    JointBands,
    JointSwitches,
    PoseBands,
    PoseSwitches,
    exchange_of,
    identity_number,
    sample_s,
)
from rapidsim.library.signals import connected
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait

EgmFrameType = Annotated[float, types.Alias("egmframetype", types.NUM)]
EgmState = Annotated[float, types.Alias("egmstate", types.NUM)]
EgmStopMode = Annotated[float, types.Alias("egmstopmode", types.NUM)]

MAX_SPEED_DEVIATION: Final = 1.0
MAX_POS_DEVIATION: Final = 1000.0
TIMEOUT_S: Final = 1.0
CONDITION_S: Final = 1.0


def egm_get_id(controller: Guidance, egmid: Var[EgmIdent]) -> None:
    """Create an identity."""
    egmid.value = controller.connect()


def egm_reset(controller: Guidance, egmid: Var[EgmIdent]) -> None:
    """Stop the activity of an identity and release it."""
    if egmid.value is not None:
        controller.give_back(egmid.value)
        egmid.value = None


def egm_get_state(controller: Guidance, egmid: Var[EgmIdent]) -> EgmState:
    """The state of an identity: disconnected, connected or running."""
    return 0.0 if egmid.value is None else controller.state(egmid.value)


def egm_setup_uc(
    controller: Guidance,
    mec_unit: Var[MecUnit],
    egmid: Var[EgmIdent],
    ext_config_name: String,
    uc_device: String,
    *,
    joint: Switch = False,
    pose: Switch = False,
    path_corr: Switch = False,
    aptr: Switch = False,
    latr: Switch = False,
    comm_timeout: Num | None = None,
) -> None:
    """Connect an identity with a sensor over UDP; without a switch it only receives positions."""
    del mec_unit, aptr, latr
    silence_s = _positive("CommTimeout", comm_timeout, TIMEOUT_S)
    setup = SensorSetup(
        uc_device.rstrip(":"),
        ext_config_name,
        _purpose(joint=joint, pose=pose, path_corr=path_corr),
        silence_s,
    )
    controller.set_up(identity_number(egmid, "EGMSetupUC"), setup)


def egm_setup_ai(
    controller: Controller,
    mec_unit: Var[MecUnit],
    egmid: Var[EgmIdent],
    ext_config_name: String,
    *,
    joint: Switch = False,
    pose: Switch = False,
    path_corr: Switch = False,
    aptr: Switch = False,
    latr: Switch = False,
    **signals: Unpack[AnalogInputs],
) -> None:
    """Let analog inputs guide joints [deg] or a pose [mm, deg]; external axes do not move."""
    del mec_unit, aptr, latr
    purpose = _purpose(joint=joint, pose=pose, path_corr=path_corr)
    _guide_by(controller, egmid, ext_config_name, purpose, "EGMSetupAI", signals)


def egm_setup_ao(
    controller: Controller,
    mec_unit: Var[MecUnit],
    egmid: Var[EgmIdent],
    ext_config_name: String,
    *,
    joint: Switch = False,
    pose: Switch = False,
    path_corr: Switch = False,
    aptr: Switch = False,
    latr: Switch = False,
    **signals: Unpack[AnalogOutputs],
) -> None:
    """Let analog outputs guide, as EGMSetupAI does with inputs."""
    del mec_unit, aptr, latr
    purpose = _purpose(joint=joint, pose=pose, path_corr=path_corr)
    _guide_by(controller, egmid, ext_config_name, purpose, "EGMSetupAO", signals)


def egm_setup_gi(
    controller: Controller,
    mec_unit: Var[MecUnit],
    egmid: Var[EgmIdent],
    ext_config_name: String,
    *,
    joint: Switch = False,
    pose: Switch = False,
    path_corr: Switch = False,
    aptr: Switch = False,
    latr: Switch = False,
    **signals: Unpack[GroupInputs],
) -> None:
    """Let group inputs guide, as EGMSetupAI does with analog inputs."""
    del mec_unit, aptr, latr
    purpose = _purpose(joint=joint, pose=pose, path_corr=path_corr)
    _guide_by(controller, egmid, ext_config_name, purpose, "EGMSetupGI", signals)


def egm_act_joint(
    controller: Guidance,
    egmid: Var[EgmIdent],
    *,
    stream_start: Switch = False,
    tool: Pers[ToolData] | None = None,
    wobj: Pers[WobjData] | None = None,
    tload: Pers[LoadData] | None = None,
    lp_filter: Num | None = None,
    sample_rate: Num | None = None,
    max_pos_deviation: Num | None = None,
    max_speed_deviation: Num | None = None,
    **bands: Unpack[JointBands],
) -> None:
    """Let the sensor send joint goals, with the bands within which they are reached."""
    del tload
    controller.activate(
        identity_number(egmid, "EGMActJoint"),
        Activation(
            tuple(bands.get(name) for name in JOINTS),  # type: ignore[misc]
            tool.value if tool else None,
            wobj.value if wobj else None,
            _positive("LpFilter", lp_filter),
            sample_s(sample_rate),
            _positive("MaxSpeedDeviation", max_speed_deviation, MAX_SPEED_DEVIATION),
            _positive("MaxPosDeviation", max_pos_deviation, MAX_POS_DEVIATION),
            exchange=exchange_of(bands),
            streams=stream_start,
        ),
    )


def egm_act_pose(
    controller: Guidance,
    egmid: Var[EgmIdent],
    corr_frame: Pose,
    corr_fr_type: EgmFrameType,
    sensor_frame: Pose,
    sensor_fr_type: EgmFrameType,
    *,
    stream_start: Switch = False,
    tool: Pers[ToolData] | None = None,
    wobj: Pers[WobjData] | None = None,
    tload: Pers[LoadData] | None = None,
    lp_filter: Num | None = None,
    sample_rate: Num | None = None,
    max_pos_deviation: Num | None = None,
    max_speed_deviation: Num | None = None,
    **bands: Unpack[PoseBands],
) -> None:
    """Let the sensor send poses of the TCP as goals, with their frames and bands."""
    del tload
    controller.activate(
        identity_number(egmid, "EGMActPose"),
        Activation(
            tuple(bands.get(name) for name in POSE_AXES),  # type: ignore[misc]
            tool.value if tool else None,
            wobj.value if wobj else None,
            _positive("LpFilter", lp_filter),
            sample_s(sample_rate),
            _positive("MaxSpeedDeviation", max_speed_deviation, MAX_SPEED_DEVIATION),
            _positive("MaxPosDeviation", max_pos_deviation, MAX_POS_DEVIATION),
            frames=PoseFrames(corr_frame, corr_fr_type, sensor_frame, sensor_fr_type),
            exchange=exchange_of(bands),
            streams=stream_start,
        ),
    )


def egm_run_joint(
    controller: Guidance,
    egmid: Var[EgmIdent],
    mode: EgmStopMode,
    *,
    no_wait_cond: Switch = False,
    cond_time: Num | None = None,
    ramp_in_time: Num | None = None,
    ramp_out_time: Num | None = None,
    pos_corr_gain: Num | None = None,
    **chosen: Unpack[JointSwitches],
) -> None:
    """Let the sensor move the joints until they have reached its goal."""
    terms = _terms(
        [bool(chosen.get(name)) for name in JOINTS],
        mode,
        not no_wait_cond,
        (cond_time, ramp_in_time, ramp_out_time),
        pos_corr_gain,
        None,
        exchange_of(chosen),
    )
    controller.guide(identity_number(egmid, "EGMRunJoint"), terms)


def egm_run_pose(
    controller: Guidance,
    egmid: Var[EgmIdent],
    mode: EgmStopMode,
    *,
    no_wait_cond: Switch = False,
    cond_time: Num | None = None,
    ramp_in_time: Num | None = None,
    ramp_out_time: Num | None = None,
    offset: Pose | None = None,
    pos_corr_gain: Num | None = None,
    **chosen: Unpack[PoseSwitches],
) -> None:
    """Let the sensor move the TCP until it has reached its goal."""
    terms = _terms(
        [bool(chosen.get(name)) for name in POSE_AXES],
        mode,
        not no_wait_cond,
        (cond_time, ramp_in_time, ramp_out_time),
        pos_corr_gain,
        offset,
        exchange_of(chosen),
    )
    controller.guide(identity_number(egmid, "EGMRunPose"), terms)


def egm_wait_cond(controller: Guidance, egmid: Var[EgmIdent]) -> None:
    r"""Wait until the robot has reached the sensor's goal, after a run with \NoWaitCond."""
    controller.await_condition(identity_number(egmid, "EGMWaitCond"))


def egm_stop(
    controller: Guidance,
    egmid: Var[EgmIdent],
    mode: EgmStopMode,
    *,
    ramp_out_time: Num | None = None,
) -> None:
    """End the guidance; the robot stays, or returns to the position where the guidance began."""
    ramp_s = _positive("RampOutTime", ramp_out_time)
    controller.end_guidance(
        identity_number(egmid, "EGMStop"), moves_back=mode == RAMP_DOWN, ramp_out_s=ramp_s
    )


def egm_stream_start(
    controller: Guidance, egmid: Var[EgmIdent], *, sample_rate: Num | None = None
) -> None:
    """Start streaming the robot's position to the sensor."""
    controller.stream(identity_number(egmid, "EGMStreamStart"), sample_s(sample_rate))


def egm_stream_stop(controller: Guidance, egmid: Var[EgmIdent]) -> None:
    """Stop streaming."""
    controller.stream(identity_number(egmid, "EGMStreamStop"), None)


def _guide_by(
    controller: Controller,
    egmid: Reference[int | None],
    configuration: str,
    purpose: Purpose,
    routine_name: str,
    signals: Mapping[str, object],
) -> None:
    """Let signals guide; their values are always available, so no communication timeout applies."""
    kind = routine_name[-2:]
    given = {name: signals.get(f"{kind.lower()}_{name}") for name in (*SIGNALS, *EXTERNAL)}
    external = {rf"\{kind.lower()}{name.upper()}": given[name] for name in EXTERNAL}
    note_ignored_options(controller.fidelity, routine_name, external)
    names = tuple(_name_of(given[name]) for name in SIGNALS)
    setup = SensorSetup(routine_name, configuration, purpose, math.inf, names)
    controller.guidance.set_up(identity_number(egmid, routine_name), setup)


def _name_of(signal: object) -> str:
    """Name of the signal that an argument refers to; empty without an argument."""
    return "" if signal is None else connected(cast("Reference[Signal]", signal))


def _purpose(*, joint: bool, pose: bool, path_corr: bool) -> Purpose:
    if joint:
        return Purpose.JOINT
    if pose:
        return Purpose.POSE
    return Purpose.PATH_CORRECTION if path_corr else Purpose.STREAM


def _terms(
    chosen: Sequence[bool],
    mode: float,
    waits: bool,
    times: tuple[float | None, float | None, float | None],
    gain: float | None,
    offset: Pose | None,
    exchange: Exchange,
) -> GuidanceTerms:
    condition, ramp_in, ramp_out = times
    gain = _positive("PosCorrGain", gain, 1.0)
    if gain > 1.0:
        raise rapid_error(ERR_ARGVALERR, f"PosCorrGain is {gain:g}; 0..1 is possible")
    return GuidanceTerms(
        tuple(chosen),
        mode == RAMP_DOWN,
        waits,
        _positive("CondTime", condition, CONDITION_S),
        _positive("RampInTime", ramp_in),
        _positive("RampOutTime", ramp_out),
        gain,
        offset,
        exchange,
    )


@overload
def _positive(name: str, value: float | None) -> float | None: ...
@overload
def _positive(name: str, value: float | None, default: float) -> float: ...
def _positive(name: str, value: float | None, default: float | None = None) -> float | None:
    """The value of an argument, which cannot be negative; the default if the call omits it."""
    if value is None:
        return default
    if not value >= 0.0:
        raise rapid_error(ERR_ARGVALERR, f"{name} is {value:g}; it cannot be negative")
    return value


_SOURCE = r"MecUnit EGMid ExtConfigName"
_PURPOSE = r"\Joint|\Pose|\PathCorr \APTR|\LATR"
_ACT = r"\StreamStart \Tool \WObj \TLoad \DOToSensor \DIFromSensor \DataToSensor \DataFromSensor"
_LIMITS = r"\LpFilter \SampleRate \MaxPosDeviation \MaxSpeedDeviation"
_TIMES = r"\CondTime \RampInTime \RampOutTime"
_WHILE = r"\DOToSensor \DIFromSensor \DataToSensor \DataFromSensor"
_SEVEN = r"\J1 \J2 \J3 \J4 \J5 \J6 \J7"
_SIX = r"\x \y \z \rx \ry \rz"


def _signals(kind: str) -> str:
    return " ".join(rf"\{kind}{name[:2].upper()}{name[2:]}" for name in SIGNALS)


def _axes(kind: str) -> str:
    return " ".join(rf"\{kind}{name.upper()}" for name in EXTERNAL)


_GUIDES = Trait.WAIT | Trait.LEAVE_PATH

GUIDANCE = table(
    routine("EGMGetId", egm_get_id, "EGMid"),
    routine("EGMReset", egm_reset, "EGMid", does=_GUIDES),
    routine("EGMGetState", egm_get_state, "EGMid", does=Trait.READ_TASK),
    routine(
        "EGMSetupUC",
        egm_setup_uc,
        rf"{_SOURCE} UCDevice {_PURPOSE} \CommTimeout",
    ),
    routine("EGMSetupAI", egm_setup_ai, f"{_SOURCE} {_PURPOSE} {_signals('ai')} {_axes('ai')}"),
    routine("EGMSetupAO", egm_setup_ao, f"{_SOURCE} {_PURPOSE} {_signals('ao')}"),
    routine("EGMSetupGI", egm_setup_gi, f"{_SOURCE} {_PURPOSE} {_signals('gi')} {_axes('gi')}"),
    routine("EGMActJoint", egm_act_joint, rf"EGMid {_ACT} {_SEVEN} {_LIMITS}"),
    routine(
        "EGMActPose",
        egm_act_pose,
        rf"EGMid {_ACT} CorrFrame CorrFrType SensorFrame SensorFrType {_SIX} {_LIMITS}",
    ),
    routine(
        "EGMRunJoint",
        egm_run_joint,
        rf"EGMid Mode \NoWaitCond {_WHILE} {_SEVEN} {_TIMES} \PosCorrGain",
        does=_GUIDES,
    ),
    routine(
        "EGMRunPose",
        egm_run_pose,
        rf"EGMid Mode \NoWaitCond {_WHILE} {_SIX} {_TIMES} \Offset \PosCorrGain",
        does=_GUIDES,
    ),
    routine("EGMWaitCond", egm_wait_cond, "EGMid", does=_GUIDES),
    routine("EGMStop", egm_stop, r"EGMid Mode \RampOutTime", does=_GUIDES),
    *CORRECTED_PATHS,
    routine("EGMStreamStart", egm_stream_start, r"EGMid \SampleRate"),
    routine("EGMStreamStop", egm_stream_stop, "EGMid"),
)
