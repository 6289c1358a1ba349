r"""SingArea and CirPathMode on curves: the TCP keeps its way, the tool turns as asked."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from motion_programs import HOME, MODEL, ROBOT, TOOL, Programmer, path_of, path_or_fault, zone
from plain_segments import plain_segment

from rapidsim.frames.rotation_vectors import rotation_from_vector, vector_from_rotation
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.wrist_lock import lock_axis_4
from rapidsim.motion.geometry.segments import CircleMode, Geometry, Segment, Waypoint
from rapidsim.motion.path.curve_following import FaultKind, PathFault
from rapidsim.motion.path.path import Path
from rapidsim.motion.timing.axis_limits import limits_of
from rapidsim.motion.timing.planning import plan

LIMITS = limits_of(ROBOT, MODEL)
ABOVE = np.radians([0.0, 0.0, 0.0, 0.0, 15.0, 0.0])
BELOW = np.radians([0.0, 10.0, 0.0, 0.0, -15.0, 0.0])
ASIDE = np.radians([8.0, 12.0, -4.0, 10.0, -20.0, 10.0])


def across(*ends: Array, wrist: bool = True) -> list[Segment]:
    """Lines from one joint vector to the next."""
    segments = []
    program = Programmer()
    for index, (start, end) in enumerate(pairwise(ends)):
        begin, finish = (Waypoint(q, ROBOT.forward(q) @ TOOL) for q in (start, end))
        segments.append(
            plain_segment(
                geometry=Geometry.LINE,
                start=begin,
                end=finish,
                tcp_from_flange=TOOL.inverse(),
                branch=int(ROBOT.kinematics.branch_of(start)),
                speed=program.speed,
                zone=zone(20.0) if index < len(ends) - 2 else None,
                wrist_in_joints=wrist,
            )
        )
    return segments


def test_a_line_through_the_singularity_is_a_fault() -> None:
    fault = path_or_fault(across(ABOVE, BELOW, wrist=False))
    assert isinstance(fault, PathFault)
    assert fault.kind is FaultKind.SINGULARITY
    assert 0.3 < fault.fraction < 0.7


def test_with_the_wrist_in_joints_the_tcp_keeps_the_line() -> None:
    path = path_of(across(ABOVE, BELOW, ASIDE))
    s = np.linspace(0.0, path.length, 400)
    points = path.evaluate(s)
    corner = path.layout.corners.radius[0]
    start, end = (
        w.base_from_tcp.translation for w in (path.segments[0].start, path.segments[0].end)
    )
    along = (end - start) / np.linalg.norm(end - start)
    straight = s < path.segment_starts[1] - corner
    off = points.base_from_tcp.translation[straight] - start
    assert np.abs(off - np.outer(off @ along, along)).max() < 1e-9
    # The wrist turns evenly, and the pose that is told is the pose of the joints.
    wrist = points.joints[straight][:, 3:]
    share = s[straight, None] / path.layout.curves.length[0]
    assert wrist == pytest.approx(ABOVE[3:] + share * (BELOW - ABOVE)[3:], abs=1e-9)
    told = ROBOT.forward(points.joints) @ TOOL
    assert points.base_from_tcp.rotation == pytest.approx(told.rotation, abs=1e-9)


def test_derivatives_of_the_wrist_in_joints_are_those_of_the_joints() -> None:
    path = path_of(across(ABOVE, BELOW, ASIDE))
    s = np.linspace(0.02, 0.98, 40) * path.length
    piece, step = path.layout.piece_at(s), 1e-6
    inside = (path.layout.piece_at(s - step) == piece) & (path.layout.piece_at(s + step) == piece)
    rates = path.rates(s, piece)
    early, late = path.evaluate(s - step).joints, path.evaluate(s + step).joints
    slope = (late - early) / (2 * step)
    assert slope[inside] == pytest.approx(rates.first[inside], abs=1e-5)
    bend = (path.rates(s + step, piece).first - path.rates(s - step, piece).first) / (2 * step)
    assert bend[inside] == pytest.approx(rates.second[inside], rel=1e-3, abs=1e-2)


def test_the_passage_takes_as_long_as_a_line_does() -> None:
    timing = plan(path_of(across(ABOVE, BELOW)), LIMITS)
    way = np.linalg.norm(
        (ROBOT.forward(ABOVE) @ TOOL).translation - (ROBOT.forward(BELOW) @ TOOL).translation
    )
    assert way / 0.5 < timing.duration < way / 0.5 + 0.6


@pytest.mark.parametrize("turn", [0.1, 0.6, 2.9, 3.4])
def test_a_locked_axis_4_stands_at_half_turns_and_the_tcp_in_its_place(turn: float) -> None:
    joints = HOME.copy()
    joints[3] = turn
    wanted = ROBOT.forward(joints) @ TOOL
    locked = lock_axis_4(ROBOT.kinematics, wanted, TOOL.inverse(), joints)
    assert locked is not None
    assert locked[3] == pytest.approx(np.pi * round(turn / np.pi))
    taken = ROBOT.forward(locked) @ TOOL
    assert taken.translation == pytest.approx(wanted.translation, abs=1e-9)
    # No small turn of the wrist comes nearer to the orientation, the TCP kept in place.
    angle = np.linalg.norm(vector_from_rotation(taken.rotation @ wanted.rotation.T))
    assert angle < abs(turn - locked[3]) + 1e-9


def arc(mode: CircleMode, via_turn: Array) -> Path:
    """Half a circle on which the tool turns by a tenth of a turn about z."""
    program = Programmer().line((0.0, 0.16, 0.0), (0.0, 0.0, 0.6), via=(0.08, 0.08, 0.0))
    (segment,) = program.segments
    assert segment.via is not None
    start = segment.start.base_from_tcp.rotation
    via = Transform(rotation_from_vector(via_turn) @ start, segment.via.translation)
    return path_of([replace(segment, via=via, circle_mode=mode)])


def turned_by(path: Path, shares: Array) -> Array:
    """How far the tool has turned in base since the start (k, 3) [rad]."""
    rotation = path.evaluate(shares * path.length).base_from_tcp.rotation
    return vector_from_rotation(rotation @ rotation[0].T)


def test_in_the_object_frame_the_tool_turns_as_on_a_line() -> None:
    shares = np.linspace(0.0, 1.0, 9)
    turned = turned_by(arc(CircleMode.OBJECT_FRAME, np.zeros(3)), shares)
    assert turned == pytest.approx(np.outer(shares, [0.0, 0.0, 0.6]), abs=1e-9)


def test_through_the_circle_point_the_tool_has_its_orientation() -> None:
    via_turn = np.array([0.2, -0.1, 0.4])
    path = arc(CircleMode.CIRCLE_POINT, via_turn)
    turned = turned_by(path, np.array([0.0, 0.5, 1.0]))
    assert turned[1] == pytest.approx(via_turn, abs=1e-9)
    assert turned[2] == pytest.approx([0.0, 0.0, 0.6], abs=1e-9)
    s = np.linspace(0.05, 0.95, 21) * path.length
    piece, step = path.layout.piece_at(s), 1e-6
    before, after = (path.evaluate(s + sign * step).joints for sign in (-1, 1))
    assert (after - before) / (2 * step) == pytest.approx(path.rates(s, piece).first, abs=1e-5)
    bend = (path.rates(s + step, piece).first - path.rates(s - step, piece).first) / (2 * step)
    assert bend == pytest.approx(path.rates(s, piece).second, rel=1e-3, abs=1e-2)
