r"""Searching on a move: SearchL, SearchC and SearchExtJ.

The position found is that of the TCP at the instant of the flank, without the delays of a real
input. \Stop brakes as fast as the axes can, \SStop more gently, and \PStop most gently. All of
them stay on the path, which a controller's \Stop leaves by a millimetre or two.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "SearchL",
"SearchExtJ".
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Unpack

from rapidsim.language.annotations import Bool, InOut, Pers, SignalDi, Switch
from rapidsim.language.controller import Controller
from rapidsim.language.data import FINE, JointTarget, RobTarget, Signal, SpeedData, ToolData
from rapidsim.language.errors import NotAllowed
from rapidsim.language.moves import Flank, Interpolation, Move, SearchStop
from rapidsim.language.reference import Reference
from rapidsim.library.displacement import in_program, with_axis_offsets, without_axis_offsets
from rapidsim.library.motion import MoveOptions, build_move, move_variants
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait

STIFF_STOP_MM_S = 100.0
r"""Maximum speed [mm/s] of a search that \Stop may end.

Source: event 41539 of RobotWare 5.15 stops the program above a speed; the number is from memory of
"SearchL", unverified.
"""
_STOPS = {
    "stop": SearchStop.STIFFLY,
    "s_stop": SearchStop.SOFTLY,
    "p_stop": SearchStop.ON_PATH,
}


class SearchOptions(MoveOptions, total=False):
    """Options of a search: its stop mode and the flank that it waits for."""

    stop: Switch
    p_stop: Switch
    s_stop: Switch
    sup: Switch
    flanks: Switch
    pos_flank: Switch
    neg_flank: Switch
    high_level: Switch
    low_level: Switch


def _search(name: str, interpolation: Interpolation) -> Callable[..., None]:
    def body(
        controller: Controller,
        signal: InOut[SignalDi] | InOut[Bool],
        search_point: InOut[RobTarget],
        to_point: RobTarget,
        speed: SpeedData,
        tool: Pers[ToolData],
        **options: Unpack[SearchOptions],
    ) -> None:
        move = build_move(controller, name, interpolation, to_point, speed, FINE, tool, options)
        stop = _stop(options)
        _require_slow(name, move, options)
        found = controller.searches.search(move, _stop_condition(signal), _flank(options), stop)
        search_point.value = in_program(controller.motion, found)

    return body


def search_ext_j(
    controller: Controller,
    signal: InOut[SignalDi] | InOut[Bool],
    search_joint_pos: InOut[JointTarget],
    to_joint_pos: JointTarget,
    speed: SpeedData,
    **options: Unpack[SearchOptions],
) -> None:
    """Move the external axes only and store the positions of all axes when a signal changes."""
    name, way = "SearchExtJ", Interpolation.EXTERNAL_AXES
    offsets = controller.motion.settings.axis_offsets if options.get("use_eoffs") else None
    to = JointTarget(to_joint_pos.robax, with_axis_offsets(to_joint_pos.extax, offsets))
    move = build_move(controller, name, way, to, speed, FINE, None, options)
    stop = _stop(options)
    found = controller.searches.search_joints(move, _stop_condition(signal), _flank(options), stop)
    search_joint_pos.value = JointTarget(found.robax, without_axis_offsets(found.extax, offsets))


def _stop_condition(signal: Reference[Signal] | Reference[bool]) -> Callable[[], float] | str:
    """Condition of a search: the name of a signal, or a function that reads a persistent."""
    if isinstance(signal.value, Signal):
        return signal.value.name
    return lambda: float(bool(signal.value))


def _flank(options: SearchOptions) -> Flank:
    if options.get("flanks"):
        return Flank.EITHER
    if options.get("pos_flank"):
        return Flank.ONLY_RISING
    if options.get("neg_flank"):
        return Flank.ONLY_FALLING
    return Flank.FALLING if options.get("low_level") else Flank.RISING


def _require_slow(name: str, move: Move, options: SearchOptions) -> None:
    """Check that a search is slow enough for a stop that leaves the path."""
    if options.get("stop") and move.speed.v_tcp > STIFF_STOP_MM_S:
        raise NotAllowed(
            rf"{name} \Stop at {move.speed.v_tcp:g} mm/s: at most {STIFF_STOP_MM_S:g} are allowed; "
            r"\PStop and \SStop stop on the path"
        )


def _stop(options: SearchOptions) -> SearchStop:
    for option, stop in _STOPS.items():
        if options.get(option):
            return stop
    return SearchStop.GO_ON_ONCE if options.get("sup") else SearchStop.GO_ON


_WATCHED = r"\Stop|\PStop|\SStop|\Sup Signal \Flanks|\PosFlank|\NegFlank|\HighLevel|\LowLevel"

SEARCH = table(
    *move_variants(
        "Search*",
        _search,
        rf"{_WATCHED} SearchPoint ToPoint \ID Speed \V|\T Tool \WObj \Corr \TLoad",
        " and keep where it was when a signal changed",
        interpolations="LC",
        does=Trait.SEARCH,
    ),
    routine(
        "SearchExtJ",
        search_ext_j,
        rf"{_WATCHED} SearchJointPos ToJointPos \ID \UseEOffs Speed \T",
        does=Trait.SEARCH,
    ),
)
