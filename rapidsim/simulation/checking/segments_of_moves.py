"""Known moves as segments: what path planning takes, from how the arm stands at both ends."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rapidsim.frames.transform import Transform
from rapidsim.language.controller import Interpolation, Move
from rapidsim.motion import targets
from rapidsim.motion.robot import Robot
from rapidsim.motion.segments import CircleMode, Segment, Waypoint
from rapidsim.simulation.checking.moves import KnownMove
from rapidsim.simulation.checking.poses import PosedMoves
from rapidsim.simulation.checking.stances import Stances
from rapidsim.simulation.move_data import CIRCLE_MODES, GEOMETRY, speed_of, zone_of


def segments_of(
    posed: PosedMoves,
    stances: Stances,
    robot: Robot,
    base_from_world: Transform,
    rows: Sequence[int],
) -> list[Segment]:
    """Segments of moves whose start is known; their end joints are those of the stance."""
    if not rows:
        return []
    at = np.array(rows)
    before = np.array([posed.moves[row].previous for row in rows], dtype=np.int64)
    start_joints = stances.joints[before]
    tcp_from_flange = posed.tcp_from_flange[at]
    start = robot.forward(start_joints) @ tcp_from_flange.inverse()
    branch = robot.kinematics.branch_of(start_joints)
    return [
        Segment(
            index=position,
            geometry=GEOMETRY[posed.moves[row].move.interpolation],
            start=Waypoint(start_joints[position], start[position]),
            end=Waypoint(stances.joints[row], posed.base_from_tcp[row]),
            tcp_from_flange=tcp_from_flange[position],
            branch=int(branch[position]),
            speed=speed_of(posed.moves[row].move, posed.moves[row].settings),
            zone=zone_of(posed.moves[row].move),
            via=_via(posed.moves[row].move, base_from_world),
            duration=posed.moves[row].move.duration_s,
            circle_mode=_circle_mode(posed.moves[row]),
        )
        for position, row in enumerate(rows)
    ]


def _circle_mode(known: KnownMove) -> CircleMode:
    mode = CIRCLE_MODES.get(known.settings.circle_path)
    on_arc = known.move.interpolation is Interpolation.CIRCLE
    return mode if mode is not None and on_arc else CircleMode.PATH_FRAME


def _via(move: Move, base_from_world: Transform) -> Transform | None:
    if move.circle_point is None:
        return None
    return targets.base_from_tcp(move.circle_point, move.wobj, base_from_world)
