r"""Move instructions: they make a `Move` of their arguments and give it to the controller.

All moves are made here (`build_move`), also those of other chapters, which do more on their way.

Program displacement and offsets of external axes are applied here, so that the controller sees
targets in the work object. \V, \T and \Z replace what speed and zone say; \Inpos makes any zone a
stop point, with the times it gives.

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
    """What a move may have beside target, speed, zone and tool."""

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
    """The move that an instruction asks for; options that change nothing are reported.

    Args:
        controller: Of the task.
        name: The instruction.
        interpolation: How it moves.
        to: The target as the program gives it; axis positions with the offsets that count for them.
        speed: Without its option.
        zone: Likewise.
        tool: None where the instruction has none: then tool and work object in force count.
        options: All others that were given.
        sync_id: What the instruction makes of its option to move in step with other robots.
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
    """The body of a move to a pose that does nothing else."""

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
    """Move the external axes only; the robot stays where it is on them."""
    to = with_offsets(controller.motion, to_joint_pos, wanted=options.get("use_eoffs", False))
    how, sync_id = Interpolation.EXTERNAL_AXES, options.pop("id_", None)
    controller.motion.move(
        build_move(controller, "MoveExtJ", how, to, speed, zone, None, options, sync_id)
    )


def with_offsets(controller: Motion, to: JointTarget, *, wanted: bool) -> JointTarget:
    """Axis positions as the program gives them, with the offsets of external axes if wanted."""
    offsets = controller.settings.axis_offsets if wanted else None
    return JointTarget(to.robax, with_axis_offsets(to.extax, offsets))


def _stop(controller: FidelityReporter, inpos: StopPointData | None) -> StopTime | None:
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


def _speed(speed: SpeedData, v: float | None) -> SpeedData:
    r"""The speed of a move, with \V in it."""
    return speed if v is None else SpeedData(v, *speed[1:])


def _zone(zone: ZoneData, z: float | None, inpos: StopPointData | None) -> ZoneData:
    r"""The zone of a move, with \Z and \Inpos in it."""
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
"""The instruction that moves so and does nothing else."""
_WAYS: Mapping[str, tuple[Interpolation, str]] = MappingProxyType(
    {
        "J": (Interpolation.JOINT, "Move all axes together to a pose"),
        "L": (Interpolation.LINE, "Move the TCP on a straight line to a pose"),
        "C": (Interpolation.CIRCLE, "Move the TCP on an arc through a circle point to a pose"),
    }
)
"""By the letter in an instruction's name."""


def move_variants(
    name: str,
    body_of: Callable[[str, Interpolation], Callable[..., None]],
    order: str,
    suffix: str = "",
    interpolations: str = "JLC",
    does: Trait = NO_TRAITS,
    treated_as: str | None = None,
) -> Iterator[LibraryRoutine]:
    r"""The rows of an instruction that moves to a pose, one a way to move.

    Args:
        name: With `*` for the letter of the way, as in `Move*DO`.
        body_of: Makes the function, of the name and the way.
        order: That of the move on a line; an arc has a CirPoint more, a joint move no \Corr.
        suffix: What it does beside, to stand after how it moves.
        interpolations: The letters.
        does: The same for whoever asks, on all ways.
        treated_as: What is done instead, where they are not simulated with all they do.
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
