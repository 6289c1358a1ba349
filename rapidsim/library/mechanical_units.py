r"""Mechanical units: their names, and the positions of their axes.

A robot of a run has no motors: torques are 0, which the run reports.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "GetNextMechUnit",
"GetMecUnitName", "GetJointData".
"""

from __future__ import annotations

from typing import Any

from rapidsim.language.annotations import Bool, MecUnit, Num, String, Var
from rapidsim.language.controller import Controller
from rapidsim.language.data import JointTarget
from rapidsim.language.equipment import MechanicalUnitFacts
from rapidsim.language.error_numbers import ERR_AXIS_PAR, rapid_error
from rapidsim.language.reference import Reference
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait

_THE_ROBOT = "rob_id"
"""Name of the task's own robot, folded."""


def get_next_mech_unit(
    controller: Controller,
    list_number: Var[Num],
    unit_name: Var[String],
    *,
    mec_ref: Var[MecUnit] | None = None,
    tcp_rob: Var[Bool] | None = None,
    no_of_axes: Var[Num] | None = None,
    mec_task_no: Var[Num] | None = None,
    mot_plan_no: Var[Num] | None = None,
    active: Var[Bool] | None = None,
    drive_module: Var[Num] | None = None,
    ok_to_deact: Var[Bool] | None = None,
) -> Bool:
    """The next mechanical unit of the system, by list number from 0; FALSE after the last."""
    units = controller.equipment.system_units()
    number = int(list_number.value)
    if not 0 <= number < len(units):
        return False
    unit = units[number]
    list_number.value, unit_name.value = float(number + 1), unit.name
    told: list[tuple[Reference[Any] | None, object]] = [
        (mec_ref, unit.name),
        (tcp_rob, unit.is_robot),
        (no_of_axes, float(len(unit.axes))),
        (mec_task_no, float(unit.task_number)),
        (mot_plan_no, float(unit.robot_number)),
        (active, unit.is_active),
        (drive_module, 1.0),
        (ok_to_deact, not unit.is_robot),
    ]
    for reference, value in told:
        if reference is not None:
            reference.value = value
    return True


def get_mec_unit_name(controller: Controller, mech_unit: Var[MecUnit]) -> String:
    """The name of a mechanical unit."""
    return unit_named(controller, mech_unit).name


def get_joint_data(
    controller: Controller,
    axis: Num,
    *,
    mech_unit: Var[MecUnit] | None = None,
    position: Var[Num] | None = None,
    speed: Var[Num] | None = None,
    torque: Var[Num] | None = None,
    ext_torque: Var[Num] | None = None,
) -> None:
    """The position [deg or mm] and speed of an axis; its torques are not simulated."""
    unit = unit_named(controller, mech_unit)
    if not 1 <= axis <= len(unit.axes):
        raise rapid_error(
            ERR_AXIS_PAR, f"{unit.name} has axes 1 to {len(unit.axes)}; {axis:g} is none of them"
        )
    at = unit.axes[int(axis) - 1]
    if position is not None:
        position.value = _of_axis(controller.motion.current_joints(), unit, at)
    if speed is not None:
        speed.value = _of_axis(controller.motion.current_speeds(), unit, at)
    for name, given in ((r"\Torque", torque), (r"\ExtTorque", ext_torque)):
        if given is not None:
            controller.fidelity.not_simulated(f"GetJointData {name}", "0")
            given.value = 0.0


def _of_axis(joints: JointTarget, unit: MechanicalUnitFacts, at: int) -> float:
    return joints.robax[at] if unit.is_robot else joints.extax[at]


def unit_named(
    controller: Controller, reference: Reference[object] | None, parameter: str = "mechunit"
) -> MechanicalUnitFacts:
    """Mechanical unit that an argument names; the robot without an argument."""
    units = controller.equipment.mechanical_units()
    name = _THE_ROBOT
    if reference is not None:
        written = controller.clock.place.arguments.get(parameter, "")
        name = reference.value if isinstance(reference.value, str) else written
    if name.lower() == _THE_ROBOT:
        name = next((unit.name for unit in units if unit.is_robot), name)
    named = (unit for unit in units if unit.name.lower() == name.lower())
    return next(named, MechanicalUnitFacts(name, False, ()))


def system_unit_named(
    controller: Controller, reference: Reference[object], parameter: str = "mechunit"
) -> MechanicalUnitFacts:
    """Unit of any task that an argument names; without axes if no task has it."""
    own = unit_named(controller, reference, parameter)
    wanted = own.name.lower()
    units = (unit for unit in controller.equipment.system_units() if unit.name.lower() == wanted)
    return own if own.axes else next(units, own)


_FACTS = r"\MecRef \TCPRob \NoOfAxes \MecTaskNo \MotPlanNo \Active \DriveModule \OKToDeact"

MECHANICAL_UNITS = table(
    routine(
        "GetNextMechUnit",
        get_next_mech_unit,
        rf"ListNumber UnitName {_FACTS}",
        does=Trait.READ_TASK,
    ),
    routine("GetMecUnitName", get_mec_unit_name, does=Trait.READ_TASK),
    routine(
        "GetJointData",
        get_joint_data,
        r"\MechUnit Axis \Position \Speed \Torque \ExtTorque",
        does=Trait.READ_TASK,
    ),
)
