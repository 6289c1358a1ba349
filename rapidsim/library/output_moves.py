"""Moves that set an output or call a procedure at their end, in the middle of its corner path.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "MoveLDO",
"MoveLAO", "MoveLGO", "MoveLSync".
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Unpack

from rapidsim.language.annotations import (
    DioNum,
    Dnum,
    Num,
    Pers,
    SignalAo,
    SignalDo,
    SignalGo,
    String,
    Var,
)
from rapidsim.language.controller import Controller
from rapidsim.language.data import RobTarget, SpeedData, ToolData, ZoneData
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.language.moves import Interpolation
from rapidsim.language.path_events import CallProcedure, SetOutput, Trigger
from rapidsim.library.motion import MoveOptions, build_move, move_variants
from rapidsim.library.signals import connected
from rapidsim.library.table import table
from rapidsim.library.traits import Trait


class GroupValue(MoveOptions, total=False):
    """Value of a group, as a num or a dnum."""

    value: Num
    d_value: Dnum


def _digital(name: str, interpolation: Interpolation) -> Callable[..., None]:
    def body(
        controller: Controller,
        to_point: RobTarget,
        speed: SpeedData,
        zone: ZoneData,
        tool: Pers[ToolData],
        signal: Var[SignalDo],
        value: DioNum,
        **options: Unpack[MoveOptions],
    ) -> None:
        at_end = Trigger(SetOutput(connected(signal), 0.0 if value == 0.0 else 1.0))
        move = build_move(controller, name, interpolation, to_point, speed, zone, tool, options)
        controller.motion.move(move, (at_end,))

    return body


def _analog(name: str, interpolation: Interpolation) -> Callable[..., None]:
    def body(
        controller: Controller,
        to_point: RobTarget,
        speed: SpeedData,
        zone: ZoneData,
        tool: Pers[ToolData],
        signal: Var[SignalAo],
        value: Num,
        **options: Unpack[MoveOptions],
    ) -> None:
        controller.signals.require_within(connected(signal), value)
        at_end = Trigger(SetOutput(connected(signal), value))
        move = build_move(controller, name, interpolation, to_point, speed, zone, tool, options)
        controller.motion.move(move, (at_end,))

    return body


def _group(name: str, interpolation: Interpolation) -> Callable[..., None]:
    def body(
        controller: Controller,
        to_point: RobTarget,
        speed: SpeedData,
        zone: ZoneData,
        tool: Pers[ToolData],
        signal: Var[SignalGo],
        **options: Unpack[GroupValue],
    ) -> None:
        value = options.get("value")
        if value is None:
            value = options.get("d_value")
        if value is None:
            raise rapid_error(ERR_ARGVALERR, r"one of \Value and \DValue is needed")
        controller.signals.require_within(connected(signal), value)
        at_end = Trigger(SetOutput(connected(signal), value))
        move = build_move(controller, name, interpolation, to_point, speed, zone, tool, options)
        controller.motion.move(move, (at_end,))

    return body


def _call(name: str, interpolation: Interpolation) -> Callable[..., None]:
    def body(
        controller: Controller,
        to_point: RobTarget,
        speed: SpeedData,
        zone: ZoneData,
        tool: Pers[ToolData],
        proc_name: String,
        **options: Unpack[MoveOptions],
    ) -> None:
        move = build_move(controller, name, interpolation, to_point, speed, zone, tool, options)
        controller.motion.move(move, (Trigger(CallProcedure(proc_name)),))

    return body


_MOVE = r"ToPoint \ID Speed \T Zone Tool \WObj"

OUTPUT_MOVES = table(
    *move_variants(
        "Move*DO", _digital, rf"{_MOVE} Signal Value \TLoad", " and set a digital output there"
    ),
    *move_variants(
        "Move*AO", _analog, rf"{_MOVE} Signal Value \TLoad", " and set an analog output there"
    ),
    *move_variants(
        "Move*GO",
        _group,
        rf"{_MOVE} Signal \Value|\DValue \TLoad",
        " and set a group of outputs there",
    ),
    *move_variants(
        "Move*Sync",
        _call,
        rf"{_MOVE} ProcName \TLoad",
        " and call a procedure there",
        does=Trait.CALL_ON_THE_WAY,
    ),
)
