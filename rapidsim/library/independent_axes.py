"""Independent axes: turntables and similar axes that turn while the robot executes other moves.

Their times and the results of IndInpos and IndSpeed are simulated. In path and recording such an
axis keeps its position, which each run reports.

Source: Application manual Controller software, "Independent Axes"; Technical reference manual RAPID
Instructions, Functions and Data types, "IndAMove" to "IndSpeed".
"""

from __future__ import annotations

from dataclasses import replace

from rapidsim.language.annotations import Bool, MecUnit, Num, Switch, Var
from rapidsim.language.controller import Controller
from rapidsim.language.data import ExtJoint, RobTarget
from rapidsim.language.equipment import IndependentAxis, MechanicalUnitFacts
from rapidsim.language.error_numbers import (
    ERR_ARGVALERR,
    ERR_AXIS_ACT,
    ERR_AXIS_IND,
    ERR_AXIS_MOVING,
    ERR_AXIS_PAR,
    rapid_error,
)
from rapidsim.library.mechanical_units import unit_named
from rapidsim.library.table import routine, table

_TREATED_AS = "a separately timed motion; path and recording show the axis at rest"
_TURN = 360.0


def ind_a_move(
    controller: Controller,
    mec_unit: Var[MecUnit],
    axis: Num,
    speed: Num,
    *,
    to_abs_pos: RobTarget | None = None,
    to_abs_num: Num | None = None,
    ramp: Num | None = None,
) -> None:
    """Send an independent axis to a position."""
    moved, unit, now_s = _make_independent(controller, "IndAMove", mec_unit, axis)
    target = _position("IndAMove", unit, axis, to_abs_pos, to_abs_num)
    moved.move_to(target, _forward("IndAMove", speed), _acceleration(moved, ramp), now_s)


def ind_r_move(
    controller: Controller,
    mec_unit: Var[MecUnit],
    axis: Num,
    speed: Num,
    *,
    to_rel_pos: RobTarget | None = None,
    to_rel_num: Num | None = None,
    short: Switch = False,
    fwd: Switch = False,
    bwd: Switch = False,
    ramp: Num | None = None,
) -> None:
    """Turn an independent axis to a position within one revolution."""
    del short
    moved, unit, now_s = _make_independent(controller, "IndRMove", mec_unit, axis)
    if not moved.turns:
        raise rapid_error(ERR_AXIS_PAR, f"IndRMove: axis {axis:g} of {unit.name} does not turn")
    at = moved.position(now_s)
    on = (_position("IndRMove", unit, axis, to_rel_pos, to_rel_num) - at) % _TURN
    back = on - _TURN if on else 0.0
    nearer = on if on <= -back else back
    way = on if fwd else back if bwd else nearer
    moved.move_to(at + way, _forward("IndRMove", speed), _acceleration(moved, ramp), now_s)


def ind_d_move(
    controller: Controller,
    mec_unit: Var[MecUnit],
    axis: Num,
    delta: Num,
    speed: Num,
    *,
    ramp: Num | None = None,
) -> None:
    """Move an independent axis by a distance from its position."""
    moved, _, now_s = _make_independent(controller, "IndDMove", mec_unit, axis)
    moved.move_to(
        moved.position(now_s) + delta,
        _forward("IndDMove", speed),
        _acceleration(moved, ramp),
        now_s,
    )


def ind_c_move(
    controller: Controller,
    mec_unit: Var[MecUnit],
    axis: Num,
    speed: Num,
    *,
    ramp: Num | None = None,
) -> None:
    """Let an independent axis move continuously, backwards at a negative speed."""
    moved, _, now_s = _make_independent(controller, "IndCMove", mec_unit, axis)
    moved.move_at(speed, _acceleration(moved, ramp), now_s)


def ind_reset(
    controller: Controller,
    mec_unit: Var[MecUnit],
    axis: Num,
    *,
    ref_pos: RobTarget | None = None,
    ref_num: Num | None = None,
    short: Switch = False,
    fwd: Switch = False,
    bwd: Switch = False,
    old: Switch = False,
) -> None:
    """Return an axis, which must be at rest, to the control of the path."""
    del ref_pos, ref_num, short, fwd, bwd, old
    unit, one = _axis(controller, "IndReset", mec_unit, axis)
    now_s = controller.clock.now()
    if one.is_independent and one.speed(now_s):
        raise rapid_error(ERR_AXIS_MOVING, f"IndReset: axis {axis:g} of {unit.name} moves")
    one.release()
    _leave_out(controller, unit, unit.axes[int(axis) - 1], left_out=False)


