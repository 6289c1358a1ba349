r"""Moves with places where something happens: TriggJ, TriggL, TriggC.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "TriggL".
"""

from __future__ import annotations

from typing import Annotated, TypedDict, Unpack

from rapidsim.language.annotations import (
    IdentNo,
    Mode,
    Num,
    Pers,
    Switch,
    TriggData,
    Var,
)
from rapidsim.language.controller import Controller, Interpolation, Move
from rapidsim.language.data import (
    WOBJ0,
    LoadData,
    RobTarget,
    SpeedData,
    StopPointData,
    ToolData,
    WobjData,
    ZoneData,
)
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.language.path_events import Trigger
from rapidsim.language.reference import Reference
from rapidsim.library.displacement import in_object
from rapidsim.library.honesty import ignored
from rapidsim.library.motion import speed_of, stop_of, zone_of
from rapidsim.library.table import routine, table

Triggers = Var[TriggData] | Annotated[list[TriggData], Mode.VAR]


class TriggerOptions(TypedDict, total=False):
    """What these instructions may have beside their required arguments."""

    conc: Switch
    id_: IdentNo
    t: Num
    t2: Var[TriggData]
    t3: Var[TriggData]
    t4: Var[TriggData]
    t5: Var[TriggData]
    t6: Var[TriggData]
    t7: Var[TriggData]
    t8: Var[TriggData]
    inpos: StopPointData
    wobj: Pers[WobjData]
    tload: Pers[LoadData]


def trigg_j(
    controller: Controller,
    to_point: RobTarget,
    speed: SpeedData,
    trigg_1: Triggers,
    zone: ZoneData,
    tool: Pers[ToolData],
    **options: Unpack[TriggerOptions],
) -> None:
    """Move all axes together to a pose, with triggers on the way."""
    _go(
        controller,
        "TriggJ",
        Interpolation.JOINT,
        to_point,
        None,
        speed,
        trigg_1,
        zone,
        tool,
        options,
    )


def trigg_l(
    controller: Controller,
    to_point: RobTarget,
    speed: SpeedData,
    trigg_1: Triggers,
    zone: ZoneData,
    tool: Pers[ToolData],
    *,
    corr: Switch = False,
    **options: Unpack[TriggerOptions],
) -> None:
    """Move the TCP on a straight line to a pose, with triggers on the way."""
    ignored(controller, "TriggL", {r"\Corr": corr})
    _go(
        controller,
        "TriggL",
        Interpolation.LINE,
        to_point,
        None,
        speed,
        trigg_1,
        zone,
        tool,
        options,
    )


def trigg_c(
    controller: Controller,
    cir_point: RobTarget,
    to_point: RobTarget,
    speed: SpeedData,
    trigg_1: Triggers,
    zone: ZoneData,
    tool: Pers[ToolData],
    *,
    corr: Switch = False,
    **options: Unpack[TriggerOptions],
) -> None:
    """Move the TCP on an arc through a circle point to a pose, with triggers on the way."""
    ignored(controller, "TriggC", {r"\Corr": corr})
    circle = Interpolation.CIRCLE
    _go(controller, "TriggC", circle, to_point, cir_point, speed, trigg_1, zone, tool, options)


def _go(
    controller: Controller,
    name: str,
    interpolation: Interpolation,
    to_point: RobTarget,
    cir_point: RobTarget | None,
    speed: SpeedData,
    first: Reference[Trigger | None] | list[Trigger | None],
    zone: ZoneData,
    tool: Reference[ToolData],
    options: TriggerOptions,
) -> None:
    triggers = _triggers(name, first, options)
    move_with_triggers(
        controller,
        name,
        interpolation,
        to_point,
        cir_point,
        speed,
        zone,
        tool,
        options,
        triggers,
    )


def move_with_triggers(
    controller: Controller,
    name: str,
    interpolation: Interpolation,
    to_point: RobTarget,
    cir_point: RobTarget | None,
    speed: SpeedData,
    zone: ZoneData,
    tool: Reference[ToolData],
    options: TriggerOptions,
    triggers: tuple[Trigger, ...],
) -> None:
    """Put a move on the path with what happens on its way."""
    ignored(controller, name, {r"\ID": options.get("id_"), r"\TLoad": options.get("tload")})
    wobj, inpos = options.get("wobj"), options.get("inpos")
    move = Move(
        name,
        interpolation,
        in_object(controller, to_point),
        speed_of(speed, None),
        zone_of(zone, None, inpos),
        tool.value,
        WOBJ0 if wobj is None else wobj.value,
        circle_point=None if cir_point is None else in_object(controller, cir_point),
        duration_s=options.get("t"),
        concurrent=options.get("conc", False),
        stop=stop_of(controller, inpos),
    )
    controller.move(move, triggers)


def _triggers(
    name: str,
    first: Reference[Trigger | None] | list[Trigger | None],
    options: TriggerOptions,
) -> tuple[Trigger, ...]:
    """The triggers that are given; in an array those that mean nothing are left out."""
    if isinstance(first, list):
        return tuple(trigger for trigger in first if trigger is not None)
    more = (options.get(key) for key in ("t2", "t3", "t4", "t5", "t6", "t7", "t8"))
    given = [first, *(one for one in more if one is not None)]
    triggers = []
    for number, reference in enumerate(given, start=1):
        trigger = reference.value  # type: ignore[attr-defined]
        if trigger is None:
            raise rapid_error(
                ERR_ARGVALERR,
                f"{name}: trigger {number} is not defined; TriggIO and others do that",
            )
        triggers.append(trigger)
    return tuple(triggers)


_TRIGGERS = r"Trigg_1 \T2 \T3 \T4 \T5 \T6 \T7 \T8 Zone \Inpos Tool \WObj"

TRIGGER_MOVES = table(
    routine("TriggJ", trigg_j, rf"\Conc ToPoint \ID Speed \T {_TRIGGERS} \TLoad"),
    routine("TriggL", trigg_l, rf"\Conc ToPoint \ID Speed \T {_TRIGGERS} \Corr \TLoad"),
    routine("TriggC", trigg_c, rf"\Conc CirPoint ToPoint \ID Speed \T {_TRIGGERS} \Corr \TLoad"),
)
