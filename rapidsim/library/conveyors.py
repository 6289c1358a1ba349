r"""Conveyors: waiting for the next object, and dropping it.

The [[conveyor]] tables of the station define belts and when objects arrive on them. Moves in the
work object of a connected object follow it (`controller/belt_tracking.py`).

Source: Application manual Conveyor tracking, "WaitWObj", "DropWObj".
"""

from __future__ import annotations

import math
from functools import partial

from rapidsim.language.annotations import Bool, Num, Pers, Var
from rapidsim.language.controller import Controller
from rapidsim.language.data import WobjData
from rapidsim.language.equipment import Conveyor
from rapidsim.language.error_numbers import (
    ERR_CNV_CONNECT,
    ERR_CNV_NOT_ACT,
    rapid_error,
)
from rapidsim.library.table import routine, table
from rapidsim.library.timing import report_timeout

_POLL_S = 0.012
"""Time [s] between two looks at a belt that signals may stop."""
_NO_CONVEYOR = "skipped: the station has no [[conveyor]] for its unit"


def wait_wobj(
    controller: Controller,
    wobj: Pers[WobjData],
    *,
    rel_dist: Num | None = None,
    max_time: Num | None = None,
    time_flag: Var[Bool] | None = None,
) -> None:
    """Wait until the next object has travelled a distance [mm], and connect the work object."""
    unit = wobj.value.ufmec
    conveyor = controller.equipment.conveyor(unit)
    if conveyor is None:
        controller.fidelity.not_simulated("WaitWObj", _NO_CONVEYOR)
        return
    if unit.lower() in controller.motion.settings.inactive_units:
        raise rapid_error(ERR_CNV_NOT_ACT, f"the conveyor {unit} is not active")
    if conveyor.is_connected:
        raise rapid_error(ERR_CNV_CONNECT, f"the work object of {unit} is connected already")
    now_s = controller.clock.now()
    comes_s = conveyor.next_s(now_s, rel_dist or 0.0)
    if comes_s is not None and conveyor.stops:
        arrives = partial(_has_arrived, controller, conveyor, rel_dist or 0.0)
        in_time = controller.signals.wait_until(arrives, max_time=max_time, poll_s=_POLL_S)
        if in_time:
            conveyor.connect(controller.clock.now())
        report_timeout(in_time, time_flag, f"WaitWObj {unit}", max_time)
        return
    wait_s = math.inf if comes_s is None else max(0.0, comes_s - now_s)
    limit_s = math.inf if max_time is None else max_time
    if wait_s > limit_s:
        controller.clock.wait(limit_s)
        report_timeout(False, time_flag, f"WaitWObj {unit}", max_time)
        return
    if comes_s is None:
        controller.signals.wait_until(lambda: False)
    controller.clock.wait(wait_s)
    conveyor.connect(controller.clock.now())
    report_timeout(True, time_flag, f"WaitWObj {unit}", max_time)


def _has_arrived(controller: Controller, conveyor: Conveyor, distance_mm: float) -> bool:
    now_s = controller.clock.now()
    comes_s = conveyor.next_s(now_s, distance_mm)
    return comes_s is not None and comes_s <= now_s


def drop_wobj(controller: Controller, wobj: Pers[WobjData]) -> None:
    """Disconnect the work object, so that the next object can be waited for."""
    conveyor = controller.equipment.conveyor(wobj.value.ufmec)
    if conveyor is None:
        controller.fidelity.not_simulated("DropWObj", _NO_CONVEYOR)
        return
    conveyor.drop(controller.clock.now() if conveyor.shows_connection else 0.0)


CONVEYORS = table(
    routine("WaitWObj", wait_wobj, r"WObj \RelDist \MaxTime \TimeFlag"),
    routine("DropWObj", drop_wobj),
)
