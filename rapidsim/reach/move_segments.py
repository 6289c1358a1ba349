"""Known moves as segments: what path planning takes, from how the arm stands at both ends."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rapidsim.controller.moves.move_data import GEOMETRY, speed_of, zone_of
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.moves import Move
from rapidsim.motion.configurations import targets
from rapidsim.motion.geometry.segments import WRIST_PAIRS, Segment, Waypoint
from rapidsim.motion.path.wrist_circle import start_on_circle
from rapidsim.motion.robot.robot import Robot
from rapidsim.reach.dataflow.circle_modes import led_by_wrist, mode_of
from rapidsim.reach.target_poses import PosedMoves


def segments_of(
    posed: PosedMoves,
    joints: Array,
    robot: Robot,
    base_from_world: Transform,
    rows: Sequence[int],
) -> list[Segment]:
    """Segments of moves whose start is known.

    Args:
        posed: The moves.
        joints: How the arm stands at the end of each move (k, n) [rad].
        robot: The arm.
        base_from_world: Where the world is.
        rows: The moves whose segments are wanted.
    """
    if not rows:
        return []
    at = np.array(rows)
    before = np.array([posed.moves[row].previous for row in rows], dtype=np.int64)
    tcp_from_flange = posed.tcp_from_flange[at]
    start = robot.forward(joints[before]) @ tcp_from_flange.inverse()
    branch = robot.kinematics.branch_of(joints[before])
    segments = []
    for position, row in enumerate(rows):
        known = posed.moves[row]
        mode, begin = mode_of(known, robot), start[position]
        if mode in WRIST_PAIRS:
            begin = start_on_circle(begin, _aim_of(posed, robot, int(before[position])))
        segments.append(
            Segment(
                index=position,
                geometry=GEOMETRY[known.move.interpolation],
                start=Waypoint(joints[before[position]], begin),
                end=Waypoint(joints[row], posed.base_from_tcp[row]),
                tcp_from_flange=tcp_from_flange[position],
                branch=int(branch[position]),
                speed=speed_of(known.move, known.settings),
                zone=zone_of(known.move),
                via=_via(known.move, base_from_world),
                duration=known.move.duration_s,
                circle_mode=mode,
            )
        )
    return segments


def _aim_of(posed: PosedMoves, robot: Robot, row: int) -> Array | None:
    """Where the z axis of the tool passes the plane at the end (3,) of an arc so led."""
    led = led_by_wrist(posed.moves[row], robot)
    return posed.base_from_tcp.translation[row] if led else None


def _via(move: Move, base_from_world: Transform) -> Transform | None:
    if move.circle_point is None:
        return None
    return targets.base_from_tcp(move.circle_point, move.wobj, base_from_world)
