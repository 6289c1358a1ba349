r"""Move instructions: they make a `Move` of their arguments and give it to the controller.

Program displacement and offsets of external axes are applied here, so that the controller sees
targets in the work object. \V, \T and \Z replace what speed and zone say; \Inpos makes any zone a
stop point, with the times it gives.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "MoveAbsJ",
"MoveC", "MoveExtJ", "MoveJ", "MoveL". That \Z scales the whole zone is our reading of "zonedata".
"""

from __future__ import annotations

from rapidsim.language.annotations import IdentNo, Num, Pers, Switch
from rapidsim.language.controller import Controller, Interpolation, Move, StopTime
from rapidsim.language.data import (
    WOBJ0,
    JointTarget,
    LoadData,
    RobTarget,
    SpeedData,
    StopPointData,
    ToolData,
    WobjData,
    ZoneData,
)
from rapidsim.language.single import single
from rapidsim.library.displacement import in_object, with_axis_offsets
from rapidsim.library.honesty import ignored
from rapidsim.library.table import routine, table


def move_j(
    controller: Controller,
    to_point: RobTarget,
    speed: SpeedData,
    zone: ZoneData,
    tool: Pers[ToolData],
    *,
    conc: Switch = False,
    id_: IdentNo | None = None,
    v: Num | None = None,
    t: Num | None = None,
    z: Num | None = None,
    inpos: StopPointData | None = None,
    wobj: Pers[WobjData] | None = None,
    tload: Pers[LoadData] | None = None,
) -> None:
    """Move all axes together to a pose."""
    ignored(controller, "MoveJ", {r"\TLoad": tload})
    controller.move(
        Move(
            "MoveJ",
            Interpolation.JOINT,
            in_object(controller, to_point),
            speed_of(speed, v),
            zone_of(zone, z, inpos),
            tool.value,
            WOBJ0 if wobj is None else wobj.value,
            duration_s=t,
            concurrent=conc,
            sync_id=id_,
            stop=stop_of(controller, inpos),
        )
    )


def move_l(
    controller: Controller,
    to_point: RobTarget,
    speed: SpeedData,
    zone: ZoneData,
    tool: Pers[ToolData],
    *,
    conc: Switch = False,
    id_: IdentNo | None = None,
    v: Num | None = None,
    t: Num | None = None,
    z: Num | None = None,
    inpos: StopPointData | None = None,
    wobj: Pers[WobjData] | None = None,
    corr: Switch = False,
    tload: Pers[LoadData] | None = None,
) -> None:
    """Move the TCP on a straight line to a pose."""
    ignored(controller, "MoveL", {r"\Corr": corr, r"\TLoad": tload})
    controller.move(
        Move(
            "MoveL",
            Interpolation.LINE,
            in_object(controller, to_point),
            speed_of(speed, v),
            zone_of(zone, z, inpos),
            tool.value,
            WOBJ0 if wobj is None else wobj.value,
            duration_s=t,
            concurrent=conc,
            sync_id=id_,
            stop=stop_of(controller, inpos),
        )
    )


def move_c(
    controller: Controller,
    cir_point: RobTarget,
    to_point: RobTarget,
    speed: SpeedData,
    zone: ZoneData,
    tool: Pers[ToolData],
    *,
    conc: Switch = False,
    id_: IdentNo | None = None,
    v: Num | None = None,
    t: Num | None = None,
    z: Num | None = None,
    inpos: StopPointData | None = None,
    wobj: Pers[WobjData] | None = None,
    corr: Switch = False,
    tload: Pers[LoadData] | None = None,
) -> None:
    """Move the TCP on an arc through a circle point to a pose."""
    ignored(controller, "MoveC", {r"\Corr": corr, r"\TLoad": tload})
    controller.move(
        Move(
            "MoveC",
            Interpolation.CIRCLE,
            in_object(controller, to_point),
            speed_of(speed, v),
            zone_of(zone, z, inpos),
            tool.value,
            WOBJ0 if wobj is None else wobj.value,
            circle_point=in_object(controller, cir_point),
            duration_s=t,
            concurrent=conc,
            sync_id=id_,
            stop=stop_of(controller, inpos),
        )
    )


