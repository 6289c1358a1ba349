"""Geometry of paths: lines, arcs, joint moves, corners, and where the arm cannot follow."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples
from motion_programs import MODEL, ROBOT, TOOL, Programmer, path_of, path_or_fault, programs, zone

from rapidsim.frames.rotation_vectors import vector_from_rotation
from rapidsim.frames.transform import Transform
from rapidsim.motion.geometry.segments import Speed, Waypoint, Zone
from rapidsim.motion.model import MODELS, MotionModel
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.path.path import Path

PARABOLA = MotionModel(corner="parabola")
C2 = MODELS["1"]
PROGRAMMED = replace(C2, orientation_zone="programmed")


def right_angle(millimetres: float, angle: float = 90.0) -> Programmer:
    """Two lines of 100 mm that turn by an angle [deg] at a zone."""
    a = math.radians(angle)
    program = Programmer().line((0.1, 0.0, 0.0), z=zone(millimetres))
    return program.line((0.1 * math.cos(a), 0.1 * math.sin(a), 0.0))


def places(path: Path, count: int = 2001) -> np.ndarray:
    return np.linspace(0.0, path.length, count)


def test_a_line_is_straight_to_a_micrometre() -> None:
    program = Programmer().line((0.25, -0.1, 0.05), (0.1, 0.2, -0.1))
    path = path_of(program)
    points = path.evaluate(places(path))
    flange = ROBOT.kinematics.forward(points.joints)
    tcp = (flange @ TOOL).translation
    start, end = (w.base_from_tcp.translation for w in ends(program))
    direction = (end - start) / np.linalg.norm(end - start)
    off = tcp - start - ((tcp - start) @ direction)[:, None] * direction
    assert np.abs(off).max() < 1e-9
    assert path.length == pytest.approx(np.linalg.norm(end - start), rel=1e-12)


def test_a_corner_has_knees_only_where_the_path_bends() -> None:
    """Going straight on, each piece more would cost time and show nothing."""
    bent, straight = (path_of(right_angle(10.0, angle)).breakpoints for angle in (0.1, 0.05))
    assert np.allclose(straight, [0.0, 0.09, 0.1, 0.11, 0.2])
    assert np.allclose(bent, np.sort([*straight, 0.1 - 0.01 / 3.0, 0.1 + 0.01 / 3.0]))


def ends(program: Programmer) -> tuple[Waypoint, Waypoint]:
    return program.segments[0].start, program.segments[-1].end


def test_a_line_turns_evenly() -> None:
    program = Programmer().line((0.2, 0.0, 0.0), (0.0, 0.0, 0.4))
    path = path_of(program)
    rotation = path.evaluate(places(path, 5)).base_from_tcp.rotation
    steps = np.swapaxes(rotation[:-1], -1, -2) @ rotation[1:]
    angles = np.arccos((np.trace(steps, axis1=1, axis2=2) - 1.0) / 2.0)
    assert angles == pytest.approx([0.1] * 4, abs=1e-9)


def test_a_joint_move_is_straight_in_joint_space() -> None:
    path = path_of(Programmer().move((0.5, 0.2, -0.1, 0.3, 0.2, -0.9)))
    joints = path.evaluate(places(path)).joints
    expected = joints[0] + np.linspace(0.0, 1.0, len(joints))[:, None] * (joints[-1] - joints[0])
    assert np.abs(joints - expected).max() < 1e-12


def test_the_length_of_a_joint_move_is_the_way_of_its_tcp() -> None:
    program = Programmer().move((1.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    x, y, _ = program.segments[0].start.base_from_tcp.translation
    assert path_of(program).length == pytest.approx(math.hypot(x, y), rel=1e-6)


@pytest.mark.parametrize(
    ("model", "millimetres"),
    [(MODEL, 20.0 * 31.0 / 144.0 * math.sqrt(0.5)), (C2, 2.6517), (PARABOLA, 3.5355)],
)
def test_z10_at_a_right_angle_passes_the_corner_at(model: MotionModel, millimetres: float) -> None:
    program = right_angle(10.0)
    path = path_of(program, model)
    corner = program.segments[0].end.base_from_tcp.translation
    tcp = path.evaluate(places(path)).base_from_tcp.translation
    assert np.linalg.norm(tcp - corner, axis=1).min() == pytest.approx(millimetres / 1e3, rel=1e-4)
    middle = path.evaluate(path.segment_starts[1:]).base_from_tcp.translation[0]
    assert np.linalg.norm(middle - corner) == pytest.approx(millimetres / 1e3, rel=1e-4)


@pytest.mark.parametrize("model", [MODEL, PARABOLA])
@pytest.mark.parametrize("angle", [1.0, 30.0, 90.0, 150.0, 179.0])
def test_a_corner_path_stays_inside_the_zone_and_the_rest_on_the_lines(
    model: MotionModel, angle: float
) -> None:
    program = right_angle(20.0, angle)
    path = path_of(program, model)
    s = places(path, 4001)
    tcp = path.evaluate(s).base_from_tcp.translation
    corner = program.segments[0].end.base_from_tcp.translation
    within = np.abs(s - 0.1) < 0.02
    assert np.linalg.norm(tcp[within] - corner, axis=1).max() <= 0.02 * (1.0 + 1e-9)
    start = program.segments[0].start.base_from_tcp.translation
    before = s <= 0.08
    assert np.abs(tcp[before] - start - np.outer(s[before], [1.0, 0.0, 0.0])).max() < 1e-9


def test_zones_meet_at_half_of_a_short_move() -> None:
    program = Programmer().line((0.1, 0, 0), z=zone(50)).line((0, 0.03, 0), z=zone(50))
    path = path_of(program.line((0.1, 0, 0)))
    assert [corner.radius for corner in path.corners] == pytest.approx([0.015, 0.015, 0.0])
    assert path.corners[0].reason == ("zone 50 mm reduced to 15 mm: half of the shorter move at it")
    assert path.corners[2].stops


def test_a_large_reorientation_reduces_the_zone() -> None:
    # The manual's own example: 9 deg of 25 deg leave 36 % of the move.
    z = Zone(0.05, 0.06, math.radians(9.0))
    program = Programmer().line((0.1, 0, 0), (0, 0, math.radians(25)), z).line((0, 0.1, 0))
    corner = path_of(program, PROGRAMMED).corners[0]
    assert path_of(program).corners[0].radius == pytest.approx(0.05)
    assert corner.radius == pytest.approx(0.036)
    assert "reorientation of 25.0 deg" in corner.reason


def test_the_orientation_may_have_its_own_zone() -> None:
    program = Programmer().line((0.1, 0, 0), (0, 0, 0.1), zone(10)).line((0, 0.1, 0))
    together = path_of(program, C2).breakpoints
    apart = path_of(program, PROGRAMMED).breakpoints
    assert together == pytest.approx([0, 0.09, 0.1, 0.11, 0.2])
    assert apart == pytest.approx([0, 0.085, 0.09, 0.1, 0.11, 0.115, 0.2])


def test_by_default_neither_zone_changes_the_other() -> None:
    """A zone of 15 mm for the orientation beside one of 10 mm, with a turn of 23 deg at z10."""
    program = Programmer().line((0.1, 0, 0), (0, 0, 0.4), zone(10)).line((0, 0.024, 0))
    corners = path_of(program).layout.corners
    assert corners.radius == pytest.approx([0.010])
    assert corners.orientation_radius == pytest.approx([0.012])
    straight = Programmer().line((0.1, 0, 0), z=zone(10)).line((0, 0.1, 0))
    # Where nothing turns there is nothing to look at.
    assert path_of(straight).layout.corners.orientation_radius == pytest.approx([0.0])


def test_the_orientation_at_the_programmed_point_is_that_of_a_parabola() -> None:
    """Off by a quarter of its zone times the change of the turn per way."""
    turn = 0.1
    program = Programmer().line((0.1, 0, 0), (0, 0, turn), zone(10)).line((0.1, 0, 0))
    path = path_of(program)
    middle = path.evaluate(path.segment_starts[1:]).base_from_tcp.rotation[0]
    wanted = program.segments[0].end.base_from_tcp.rotation
    off = np.linalg.norm(vector_from_rotation(middle @ wanted.T))
    assert off == pytest.approx(0.015 / 4.0 * turn / 0.1, rel=1e-6)


def test_there_is_no_corner_between_travel_and_pure_turn() -> None:
    program = Programmer().line((0.1, 0, 0), z=zone(10)).line(turn=(0, 0, 0.3), z=zone(10))
    path = path_of(program.line((0, 0.1, 0)))
    assert [corner.stops for corner in path.corners] == [True, True, True]
    assert "pure reorientation" in path.corners[0].reason
    assert path.stops == pytest.approx(path.segment_starts[1:])


def test_pure_turns_have_a_corner_in_degrees() -> None:
    program = Programmer().line(turn=(0, 0, 0.3), z=zone(10)).line(turn=(0.3, 0, 0))
    path = path_of(program)
    share = path.layout.corners.radius[0] / (path.length / 2)
    assert share == pytest.approx(math.radians(1.5) / 0.3)
    # The path parameter is no length there, so no radius is told.
    assert path.corners[0].radius == 0.0
    assert path.corners[0].reason == "within 1.5 deg of the end"


def test_a_corner_between_a_joint_move_and_a_line_is_made_in_joints() -> None:
    program = Programmer().move((0.3, 0.1, 0, 0, 0, 0.2), zone(20)).line((0, -0.1, 0))
    path = path_of(program)
    corner = path.corners[0]
    assert corner.in_joints
    assert corner.reason == "made in joint space"
    tcp = path.evaluate(places(path, 4001)).base_from_tcp.translation
    point = program.segments[0].end.base_from_tcp.translation
    edge = path.evaluate(path.segment_starts[1:] - corner.radius).base_from_tcp.translation[0]
    assert np.linalg.norm(edge - point) == pytest.approx(0.02, rel=0.1)
    assert 0.001 < np.linalg.norm(tcp - point, axis=1).min() < 0.01


@pytest.mark.parametrize("millimetres", [1.0, 10.0, 60.0])
def test_the_zone_between_long_joint_moves_ends_where_the_tcp_leaves_it(millimetres: float) -> None:
    """Zones are a small part of most joint moves: here a thousandth to a fifteenth."""
    program = Programmer().move((1.0, 0.1, 0, 0, 0, 0), zone(millimetres))
    path = path_of(program.move((0.9, -0.2, 0.1, 0, 0, 0)))
    corner, radius = path.corners[0], path.corners[0].radius
    assert corner.in_joints
    edges = path.evaluate(path.segment_starts[1] + np.array([-radius, radius]))
    point = program.segments[0].end.base_from_tcp.translation
    away = np.linalg.norm(edges.base_from_tcp.translation - point, axis=1)
    assert away.max() <= millimetres / 1e3
    assert away.max() == pytest.approx(millimetres / 1e3, rel=0.1)


def test_another_tool_makes_the_corner_in_joints() -> None:
    program = Programmer().line((0.1, 0, 0), z=zone(10), joint_corner=True)
    program.tool = Transform(np.eye(3), np.array([0.0, 0.0, 0.1]))
    path = path_of(program.line((0, 0.1, 0)))
    assert path.corners[0].in_joints
    joints = path.evaluate(places(path, 4001)).joints
    assert np.abs(np.diff(joints, axis=0)).max() < 1e-3


def test_an_arc_is_a_circle_and_the_tool_turns_with_it() -> None:
    program = Programmer().line((0.1, 0.1, 0), (0, 0, math.pi / 2), via=(0.0707107, 0.0292893, 0))
    program.segments[0] = replace(program.segments[0])
    path = path_of(program)
    points = path.evaluate(places(path))
    start = program.segments[0].start.base_from_tcp
    radius = points.base_from_tcp.translation - start.translation - np.array([0.0, 0.1, 0.0])
    assert np.linalg.norm(radius, axis=1) == pytest.approx([0.1] * len(radius), abs=1e-7)
    assert path.length == pytest.approx(0.05 * math.pi, rel=1e-6)
    # The tool turns by as much as the path: seen from the spoke it stands still.
    angle = np.linspace(0.0, math.pi / 2, len(radius))
    about_z = np.zeros((len(angle), 3, 3))
    about_z[:, 0, 0] = about_z[:, 1, 1] = np.cos(angle)
    about_z[:, 1, 0], about_z[:, 0, 1] = np.sin(angle), -np.sin(angle)
    about_z[:, 2, 2] = 1.0
    assert points.base_from_tcp.rotation == pytest.approx(about_z @ start.rotation, abs=1e-6)


@pytest.mark.parametrize(
    ("end", "via", "reason"),
    [
        ((0.1, 0, 0), (0.05, 0, 0), "on one line"),
        ((0.1, 0, 0), (0.00001, 0, 0), "circle point is 0.010 mm from the start"),
        ((0.00001, 0, 0), (0.05, 0, 0), "end point is 0.010 mm from the start"),
        ((0.02, 0, 0), (0.01, 0.06, 0), "more than 240 deg"),
    ],
)
def test_an_uncertain_circle_is_refused(
    end: tuple[float, ...], via: tuple[float, ...], reason: str
) -> None:
    fault = path_or_fault(Programmer().line(end, via=via))
    assert isinstance(fault, PathFault)
    assert reason in fault.reason


def test_out_of_reach_says_where_and_by_how_much() -> None:
    program = Programmer().line((0.1, 0, 0), z=zone(10)).line((0.1, 0, 0))
    far = program.segments[1]
    pose = far.end.base_from_tcp
    away = Transform(pose.rotation, pose.translation + np.array([1.0, 0.0, 0.0]))
    program.segments[1] = replace(far, end=Waypoint(far.end.joints, away))
    fault = path_or_fault(program)
    assert isinstance(fault, PathFault)
    assert fault.segment == 1
    assert 0.0 < fault.fraction < 1.0
    assert fault.distance == pytest.approx(fault.fraction * 1.1)
    assert "beyond the arm's reach" in fault.reason


def test_leaving_a_joint_limit_says_which_and_by_how_much() -> None:
    over = float(ROBOT.upper[4] - Programmer().joints[4]) + math.radians(5.0)
    fault = path_or_fault(Programmer().move((0, 0, 0, 0, over, 0)))
    assert isinstance(fault, PathFault)
    assert "5.0 deg past its limit of 115.0 deg" in fault.reason
    assert fault.fraction == pytest.approx(1.0 - math.radians(5.0) / over, abs=1e-6)


def test_a_line_through_the_wrist_singularity_is_refused() -> None:
    program = Programmer(joints=np.radians([0, 10, 5, 0, 20, 0]), tool=Transform.identity())
    program.line((0, 0, 0), (0, -math.radians(40), 0))
    fault = path_or_fault(program)
    assert isinstance(fault, PathFault)
    assert "singularity" in fault.reason
    assert 0.3 < fault.fraction < 0.7


def test_a_wrong_turn_at_the_end_is_refused() -> None:
    program = Programmer().line((0.1, 0, 0))
    segment = program.segments[0]
    turned = segment.end.joints - np.array([0, 0, 0, 0, 0, 2.0 * math.pi])
    program.segments[0] = replace(segment, end=Waypoint(turned, segment.end.base_from_tcp))
    fault = path_or_fault(program)
    assert isinstance(fault, PathFault)
    assert "axis 6" in fault.reason


@pytest.mark.parametrize("count", [1, 3])
def test_moves_without_length_make_no_path(count: int) -> None:
    program = Programmer()
    for _ in range(count):
        program.line(z=zone(10))
    path = path_of(program)
    assert path.length == 0.0
    assert path.evaluate(np.zeros(2)).joints == pytest.approx(np.tile(program.joints, (2, 1)))


def test_a_repeated_target_stops_the_arm() -> None:
    program = Programmer().line((0.1, 0, 0), z=zone(10)).line(z=zone(10)).line((0, 0.1, 0))
    path = path_of(program)
    assert [corner.stops for corner in path.corners] == [True, True, True]
    assert path.segment_starts == pytest.approx([0.0, 0.1, 0.1])
    assert path.lengths == pytest.approx([0.1, 0.0, 0.1])


def test_the_path_does_not_depend_on_speed() -> None:
    slow, fast = right_angle(10.0), right_angle(10.0)
    fast.segments = [replace(segment, speed=Speed(7.0, 1.0)) for segment in fast.segments]
    a, b = path_of(slow), path_of(fast)
    assert np.array_equal(a.evaluate(places(a)).joints, b.evaluate(places(b)).joints)


@examples(40)
@given(program=programs(), model=st.sampled_from([MODEL, PARABOLA]))
def test_joints_poses_and_rates_agree(program: Programmer, model: MotionModel) -> None:
    path = path_or_fault(program, model)
    if isinstance(path, PathFault):
        assert path.reason
        assert 0.0 <= path.fraction <= 1.0
        return
    s = places(path, 801)
    points = path.evaluate(s)
    assert np.isfinite(points.joints).all()
    assert np.abs(path.joints_at(s) - points.joints).max() < 1e-11
    if path.length == 0.0:
        return
    forward = ROBOT.kinematics.forward(points.joints) @ TOOL
    assert np.abs(forward.translation - points.base_from_tcp.translation).max() < 1e-9
    assert np.abs(forward.rotation - points.base_from_tcp.rotation).max() < 1e-9
    bounds = path.breakpoints
    if np.diff(bounds).min() < 1e-5:
        return  # Differences over less than a tenth of a nanometre are rounding.
    middle = bounds[:-1] + 0.37 * np.diff(bounds)
    h = 1e-5 * np.diff(bounds)
    rates = path.rates(middle, path.layout.piece_at(middle))
    back, here, ahead = (path.evaluate(middle + step).joints for step in (-h, 0.0 * h, h))
    first = (ahead - back) / (2.0 * h[:, None])
    scale = 1.0 + np.abs(rates.first).max()
    assert np.abs(first - rates.first).max() < 1e-4 * scale
    h = h * 100.0
    back, ahead = (path.evaluate(middle + step).joints for step in (-h, h))
    second = (ahead - 2.0 * here + back) / h[:, None] ** 2
    assert np.abs(second - rates.second).max() < 2e-3 * (1.0 + np.abs(rates.second).max())


@examples(40)
@given(program=programs())
def test_waypoints_without_corner_are_met_exactly(program: Programmer) -> None:
    path = path_or_fault(program)
    if isinstance(path, PathFault):
        return
    at = np.append(path.segment_starts[1:], path.length)
    joints = path.evaluate(at).joints
    for corner, reached, segment in zip(path.corners, joints, program.segments, strict=True):
        if corner.radius == 0.0:
            assert reached == pytest.approx(segment.end.joints, abs=1e-9)


@examples(25)
@given(program=programs())
def test_travel_is_the_sum_of_small_steps(program: Programmer) -> None:
    path = path_or_fault(program)
    if isinstance(path, PathFault):
        return
    s = places(path, 4001)
    steps = np.diff(path.evaluate(s).base_from_tcp.translation, axis=0)
    summed = np.linalg.norm(steps, axis=1).sum()
    assert float(path.travelled(s[-1:])[0]) == pytest.approx(summed, rel=1e-3)


def test_derivatives_of_the_tcp_are_those_of_its_positions() -> None:
    program = Programmer().line((0.1, 0, 0), (0, 0.1, 0), zone(20)).line((0, 0.1, 0), z=zone(10))
    path = path_of(program.move((0.2, 0.1, 0, 0.1, 0, 0)))
    h = 1e-5
    s = np.linspace(0.01, 0.99, 200) * path.length
    away = np.abs(s[:, None] - path.breakpoints).min(axis=1) > 2.0 * h
    s = s[away]
    before, here, after = (path.evaluate(s + step).base_from_tcp.translation for step in (-h, 0, h))
    velocity, acceleration = path.tcp_derivatives(s, path.layout.piece_at(s))
    assert np.abs(velocity - (after - before) / (2.0 * h)).max() < 1e-6
    assert np.abs(acceleration - (after - 2.0 * here + before) / h**2).max() < 1e-3


def test_a_wide_corner_between_large_turns_is_far_from_its_waypoint() -> None:
    """By less than a whole turn, so that is no wrong turn."""
    z = Zone(0.05, 0.075, math.radians(170.0))
    program = Programmer().line((0.1, 0, 0), (2.4, 0, 0), z).line((0, 0.1, 0), (-2.4, 0, 0))
    path = path_of(program)
    middle = path.evaluate(path.segment_starts[1:]).joints[0]
    assert np.abs(middle - program.segments[0].end.joints).max() > 0.5
