r"""Move instructions: they build a `Move` from their arguments and pass it to the controller.

`build_move` builds all moves, including the moves of other chapters with additional effects.

Program displacement and offsets of external axes are applied here, so that the controller receives
targets in the work object. \V, \T and \Z override the speed and zone data; \Inpos turns any zone
into a stop point with its times.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "MoveAbsJ",
"MoveC", "MoveExtJ", "MoveJ", "MoveL". That \Z scales the whole zone is our reading of "zonedata".
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType
from typing import TypedDict, Unpack

from rapidsim.language.annotations import IdentNo, Num, Pers, Switch
from rapidsim.language.controller import Controller, FidelityReporter, Motion
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
from rapidsim.language.moves import Interpolation, Move, StopTime
from rapidsim.language.reference import Reference
from rapidsim.language.single_precision import single
from rapidsim.library.displacement import in_object, with_axis_offsets
from rapidsim.library.fidelity_notes import note_ignored_options, reject_in_undo
from rapidsim.library.path_offset import offset
from rapidsim.library.table import LibraryRoutine, routine, table
from rapidsim.library.traits import NO_TRAITS, Trait


class MoveOptions(TypedDict, total=False):
    """Options of a move in addition to target, speed, zone and tool."""

    cir_point: RobTarget
    conc: Switch
    id_: IdentNo
    no_eoffs: Switch
    use_eoffs: Switch
    v: Num
    t: Num
    z: Num
    inpos: StopPointData
    wobj: Pers[WobjData]
    corr: Switch
    tload: Pers[LoadData]


def build_move(
    controller: Controller,
    name: str,
    interpolation: Interpolation,
    to: RobTarget | JointTarget,
    speed: SpeedData,
    zone: ZoneData,
    tool: Reference[ToolData] | None,
    options: MoveOptions,
    sync_id: float | None = None,
) -> Move:
    r"""Build the move of an instruction; options without effect are reported.

    Args:
        controller: Controller of the task.
        name: The instruction.
        interpolation: Interpolation of the move.
        to: The target as programmed; axis positions with the offsets that apply to them.
        speed: Speed data before \V is applied.
        zone: Zone data before \Z is applied.
        tool: None if the instruction has none: the active tool and work object apply.
        options: The remaining optional arguments.
        sync_id: The ID of the move for synchronized motion, from the option of the instruction.
    """
    reject_in_undo(controller, name)
    left_out = {
        r"\ID": options.get("id_"),
        r"\TLoad": options.get("tload"),
    }
    note_ignored_options(controller.fidelity, name, left_out)
    cir_point, wobj, inpos = options.get("cir_point"), options.get("wobj"), options.get("inpos")
    no_object = WOBJ0 if tool is not None else controller.motion.active_wobj()
    used_tool = controller.motion.active_tool() if tool is None else tool.value
    used_wobj = no_object if wobj is None else wobj.value
    programmed = None
    if isinstance(to, RobTarget):
        to = in_object(controller.motion, to)
        cir_point = None if cir_point is None else in_object(controller.motion, cir_point)
        if options.get("corr") and controller.motion.corrections:
            controller.fidelity.not_simulated(
                rf"{name} \Corr", "offset by what is written when the instruction executes"
            )
            programmed = to
            to, cir_point = offset(controller.motion, to, cir_point, used_tool, used_wobj)
    return Move(
        name,
        interpolation,
        to,
        _speed(speed, options.get("v")),
        _zone(zone, options.get("z"), inpos),
        used_tool,
        used_wobj,
        circle_point=cir_point,
        duration_s=options.get("t"),
        concurrent=options.get("conc", False),
        sync_id=sync_id,
        stop=_stop(controller.fidelity, inpos),
        programmed=programmed,
    )


def move(name: str, interpolation: Interpolation) -> Callable[..., None]:
    """Build the function of a move to a pose without further effects."""

    def body(
        controller: Controller,
        to_point: RobTarget,
        speed: SpeedData,
        zone: ZoneData,
        tool: Pers[ToolData],
        **options: Unpack[MoveOptions],
    ) -> None:
        sync_id = options.pop("id_", None)
        controller.motion.move(
            build_move(
                controller, name, interpolation, to_point, speed, zone, tool, options, sync_id
            )
        )

    return body


def move_abs_j(
    controller: Controller,
    to_joint_pos: JointTarget,
    speed: SpeedData,
    zone: ZoneData,
    tool: Pers[ToolData],
    **options: Unpack[MoveOptions],
) -> None:
    """Move all axes together to axis positions; program displacement has no effect."""
    to = with_offsets(controller.motion, to_joint_pos, wanted=not options.get("no_eoffs"))
    how, sync_id = Interpolation.AXES, options.pop("id_", None)
    controller.motion.move(
        build_move(controller, "MoveAbsJ", how, to, speed, zone, tool, options, sync_id)
    )


def move_ext_j(
    controller: Controller,
    to_joint_pos: JointTarget,
    speed: SpeedData,
    zone: ZoneData,
    **options: Unpack[MoveOptions],
) -> None:
    """Move the external axes only; the robot keeps its position on them."""
    move_external_axes(controller, "MoveExtJ", to_joint_pos, speed, zone, options)


def move_external_axes(
    controller: Controller,
    name: str,
    to_joint_pos: JointTarget,
    speed: SpeedData,
    zone: ZoneData,
    options: MoveOptions,
) -> None:
    """Move the external axes by an instruction of this name."""
    to = with_offsets(controller.motion, to_joint_pos, wanted=options.get("use_eoffs", False))
    how, sync_id = Interpolation.EXTERNAL_AXES, options.pop("id_", None)
    controller.motion.move(
        build_move(controller, name, how, to, speed, zone, None, options, sync_id)
    )


def with_offsets(controller: Motion, to: JointTarget, *, wanted: bool) -> JointTarget:
    """Programmed axis positions, with the offsets of external axes if wanted."""
    offsets = controller.settings.axis_offsets if wanted else None
    return JointTarget(to.robax, with_axis_offsets(to.extax, offsets))


def _stop(controller: FidelityReporter, inpos: StopPointData | None) -> StopTime | None:
    r"""Waiting times that \Inpos requests at the stop point; None if it requests none."""
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


def _speed(speed: SpeedData, v: float | None) -> SpeedData:
    r"""Speed data of a move with \V applied."""
    return speed if v is None else SpeedData(v, *speed[1:])


def _zone(zone: ZoneData, z: float | None, inpos: StopPointData | None) -> ZoneData:
    r"""Zone data of a move with \Z and \Inpos applied."""
    if inpos is not None:
        zone = ZoneData(True, *zone[1:])
    if z is None:
        return zone
    if zone.pzone_tcp <= 0.0:
        return zone._replace(pzone_tcp=z)
    scale = z / zone.pzone_tcp
    return ZoneData(zone.finep, z, *(single(size * scale) for size in zone[2:]))


PLAIN_MOVES: Mapping[Interpolation, str] = MappingProxyType(
    {
        Interpolation.JOINT: "MoveJ",
        Interpolation.AXES: "MoveAbsJ",
        Interpolation.EXTERNAL_AXES: "MoveExtJ",
        Interpolation.LINE: "MoveL",
        Interpolation.CIRCLE: "MoveC",
    }
)
"""Plain move instruction by interpolation."""
_WAYS: Mapping[str, tuple[Interpolation, str]] = MappingProxyType(
    {
        "J": (Interpolation.JOINT, "Move all axes together to a pose"),
        "L": (Interpolation.LINE, "Move the TCP on a straight line to a pose"),
        "C": (Interpolation.CIRCLE, "Move the TCP on an arc through a circle point to a pose"),
    }
)
"""Interpolation and description by the letter in an instruction's name."""


