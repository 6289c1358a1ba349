r"""Searching on a move: SearchL, SearchC and SearchExtJ.

The position found is that of the TCP at the instant of the flank, without the delays of a real
input. \Stop, \PStop and \SStop all brake on the path as fast as the axes can; a controller lets a
\Stop leave the path, and the run says so.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "SearchL",
"SearchExtJ".
"""

from __future__ import annotations

from collections.abc import Callable
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
from rapidsim.language.controller import (
    Controller,
    Flank,
    Honesty,
    Interpolation,
    Move,
    SearchStop,
)
from rapidsim.language.data import (
    FINE,
    WOBJ0,
    JointTarget,
    LoadData,
    RobTarget,
    Signal,
    SpeedData,
    ToolData,
    WobjData,
)
from rapidsim.language.reference import Reference
from rapidsim.library.displacement import (
    in_object,
    in_program,
    with_axis_offsets,
    without_axis_offsets,
)
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


class AxisSearchOptions(TypedDict, total=False):
    """How a search of external axes stops, what it waits for, and the options of its move."""

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
    use_eoffs: Switch
    t: Num


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


def search_ext_j(
    controller: Controller,
    signal: InOut[SignalDi] | InOut[Bool],
    search_joint_pos: InOut[JointTarget],
    to_joint_pos: JointTarget,
    speed: SpeedData,
    **options: Unpack[AxisSearchOptions],
) -> None:
    """Move the external axes only and keep where all axes were when a signal changed."""
    _say_what_is_left_out(controller, "SearchExtJ", options)
    offsets = controller.settings.axis_offsets if options.get("use_eoffs") else None
    move = Move(
        "SearchExtJ",
        Interpolation.EXTERNAL_AXES,
        JointTarget(to_joint_pos.robax, with_axis_offsets(to_joint_pos.extax, offsets)),
        speed,
        FINE,
        controller.active_tool(),
        controller.active_wobj(),
        duration_s=options.get("t"),
    )
    found = controller.search_joints(move, _watched(signal), _flank(options), _stop(options))
    search_joint_pos.value = JointTarget(found.robax, without_axis_offsets(found.extax, offsets))


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
    _say_what_is_left_out(controller, name, options)
    left_out = {r"\Corr": options.get("corr"), r"\TLoad": options.get("tload")}
    ignored(controller, name, left_out)
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
    found = controller.search(move, _watched(signal), _flank(options), _stop(options))
    search_point.value = in_program(controller, found)


def _say_what_is_left_out(
    controller: Honesty, name: str, options: SearchOptions | AxisSearchOptions
) -> None:
    ignored(controller, name, {r"\ID": options.get("id_")})
    if options.get("stop"):
        controller.not_simulated(rf"{name} \Stop", r"stops on the path, as \PStop")


def _watched(signal: Reference[Signal] | Reference[bool]) -> Callable[[], float] | str:
    """What is watched: a signal by its name, or a persistent by a function that reads it."""
    if isinstance(signal.value, Signal):
        return signal.value.name
    return lambda: float(bool(signal.value))


def _flank(options: SearchOptions | AxisSearchOptions) -> Flank:
    if options.get("flanks"):
        return Flank.EITHER
    if options.get("pos_flank"):
        return Flank.ONLY_RISING
    if options.get("neg_flank"):
        return Flank.ONLY_FALLING
    return Flank.FALLING if options.get("low_level") else Flank.RISING


def _stop(options: SearchOptions | AxisSearchOptions) -> SearchStop:
    if options.get("stop") or options.get("p_stop") or options.get("s_stop"):
        return SearchStop.STOP
    return SearchStop.GO_ON_ONCE if options.get("sup") else SearchStop.GO_ON


_WATCHED = r"\Stop|\PStop|\SStop|\Sup Signal \Flanks|\PosFlank|\NegFlank|\HighLevel|\LowLevel"
_MOVE = r"ToPoint \ID Speed \V|\T Tool \WObj \Corr \TLoad"

SEARCH = table(
    routine("SearchL", search_l, f"{_WATCHED} SearchPoint {_MOVE}"),
    routine("SearchC", search_c, f"{_WATCHED} SearchPoint CirPoint {_MOVE}"),
    routine(
        "SearchExtJ",
        search_ext_j,
        rf"{_WATCHED} SearchJointPos ToJointPos \ID \UseEOffs Speed \T",
    ),
)
