"""Moves that set an output or call a procedure at their end, in the middle of its corner path.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "MoveLDO",
"MoveLAO", "MoveLGO", "MoveLSync".
"""

from __future__ import annotations

from typing import TypedDict, Unpack

from rapidsim.language.annotations import (
    DioNum,
    Dnum,
    IdentNo,
    Num,
    Pers,
    SignalAo,
    SignalDo,
    SignalGo,
    String,
    Var,
)
from rapidsim.language.controller import Controller, Interpolation, Move
from rapidsim.language.data import (
    WOBJ0,
    LoadData,
    RobTarget,
    Signal,
    SpeedData,
    ToolData,
    WobjData,
    ZoneData,
)
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.language.path_events import CallProcedure, SetOutput, Trigger
from rapidsim.language.reference import Reference
from rapidsim.library.displacement import in_object
from rapidsim.library.honesty import ignored
from rapidsim.library.signals import connected
from rapidsim.library.table import LibraryRoutine, routine, table


class MoveOptions(TypedDict, total=False):
    """What these instructions may have beside their required arguments."""

    id_: IdentNo
    t: Num
    wobj: Pers[WobjData]
    tload: Pers[LoadData]


class GroupValue(MoveOptions, total=False):
    """The value of a group, as one or the other number."""

    value: Num
    d_value: Dnum


def _ends_with(
    controller: Controller,
    name: str,
    action: SetOutput | CallProcedure,
    to_point: RobTarget,
    speed: SpeedData,
    zone: ZoneData,
    tool: Reference[ToolData],
    options: MoveOptions | GroupValue,
    cir_point: RobTarget | None = None,
) -> None:
    ignored(controller, name, {r"\ID": options.get("id_"), r"\TLoad": options.get("tload")})
    wobj = options.get("wobj")
    move = Move(
        name,
        _INTERPOLATION[name[4]],
        in_object(controller, to_point),
        speed,
        zone,
        tool.value,
        WOBJ0 if wobj is None else wobj.value,
        circle_point=None if cir_point is None else in_object(controller, cir_point),
        duration_s=options.get("t"),
    )
    controller.move(move, (Trigger(action),))


_INTERPOLATION = {
    "J": Interpolation.JOINT,
    "L": Interpolation.LINE,
    "C": Interpolation.CIRCLE,
}
"""By the fifth letter of the instruction."""


def _digital(signal: Reference[Signal], value: float) -> SetOutput:
    return SetOutput(connected(signal), 0.0 if value == 0.0 else 1.0)


def _analog(signal: Reference[Signal], value: float) -> SetOutput:
    return SetOutput(connected(signal), value)


def _group(signal: Reference[Signal], options: GroupValue) -> SetOutput:
    value = options.get("value")
    if value is None:
        value = options.get("d_value")
    if value is None:
        raise rapid_error(ERR_ARGVALERR, r"one of \Value and \DValue is needed")
    return SetOutput(connected(signal), value)


def _with_do(name: str) -> LibraryRoutine:
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
        action = _digital(signal, value)
        _ends_with(controller, name, action, to_point, speed, zone, tool, options)

    return routine(name, body, rf"{_TO_POINT} Signal Value \TLoad")


def _with_ao(name: str) -> LibraryRoutine:
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
        action = _analog(signal, value)
        _ends_with(controller, name, action, to_point, speed, zone, tool, options)

    return routine(name, body, rf"{_TO_POINT} Signal Value \TLoad")


def _with_go(name: str) -> LibraryRoutine:
    def body(
        controller: Controller,
        to_point: RobTarget,
        speed: SpeedData,
        zone: ZoneData,
        tool: Pers[ToolData],
        signal: Var[SignalGo],
        **options: Unpack[GroupValue],
    ) -> None:
        action = _group(signal, options)
        _ends_with(controller, name, action, to_point, speed, zone, tool, options)

    return routine(name, body, rf"{_TO_POINT} Signal \Value|\DValue \TLoad")


def _with_call(name: str) -> LibraryRoutine:
    def body(
        controller: Controller,
        to_point: RobTarget,
        speed: SpeedData,
        zone: ZoneData,
        tool: Pers[ToolData],
        proc_name: String,
        **options: Unpack[MoveOptions],
    ) -> None:
        action = CallProcedure(proc_name)
        _ends_with(controller, name, action, to_point, speed, zone, tool, options)

    return routine(name, body, rf"{_TO_POINT} ProcName \TLoad")


def move_c_do(
    controller: Controller,
    cir_point: RobTarget,
    to_point: RobTarget,
    speed: SpeedData,
    zone: ZoneData,
    tool: Pers[ToolData],
    signal: Var[SignalDo],
    value: DioNum,
    **options: Unpack[MoveOptions],
) -> None:
    """Move on an arc and set a digital output at its end."""
    action = _digital(signal, value)
    _ends_with(controller, "MoveCDO", action, to_point, speed, zone, tool, options, cir_point)


def move_c_ao(
    controller: Controller,
    cir_point: RobTarget,
    to_point: RobTarget,
    speed: SpeedData,
    zone: ZoneData,
    tool: Pers[ToolData],
    signal: Var[SignalAo],
    value: Num,
    **options: Unpack[MoveOptions],
) -> None:
    """Move on an arc and set an analog output at its end."""
    action = _analog(signal, value)
    _ends_with(controller, "MoveCAO", action, to_point, speed, zone, tool, options, cir_point)


def move_c_go(
    controller: Controller,
    cir_point: RobTarget,
    to_point: RobTarget,
    speed: SpeedData,
    zone: ZoneData,
    tool: Pers[ToolData],
    signal: Var[SignalGo],
    **options: Unpack[GroupValue],
) -> None:
    """Move on an arc and set a group of outputs at its end."""
    action = _group(signal, options)
    _ends_with(controller, "MoveCGO", action, to_point, speed, zone, tool, options, cir_point)


def move_c_sync(
    controller: Controller,
    cir_point: RobTarget,
    to_point: RobTarget,
    speed: SpeedData,
    zone: ZoneData,
    tool: Pers[ToolData],
    proc_name: String,
    **options: Unpack[MoveOptions],
) -> None:
    """Move on an arc and call a procedure at its end."""
    action = CallProcedure(proc_name)
    _ends_with(controller, "MoveCSync", action, to_point, speed, zone, tool, options, cir_point)


_TO_POINT = r"ToPoint \ID Speed \T Zone Tool \WObj"

OUTPUT_MOVES = table(
    _with_do("MoveJDO"),
    _with_do("MoveLDO"),
    routine("MoveCDO", move_c_do, rf"CirPoint {_TO_POINT} Signal Value \TLoad"),
    _with_ao("MoveJAO"),
    _with_ao("MoveLAO"),
    routine("MoveCAO", move_c_ao, rf"CirPoint {_TO_POINT} Signal Value \TLoad"),
    _with_go("MoveJGO"),
    _with_go("MoveLGO"),
    routine("MoveCGO", move_c_go, rf"CirPoint {_TO_POINT} Signal \Value|\DValue \TLoad"),
    _with_call("MoveJSync"),
    _with_call("MoveLSync"),
    routine("MoveCSync", move_c_sync, rf"CirPoint {_TO_POINT} ProcName \TLoad"),
)
