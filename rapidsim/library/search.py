r"""Searching on a move: SearchL and SearchC.

The position found is that of the TCP at the instant of the flank, without the delays of a real
input. \Stop, \PStop and \SStop all brake on the path as fast as the axes can; a controller lets a
\Stop leave the path, and the run says so.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "SearchL".
"""

from __future__ import annotations

from typing import TypedDict, Unpack

from rapidsim.language.annotations import (
    Bool,
    IdentNo,
    InOut,
    Num,
    Pers,
    SignalDi,
    Switch,
)
from rapidsim.language.controller import Controller, Flank, Interpolation, Move, SearchStop
from rapidsim.language.data import (
    FINE,
    WOBJ0,
    LoadData,
    RobTarget,
    Signal,
    SpeedData,
    ToolData,
    WobjData,
)
from rapidsim.language.reference import Reference
from rapidsim.library.displacement import in_object, in_program
from rapidsim.library.honesty import ignored
from rapidsim.library.motion import speed_of
from rapidsim.library.table import routine, table


class SearchOptions(TypedDict, total=False):
    """How a search stops, what it waits for, and the options of its move."""

    stop: Switch
    p_stop: Switch
    s_stop: Switch
    sup: Switch
    flanks: Switch
    pos_flank: Switch
    neg_flank: Switch
    high_level: Switch
    low_level: Switch
    id_: IdentNo
    v: Num
    t: Num
    wobj: Pers[WobjData]
    corr: Switch
    tload: Pers[LoadData]


def search_l(
    controller: Controller,
    signal: InOut[SignalDi] | InOut[Bool],
    search_point: InOut[RobTarget],
    to_point: RobTarget,
    speed: SpeedData,
    tool: Pers[ToolData],
    **options: Unpack[SearchOptions],
) -> None:
    """Move the TCP on a straight line and keep where it was when a signal changed."""
    _search(controller, "SearchL", signal, search_point, None, to_point, speed, tool, options)


def search_c(
    controller: Controller,
    signal: InOut[SignalDi] | InOut[Bool],
    search_point: InOut[RobTarget],
    cir_point: RobTarget,
    to_point: RobTarget,
    speed: SpeedData,
    tool: Pers[ToolData],
    **options: Unpack[SearchOptions],
) -> None:
    """Move the TCP on an arc and keep where it was when a signal changed."""
    _search(controller, "SearchC", signal, search_point, cir_point, to_point, speed, tool, options)


def _search(
    controller: Controller,
    name: str,
    signal: Reference[Signal] | Reference[bool],
    search_point: Reference[RobTarget],
    cir_point: RobTarget | None,
    to_point: RobTarget,
    speed: SpeedData,
    tool: Reference[ToolData],
    options: SearchOptions,
) -> None:
    left_out = {r"\Corr": options.get("corr"), r"\TLoad": options.get("tload")}
    ignored(controller, name, {r"\ID": options.get("id_"), **left_out})
    if options.get("stop"):
        controller.not_simulated(rf"{name} \Stop", r"stops on the path, as \PStop")
    wobj = options.get("wobj")
    move = Move(
        name,
        Interpolation.LINE if cir_point is None else Interpolation.CIRCLE,
        in_object(controller, to_point),
        speed_of(speed, options.get("v")),
        FINE,
        tool.value,
        WOBJ0 if wobj is None else wobj.value,
        circle_point=None if cir_point is None else in_object(controller, cir_point),
        duration_s=options.get("t"),
    )
    if isinstance(signal.value, Signal):
        found = controller.search(move, signal.value.name, _flank(options), _stop(options))
    else:
        watched = signal
        found = controller.search(
            move, lambda: float(bool(watched.value)), _flank(options), _stop(options)
        )
    search_point.value = in_program(controller, found)


def _flank(options: SearchOptions) -> Flank:
    if options.get("flanks"):
        return Flank.EITHER
    if options.get("pos_flank"):
        return Flank.ONLY_RISING
    if options.get("neg_flank"):
        return Flank.ONLY_FALLING
    return Flank.FALLING if options.get("low_level") else Flank.RISING


def _stop(options: SearchOptions) -> SearchStop:
    if options.get("stop") or options.get("p_stop") or options.get("s_stop"):
        return SearchStop.STOP
    return SearchStop.GO_ON_ONCE if options.get("sup") else SearchStop.GO_ON


_WATCHED = (
    r"\Stop|\PStop|\SStop|\Sup Signal \Flanks|\PosFlank|\NegFlank|\HighLevel|\LowLevel SearchPoint"
)
_MOVE = r"ToPoint \ID Speed \V|\T Tool \WObj \Corr \TLoad"

SEARCH = table(
    routine("SearchL", search_l, f"{_WATCHED} {_MOVE}"),
    routine("SearchC", search_c, f"{_WATCHED} CirPoint {_MOVE}"),
)
