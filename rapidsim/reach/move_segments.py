"""Known moves as path segments like those of a run, from the joints at both ends."""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.controller.moves.move_request import MoveRequest
from rapidsim.controller.moves.segments import segments
from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.segments import Segment, Waypoint
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.wrist_circle import end_of_circle
from rapidsim.motion.robot.robot import Robot
from rapidsim.reach.dataflow.circle_modes import is_wrist_driven
from rapidsim.reach.target_poses import PosedMoves


def segments_of(
    posed: PosedMoves, joints: Array, robot: Robot, model: MotionModel, rows: Sequence[int]
) -> tuple[Segment, ...]:
    """Return the segments of moves with known starts.

    Args:
        posed: The moves.
        joints: Joints at the end of each move (k, n) [rad].
        robot: The arm.
        model: Motion model, for the effect of the load on accelerations.
        rows: Rows of the requested moves.
    """
    ends: dict[int, Waypoint] = {}
    starts, requests = [], []
    for row in rows:
        known = posed.moves[row]
        assert known.previous is not None
        for at in (known.previous, row):
            if at not in ends:
                ends[at] = _end(posed, joints, robot, at)
        starts.append(ends[known.previous])
        requests.append(MoveRequest(known.move, known.settings, posed.placed[row]))
    to = [ends[row] for row in rows]
    share = model.payload_acceleration
    return segments(requests, starts, to, robot, payload_acceleration=share)


def _end(posed: PosedMoves, joints: Array, robot: Robot, row: int) -> Waypoint:
    end = Waypoint(joints[row], posed.curve_from_tcp[row], posed.external[row])
    return end_of_circle(end) if is_wrist_driven(posed.moves[row], robot) else end