def move_abs_j(
    controller: Controller,
    to_joint_pos: JointTarget,
    speed: SpeedData,
    zone: ZoneData,
    tool: Pers[ToolData],
    *,
    conc: Switch = False,
    id_: IdentNo | None = None,
    no_eoffs: Switch = False,
    v: Num | None = None,
    t: Num | None = None,
    z: Num | None = None,
    inpos: StopPointData | None = None,
    wobj: Pers[WobjData] | None = None,
    tload: Pers[LoadData] | None = None,
) -> None:
    """Move all axes together to axis positions; program displacement has no effect."""
    ignored(controller, "MoveAbsJ", {r"\TLoad": tload})
    offsets = None if no_eoffs else controller.settings.axis_offsets
    controller.move(
        Move(
            "MoveAbsJ",
            Interpolation.AXES,
            JointTarget(to_joint_pos.robax, with_axis_offsets(to_joint_pos.extax, offsets)),
            speed_of(speed, v),
            zone_of(zone, z, inpos),
            tool.value,
            WOBJ0 if wobj is None else wobj.value,
            duration_s=t,
            concurrent=conc,
            sync_id=id_,
            stop=stop_of(controller, inpos),
        )
    )


def move_ext_j(
    controller: Controller,
    to_joint_pos: JointTarget,
    speed: SpeedData,
    zone: ZoneData,
    *,
    conc: Switch = False,
    id_: IdentNo | None = None,
    use_eoffs: Switch = False,
    t: Num | None = None,
    inpos: StopPointData | None = None,
) -> None:
    """Move the external axes only; the robot stays where it is on them."""
    ignored(controller, "MoveExtJ", {})
    offsets = controller.settings.axis_offsets if use_eoffs else None
    controller.move(
        Move(
            "MoveExtJ",
            Interpolation.EXTERNAL_AXES,
            JointTarget(to_joint_pos.robax, with_axis_offsets(to_joint_pos.extax, offsets)),
            speed,
            zone_of(zone, None, inpos),
            controller.active_tool(),
            controller.active_wobj(),
            duration_s=t,
            concurrent=conc,
            sync_id=id_,
            stop=stop_of(controller, inpos),
        )
    )


def stop_of(controller: Controller, inpos: StopPointData | None) -> StopTime | None:
    r"""What \Inpos asks for beside the stop itself."""
    if inpos is None:
        return None
    match inpos.type:
        case 1.0:
            return StopTime(inpos.inpos.mintime, inpos.progsynch)
        case 2.0:
            return StopTime(inpos.stoptime, inpos.progsynch)
        case _:
            controller.not_simulated(r"\Inpos that follows a conveyor", "a stop point")
            return None


def speed_of(speed: SpeedData, v: float | None) -> SpeedData:
    r"""The speed of a move, with \V in it."""
    return speed if v is None else SpeedData(v, *speed[1:])


def zone_of(zone: ZoneData, z: float | None, inpos: StopPointData | None) -> ZoneData:
    r"""The zone of a move, with \Z and \Inpos in it."""
    if inpos is not None:
        zone = ZoneData(True, *zone[1:])
    if z is None:
        return zone
    if zone.pzone_tcp <= 0.0:
        return zone._replace(pzone_tcp=z)
    scale = z / zone.pzone_tcp
    return ZoneData(zone.finep, z, *(single(size * scale) for size in zone[2:]))


_AFTER_POINT = r"Speed \V|\T Zone \Z \Inpos Tool \WObj"

MOTION = table(
    routine("MoveJ", move_j, rf"\Conc ToPoint \ID {_AFTER_POINT} \TLoad"),
    routine("MoveL", move_l, rf"\Conc ToPoint \ID {_AFTER_POINT} \Corr \TLoad"),
    routine("MoveC", move_c, rf"\Conc CirPoint ToPoint \ID {_AFTER_POINT} \Corr \TLoad"),
    routine("MoveAbsJ", move_abs_j, rf"\Conc ToJointPos \ID \NoEOffs {_AFTER_POINT} \TLoad"),
    routine("MoveExtJ", move_ext_j, r"\Conc ToJointPos \ID \UseEOffs Speed \T Zone \Inpos"),
)
