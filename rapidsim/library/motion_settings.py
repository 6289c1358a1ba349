r"""Motion settings: what VelSet, AccSet, ConfL and their like change until PP to main.

Source: Technical reference manual RAPID Instructions, Functions and Data types.
"""

from __future__ import annotations

from dataclasses import replace

from rapidsim.language.annotations import Num, Pers, Switch
from rapidsim.language.controller import Controller, Motion
from rapidsim.language.data import LoadData
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.library.honesty import ignored
from rapidsim.library.predefined import MAX_TCP_SPEED_MM_S
from rapidsim.library.table import routine, table

LEAST_ACCELERATION_PERCENT = 20.0
LEAST_RAMP_PERCENT = 10.0


def vel_set(controller: Motion, override: Num, max_: Num) -> None:
    """Scale programmed speeds [%] and limit the TCP speed [mm/s]."""
    if not 0.0 <= override <= 100.0:
        raise rapid_error(ERR_ARGVALERR, f"a speed override of {override:g} %; 0..100 are possible")
    controller.settings = replace(
        controller.settings, speed_override_percent=override, max_speed_mm_s=max_
    )


def acc_set(
    controller: Controller, acc: Num, ramp: Num, *, fine_point_ramp: Num | None = None
) -> None:
    """Reduce acceleration and its rise [%]; the controller goes no lower than 20 and 10."""
    ignored(controller, "AccSet", {r"\FinePointRamp": fine_point_ramp})
    controller.settings = replace(
        controller.settings,
        acceleration_percent=min(max(acc, LEAST_ACCELERATION_PERCENT), 100.0),
        ramp_percent=min(max(ramp, LEAST_RAMP_PERCENT), 100.0),
    )


def conf_j(controller: Motion, *, on: Switch = False, off: Switch = False) -> None:
    """Switch the check of configurations in joint moves; on without a switch."""
    controller.settings = replace(controller.settings, conf_j=on or not off)


def conf_l(controller: Motion, *, on: Switch = False, off: Switch = False) -> None:
    """Switch the check of configurations on lines and arcs; on without a switch."""
    controller.settings = replace(controller.settings, conf_l=on or not off)


def sing_area(
    controller: Controller,
    *,
    wrist: Switch = False,
    lock_axis4: Switch = False,
    off: Switch = False,
) -> None:
    r"""Choose how singularities are passed; only \Off, the path as programmed, is simulated."""
    del off
    if wrist or lock_axis4:
        name = r"SingArea \Wrist" if wrist else r"SingArea \LockAxis4"
        controller.not_simulated(name, r"SingArea \Off")


def cir_path_mode(
    controller: Controller,
    *,
    path_frame: Switch = False,
    object_frame: Switch = False,
    cir_point_ori: Switch = False,
    wrist45: Switch = False,
    wrist46: Switch = False,
    wrist56: Switch = False,
) -> None:
    r"""Choose how the tool turns on arcs; only \PathFrame is simulated."""
    del path_frame
    others = {
        r"\ObjectFrame": object_frame,
        r"\CirPointOri": cir_point_ori,
        r"\Wrist45": wrist45,
        r"\Wrist46": wrist46,
        r"\Wrist56": wrist56,
    }
    for name, chosen in others.items():
        if chosen:
            controller.not_simulated(f"CirPathMode {name}", r"CirPathMode \PathFrame")


def grip_load(controller: Controller, load: Pers[LoadData]) -> None:
    """Tell the controller the load in the gripper; the motion model knows no loads."""
    del load
    controller.not_simulated("GripLoad", "skipped, loads do not change the motion")


def max_rob_speed(controller: Controller) -> Num:
    """The highest TCP speed [mm/s]."""
    controller.not_simulated("MaxRobSpeed", "the speed of vmax")
    return MAX_TCP_SPEED_MM_S


MOTION_SETTINGS = table(
    routine("VelSet", vel_set, "Override Max"),
    routine("AccSet", acc_set),
    routine("ConfJ", conf_j, r"\On|\Off"),
    routine("ConfL", conf_l, r"\On|\Off"),
    routine("SingArea", sing_area, r"\Wrist|\LockAxis4|\Off"),
    routine(
        "CirPathMode",
        cir_path_mode,
        r"\PathFrame|\ObjectFrame|\CirPointOri|\Wrist45|\Wrist46|\Wrist56",
    ),
    routine("GripLoad", grip_load, treated_as="skipped, loads do not change the motion"),
    routine("MaxRobSpeed", max_rob_speed, treated_as="the speed of vmax"),
)
