"""Moves whose outputs are named by text: TriggJIOs, TriggLIOs.

The values are arrays of records; an element counts while its `used` is TRUE. A place of the path
and a lag work as those of TriggEquip.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "TriggLIOs",
"triggios", "triggstrgo".
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, TypedDict, Unpack

from rapidsim.language.annotations import IdentNo, Mode, Num, Pers, Switch
from rapidsim.language.controller import Controller, Interpolation
from rapidsim.language.data import (
    LoadData,
    RobTarget,
    SpeedData,
    StopPointData,
    ToolData,
    TriggIos,
    TriggIosDnum,
    TriggStrGo,
    WobjData,
    ZoneData,
)
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.language.path_events import SetOutput, Trigger
from rapidsim.language.reference import Reference
from rapidsim.library.honesty import ignored
from rapidsim.library.table import routine, table
from rapidsim.library.trigger_moves import TriggerOptions, move_with_triggers


class OutputOptions(TypedDict, total=False):
    """What these instructions may have beside their required arguments."""

    conc: Switch
    id_: IdentNo
    t: Num
    trigg_data1: Annotated[list[TriggIos], Mode.VAR]
    trigg_data2: Annotated[list[TriggStrGo], Mode.VAR]
    trigg_data3: Annotated[list[TriggIosDnum], Mode.VAR]
    inpos: StopPointData
    wobj: Pers[WobjData]
    tload: Pers[LoadData]


def trigg_j_ios(
    controller: Controller,
    to_point: RobTarget,
    speed: SpeedData,
    zone: ZoneData,
    tool: Pers[ToolData],
    **options: Unpack[OutputOptions],
) -> None:
    """Move all axes together to a pose, with outputs on the way."""
    _go(controller, "TriggJIOs", Interpolation.JOINT, to_point, speed, zone, tool, options)


def trigg_l_ios(
    controller: Controller,
    to_point: RobTarget,
    speed: SpeedData,
    zone: ZoneData,
    tool: Pers[ToolData],
    *,
    corr: Switch = False,
    **options: Unpack[OutputOptions],
) -> None:
    """Move the TCP on a straight line to a pose, with outputs on the way."""
    ignored(controller, "TriggLIOs", {r"\Corr": corr})
    _go(controller, "TriggLIOs", Interpolation.LINE, to_point, speed, zone, tool, options)


def _go(
    controller: Controller,
    name: str,
    interpolation: Interpolation,
    to_point: RobTarget,
    speed: SpeedData,
    zone: ZoneData,
    tool: Reference[ToolData],
    options: OutputOptions,
) -> None:
    rows: list[TriggIos | TriggStrGo | TriggIosDnum] = [
        *options.get("trigg_data1", ()),
        *options.get("trigg_data2", ()),
        *options.get("trigg_data3", ()),
    ]
    triggers = tuple(_triggers(name, rows))
    own = {"trigg_data1", "trigg_data2", "trigg_data3"}
    shared: TriggerOptions = {k: v for k, v in options.items() if k not in own}  # type: ignore[assignment]
    move_with_triggers(
        controller, name, interpolation, to_point, None, speed, zone, tool, shared, triggers
    )


def _triggers(name: str, rows: Iterable[TriggIos | TriggStrGo | TriggIosDnum]) -> Iterable[Trigger]:
    for row in rows:
        if row.used:
            output = SetOutput(row.signalname, _value(name, row.setvalue))
            yield Trigger(output, row.distance, from_start=row.start, lag_s=row.equiplag)


def _value(name: str, value: float | str) -> float:
    """The value of an output, also where it is written in digits."""
    if not isinstance(value, str):
        return value
    if not value.isdecimal():
        raise rapid_error(ERR_ARGVALERR, f'{name}: setvalue "{value}" is no number in digits')
    return float(value)


_OUTPUTS = r"ToPoint \ID Speed \T \TriggData1 \TriggData2 \TriggData3 Zone \Inpos Tool \WObj"

TRIGGER_OUTPUTS = table(
    routine("TriggJIOs", trigg_j_ios, rf"\Conc {_OUTPUTS} \TLoad"),
    routine("TriggLIOs", trigg_l_ios, rf"\Conc {_OUTPUTS} \Corr \TLoad"),
)
