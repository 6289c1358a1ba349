"""From moves to segments: the one place that makes them, for a run and for a check of reach."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rapidsim.controller.moves.move_data import (
    GEOMETRY,
    acceleration_share_of,
    can_turn_wrist_in_joints,
    circle_mode_of,
    external_speeds_of,
    speed_of,
    stop_ramp_of,
    unbounded,
    wrist_asked_in_joints,
    zone_of,
)
from rapidsim.controller.moves.move_request import MoveRequest
from rapidsim.frames.transform import Transform
from rapidsim.motion.configurations import targets
from rapidsim.motion.geometry.segments import WRIST_PAIRS, Segment, Waypoint
from rapidsim.motion.path.wrist_circle import start_on_circle
from rapidsim.motion.robot.robot import Robot


def segments(
    requests: Sequence[MoveRequest],
    starts: Sequence[Waypoint],
    ends: Sequence[Waypoint],
    robot: Robot,
    *,
    payload_acceleration: float | None,
    first: int = 0,
) -> tuple[Segment, ...]:
    """Segments of moves.

    Args:
        requests: The moves; each starts where it is said, whatever the others do.
        starts: How the arm stands before each; the poses there do not count, as another tool may
            have had them.
        ends: Where each ends.
        robot: The arm.
        payload_acceleration: See `MotionModel`.
        first: Number of the first of them on the path.
    """
    if not requests:
        return ()
    placements = [request.placed for request in requests]
    begins = targets.standing_at(placements, robot.kinematics, starts)
    if len(starts) == 1:
        branches = [int(robot.kinematics.branch_of(starts[0].joints))]
    else:
        branches = robot.kinematics.branch_of(np.array([one.joints for one in starts])).tolist()
    of_robot = (robot, payload_acceleration)
    rows = zip(requests, starts, begins, ends, branches, strict=True)
    return tuple(_segment(first + row, *one, *of_robot) for row, one in enumerate(rows))


def _segment(
    index: int,
    request: MoveRequest,
    start: Waypoint,
    begin: Transform,
    end: Waypoint,
    branch: int,
    robot: Robot,
    payload_acceleration: float | None,
) -> Segment:
    move, settings, placed = request.move, request.settings, request.placed
    mode = circle_mode_of(move, settings, placed.carrier, robot)
    if mode in WRIST_PAIRS:
        begin = start_on_circle(begin, start.aim)
    in_joints = wrist_asked_in_joints(move, settings) and can_turn_wrist_in_joints(move, robot)
    via = move.circle_point
    share, load = acceleration_share_of(move, settings, robot.payload_kg, payload_acceleration)
    return Segment(
        index=index,
        geometry=GEOMETRY[move.interpolation],
        start=Waypoint(start.joints, begin, start.external),
        end=end,
        tcp_from_flange=placed.tcp_from_flange,
        branch=branch,
        speed=speed_of(move, settings),
        zone=zone_of(move),
        via=None if via is None else placed.curve_from_tcp(via),
        duration=move.duration_s,
        # Only the move after it tells.
        joint_corner=False,
        acceleration_share=share,
        ramp=settings.ramp_percent / 100.0,
        stop_ramp=stop_ramp_of(settings),
        carrier=placed.carrier,
        wrist_in_joints=in_joints and mode not in WRIST_PAIRS,
        circle_mode=mode,
        tcp_acceleration=unbounded(settings.tcp_acceleration_m_s2),
        tcp_deceleration=unbounded(settings.tcp_deceleration_m_s2),
        world_acceleration=unbounded(settings.world_acceleration_m_s2),
        external_linear=tuple(axis.linear for axis in robot.external),
        external_speeds=external_speeds_of(move, settings, robot.external),
        load=load,
    )