def ind_inpos(controller: Controller, mec_unit: Var[MecUnit], axis: Num) -> Bool:
    """Whether an independent axis has reached its target."""
    return _independent(controller, "IndInpos", mec_unit, axis).is_at_target(controller.clock.now())


def ind_speed(
    controller: Controller,
    mec_unit: Var[MecUnit],
    axis: Num,
    *,
    in_speed: Switch = False,
    zero_speed: Switch = False,
) -> Bool:
    """Whether an independent axis moves at its speed or, with ZeroSpeed, is at rest."""
    del in_speed
    one = _independent(controller, "IndSpeed", mec_unit, axis)
    now_s = controller.clock.now()
    return one.speed(now_s) == 0.0 if zero_speed else one.has_speed(now_s)


def _make_independent(
    controller: Controller, name: str, mec_unit: Var[MecUnit], axis: float
) -> tuple[IndependentAxis, MechanicalUnitFacts, float]:
    """Return the axis, now independent; its unit; and the time [s]."""
    unit, one = _axis(controller, name, mec_unit, axis)
    controller.fidelity.not_simulated(name, _TREATED_AS)
    joints = controller.motion.current_joints()
    at = unit.axes[int(axis) - 1]
    now_s = controller.clock.now()
    one.take(joints.robax[at] if unit.is_robot else joints.extax[at], now_s)
    _leave_out(controller, unit, at, left_out=True)
    return one, unit, now_s


def _leave_out(
    controller: Controller, unit: MechanicalUnitFacts, at: int, *, left_out: bool
) -> None:
    """Exclude an axis from targets, or include it again."""
    if unit.is_robot:
        return
    settings = controller.motion.settings
    component = frozenset({ExtJoint._fields[at]})
    axes = settings.independent_axes
    axes = axes | component if left_out else axes - component
    controller.motion.settings = replace(settings, independent_axes=axes)


def _independent(
    controller: Controller, name: str, mec_unit: Var[MecUnit], axis: float
) -> IndependentAxis:
    unit, one = _axis(controller, name, mec_unit, axis)
    if not one.is_independent:
        raise rapid_error(
            ERR_AXIS_IND, f"{name}: axis {axis:g} of {unit.name} is not in independent mode"
        )
    return one


def _axis(
    controller: Controller, name: str, mec_unit: Var[MecUnit], axis: float
) -> tuple[MechanicalUnitFacts, IndependentAxis]:
    unit = unit_named(controller, mec_unit, "mecunit")
    if not 1 <= axis <= len(unit.axes):
        raise rapid_error(
            ERR_AXIS_PAR,
            f"{name}: {unit.name} has {len(unit.axes)} axes; {axis:g} is none of them",
        )
    if not unit.is_active:
        raise rapid_error(ERR_AXIS_ACT, f"{name}: {unit.name} is not active; ActUnit activates it")
    return unit, controller.equipment.independent_axis(unit, int(axis))


def _position(
    name: str,
    unit: MechanicalUnitFacts,
    axis: float,
    target: RobTarget | None,
    number: float | None,
) -> float:
    if number is not None:
        return number
    if target is None or unit.is_robot:
        raise rapid_error(ERR_ARGVALERR, f"{name} needs a position of the axis")
    return target.extax[unit.axes[int(axis) - 1]]


def _forward(name: str, speed: float) -> float:
    if speed <= 0.0:
        raise rapid_error(ERR_ARGVALERR, f"{name}: the speed is {speed:g}, not above 0")
    return speed


def _acceleration(moved: IndependentAxis, ramp: float | None) -> float:
    return moved.acceleration * (100.0 if ramp is None else ramp) / 100.0


_SETS = ("independent_axes",)

INDEPENDENT_AXES = table(
    routine("IndAMove", ind_a_move, r"MecUnit Axis \ToAbsPos|\ToAbsNum Speed \Ramp", sets=_SETS),
    routine(
        "IndRMove",
        ind_r_move,
        r"MecUnit Axis \ToRelPos|\ToRelNum \Short|\Fwd|\Bwd Speed \Ramp",
        sets=_SETS,
    ),
    routine("IndDMove", ind_d_move, r"MecUnit Axis Delta Speed \Ramp", sets=_SETS),
    routine("IndCMove", ind_c_move, r"MecUnit Axis Speed \Ramp", sets=_SETS),
    routine(
        "IndReset", ind_reset, r"MecUnit Axis \RefPos|\RefNum \Short|\Fwd|\Bwd|\Old", sets=_SETS
    ),
    routine("IndInpos", ind_inpos, "MecUnit Axis"),
    routine("IndSpeed", ind_speed, r"MecUnit Axis \InSpeed|\ZeroSpeed"),
)
