r"""World zones: volumes of space, and ranges of the axes, that stop the robot or set an output.

\Temp and \Stat determine who may change a zone later; a run does not distinguish them.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "WZBoxDef",
"WZCylDef", "WZSphDef", "WZLimJointDef", "WZHomeJointDef", "WZLimSup", "WZDOSet".
"""

from __future__ import annotations

from rapidsim.language.annotations import DioNum, InOut, Num, ShapeData, SignalDo, Switch, Var
from rapidsim.language.data import JointTarget, Pos, RobJoint, WzStationary, WzTemporary
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.language.path_control import WorldZones
from rapidsim.language.path_events import AxisRange, Cuboid, Cylinder, Sphere, ZoneShape
from rapidsim.language.reference import Reference
from rapidsim.library.signals import connected
from rapidsim.library.table import routine, table


def wz_box_def(
    shape: Var[ShapeData],
    low_point: Pos,
    high_point: Pos,
    *,
    inside: Switch = False,
    outside: Switch = False,
) -> None:
    """Define a box by two opposite corners."""
    del inside
    shape.value = ZoneShape(Cuboid(low_point, high_point), outside)


def wz_cyl_def(
    shape: Var[ShapeData],
    centre_point: Pos,
    radius: Num,
    height: Num,
    *,
    inside: Switch = False,
    outside: Switch = False,
) -> None:
    """Define a cylinder above a point, or below it with a negative height."""
    del inside
    shape.value = ZoneShape(Cylinder(centre_point, radius, height), outside)


def wz_sph_def(
    shape: Var[ShapeData],
    centre_point: Pos,
    radius: Num,
    *,
    inside: Switch = False,
    outside: Switch = False,
) -> None:
    """Define a sphere."""
    del inside
    shape.value = ZoneShape(Sphere(centre_point, radius), outside)


def wz_lim_joint_def(
    shape: Var[ShapeData],
    low_joint_val: JointTarget,
    high_joint_val: JointTarget,
    *,
    inside: Switch = False,
    outside: Switch = False,
) -> None:
    """Define a range of the axes by its limits."""
    del inside
    shape.value = ZoneShape(AxisRange(low_joint_val, high_joint_val), outside)


def wz_home_joint_def(
    shape: Var[ShapeData],
    middle_joint_val: JointTarget,
    delta_joint_val: JointTarget,
    *,
    inside: Switch = False,
    outside: Switch = False,
) -> None:
    """Define a range of the axes around a position."""
    del inside
    middle, delta = middle_joint_val.robax, delta_joint_val.robax
    low = RobJoint(*(at - by for at, by in zip(middle, delta, strict=True)))
    high = RobJoint(*(at + by for at, by in zip(middle, delta, strict=True)))
    around = AxisRange(middle_joint_val._replace(robax=low), middle_joint_val._replace(robax=high))
    shape.value = ZoneShape(around, outside)


def wz_lim_sup(
    controller: WorldZones,
    world_zone: InOut[WzTemporary] | InOut[WzStationary],
    shape: Var[ShapeData],
    *,
    temp: Switch = False,
    stat: Switch = False,
) -> None:
    """Stop the robot when it enters a zone."""
    del temp, stat
    world_zone.value = WzTemporary(controller.watch_zone(_defined(shape), None))


def wz_do_set(
    controller: WorldZones,
    world_zone: InOut[WzTemporary] | InOut[WzStationary],
    shape: Var[ShapeData],
    signal: Var[SignalDo],
    set_value: DioNum,
    *,
    temp: Switch = False,
    stat: Switch = False,
    inside: Switch = False,
    before: Switch = False,
) -> None:
    """Set an output while the robot is in a zone; outside it has the opposite value."""
    del temp, stat, inside
    output = (connected(signal), 0.0 if set_value == 0.0 else 1.0)
    world_zone.value = WzTemporary(controller.watch_zone(_defined(shape), output, before=before))


def wz_enable(controller: WorldZones, world_zone: InOut[WzTemporary]) -> None:
    """Enable a zone."""
    controller.enable_zone(world_zone.value.wz, enabled=True)


def wz_disable(controller: WorldZones, world_zone: InOut[WzTemporary]) -> None:
    """Disable a zone."""
    controller.enable_zone(world_zone.value.wz, enabled=False)


def wz_free(controller: WorldZones, world_zone: InOut[WzTemporary]) -> None:
    """Delete a zone."""
    controller.free_zone(world_zone.value.wz)
    world_zone.value = WzTemporary(0.0)


def _defined(shape: Reference[ZoneShape | None]) -> ZoneShape:
    if shape.value is None:
        raise rapid_error(ERR_ARGVALERR, "the shape is not defined; WZBoxDef and others do that")
    return shape.value


_SIDE = r"\Inside|\Outside Shape"
_KIND = r"\Temp|\Stat WorldZone"

WORLD_ZONES = table(
    routine("WZBoxDef", wz_box_def, rf"{_SIDE} LowPoint HighPoint"),
    routine("WZCylDef", wz_cyl_def, rf"{_SIDE} CentrePoint Radius Height"),
    routine("WZSphDef", wz_sph_def, rf"{_SIDE} CentrePoint Radius"),
    routine("WZLimJointDef", wz_lim_joint_def, rf"{_SIDE} LowJointVal HighJointVal"),
    routine("WZHomeJointDef", wz_home_joint_def, rf"{_SIDE} MiddleJointVal DeltaJointVal"),
    routine("WZLimSup", wz_lim_sup, rf"{_KIND} Shape"),
    routine("WZDOSet", wz_do_set, rf"{_KIND} \Inside|\Before Shape Signal SetValue"),
    routine("WZEnable", wz_enable),
    routine("WZDisable", wz_disable),
    routine("WZFree", wz_free),
)
