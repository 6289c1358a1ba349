"""Known moves as path segments like those of a run, from the joints at both ends."""

from __future__ import annotations

import numpy as np

from rapidsim.controller.moves.move_request import MoveRequest
from rapidsim.controller.moves.segments import segment_of, segment_rows
from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.segment_rows import SegmentRows, WaypointRows
from rapidsim.motion.geometry.segments import Segment, Waypoint
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.wrist_circle import end_of_circle
from rapidsim.motion.robot.robot import Robot
from rapidsim.reach.dataflow.circle_modes import is_wrist_driven
from rapidsim.reach.target_poses import PosedMoves
from rapidsim.repeated_rows import Index


def segments_of(
    posed: PosedMoves, joints: Array, robot: Robot, model: MotionModel, rows: Index
) -> SegmentRows:
    """Return the segments of moves with known starts.

    Args:
        posed: The moves.
        joints: Joints at the end of each move (k, n) [rad].
        robot: The arm.
        model: Motion model, for the effect of the load on accelerations.
        rows: Rows of the requested moves.
    """
    moves, before = posed.moves, posed.moves.previous[rows]
    _, first, kind = np.unique(moves.tree_row[rows], return_index=True, return_inverse=True)

    def waypoints(at: Index) -> WaypointRows:
        poses = posed.curve_from_tcp[at]
        led = moves.each_of(at, lambda known: is_wrist_driven(known, robot))
        aims = {row: poses.translation[row] for row in np.flatnonzero(led).tolist()}
        return WaypointRows(joints[at], poses, posed.external[at], aims)

    return segment_rows(
        [_request(posed, row) for row in rows[first].tolist()],
        kind,
        waypoints(before),
        waypoints(rows),
        robot,
        payload_acceleration=model.payload_acceleration,
    )


def segment_of_row(
    posed: PosedMoves, joints: Array, robot: Robot, model: MotionModel, row: int
) -> Segment:
    """Return the segment of one move with a known start; see `segments_of`."""
    start, end = (_end(posed, joints, robot, at) for at in (int(posed.moves.previous[row]), row))
    share = model.payload_acceleration
    return segment_of(_request(posed, row), start, end, robot, payload_acceleration=share)


def _request(posed: PosedMoves, row: int) -> MoveRequest:
    known = posed.moves.like(row)
    return MoveRequest(known.move, known.settings, posed.placed(row))


def _end(posed: PosedMoves, joints: Array, robot: Robot, row: int) -> Waypoint:
    end = Waypoint(joints[row], posed.curve_from_tcp[row], posed.external[row])
    return end_of_circle(end) if is_wrist_driven(posed.moves.like(row), robot) else end
