r"""Motion settings that VelSet, AccSet, ConfL and similar instructions change until PP to main.

Source: Technical reference manual RAPID Instructions, Functions and Data types.
"""

from __future__ import annotations

import math
from dataclasses import replace

from rapidsim.language.annotations import Bool, MecUnit, Num, Pers, Switch, Var
from rapidsim.language.controller import (
    ACCEPTED,
    ClockService,
    Controller,
    FidelityReporter,
    Motion,
)
from rapidsim.language.data import (
    MAX_LINEAR_AXIS_SPEED_MM_S,
    MAX_REORIENT_SPEED_DEG_S,
    MAX_ROTATING_AXIS_SPEED_DEG_S,
    MAX_TCP_SPEED_MM_S,
    LoadData,
)
from rapidsim.language.error_numbers import (
    ERR_ACC_TOO_LOW,
    ERR_ARGVALERR,
    ERR_AXIS_PAR,
    ERR_SPEED_REFRESH_LIM,
    ERR_SPEEDLIM_VALUE,
    ERR_UNIT_PAR,
    rapid_error,
)
from rapidsim.language.errors import NotAllowed
from rapidsim.language.moves import LEAST_RAMP_PERCENT, CirclePathMode, SingularArea
from rapidsim.library.mechanical_units import system_unit_named
from rapidsim.library.table import routine, table

_NO_LIMIT_SPEED = "no system input LimitSpeed slows the robot down"
_OF_VMAX = "the speed of vmax"
LEAST_ACCELERATION_PERCENT = 20.0
LEAST_LIMIT_M_S2 = 0.1
LEAST_REFRESH_PERCENT = 1.0


def vel_set(controller: Motion, override: Num, max_: Num) -> None:
    """Scale programmed speeds [%] and limit the TCP speed [mm/s]."""
    if override <= 0.0 or max_ <= 0.0:
        raise NotAllowed(f"VelSet {override:g},{max_:g}: both must be greater than 0")
    if not 0.0 <= override <= 100.0:
        raise rapid_error(ERR_ARGVALERR, f"a speed override of {override:g} %; 0..100 are possible")
    controller.settings = replace(
        controller.settings, speed_override_percent=override, max_speed_mm_s=max_
    )


def acc_set(controller: Motion, acc: Num, ramp: Num, *, fine_point_ramp: Num | None = None) -> None:
    """Reduce acceleration and its rise [%]; the controller's minimum is 20 and 10.

    At stop points both ramps apply to the rise: Ramp times FinePointRamp.
    """
    if not (0.0 < acc <= 100.0 and 0.0 < ramp <= 100.0):
        raise NotAllowed(f"AccSet {acc:g},{ramp:g}: both must be greater than 0 and at most 100")
    fine_ramp = 100.0 if fine_point_ramp is None else fine_point_ramp
    controller.settings = replace(
        controller.settings,
        acceleration_percent=min(max(acc, LEAST_ACCELERATION_PERCENT), 100.0),
        ramp_percent=min(max(ramp, LEAST_RAMP_PERCENT), 100.0),
        fine_ramp_percent=min(max(fine_ramp, LEAST_RAMP_PERCENT), 100.0),
    )


def speed_refresh(controller: Controller, override: Num) -> None:
    """Scale the speed [%] of later moves; active moves keep their speed, which the run reports.

    It multiplies with VelSet, as the operator's override does.
    """
    if not 0.0 <= override <= 100.0:
        raise rapid_error(
            ERR_SPEED_REFRESH_LIM, f"a speed override of {override:g} %; 0..100 are possible"
        )
    if override < LEAST_REFRESH_PERCENT:
        controller.fidelity.not_simulated(
            f"SpeedRefresh {override:g}", f"{LEAST_REFRESH_PERCENT:g} %, so that the run continues"
        )
    if controller.motion.is_moving():
        controller.fidelity.not_simulated(
            "SpeedRefresh while the robot moves", "the moves under way keep their speed"
        )
    controller.motion.settings = replace(
        controller.motion.settings,
        speed_refresh_percent=max(override, LEAST_REFRESH_PERCENT),
    )


def speed_lim_axis(
    controller: Controller, mech_unit: Var[MecUnit], axis_no: Num, axis_speed: Num
) -> None:
    """Set the speed limit [deg/s or mm/s] of an axis for when the system input LimitSpeed is 1.

    No cell of a run has this input, so the limit is never in force.
    """
    unit = system_unit_named(controller, mech_unit)
    if not unit.axes:
        raise rapid_error(ERR_UNIT_PAR, f"there is no mechanical unit {unit.name} in this run")
    if not (1 <= axis_no <= len(unit.axes) and axis_no == math.floor(axis_no)):
        raise rapid_error(
            ERR_AXIS_PAR, f"{unit.name} has axes 1 to {len(unit.axes)}; {axis_no:g} is none of them"
        )
    _require_limit("SpeedLimAxis", axis_speed)
    _without_effect(controller, "SpeedLimAxis", _NO_LIMIT_SPEED)


