"""Conversion of moves to segments, the only one, for runs and reach checks alike."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from operator import is_

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
from rapidsim.motion.geometry.segments import (
    WRIST_PAIRS,
    CircleMode,
    Segment,
    Speed,
    Waypoint,
    Zone,
    with_carrier_axes,
)
from rapidsim.motion.path.wrist_circle import start_on_circle
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import value_class


def segments(
    requests: Sequence[MoveRequest],
    starts: Sequence[Waypoint],
    ends: Sequence[Waypoint],
    robot: Robot,
    *,
    payload_acceleration: float | None,
) -> tuple[Segment, ...]:
    """Segments of moves.

    Args:
        requests: The moves; each begins at its own start, independent of the others.
        starts: Position of the arm before each; their poses are ignored, because they may be of
            another tool.
        ends: End of each.
        robot: The arm.
        payload_acceleration: See `MotionModel`.
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
    asked = _parameters_of_all(requests, *of_robot)
    rows = zip(requests, asked, starts, begins, ends, branches, strict=True)
    return tuple(_segment(*one) for one in rows)


@value_class(frozen=True, slots=True, eq=False)
class _MoveParameters:
    """Parameters of a move except its target; most moves of a program have equal ones."""

    speed: Speed
    zone: Zone | None
    share: float
    load: float
    stop_ramp: float
    mode: CircleMode
    in_joints: bool
    external_linear: tuple[bool, ...]
    external_speeds: tuple[float, ...]


def _parameters_of_all(
    requests: Sequence[MoveRequest], robot: Robot, payload_acceleration: float | None
) -> Iterator[_MoveParameters]:
    last, of_last = None, None
    for request in requests:
        move, settings, carrier = request.move, request.settings, request.placed.carrier
        of = (move.interpolation, move.speed, move.zone, move.tool, settings, carrier)
        if of_last is None or last is None or not all(map(is_, of, of_last)):
            last, of_last = _parameters_of(request, robot, payload_acceleration), of
        yield last


def _parameters_of(
    request: MoveRequest, robot: Robot, payload_acceleration: float | None
) -> _MoveParameters:
    move, settings, placed = request.move, request.settings, request.placed
    share, load = acceleration_share_of(move, settings, robot.payload_kg, payload_acceleration)
    mode = circle_mode_of(move, settings, placed.carrier, robot)
    in_joints = wrist_asked_in_joints(move, settings) and can_turn_wrist_in_joints(move, robot)
    return _MoveParameters(
        speed_of(move, settings),
        zone_of(move),
        share,
        load,
        stop_ramp_of(settings),
        mode,
        in_joints and mode not in WRIST_PAIRS,
        tuple(axis.linear for axis in robot.external),
        external_speeds_of(move, settings, robot.external),
    )


def _segment(
    request: MoveRequest,
    parameters: _MoveParameters,
    start: Waypoint,
    begin: Transform,
    end: Waypoint,
    branch: int,
) -> Segment:
    move, settings, placed = request.move, request.settings, request.placed
    if parameters.mode in WRIST_PAIRS:
        begin = start_on_circle(begin, start.aim)
    via = move.circle_point
    segment = Segment(
        geometry=GEOMETRY[move.interpolation],
        start=Waypoint(start.joints, begin, start.external),
        end=end,
        tcp_from_flange=placed.tcp_from_flange,
        branch=branch,
        speed=parameters.speed,
        zone=parameters.zone,
        via=None if via is None else placed.curve_from_tcp(via),
        duration=move.duration_s,
        # Determined by the next move.
        joint_corner=False,
        acceleration_share=parameters.share,
        ramp=settings.ramp_percent / 100.0,
        stop_ramp=parameters.stop_ramp,
        carrier=placed.carrier,
        wrist_in_joints=parameters.in_joints,
        circle_mode=parameters.mode,
        tcp_acceleration=unbounded(settings.tcp_acceleration_m_s2),
        tcp_deceleration=unbounded(settings.tcp_deceleration_m_s2),
        world_acceleration=unbounded(settings.world_acceleration_m_s2),
        external_linear=parameters.external_linear,
        external_speeds=parameters.external_speeds,
        load=parameters.load,
    )
    return (
        segment if placed.carrier_axes is None else with_carrier_axes(segment, *placed.carrier_axes)
    )
