"""The picking cycle of data sheets, 25 mm up, 300 mm across and 25 mm down and back, on an arm.

How makers program it is not published. With fly-by low points (z10) arms come nearest to figures of
data sheets; with stop points (`fine`) all are slower.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rapidsim.files import InputError, SourceFile
from rapidsim.motion.kinematics.closed_form.scara import Scara
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import value_class

_UP_MM, _ACROSS_MM = 25.0, 300.0
_PLACES = ((0.65, 0.2), (0.8, 0.2), (0.65, 0.45))
"""Middle of the cycle: distance from axis 1 and height, as shares of the reach."""
_CYCLES = 4
"""The third of these is steady: before it the arm speeds up, after it the last one ends."""
_MOVES = 6
"""Moves of one cycle."""
_LOAD_KG = 1.0


@value_class(frozen=True, slots=True)
class PickingCycle:
    """Times of the picking cycle at the fastest of three places."""

    load_kg: float
    fly_by_s: float
    """Time with z10 at the low points."""
    stop_s: float
    """Time with `fine` at the low points."""
    position_mm: tuple[float, float]
    """Place of the first: distance from axis 1 and height of the low points."""


def picking_cycle(robot: Robot, model: MotionModel | None = None) -> PickingCycle:
    """Run the picking cycle.

    Args:
        robot: An arm of the catalogue.
        model: Motion model; by default the latest.

    Raises:
        InputError: If the arm has no known reach or axis speeds, or cannot make the cycle.
    """
    if robot.reach_m is None:
        raise InputError(f"{robot.name}: no picking cycle, its reach is not known")
    known = robot.picking
    load_kg = _LOAD_KG if known is None else known.load_kg
    if robot.payload_kg is not None:
        load_kg = min(load_kg, robot.payload_kg)
    found: dict[str, list[tuple[float, tuple[float, float]]]] = {"z10": [], "fine": []}
    for place in _places(robot, 1000.0 * robot.reach_m):
        for zone, times in found.items():
            time_s = _cycle_time(robot, place, load_kg, zone, model or MotionModel())
            if time_s is not None:
                times.append((time_s, place))
    if not all(found.values()):
        raise InputError(f"{robot.name}: no picking cycle, the arm cannot make its lines")
    fly_by_s, place = min(found["z10"])
    return PickingCycle(load_kg, fly_by_s, min(found["fine"])[0], place)


def _places(robot: Robot, reach_mm: float) -> list[tuple[float, float]]:
    """Distance and height [mm] of the low points in the middle of the cycle, with the tool down."""
    if not isinstance(robot.kinematics, Scara):
        return [(ahead * reach_mm, up * reach_mm) for ahead, up in _PLACES]
    stroke = np.degrees(robot.lower[2] + robot.upper[2])
    height = 1000.0 * robot.kinematics.geometry.flange_up + 0.5 * float(stroke)
    return [(ahead * reach_mm, height) for ahead, _ in _PLACES[:2]]


def _cycle_time(
    robot: Robot, place: tuple[float, float], load_kg: float, zone: str, model: MotionModel
) -> float | None:
    """Time [s] of one steady cycle; None if the arm cannot make it."""
    from rapidsim.jobs.checking.checked_program import load
    from rapidsim.simulation.options import RunOptions
    from rapidsim.simulation.results.simulation import End
    from rapidsim.simulation.simulate import simulate

    loaded = load([SourceFile("cycle.mod", _program(place, load_kg, zone), "utf-8")])
    assert loaded.program is not None, loaded.diagnostics
    run = simulate(loaded.program, robot, options=replace(RunOptions(), model=model))
    if run.end is not End.ENDED:
        return None
    ends = [move.end_s for move in run.only.moves]
    steady = _MOVES * (_CYCLES - 2)
    return ends[steady + _MOVES] - ends[steady]


def _program(place: tuple[float, float], load_kg: float, zone: str) -> str:
    ahead, height = place

    def target(name: str, side: float, up: float) -> str:
        position = f"[{ahead:.3f},{side * 0.5 * _ACROSS_MM:.3f},{height + up:.3f}]"
        free = ",".join(["9E9"] * 6)
        return f"CONST robtarget {name}:=[{position},[0,0,1,0],[0,0,0,0],[{free}]];"

    cycle = [
        f"MoveL {to},v7000,{how},tLoad;"
        for to, how in (
            *(("a1", "z50"), ("b1", "z50"), ("b0", zone)),
            *(("b1", "z50"), ("a1", "z50"), ("a0", zone)),
        )
    ]
    return "\n".join(
        [
            "MODULE cycle",
            f"PERS tooldata tLoad:=[TRUE,[[0,0,0],[1,0,0,0]],"
            f"[{max(load_kg, 0.001):g},[0,0,50],[1,0,0,0],0,0,0]];",
            *(target(f"a{up > 0:d}", -1.0, up) for up in (0.0, _UP_MM)),
            *(target(f"b{up > 0:d}", 1.0, up) for up in (0.0, _UP_MM)),
            "PROC main()",
            r"ConfL\Off;",
            r"ConfJ\Off;",
            "MoveJ a0,v500,fine,tLoad;",
            *(cycle * _CYCLES),
            "MoveL a1,v100,fine,tLoad;",
            "ENDPROC",
            "ENDMODULE",
        ]
    )
