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
from rapidsim.motion.geometry.segment_rows import SegmentRows, WaypointRows
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
from rapidsim.repeated_rows import Index
from rapidsim.values import value_class


def segment_of(
    request: MoveRequest,
    start: Waypoint,
    end: Waypoint,
    robot: Robot,
    *,
    payload_acceleration: float | None,
) -> Segment:
    """Segment of a move.

    Args:
        request: The move.
        start: Position of the arm before it; its pose is ignored, because it may be of another
            tool.
        end: Its end.
        robot: The arm.
        payload_acceleration: See `MotionModel`.
    """
    kinematics, placed = robot.kinematics, request.placed
    begin = placed.standing_at(kinematics, start.joints, start.external, at_start=True)
    branch = int(kinematics.branch_of(start.joints))
    parameters = _parameters_of(request, robot, payload_acceleration)
    return _segment(request, parameters, start, begin, end, branch)


def segment_rows(
    requests: Sequence[MoveRequest],
    kind: Index,
    starts: WaypointRows,
    ends: WaypointRows,
    robot: Robot,
    *,
    payload_acceleration: float | None,
) -> SegmentRows:
    """Segments of moves (m,), each independent of the others.

    Args:
        requests: Moves, to which the others are equal but for their targets.
        kind: Index (m,) of that move.
        starts: Positions of the arm before each; see `segment_of`.
        ends: End of each.
        robot: The arm.
        payload_acceleration: See `MotionModel`.
    """
    kinematics = robot.kinematics
    placements = [request.placed for request in requests]
    begins = targets.standing_at(placements, kind, kinematics, starts.joints, starts.external)
    branch: Index = kinematics.branch_of(starts.joints)
    asked = _parameters_of_all(requests, robot, payload_acceleration)
    first = np.unique(kind, return_index=True)[1].tolist()
    kinds = []
    for row, request, parameters in zip(first, requests, asked, strict=True):
        at_row = (starts[row], begins[row], ends[row], int(branch[row]))
        made = _segment(request, parameters, *at_row)
        begins.rotation[row] = made.start.base_from_tcp.rotation
        begins.translation[row] = made.start.base_from_tcp.translation
        kinds.append(made)
    start_rows = WaypointRows(starts.joints, begins, starts.external)
    return SegmentRows(kinds, kind, start_rows, ends, branch)


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