def speed_lim_check_point(controller: Controller, rob_speed: Num) -> None:
    """Set the speed limit [mm/s] of four points of the robot for when LimitSpeed is 1.

    No cell of a run has this system input, so the limit is never in force.
    """
    _require_limit("SpeedLimCheckPoint", rob_speed)
    _without_effect(controller, "SpeedLimCheckPoint", _NO_LIMIT_SPEED)


def _require_limit(name: str, speed: float) -> None:
    if speed <= 0.0:
        raise rapid_error(
            ERR_SPEEDLIM_VALUE, f"{name}: a speed limit of {speed:g}; it must be greater than 0"
        )


def path_resol(controller: Controller, path_sample_time: Num) -> None:
    """Change the sample time of path planning: can be read back, without effect."""
    _without_effect(controller, "PathResol", "the path is exact")
    controller.motion.settings = replace(
        controller.motion.settings, path_resolution_percent=path_sample_time
    )


def motion_sup(
    controller: Controller,
    *,
    on: Switch = False,
    off: Switch = False,
    tunevalue: Num | None = None,
    no_backoff: Switch = False,
) -> None:
    """Switch the supervision of collisions: can be read back, without effect."""
    del on, no_backoff
    _without_effect(controller, "MotionSup", "nothing is hit")
    before = controller.motion.settings.supervision_tune_percent
    controller.motion.settings = replace(
        controller.motion.settings,
        motion_supervision=not off,
        supervision_tune_percent=before if tunevalue is None else tunevalue,
    )


def _without_effect(controller: Controller, name: str, reason: str) -> None:
    controller.fidelity.not_simulated(name, f"{ACCEPTED}: {reason}")


def conf_j(controller: Motion, *, on: Switch = False, off: Switch = False) -> None:
    """Switch the check of configurations in joint moves; on without a switch."""
    controller.settings = replace(controller.settings, conf_j=on or not off)


def conf_l(controller: Motion, *, on: Switch = False, off: Switch = False) -> None:
    """Switch the check of configurations on lines and arcs; on without a switch."""
    controller.settings = replace(controller.settings, conf_l=on or not off)


def sing_area(
    controller: Motion,
    *,
    wrist: Switch = False,
    lock_axis4: Switch = False,
    off: Switch = False,
) -> None:
    r"""Choose how lines and arcs pass singularities of the wrist; \Off without a switch."""
    del off
    area = SingularArea.WRIST if wrist else SingularArea.OFF
    area = SingularArea.LOCK_AXIS_4 if lock_axis4 else area
    controller.settings = replace(controller.settings, singular_area=area)


def cir_path_mode(
    controller: Motion,
    *,
    path_frame: Switch = False,
    object_frame: Switch = False,
    cir_point_ori: Switch = False,
    wrist45: Switch = False,
    wrist46: Switch = False,
    wrist56: Switch = False,
) -> None:
    r"""Choose the reorientation on arcs, or two wrist axes for it; \PathFrame by default."""
    del path_frame
    chosen = {
        CirclePathMode.OBJECT_FRAME: object_frame,
        CirclePathMode.CIR_POINT_ORI: cir_point_ori,
        CirclePathMode.WRIST45: wrist45,
        CirclePathMode.WRIST46: wrist46,
        CirclePathMode.WRIST56: wrist56,
    }
    modes = [mode for mode, wanted in chosen.items() if wanted]
    mode = modes[0] if modes else CirclePathMode.PATH_FRAME
    controller.settings = replace(controller.settings, circle_path=mode)


def path_acc_lim(
    controller: Controller,
    acc_lim: Bool,
    decel_lim: Bool,
    *,
    acc_max: Num | None = None,
    decel_max: Num | None = None,
) -> None:
    """Limit acceleration and deceleration of the TCP along its path [m/s2]."""
    speeding_up = _limit("AccMax", acc_max) if acc_lim else None
    braking = _limit("DecelMax", decel_max) if decel_lim else None
    if speeding_up != braking:
        controller.fidelity.not_simulated(
            "PathAccLim with two different limits", "the smaller one counts for both"
        )
    controller.motion.settings = replace(
        controller.motion.settings, tcp_acceleration_m_s2=speeding_up, tcp_deceleration_m_s2=braking
    )


def world_acc_lim(controller: Motion, *, on: Num | None = None, off: Switch = False) -> None:
    """Limit the acceleration of the TCP in the world [m/s2]."""
    del off
    limit = None if on is None else _limit("On", on)
    controller.settings = replace(controller.settings, world_acceleration_m_s2=limit)


def _limit(name: str, limit: float | None) -> float:
    if limit is None or limit < LEAST_LIMIT_M_S2:
        given = "no value" if limit is None else f"{limit:g}"
        raise rapid_error(
            ERR_ACC_TOO_LOW, rf"\{name} needs at least {LEAST_LIMIT_M_S2:g} m/s2, not {given}"
        )
    return limit


def act_unit(controller: Controller, mech_unit: Var[MecUnit]) -> None:
    """Activate a mechanical unit, so that targets move its axes."""
    name = _unit_name(controller.clock)
    active = controller.motion.settings.inactive_units - {name}
    controller.motion.settings = replace(controller.motion.settings, inactive_units=active)
    del mech_unit