def move_variants(
    name: str,
    body_of: Callable[[str, Interpolation], Callable[..., None]],
    order: str,
    suffix: str = "",
    interpolations: str = "JLC",
    does: Trait = NO_TRAITS,
    treated_as: str | None = None,
) -> Iterator[LibraryRoutine]:
    r"""Yield the rows of an instruction that moves to a pose, one per interpolation.

    Args:
        name: Name with `*` for the letter of the interpolation, as in `Move*DO`.
        body_of: Builds the function from the name and the interpolation.
        order: Parameters of the linear move; an arc adds CirPoint, a joint move has no \Corr.
        suffix: Suffix of the description: what the move does in addition.
        interpolations: The letters.
        does: Traits of all variants.
        treated_as: The replacement, if the instructions are not simulated completely.
    """
    for letter in interpolations:
        own = name.replace("*", letter)
        interpolation, moves = _WAYS[letter]
        body = body_of(own, interpolation)
        body.__doc__ = f"{moves}{suffix}."
        if interpolation is Interpolation.JOINT:
            joint = order.replace(r" \Corr", "")
            yield routine(own, body, joint, does=does, treated_as=treated_as)
        elif interpolation is Interpolation.CIRCLE:
            to = order.replace("ToPoint", "CirPoint ToPoint")
            led = does | Trait.CARTESIAN
            yield routine(own, body, to, does=led, treated_as=treated_as)
        else:
            led = does | Trait.CARTESIAN
            yield routine(own, body, order, does=led, treated_as=treated_as)


_AFTER_POINT = r"Speed \V|\T Zone \Z \Inpos Tool \WObj"

MOTION = table(
    *move_variants("Move*", move, rf"\Conc ToPoint \ID {_AFTER_POINT} \Corr \TLoad"),
    routine("MoveAbsJ", move_abs_j, rf"\Conc ToJointPos \ID \NoEOffs {_AFTER_POINT} \TLoad"),
    routine("MoveExtJ", move_ext_j, r"\Conc ToJointPos \ID \UseEOffs Speed \T Zone \Inpos"),
)
