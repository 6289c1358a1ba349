"""The servo gripper of the two-armed IRB 14000 and the IRB 14050.

`g_GripIn` and `Hand_GripInward` are two names of one routine, and so on. A declaration of the
program hides an installed name. The fingers travel from 0 mm (closed) to 25 mm (open) at the speed
of `maxSpd`, without ramps; the force has no effect. At the start of a run they are closed and
calibrated, and their speed is 25 mm/s until `maxSpd` is set: unverified, no public source documents
the defaults.

The position of an object between the fingers is known only if the station file describes it in
`[[smart_gripper]]`. Otherwise they close fully, or to `targetPos`, which the run reports. Suction
cups set the outputs `hand_CmdVacuum1_R` and so on, if the cell has them; pressures are not
simulated.

Source: public programs for these robots; several agree on names, options and units.
"""

from __future__ import annotations

from collections.abc import Callable

from rapidsim.language.annotations import Bool, Num, Switch
from rapidsim.language.controller import ClockService, Controller
from rapidsim.language.equipment import SmartGripper
from rapidsim.language.error_numbers import ERR_HAND_FAILEDGRIPPOS, rapid_error
from rapidsim.language.errors import NotAllowed
from rapidsim.library.table import LibraryRoutine, routine, table
from rapidsim.library.traits import Trait

_GRIPPER = "the gripper"
_ALLOWANCE_MM = 2.0
"""Distance from `targetPos` within which an object counts as gripped. Unverified."""


def initialize(
    controller: SmartGripper,
    *,
    max_spd: Num | None = None,
    hold_force: Num | None = None,
    phy_limit: Num | None = None,
    calibrate: Switch = False,
) -> None:
    r"""Set speed [mm/s], force [N] and opening limit [mm]; with \Calibrate, also close."""
    _require_above_0("maxSpd", max_spd)
    _require_above_0("phyLimit", phy_limit)
    controller.adjust(speed_mm_s=max_spd, force_n=hold_force, limit_mm=phy_limit)
    if calibrate:
        _move(controller, 0.0)


def calibrate_fingers(
    controller: SmartGripper, *, grip: Switch = False, jog: Switch = False
) -> None:
    """Close the fingers and take this position as 0."""
    del grip, jog
    _move(controller, 0.0)


def grip_inward(
    controller: Controller,
    *,
    hold_force: Num | None = None,
    target_pos: Num | None = None,
    pos_allowance: Num | None = None,
    no_wait: Switch = False,
) -> None:
    """Close the fingers until they hold an object or are closed."""
    gripper = controller.smart_gripper
    gripper.adjust(force_n=hold_force)
    meets_mm = gripper.object_mm
    if meets_mm is None:
        meets_mm = _within(gripper, 0.0 if target_pos is None else target_pos)
        instead = "they close fully" if target_pos is None else "an object at `targetPos`"
        controller.fidelity.not_simulated(
            "what the fingers of the gripper meet",
            f"{instead}; [[smart_gripper]] in the station file describes an object",
        )
    # Fingers that are closer already touch the object.
    meets_mm = min(meets_mm, gripper.finger_position())
    _move(gripper, meets_mm, no_wait=no_wait)
    allowed_mm = _ALLOWANCE_MM if pos_allowance is None else pos_allowance
    if target_pos is not None and not no_wait and abs(meets_mm - target_pos) > allowed_mm:
        raise rapid_error(
            ERR_HAND_FAILEDGRIPPOS,
            f"the fingers rest at {meets_mm:g} mm, more than {allowed_mm:g} mm from {target_pos:g}",
        )


def grip_outward(
    controller: SmartGripper,
    *,
    hold_force: Num | None = None,
    target_pos: Num | None = None,
    pos_allowance: Num | None = None,
    no_wait: Switch = False,
) -> None:
    """Open the fingers fully, or to a position [mm]."""
    del pos_allowance
    controller.adjust(force_n=hold_force)
    to_mm = controller.limit_mm if target_pos is None else _within(controller, target_pos)
    _move(controller, to_mm, no_wait=no_wait)


def move_to(controller: Controller, target_pos: Num, *, no_wait: Switch = False) -> None:
    """Move the fingers to a position [mm]."""
    gripper = controller.smart_gripper
    to_mm = _within(gripper, target_pos)
    if to_mm != target_pos:
        controller.fidelity.not_simulated(
            f"a gripper position of {target_pos:g} mm", f"{to_mm:g} mm", is_unknown=True
        )
    _move(gripper, to_mm, no_wait=no_wait)


def jog_inward(controller: SmartGripper) -> None:
    """Close the fingers."""
    _move(controller, 0.0)