def deact_unit(controller: Controller, mech_unit: Var[MecUnit]) -> None:
    """Deactivate a mechanical unit: its axes keep their position."""
    name = _unit_name(controller.clock)
    inactive = controller.motion.settings.inactive_units | {name}
    controller.motion.settings = replace(controller.motion.settings, inactive_units=inactive)
    del mech_unit


def is_mech_unit_active(controller: Controller, mech_unit: Var[MecUnit]) -> Bool:
    """Whether a mechanical unit is active."""
    del mech_unit
    return _unit_name(controller.clock) not in controller.motion.settings.inactive_units


def _unit_name(controller: ClockService) -> str:
    """The unit an instruction names, in small letters; units have no value, only a name."""
    return controller.place.arguments.get("mechunit", "").lower()


def grip_load(controller: Controller, load: Pers[LoadData]) -> None:
    """Set the load in the gripper.

    It reduces accelerations as far as the motion model depends on loads; by default it does not.
    """
    controller.motion.settings = replace(
        controller.motion.settings,
        grip_load=load.value,
        grip_load_name=controller.clock.place.arguments.get("load", ""),
    )


def max_rob_speed(controller: FidelityReporter) -> Num:
    """The highest TCP speed [mm/s]."""
    controller.not_simulated("MaxRobSpeed", _OF_VMAX)
    return MAX_TCP_SPEED_MM_S


def max_rob_reorient_speed(controller: FidelityReporter) -> Num:
    """The highest speed of reorientation [deg/s]."""
    controller.not_simulated("MaxRobReorientSpeed", _OF_VMAX)
    return MAX_REORIENT_SPEED_DEG_S


def max_ext_linear_speed(controller: FidelityReporter) -> Num:
    """The highest speed of linear external axes [mm/s]."""
    controller.not_simulated("MaxExtLinearSpeed", _OF_VMAX)
    return MAX_LINEAR_AXIS_SPEED_MM_S


def max_ext_reorient_speed(controller: FidelityReporter) -> Num:
    """The highest speed of rotating external axes [deg/s]."""
    controller.not_simulated("MaxExtReorientSpeed", _OF_VMAX)
    return MAX_ROTATING_AXIS_SPEED_DEG_S


MOTION_SETTINGS = table(
    routine(
        "VelSet",
        vel_set,
        "Override Max",
        sets=("speed_override_percent", "max_speed_mm_s"),
        back="VelSet 100,5000",
    ),
    routine(
        "AccSet",
        acc_set,
        sets=("acceleration_percent", "ramp_percent", "fine_ramp_percent"),
        back="AccSet 100,100",
    ),
    routine(
        "PathAccLim",
        path_acc_lim,
        r"AccLim \AccMax DecelLim \DecelMax",
        sets=("tcp_acceleration_m_s2", "tcp_deceleration_m_s2"),
    ),
    routine("WorldAccLim", world_acc_lim, r"\On|\Off", sets=("world_acceleration_m_s2",)),
    routine("ActUnit", act_unit),
    routine("DeactUnit", deact_unit, sets=("inactive_units",)),
    routine("IsMechUnitActive", is_mech_unit_active),
    routine("ConfJ", conf_j, r"\On|\Off", sets=("conf_j",), back=r"ConfJ\On"),
    routine("ConfL", conf_l, r"\On|\Off", sets=("conf_l",), back=r"ConfL\On"),
    routine(
        "SingArea",
        sing_area,
        r"\Wrist|\LockAxis4|\Off",
        sets=("singular_area",),
        back=r"SingArea\Off",
    ),
    routine(
        "CirPathMode",
        cir_path_mode,
        r"\PathFrame|\ObjectFrame|\CirPointOri|\Wrist45|\Wrist46|\Wrist56",
        sets=("circle_path",),
    ),
    routine("SpeedRefresh", speed_refresh, sets=("speed_refresh_percent",)),
    routine("SpeedLimAxis", speed_lim_axis, treated_as=f"{ACCEPTED}: {_NO_LIMIT_SPEED}"),
    routine(
        "SpeedLimCheckPoint",
        speed_lim_check_point,
        treated_as=f"{ACCEPTED}: {_NO_LIMIT_SPEED}",
    ),
    routine(
        "PathResol",
        path_resol,
        treated_as=f"{ACCEPTED}: the path is exact",
        sets=("path_resolution_percent",),
    ),
    routine(
        "MotionSup",
        motion_sup,
        r"\On|\Off \Tunevalue \NoBackoff",
        treated_as=f"{ACCEPTED}: nothing is hit",
        sets=("motion_supervision", "supervision_tune_percent"),
    ),
    routine("GripLoad", grip_load, sets=("grip_load", "grip_load_name")),
    routine("MaxRobSpeed", max_rob_speed, treated_as=_OF_VMAX),
    routine("MaxRobReorientSpeed", max_rob_reorient_speed, treated_as=_OF_VMAX),
    routine("MaxExtLinearSpeed", max_ext_linear_speed, treated_as=_OF_VMAX),
    routine("MaxExtReorientSpeed", max_ext_reorient_speed, treated_as=_OF_VMAX),
)
