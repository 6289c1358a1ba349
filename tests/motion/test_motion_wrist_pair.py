r"""CirPathMode \Wrist45, \Wrist46, \Wrist56: two wrist axes lead the tool along a circle."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples
from motion_programs import LIMITS, MODEL, Programmer, path_of, require_same_when_joined, zone
from plain_segments import plain_segment

from rapidsim.frames.rotation_vectors import rotation_from_vector
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.geometry.curves import curves_of
from rapidsim.motion.geometry.segments import CircleMode, Geometry, Segment, Speed, Waypoint, Zone
from rapidsim.motion.geometry.wrist_pair import wrist_meets
from rapidsim.motion.path.building import build_path
from rapidsim.motion.path.curve_following import FaultKind, PathFault
from rapidsim.motion.path.path import Path
from rapidsim.motion.path.wrist_circle import start_on_circle, wrist_circle_error
from rapidsim.motion.robot.robot import Robot, load_robot
from rapidsim.motion.timing.planning import plan

ARMS = {
    name: load_robot(name)
    for name in ("irb1600-6-1.2", "irb120-3-0.58", "kr10-r1100-sixx", "irb6640-180-2.55")
}
IRB1600 = ARMS["irb1600-6-1.2"]
PAIRS = {CircleMode.WRIST_45: (3, 4), CircleMode.WRIST_46: (3, 5), CircleMode.WRIST_56: (4, 5)}
BENT = np.radians([10.0, -10.0, 20.0, 10.0, 60.0, 20.0])
STRAIGHT = Transform(np.eye(3), np.array([0.0, 0.0, 0.2]))
TORCH = Transform(rotation_from_vector(np.array([0.2, 0.3, 0.0])), np.array([0.05, 0.03, 0.2]))
CUT = Speed(0.05, np.radians(500.0))

arms = pytest.mark.parametrize("robot", ARMS.values(), ids=ARMS)
pairs = pytest.mark.parametrize("mode", PAIRS, ids=lambda mode: mode.name)


def posture(robot: Robot) -> Array:
    """The same bent wrist on arms whose makers count axes 4 and 6 differently."""
    kuka = robot.name.startswith("kr")
    wrist = BENT[3:] * ([-1.0, 1.0, -1.0] if kuka else [1.0, 1.0, 1.0])
    return np.concatenate([robot.start[:3], wrist])


def half(
    mode: CircleMode,
    radius: float,
    *,
    robot: Robot = IRB1600,
    joints: Array = BENT,
    tool: Transform = TORCH,
    lean: float = 0.0,
) -> Segment:
    """Half a circle on the tool's x axis, in a plane that leans [rad] about the tool's y axis."""
    start = robot.forward(joints) @ tool
    x, y, _ = (start.rotation @ rotation_from_vector(np.array([0.0, lean, 0.0]))).T
    segment = plain_segment(
        Geometry.ARC,
        Waypoint(joints, start),
        Waypoint(joints, Transform(start.rotation, start.translation + 2.0 * radius * x)),
        tool.inverse(),
        int(robot.kinematics.branch_of(joints)),
        CUT,
        None,
        via=Transform(start.rotation, start.translation + radius * (x + y)),
        circle_mode=mode,
    )
    return arriving(robot, segment)


def arriving(robot: Robot, segment: Segment) -> Segment:
    """The same, with the joints at its end."""
    end, led = segment.end.base_from_tcp, wrist_circle_error(robot.kinematics, segment)
    at_end = segment.start.joints if led is None else led.arrival
    return replace(segment, end=Waypoint(at_end, end, aim=end.translation))


def hole(robot: Robot, mode: CircleMode, radius: float, z: Zone | None = None) -> list[Segment]:
    """A whole circle in two halves; the second starts where the first aims."""
    first = replace(half(mode, radius, robot=robot, joints=posture(robot)), zone=z)
    assert first.via is not None
    tool, begun, end = first.tcp_from_flange.inverse(), first.start.base_from_tcp, first.end
    opposite = 2.0 * (begun.translation + end.base_from_tcp.translation) / 2.0
    start = start_on_circle(robot.forward(end.joints) @ tool, end.aim)
    second = replace(
        first,
        start=Waypoint(end.joints, start),
        end=Waypoint(end.joints, begun),
        zone=None,
        via=Transform(begun.rotation, opposite - first.via.translation),
    )
    return [first, arriving(robot, second)]


def built(robot: Robot, segments: list[Segment]) -> Path:
    path = build_path(robot, segments, MODEL)
    assert isinstance(path, Path), path
    return path


def pierced(robot: Robot, segment: Segment, joints: Array) -> Array:
    """Where the z axis of the tool passes the cut plane (k, 3), by forward kinematics alone."""
    assert segment.via is not None
    corner = segment.start.base_from_tcp.translation
    to_via = segment.via.translation - corner
    normal = np.cross(to_via, segment.end.base_from_tcp.translation - corner)
    tcp = robot.forward(joints) @ segment.tcp_from_flange.inverse()
    z = tcp.rotation[..., 2]
    ahead = ((corner - tcp.translation) @ normal) / (z @ normal)
    return tcp.translation + ahead[..., None] * z


def middle_and_radius(segment: Segment) -> tuple[Array, float]:
    """Of half a circle."""
    ends = segment.start.base_from_tcp.translation, segment.end.base_from_tcp.translation
    return (ends[0] + ends[1]) / 2.0, float(np.linalg.norm(ends[1] - ends[0])) / 2.0


def newton(miss: Callable[[Array], Array], unknown: Array) -> Array:
    """The zero of two equations in two unknowns, with slopes from differences."""
    for _ in range(30):
        steps = 1e-6 * np.eye(2)
        slopes = [(miss(unknown + step) - miss(unknown - step)) / 2e-6 for step in steps]
        unknown = unknown - np.linalg.solve(np.array(slopes).T, miss(unknown))
    return unknown


@arms
@pairs
def test_the_z_axis_follows_the_circle_and_the_other_axes_stand(
    robot: Robot, mode: CircleMode
) -> None:
    first, second = hole(robot, mode, 0.006)
    path = built(robot, [first, second])
    s = np.linspace(0.0, path.length, 301)
    joints = path.evaluate(s).joints
    standing = [axis for axis in range(6) if axis not in PAIRS[mode]]
    assert np.ptp(joints[:, standing], axis=0) == pytest.approx(np.zeros(4), abs=1e-12)
    centre, radius = middle_and_radius(first)
    along = pierced(robot, first, joints)
    assert np.linalg.norm(along - centre, axis=1) == pytest.approx(radius, abs=1e-9)
    # As far along the circle as s says, and back where it began: the hole is closed.
    spokes = (along - centre) / radius
    turned = np.arccos(np.clip(spokes @ spokes[0], -1.0, 1.0))
    assert np.where(s > path.length / 2, 2 * np.pi - turned, turned) == pytest.approx(
        s / radius, abs=1e-5
    )
    assert joints[-1] == pytest.approx(joints[0], abs=1e-9)


@arms
@pairs
def test_a_plain_search_finds_the_same_joints(robot: Robot, mode: CircleMode) -> None:
    segment = half(mode, 0.006, robot=robot, joints=posture(robot))
    path = built(robot, [segment])
    assert segment.via is not None
    start, end = segment.start.base_from_tcp, segment.end.base_from_tcp
    centre, radius = middle_and_radius(segment)
    ahead = (segment.via.translation - centre) / radius
    joints = posture(robot)
    for share in (0.25, 0.5, 0.75, 1.0):
        aim = centre + radius * (
            np.cos(np.pi * share) * (start.translation - centre) / radius
            + np.sin(np.pi * share) * ahead
        )

        def miss(pair: Array, aim: Array = aim) -> Array:
            moved = joints.copy()
            moved[list(PAIRS[mode])] = pair
            tcp = robot.forward(moved) @ TORCH
            seen: Array = tcp.inverse().apply(aim)[:2]
            return seen

        joints[list(PAIRS[mode])] = newton(miss, joints[list(PAIRS[mode])])
        found = path.evaluate(np.array([share * path.length])).joints[0]
        assert found == pytest.approx(joints, abs=1e-8)
    assert segment.end.joints == pytest.approx(joints, abs=1e-8)
    assert np.linalg.norm(end.translation - pierced(robot, segment, joints)) < 1e-9


@arms
@pairs
def test_derivatives_are_those_of_the_joints(robot: Robot, mode: CircleMode) -> None:
    path = built(robot, [half(mode, 0.006, robot=robot, joints=posture(robot))])
    s, step = np.linspace(0.02, 0.98, 25) * path.length, 1e-7
    piece = path.layout.piece_at(s)
    rates = path.rates(s, piece)
    early, late = path.evaluate(s - step).joints, path.evaluate(s + step).joints
    assert (late - early) / (2 * step) == pytest.approx(rates.first, rel=1e-6, abs=1e-5)
    bend = (path.rates(s + step, piece).first - path.rates(s - step, piece).first) / (2 * step)
    assert bend == pytest.approx(rates.second, rel=1e-5, abs=1e-2)


@examples()
@given(
    mode=st.sampled_from(list(PAIRS)),
    wrist=st.tuples(*[st.floats(-1.5, 1.5)] * 3),
    turn=st.tuples(*[st.floats(-0.8, 0.8)] * 3),
    radius=st.floats(0.001, 0.15),
)
def test_an_arc_is_led_exactly_or_refused(
    mode: CircleMode,
    wrist: tuple[float, float, float],
    turn: tuple[float, float, float],
    radius: float,
) -> None:
    joints = np.append(BENT[:3], wrist)
    tool = Transform(rotation_from_vector(np.array(turn)), np.array([0.04, -0.03, 0.18]))
    segment = half(mode, radius, joints=joints, tool=tool)
    path = build_path(IRB1600, [segment], MODEL)
    if isinstance(path, PathFault):
        assert path.kind is FaultKind.WRIST_PAIR
        assert path.reason
        return
    found = path.evaluate(np.linspace(0.0, path.length, 60)).joints
    centre, radius = middle_and_radius(segment)
    off = np.linalg.norm(pierced(IRB1600, segment, found) - centre, axis=1) - radius
    assert np.abs(off).max() < 1e-9
    assert (found >= IRB1600.lower - 1e-6).all()
    assert (found <= IRB1600.upper + 1e-6).all()
    # Without a jump, however fast axis 4 turns where axis 5 is nearly straight.
    close = path.evaluate(np.linspace(0.0, path.length, 3000)).joints
    assert np.abs(np.diff(close, axis=0)).max() < 0.1


def test_the_programmed_speed_is_that_of_what_follows_the_circle() -> None:
    segment = half(CircleMode.WRIST_45, 0.02)
    path = built(IRB1600, [segment])
    timing = plan(path, LIMITS)
    times = np.arange(0.0, timing.duration, 1e-3)
    joints = path.evaluate(np.array([timing.s_at(t) for t in times])).joints
    speed = np.linalg.norm(np.diff(pierced(IRB1600, segment, joints), axis=0), axis=1) / 1e-3
    assert speed.max() == pytest.approx(CUT.tcp, rel=1e-3)
    assert np.median(speed) == pytest.approx(CUT.tcp, rel=1e-3)
    # The TCP moves more slowly here: it is nearer to the wrist.
    turning = np.abs(np.diff(joints, axis=0)) / 1e-3
    assert (turning <= LIMITS.max_speed * 1.001).all()
    change = np.abs(np.diff(joints, n=2, axis=0)) / 1e-6
    assert (change <= LIMITS.max_acceleration * 1.01).all()


def test_corners_with_neighbours_are_smooth_and_within_their_zones() -> None:
    first, second = hole(IRB1600, CircleMode.WRIST_45, 0.01, zone(1.0))
    tool = first.tcp_from_flange.inverse()
    down = first.start.base_from_tcp
    above = Transform(down.rotation, down.translation - 0.03 * down.rotation[:, 2])
    branch = first.branch
    lifted = IRB1600.kinematics.inverse_on_branch(
        (above @ first.tcp_from_flange)[None], branch, BENT
    ).joints[0]
    joints = posture(IRB1600)
    onto = replace(
        first, geometry=Geometry.LINE, via=None, zone=zone(2.0), start=Waypoint(lifted, above)
    )
    onto = replace(onto, end=first.start, circle_mode=CircleMode.PATH_FRAME)
    stands = IRB1600.forward(second.end.joints) @ tool
    away = replace(onto, start=Waypoint(second.end.joints, stands), zone=None)
    again = IRB1600.kinematics.inverse_on_branch(
        (above @ first.tcp_from_flange)[None], branch, joints
    ).joints[0]
    away = replace(away, end=Waypoint(again, above))
    row = [onto, first, replace(second, zone=zone(2.0)), away]
    path = built(IRB1600, row)
    assert [corner.in_joints for corner in path.corners[:3]] == [True, True, True]
    assert not path.stops.size
    for s in path.breakpoints[1:-1]:
        before, after = path.evaluate(np.array([s - 1e-9, s + 1e-9])).joints
        assert after == pytest.approx(before, abs=1e-6)
        at = int(path.layout.piece_at(np.array([s]))[0])
        if s not in path.segment_starts:
            sides = [path.rates(np.array([s]), np.array([piece])) for piece in (at - 1, at)]
            assert sides[0].first == pytest.approx(sides[1].first, abs=1e-6)
    inside = np.linspace(-0.001, 0.001, 21) + path.segment_starts[2]
    off = pierced(IRB1600, first, path.evaluate(inside).joints) - middle_and_radius(first)[0]
    # The corner between both halves is cut by much less than its zone of 1 mm.
    assert np.abs(np.linalg.norm(off, axis=1) - 0.01).max() < 1e-4


def test_the_second_half_goes_on_where_the_z_axis_passes_the_plane() -> None:
    first, second = hole(IRB1600, CircleMode.WRIST_45, 0.01)
    stands = IRB1600.forward(first.end.joints) @ TORCH
    assert np.linalg.norm(stands.translation - first.end.base_from_tcp.translation) > 1e-3
    assert second.start.base_from_tcp.translation == pytest.approx(
        first.end.base_from_tcp.translation
    )
    # With another tool the aim means nothing: the arc starts at the TCP.
    other = IRB1600.forward(first.end.joints) @ STRAIGHT
    assert start_on_circle(other, first.end.aim) is other


def test_how_far_the_tcp_leaves_the_plane_is_what_is_told() -> None:
    segment = half(CircleMode.WRIST_45, 0.01)
    led = wrist_circle_error(IRB1600.kinematics, segment)
    assert led is not None
    path = built(IRB1600, [segment])
    points = path.evaluate(np.linspace(0.0, path.length, 500)).base_from_tcp
    start = segment.start.base_from_tcp
    off = np.abs((points.translation - start.translation) @ start.rotation[:, 2])
    assert led.off_plane == pytest.approx(off.max(), abs=1e-6)
    assert led.tilt == pytest.approx(0.0, abs=1e-6)
    end = points.translation[-1] - segment.end.base_from_tcp.translation
    assert led.off_end == pytest.approx(np.linalg.norm(end))
    leaning = wrist_circle_error(IRB1600.kinematics, half(CircleMode.WRIST_45, 0.01, lean=0.2))
    assert leaning is not None
    assert leaning.tilt == pytest.approx(0.2)


FAULTS = {
    "in line": (
        half(CircleMode.WRIST_46, 0.005, joints=BENT * [1, 1, 1, 1, 0, 1]),
        0.0,
        "axes 4 and 6 are in one line, with axis 5 at 0.0 deg",
        "bend axis 5,",
    ),
    "tool in line with axis 6": (
        half(CircleMode.WRIST_56, 0.005, tool=STRAIGHT),
        0.0,
        "the tool's z axis lies along axis 6, which cannot move it",
        "bend wrist or tool so that it leans away from axis 6,",
    ),
    "tool in line with axis 4": (
        half(CircleMode.WRIST_45, 0.005, joints=BENT * [1, 1, 1, 1, 0, 1], tool=STRAIGHT),
        0.0,
        "the tool's z axis lies along axis 4, which cannot move it",
        "bend wrist or tool so that it leans away from axis 4,",
    ),
    "too large": (
        half(CircleMode.WRIST_56, 0.15),
        0.031,
        "the circle goes up to 184.9 mm (28.2 deg) beyond where axes 5 and 6 take the tool's z "
        "axis",
        "make the circle smaller,",
    ),
    "flat": (
        half(CircleMode.WRIST_45, 0.005, lean=1.5),
        0.0,
        "the tool's z axis hardly crosses the plane of the circle, at 4.1 deg",
        "start with the tool perpendicular to the circle,",
    ),
    "limit": (
        half(CircleMode.WRIST_45, 0.03, joints=BENT + np.radians([0, 0, 0, 0, 53, 0])),
        0.497,
        "axis 5 goes to 124.2 deg, 9.2 deg past its limit of 115.0 deg",
        None,
    ),
    "z axis across": (
        half(
            CircleMode.WRIST_45,
            0.03,
            tool=Transform(rotation_from_vector(np.array([0.0, 1.5, 0.0])), STRAIGHT.translation),
        ),
        0.071,
        "the tool's z axis passes 264.3 mm beside the wrist, and the circle comes up to 59.1 mm "
        "nearer to it",
        "use a tool whose z axis points away from the wrist,",
    ),
    "singular": (
        half(
            CircleMode.WRIST_46,
            0.01,
            joints=BENT * [1, 1, 1, 0, 1, 0],
            tool=Transform(
                rotation_from_vector(np.array([0.0, 0.3, 0.0])), np.array([0.05, 0, 0.2])
            ),
        ),
        0.0,
        "axes 4 and 6 both move the tool's z axis the same way where the circle starts: they are "
        "singular",
        "start the circle in another posture,",
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_circle_that_cannot_be_led_says_where_how_much_and_what_to_do(name: str) -> None:
    segment, fraction, reason, cure = FAULTS[name]
    fault = build_path(IRB1600, [segment], MODEL)
    assert isinstance(fault, PathFault)
    assert fault.kind is FaultKind.WRIST_PAIR
    assert fault.fraction == pytest.approx(fraction, abs=1e-3)
    assert fault.reason == reason
    assert fault.cure is None if cure is None else (fault.cure or "").startswith(cure)


def test_a_circle_over_the_line_of_axis_4_is_singular_there() -> None:
    joints = BENT * [1, 1, 1, 1, 0, 1] + np.radians([0, 0, 0, 0, 8, 0])
    segment = half(CircleMode.WRIST_45, 0.01, joints=joints, tool=STRAIGHT)
    start, rotation = segment.start.base_from_tcp.translation, segment.start.base_from_tcp.rotation
    wrist = IRB1600.kinematics.link_frames(joints).translation[4]
    axis_4, normal = IRB1600.kinematics.jacobian(joints)[3:, 3], rotation[:, 2]
    over = wrist + axis_4 * ((start - wrist) @ normal) / (axis_4 @ normal)
    beside = np.cross(normal, over - start)
    end = Waypoint(joints, Transform(rotation, over + 0.9 * beside))
    through = replace(segment, via=Transform(rotation, over), end=end)
    fault = build_path(IRB1600, [through], MODEL)
    assert isinstance(fault, PathFault)
    assert fault.reason == (
        "axes 4 and 5 both move the tool's z axis the same way on the way: they are singular"
    )
    curve = curves_of((through,), IRB1600.kinematics)
    fails = curve.at(np.array([0]), np.array([fault.place])).position[0]
    assert np.linalg.norm(fails - over) < 1e-4
    # A millimetre aside the wrist swings round within its limits.
    aside = over + 1e-3 * beside / np.linalg.norm(beside)
    assert wrist_circle_error(IRB1600.kinematics, replace(through, via=Transform(rotation, aside)))


def test_how_far_a_circle_is_too_large_is_what_no_turn_of_both_axes_makes_good() -> None:
    segment = FAULTS["too large"][0]
    centre, _ = middle_and_radius(segment)
    assert segment.via is not None
    half_turn = np.pi * np.linspace(0.0, 1.0, 61)[:, None]
    to_start = segment.start.base_from_tcp.translation - centre
    circle = centre + np.cos(half_turn) * to_start
    circle += np.sin(half_turn) * (segment.via.translation - centre)
    wrist = IRB1600.kinematics.link_frames(BENT).translation[4]
    joints = np.tile(BENT, (150 * 150, 1))
    turns = np.linspace(-np.pi, np.pi, 150)
    joints[:, 4], joints[:, 5] = np.repeat(turns, 150), np.tile(turns, 150)
    tcp = IRB1600.forward(joints) @ TORCH
    spoke, z = tcp.translation - wrist, tcp.rotation[..., 2]
    along = np.einsum("ij,ij->i", spoke, z)
    nearest = (spoke - along[:, None] * z)[:, None]
    distance = np.linalg.norm(circle - wrist, axis=1)
    slide = np.sqrt(distance**2 - np.sum(nearest**2, axis=-1))
    reached = (nearest + slide[..., None] * z[:, None]) / distance[:, None]
    cosine = np.einsum("gkj,kj->gk", reached, (circle - wrist) / distance[:, None])
    beyond = np.degrees(np.arccos(cosine.max(axis=0)))
    assert beyond.max() == pytest.approx(28.2, abs=0.3)


def test_an_arm_whose_wrist_axes_pass_each_other_cannot_lead() -> None:
    assert all(wrist_meets(robot.kinematics, robot.start) for robot in ARMS.values())
    for name in ("crb15000-5-0.95", "rv-m1"):
        robot = load_robot(name)
        assert not wrist_meets(robot.kinematics, robot.start)


def test_led_arcs_are_joined_with_other_paths() -> None:
    led = built(IRB1600, [half(CircleMode.WRIST_45, 0.004)])
    line = path_of(Programmer().line((0.1, 0.0, 0.0)))
    require_same_when_joined([line, led, line])