def jog_outward(controller: SmartGripper) -> None:
    """Open the fingers."""
    _move(controller, controller.limit_mm)


def set_max_speed(controller: SmartGripper, max_spd: Num) -> None:
    """Set the speed [mm/s] of the fingers."""
    _require_above_0("maxSpd", max_spd)
    controller.adjust(speed_mm_s=max_spd)


def set_hold_force(controller: SmartGripper, hold_force: Num) -> None:
    """Set the force [N] of the fingers; it has no effect."""
    controller.adjust(force_n=hold_force)


def stop_fingers(controller: SmartGripper) -> None:
    """Stop the fingers at their position."""
    controller.stop_fingers()


def wait_moving_completed(controller: SmartGripper) -> None:
    """Wait until the fingers are at rest."""
    controller.await_fingers()


def actual_position(controller: SmartGripper) -> Num:
    """Position [mm] of the fingers; 0 is closed."""
    return controller.finger_position()


def actual_speed(controller: SmartGripper) -> Num:
    """Speed [mm/s] of the fingers."""
    return controller.finger_speed()


def is_calibrated(controller: ClockService) -> Bool:
    """Whether the gripper is calibrated, which is always true in a run."""
    del controller
    return True


def _move(gripper: SmartGripper, to_mm: float, *, no_wait: bool = False) -> None:
    gripper.move_fingers(to_mm)
    if not no_wait:
        gripper.await_fingers()


def _air(signal: str, value: float, doing: str) -> Callable[..., None]:
    """Build the routine that switches an air line by its output."""

    def switch(controller: Controller) -> None:
        task = controller.tasks.task_name.upper()
        side = next((end for end in ("_L", "_R") if task.endswith(end)), "")
        name = f"hand_Cmd{signal}{side}"
        if not controller.signals.is_missing(name):
            controller.signals.write_signal(name, value)

    switch.__doc__ = f"{doing}: its output, where the cell has it."
    return switch


def _require_above_0(name: str, value: float | None) -> None:
    if value is not None and value <= 0.0:
        raise NotAllowed(f"{name} of {_GRIPPER} is {value:g}; it must be greater than 0")


def _within(gripper: SmartGripper, position_mm: float) -> float:
    return min(max(position_mm, 0.0), gripper.limit_mm)


_GRIP = r"\holdForce \targetPos \posAllowance \NoWait"
_OF_BOTH = (
    (("g_Init", "Hand_Initialize"), initialize, r"\maxSpd \holdForce \phyLimit \Calibrate"),
    (("g_Calibrate", "Hand_DoCalibrate"), calibrate_fingers, r"\Grip|\Jog"),
    (("g_GripIn", "Hand_GripInward"), grip_inward, _GRIP),
    (("g_GripOut", "Hand_GripOutward"), grip_outward, _GRIP),
    (("g_MoveTo", "Hand_MoveTo"), move_to, r"targetPos \NoWait"),
)
_PLAIN = (
    (("g_JogIn", "Hand_JogInward"), jog_inward, Trait.WAIT),
    (("g_JogOut", "Hand_JogOutward"), jog_outward, Trait.WAIT),
    (("g_SetMaxSpd", "Hand_SetMaxSpeed"), set_max_speed, Trait(0)),
    (("g_SetForce", "Hand_SetHoldForce"), set_hold_force, Trait(0)),
    (("g_Stop", "Hand_Stop"), stop_fingers, Trait(0)),
    (("Hand_WaitMovingCompleted",), wait_moving_completed, Trait.WAIT),
    (("g_GetPos", "Hand_GetActualPos"), actual_position, Trait.READ_TASK),
    (("g_GetSpd", "Hand_GetActualSpeed"), actual_speed, Trait.READ_TASK),
    (("g_IsCalibrated", "Hand_IsCalibrated"), is_calibrated, Trait.READ_TASK),
)


def _air_lines() -> list[LibraryRoutine]:
    rows = []
    for number in ("1", "2"):
        for short, long, signal in (("Vacuum", "Vacuum", "Vacuum"), ("Blow", "Blow", "Blowoff")):
            for on, value in (("On", 1.0), ("Off", 0.0)):
                doing = f"Switch {short.lower()} {number} {on.lower()}"
                body = _air(f"{signal}{number}", value, doing)
                for name in (f"g_{short}{on}{number}", f"Hand_Turn{on}{long}{number}"):
                    rows.append(routine(name, body, does=Trait.OUTPUT, takes_anything=True))
    return rows


SMART_GRIPPER = table(
    *(
        routine(name, body, order, does=Trait.WAIT)
        for names, body, order in _OF_BOTH
        for name in names
    ),
    *(routine(name, body, does=does) for names, body, does in _PLAIN for name in names),
    *_air_lines(),
)
