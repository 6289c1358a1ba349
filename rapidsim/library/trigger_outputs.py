"""Moves with outputs that are named by text: TriggJIOs, TriggLIOs.

The values are arrays of records; an element is active while its `used` is TRUE. Positions on the
path and lags have the same meaning as in TriggEquip.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "TriggLIOs",
"triggios", "triggstrgo".
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Annotated, Unpack

from rapidsim.language.annotations import ParameterMode, Pers
from rapidsim.language.controller import Controller
from rapidsim.language.data import (
    RobTarget,
    SpeedData,
    ToolData,
    TriggIos,
    TriggIosDnum,
    TriggStrGo,
    ZoneData,
)
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.language.moves import Interpolation
from rapidsim.language.path_events import SetOutput, Trigger
from rapidsim.library.motion import MoveOptions, build_move, move_variants
from rapidsim.library.table import table


class OutputOptions(MoveOptions, total=False):
    """Arrays of outputs that a move sets on its path."""

    trigg_data1: Annotated[list[TriggIos], ParameterMode.VAR]
    trigg_data2: Annotated[list[TriggStrGo], ParameterMode.VAR]
    trigg_data3: Annotated[list[TriggIosDnum], ParameterMode.VAR]


def _trigg_ios(name: str, interpolation: Interpolation) -> Callable[..., None]:
    def body(
        controller: Controller,
        to_point: RobTarget,
        speed: SpeedData,
        zone: ZoneData,
        tool: Pers[ToolData],
        **options: Unpack[OutputOptions],
    ) -> None:
        rows: list[TriggIos | TriggStrGo | TriggIosDnum] = [
            *options.get("trigg_data1", ()),
            *options.get("trigg_data2", ()),
            *options.get("trigg_data3", ()),
        ]
        triggers = tuple(_triggers(name, rows))
        move = build_move(controller, name, interpolation, to_point, speed, zone, tool, options)
        controller.motion.move(move, triggers)

    return body


def _triggers(name: str, rows: Iterable[TriggIos | TriggStrGo | TriggIosDnum]) -> Iterable[Trigger]:
    for row in rows:
        if row.used:
            output = SetOutput(row.signalname, _value(name, row.setvalue))
            yield Trigger(output, row.distance, from_start=row.start, lag_s=row.equiplag)


def _value(name: str, value: float | str) -> float:
    """Value of an output, which may be a string of digits."""
    if not isinstance(value, str):
        return value
    if not value.isdecimal():
        raise rapid_error(ERR_ARGVALERR, f'{name}: setvalue "{value}" is not a number in digits')
    return float(value)


_OUTPUTS = r"ToPoint \ID Speed \T \TriggData1 \TriggData2 \TriggData3 Zone \Inpos Tool \WObj"

TRIGGER_OUTPUTS = table(
    *move_variants(
        "Trigg*IOs",
        _trigg_ios,
        rf"\Conc {_OUTPUTS} \Corr \TLoad",
        ", with outputs on the way",
        interpolations="JL",
    )
)
