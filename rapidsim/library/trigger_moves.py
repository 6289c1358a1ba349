r"""Moves with triggers on their path: TriggJ, TriggL, TriggC, TriggAbsJ.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "TriggL".
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Unpack

from rapidsim.language.annotations import ParameterMode, Pers, TriggData, Var
from rapidsim.language.controller import Controller
from rapidsim.language.data import JointTarget, RobTarget, SpeedData, ToolData, ZoneData
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.language.moves import Interpolation
from rapidsim.language.path_events import Trigger
from rapidsim.language.reference import Reference
from rapidsim.library.motion import MoveOptions, build_move, move_variants, with_offsets
from rapidsim.library.table import routine, table

Triggers = Var[TriggData] | Annotated[list[TriggData], ParameterMode.VAR]


class TriggerOptions(MoveOptions, total=False):
    """Triggers after the first."""

    t2: Var[TriggData]
    t3: Var[TriggData]
    t4: Var[TriggData]
    t5: Var[TriggData]
    t6: Var[TriggData]
    t7: Var[TriggData]
    t8: Var[TriggData]


def _trigg(name: str, interpolation: Interpolation) -> Callable[..., None]:
    def body(
        controller: Controller,
        to_point: RobTarget,
        speed: SpeedData,
        trigg_1: Triggers,
        zone: ZoneData,
        tool: Pers[ToolData],
        **options: Unpack[TriggerOptions],
    ) -> None:
        triggers, sync_id = _triggers(name, trigg_1, options), options.pop("id_", None)
        move = build_move(
            controller, name, interpolation, to_point, speed, zone, tool, options, sync_id
        )
        controller.motion.move(move, triggers)

    return body


def trigg_abs_j(
    controller: Controller,
    to_joint_pos: JointTarget,
    speed: SpeedData,
    trigg_1: Triggers,
    zone: ZoneData,
    tool: Pers[ToolData],
    **options: Unpack[TriggerOptions],
) -> None:
    """Move all axes together to axis positions, with triggers on the path."""
    name, way = "TriggAbsJ", Interpolation.AXES
    triggers, sync_id = _triggers(name, trigg_1, options), options.pop("id_", None)
    to = with_offsets(controller.motion, to_joint_pos, wanted=not options.get("no_eoffs"))
    move = build_move(controller, name, way, to, speed, zone, tool, options, sync_id)
    controller.motion.move(move, triggers)


def _triggers(
    name: str,
    first: Reference[Trigger | None] | list[Trigger | None],
    options: TriggerOptions,
) -> tuple[Trigger, ...]:
    """The triggers of a call; undefined elements of an array are skipped."""
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
    *move_variants(
        "Trigg*",
        _trigg,
        rf"\Conc ToPoint \ID Speed \T {_TRIGGERS} \Corr \TLoad",
        ", with triggers on the way",
    ),
    routine(
        "TriggAbsJ",
        trigg_abs_j,
        rf"\Conc ToJointPos \ID \NoEOffs Speed \T {_TRIGGERS} \TLoad",
    ),
)
