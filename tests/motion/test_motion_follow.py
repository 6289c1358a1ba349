"""Points followed by arms: the three trajectory types, the letter, the lines, recorded numbers."""

from typing import Any

import numpy as np
import pytest
from reference_numbers import recorded

from rapidsim.frames.rotation_vectors import rotation_from_vector
from rapidsim.frames.transform import Array, Transform, quaternion_from_matrix
from rapidsim.motion.configurations.pose_solutions import solve_pose_as
from rapidsim.motion.configurations.reachability import limit_excess
from rapidsim.motion.robot.catalogue import robots_folder
from rapidsim.motion.robot.robot import load_robot
from rapidsim.motion.waypoints.follow import FollowedTrajectory, follow
from rapidsim.motion.waypoints.plan import Plan, Refused, TcpMotion, Way, tcp_motion
from rapidsim.motion.waypoints.points import Points, posed
from rapidsim.motion.waypoints.points_file import points_from_text
from rapidsim.motion.waypoints.reachability import reach
from rapidsim.motion.waypoints.velocity_profiles import Profile

KR10 = load_robot("kr10")
RVM1 = load_robot("rv-m1")
TOOL_HEAD = Transform(np.eye(3), np.array([0.0, 0.0, 0.16]))
"""The predecessors' tool of 0.24 m from the wrist, less 0.08 m to the flange."""
BARE = Transform.identity()
PROGRAMS = robots_folder().parent / "programs"
DH_SIGNS = np.array([-1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
"""Of the predecessors' joints against KUKA's."""


def table(name: str, joint_count: int) -> Points:
    return points_from_text((PROGRAMS / name).read_text(encoding="utf-8"), name, joint_count)


def followed(result: FollowedTrajectory | Refused) -> FollowedTrajectory:
    assert isinstance(result, FollowedTrajectory), result
    return result


def row_on(cfx: int, speeds: Array | None) -> FollowedTrajectory:
    """The straight row of ten points as a joint quintic, in a configuration."""
    points = table("kr10_row.csv", 6)
    points = Points(points.positions, points.attitudes, speeds=speeds)
    assert points.attitudes is not None
    pose = posed(points.positions[:1], points.attitudes[:1])[0] @ TOOL_HEAD.inverse()
    conf = {0: (-1, 0, 1, 0), 6: (1, -2, 1, 6)}[cfx]
    first = solve_pose_as(KR10, pose, conf)
    assert first.reason is None
    plan = Plan(Way.JOINT_QUINTIC, speed=0.1)
    return followed(
        follow(
            KR10,
            points,
            points.attitudes,
            TOOL_HEAD,
            plan,
            first=first.solutions[0].joints,
            dt=0.002,
        )
    )


@pytest.mark.parametrize(("cfx", "name", "mm"), [(0, "ru", 3.08), (6, "lu", 3.10)])
def test_a_joint_quintic_leaves_a_straight_row(cfx: int, name: str, mm: float) -> None:
    result = row_on(cfx, None)
    assert result.duration == pytest.approx(10.0)
    assert result.deviation_max * 1e3 == pytest.approx(mm, abs=0.01)
    known = recorded("trajectory_type_3_linear_part")["by_config"][name]["with_unwrapped_angles"]
    # The record was sampled coarsely: ours finds a little more.
    assert result.deviation_max == pytest.approx(known["v0"]["max_dev_from_line_m"], rel=2e-3)
    assert (result.overshoot < 1e-12).all()
    assert not limit_excess(KR10, result.samples.joints).any()


@pytest.mark.parametrize(("cfx", "name", "mm"), [(0, "ru", 23.78), (6, "lu", 16.06)])
def test_speed_at_the_points_makes_it_worse(cfx: int, name: str, mm: float) -> None:
    """A speed meant for the TCP, 0.1 m/s, taken as 0.1 rad/s of every joint."""
    speeds = np.tile(0.1 * DH_SIGNS, (10, 1))
    speeds[[0, -1]] = 0.0
    result = row_on(cfx, speeds)
    assert result.deviation_max * 1e3 == pytest.approx(mm, abs=0.01)
    known = recorded("trajectory_type_3_linear_part")["by_config"][name]["with_unwrapped_angles"]
    assert result.deviation_max == pytest.approx(known["vMax"]["max_dev_from_line_m"], rel=2e-3)
    assert result.overshoot.max() > np.radians(1.0)


@pytest.mark.parametrize("way", [Way.LINE, Way.SPLINE])
def test_ways_of_the_tcp_do_not_leave_it(way: Way) -> None:
    points = table("kr10_row.csv", 6)
    assert points.attitudes is not None
    plan = Plan(way, Profile.QUINTIC, speed=0.1)
    result = followed(follow(KR10, points, points.attitudes, TOOL_HEAD, plan))
    assert result.deviation_max < 1e-12
    assert result.from_chord < 1e-9
    assert result.path_length == pytest.approx(1.0)
    assert result.peak_speed == pytest.approx(0.1)
    stops = 9 if way is Way.LINE else 1
    assert result.duration == pytest.approx(stops * 1.875 * (1.0 / stops) / 0.1)
    assert result.samples.tcp_speed[[0, -1]] == pytest.approx([0.0, 0.0], abs=1e-12)
    slow = int(np.count_nonzero(result.samples.tcp_speed < 1e-9))
    assert slow == stops + 1


def octants() -> tuple[Points, list[dict[str, Any]]]:
    entries = recorded("kr10")["datasets"]["eight_quad"]
    turns = np.pi * np.array([entry["orientation_pi"] for entry in entries])
    positions = np.array([entry["p"] for entry in entries])
    return Points(positions, quaternion_from_matrix(rotation_from_vector(turns))), entries


def test_all_eight_octants_are_out_of_reach_with_their_distances() -> None:
    points, entries = octants()
    written = table("kr10_octants.csv", 6)
    assert written.positions == pytest.approx(points.positions)
    assert written.attitudes is not None
    assert points.attitudes is not None
    same = np.abs(np.sum(written.attitudes * points.attitudes, axis=1))
    assert same == pytest.approx(np.ones(8), abs=1e-8)
    reached, attitudes = reach(KR10, points, TOOL_HEAD)
    wrist = points.positions - 0.24 * posed(points.positions, attitudes).rotation[:, :, 2]
    forward = np.hypot(wrist[:, 0], wrist[:, 1]) - 0.025
    beyond = (
        np.hypot(forward, wrist[:, 2] - 0.4) - recorded("kr10")["wrist_annulus_around_axis2_m"][1]
    )
    for point, entry, distance in zip(reached, entries, beyond.tolist(), strict=True):
        assert entry["reachable_geometric"] == 0
        assert point.reason is not None
        assert point.reason.shortfall == pytest.approx(distance, abs=1e-9)
        assert point.message == f"wrist centre {distance * 1e3:.1f} mm beyond reach"


def test_the_points_around_are_reached_but_for_the_third() -> None:
    points = table("kr10_around.csv", 6)
    reached, attitudes = reach(KR10, points, TOOL_HEAD)
    assert [point.reachable for point in reached] == [True, True, False] + [True] * 6
    assert reached[2].message == "joint 1 over by 10.0 deg at its lower limit"
    known = recorded("kr10")["fixed_8_path"]
    plan = Plan(Way.LINE, Profile.SIGMOID, 0.1, 1e9, ease=0.2, least_radius=0.2)
    motion = tcp_motion(points, attitudes, plan)
    # No line comes into the sphere of 0.2 m; the true time is twice the one that was claimed.
    assert isinstance(motion, TcpMotion)
    assert [curve.length for curve in motion.curves] == pytest.approx(known["segment_lengths_m"])
    claimed = known["duration_s_vmax_0_1_ease_0_2"]
    assert motion.starts[-1] == pytest.approx(2.0 * claimed, rel=1e-9)
    assert motion.peak_speed == pytest.approx(0.1)
    closer = tcp_motion(points, attitudes, Plan(least_radius=0.35))
    assert isinstance(closer, Refused)
    least = known["min_distance_to_origin_per_segment_m"]
    assert closer.segment == int(np.argmax(np.array(least) < 0.35))
    assert f"{least[closer.segment] * 1e3:.1f} mm" in closer.message


def test_around_the_sphere_all_the_way() -> None:
    points = Points(np.array([[0.5, -0.3, 0.3], [0.5, 0.3, 0.3]]), np.tile([0.0, 1, 0, 0], (2, 1)))
    assert points.attitudes is not None
    plan = Plan(least_radius=0.62)
    assert isinstance(follow(KR10, points, points.attitudes, TOOL_HEAD, plan), Refused)
    plan = Plan(least_radius=0.62, avoid=True)
    result = followed(follow(KR10, points, points.attitudes, TOOL_HEAD, plan))
    away = np.linalg.norm(result.samples.base_from_tcp.translation, axis=1)
    assert away.min() == pytest.approx(0.62, abs=1e-9)
    assert result.deviation_max < 1e-12
    assert result.path_length > 0.6
    assert result.from_chord > 0.03


def test_the_letter_on_the_wall() -> None:
    placement = recorded("letter_d")["placements_fully_reachable"][0]
    points = table("letter_d.csv", 5)
    reached, attitudes = reach(RVM1, points, BARE)
    assert all(point.reachable for point in reached)
    plan = Plan(Way.SPLINE, Profile.SCURVE, speed=0.05)
    result = followed(follow(RVM1, points, attitudes, BARE, plan))
    assert result.deviation_rms < 1e-6
    assert result.deviation_max < 1e-6
    assert result.turn_deviation < 1e-9
    assert result.peak_speed == pytest.approx(0.05)
    # The 50 places that were recorded lie on the curve, and our joints there are the recorded ones.
    motion = tcp_motion(points, attitudes, plan)
    assert isinstance(motion, TcpMotion)
    (curve,) = motion.curves
    fine = curve.at(np.linspace(0.0, curve.length, 20_000))
    for place, joints in zip(placement["points_m"], placement["q"], strict=True):
        off = np.linalg.norm(fine.translation - place, axis=1)
        row = int(np.argmin(off))
        assert off[row] < 2e-5
        assert np.abs(RVM1.forward(np.array(joints)).translation - place).max() < 1e-9
        ours = RVM1.inverse(Transform(fine.rotation[row], np.array(place)))
        assert np.abs(ours.joints - np.array(joints)).max(axis=1).min() < 1e-2


def test_the_line_of_the_report_misses_its_first_five_points() -> None:
    known = recorded("rvm1")["line_follower"]
    points = table("rvm1_line.csv", 5)
    assert points.positions == pytest.approx(np.array(known["points_m"]))
    reached, attitudes = reach(RVM1, points, BARE)
    assert [point.reachable for point in reached] == known["flags_within_limits"]
    over = []
    for point, pitches in zip(reached, known["feasible_pitch_deg_range"], strict=True):
        if pitches is None:
            assert point.reason is not None
            assert (point.reason.joint, point.reason.excess < 0.0) == (3, True)
            over.append(-np.degrees(point.reason.excess))
        else:
            assert point.pitches is not None
            assert np.degrees(point.pitches) == pytest.approx(pitches)
    assert over == pytest.approx([22.6, 19.1, 14.3, 8.6, 3.0], abs=0.06)
    rest = np.arange(5, 11)
    result = follow(RVM1, points.some(rest), attitudes[rest], BARE, Plan(speed=0.05))
    assert followed(result).deviation_max < 1e-12


def test_joint_moves_bow_out_as_recorded() -> None:
    """MoveJ against MoveL: 23.8 mm and 179.0 mm from the straight line, 2 poses solved."""
    robot = load_robot("irb1600")
    program = recorded("rapid_program")
    tool = Transform(np.eye(3), np.array(program["tool_t4"]["trans_mm"]) / 1000.0)
    poses = [program["targets"][name]["tcp_base"] for name in ("p10", "p20")]
    points = Points(
        np.array([pose["p_m"] for pose in poses]), np.array([pose["q_wxyz"] for pose in poses])
    )
    assert points.attitudes is not None
    approach = program["movej_home_to_p10"]
    ends = np.array([approach["q_start"], approach["q_end"]])
    plan = Plan(Way.JOINT)
    joint = followed(follow(robot, points, points.attitudes, tool, plan, first=ends[1], dt=0.002))
    known = program["movej_p10_to_p20_deviation_from_line_m"]
    assert joint.from_chord == pytest.approx(known, abs=2e-6)
    assert joint.poses_solved == 2
    line = followed(follow(robot, points, points.attitudes, tool, Plan(Way.LINE)))
    assert line.from_chord < 1e-9
    assert line.poses_solved == len(line.samples.times) > 100

    poses_there = robot.forward(ends) @ tool
    there = Points(poses_there.translation, poses_there.quaternion)
    assert there.attitudes is not None
    bow = followed(
        follow(robot, there, there.attitudes, tool, Plan(Way.JOINT, speed=1.0), first=ends[0])
    )
    assert bow.samples.joints[-1] == pytest.approx(ends[1], abs=1e-9)
    assert bow.from_chord == pytest.approx(approach["max_deviation_from_chord_m"], abs=1e-5)
    assert bow.path_length == pytest.approx(approach["arc_m"], abs=1e-4)


def test_a_line_that_needs_a_jump_is_refused_with_place_and_joint() -> None:
    """Half a millimetre beside the wrist singularity: axis 4 would have to turn round at once."""
    robot = load_robot("irb1600")
    level = np.tile([0.5**0.5, 0.0, 0.5**0.5, 0.0], (2, 1))
    points = Points(np.array([[0.75, 0.0005, 1.1], [0.75, 0.0005, 0.8]]), level)
    result = follow(robot, points, level, BARE, Plan(speed=1.0))
    assert isinstance(result, Refused)
    assert result.message.startswith("between points 1 and 2 at 0.")
    assert "would have to jump by 164 deg, at a singularity" in result.message
    assert result.segment == 0
    assert len(result.other_branches) == 7
    assert any(why is not None and "joint 2 goes to" in why for _, why in result.other_branches)
    # Right through it, and well beside it, the arm goes on.
    through = Points(points.positions * [1.0, 0.0, 1.0], level)
    assert followed(follow(robot, through, level, BARE, Plan(speed=1.0))).deviation_max < 1e-12
    away = Points(points.positions + np.array([0.0, 0.2, 0.0]), level)
    assert followed(follow(robot, away, level, BARE, Plan(speed=1.0))).deviation_max < 1e-12


def test_an_arm_with_seven_axes_is_followed_from_sample_to_sample() -> None:
    robot = load_robot("irb14000-0.5-0.5")
    down = np.tile([0.0, 1.0, 0.0, 0.0], (2, 1))
    points = Points(np.array([[0.4, 0.0, 0.3], [0.4, 0.06, 0.3]]), down)
    result = followed(follow(robot, points, down, BARE, Plan(speed=0.2)))
    assert result.deviation_max < 1e-8
    assert np.abs(np.diff(result.samples.joints, axis=0)).max() < 0.05
    far = Points(points.positions * [1.0, 30.0, 1.0], down)
    refused = follow(robot, far, down, BARE, Plan(speed=0.2))
    assert isinstance(refused, Refused)
    assert refused.message.startswith("between points 1 and 2 at ")


def test_a_limit_on_the_way_is_called_a_limit() -> None:
    """From (500,100,300) to (300,400,500) with --conf 0,0,-2,0: joint 3 passes 55 deg by 2.7."""
    robot = load_robot("irb1600")
    down = np.tile([0.0, 1.0, 0.0, 0.0], (2, 1))
    points = Points(np.array([[0.5, 0.1, 0.3], [0.3, 0.4, 0.5]]), down)
    pose = posed(points.positions[:1], down[:1])[0]
    (first,) = solve_pose_as(robot, pose, (0, 0, -2, 0)).solutions
    refused = follow(robot, points, down, BARE, Plan(), first=first.joints)
    assert isinstance(refused, Refused)
    assert "[0,0,-2,0] joint 3 goes to 57.8 deg, 2.8 deg beyond its upper limit of 55 deg" in (
        refused.message
    )
    free = {conf for conf, why in refused.other_branches if why is None}
    assert free == {(-2, 2, -2, 6), (-2, 0, 0, 7)}
    # What is said to go all the way does, and is found where no configuration is asked for.
    assert refused.help is not None
    assert "--conf=-2,2,-2,6" in refused.help
    assert followed(follow(robot, points, down, BARE, Plan())).deviation_max < 1e-12


LEVEL = np.tile([0.0, 1.0, 0.0, 0.0], (2, 1))


def test_at_a_lone_point_the_arm_rests_and_at_none_there_is_nothing() -> None:
    robot = load_robot("irb1600")
    none = follow(robot, Points(np.zeros((0, 3)), None), np.zeros((0, 4)), BARE, Plan())
    assert isinstance(none, Refused)
    assert none.message == "a trajectory needs points"
    one = Points(np.array([[0.6, 0.1, 0.5]]), LEVEL[:1])
    result = followed(follow(robot, one, LEVEL[:1], TOOL_HEAD, Plan()))
    assert (result.duration, result.path_length, result.peak_speed) == (0.0, 0.0, 0.0)
    assert result.samples.base_from_tcp.translation == pytest.approx(one.positions, abs=1e-9)
    assert result.deviation_max < 1e-9
    assert result.from_chord < 1e-9
    assert (result.poses_solved, result.dt) == (1, 0.012)
    assert not result.joint_peaks.any()
    assert result.joint_peaks.shape == result.overshoot.shape == (6,)
    far = Points(np.array([[9.0, 0.1, 0.5]]), LEVEL[:1])
    refused = follow(robot, far, LEVEL[:1], TOOL_HEAD, Plan())
    assert isinstance(refused, Refused)
    assert refused.message.startswith("point 1: ")
    assert refused.segment == 0


def test_figures_of_a_joint_move_are_those_of_its_samples() -> None:
    robot = load_robot("irb1600")
    points = Points(np.array([[0.6, -0.2, 0.5], [0.7, 0.2, 0.6]]), LEVEL)
    result = followed(follow(robot, points, LEVEL, TOOL_HEAD, Plan(Way.JOINT, speed=0.2), dt=0.001))
    samples = result.samples
    steps = np.diff(samples.times)
    speeds = np.abs(np.diff(samples.joints, axis=0)) / steps[:, None]
    assert result.joint_peaks == pytest.approx(speeds.max(axis=0), rel=1e-2)
    tcp = samples.base_from_tcp.translation
    way = np.linalg.norm(np.diff(tcp, axis=0), axis=1)
    assert result.path_length == pytest.approx(way.sum())
    assert result.peak_speed == pytest.approx((way / steps).max(), rel=1e-2)
    assert result.deviation_rms == pytest.approx(float(np.sqrt(np.mean(result.deviation**2))))
    assert result.even_duration == pytest.approx(way.sum() / 0.2)
    limits = [joint.max_speed or 1.0 for joint in robot.joints]
    assert result.speed_ratios == pytest.approx(result.joint_peaks / limits)
    chord = points.positions[1] - points.positions[0]
    off = np.linalg.norm(np.cross(tcp - points.positions[0], chord), axis=1)
    assert result.deviation == pytest.approx(off / np.linalg.norm(chord), abs=1e-9)


def test_a_trajectory_of_too_many_samples_is_refused() -> None:
    robot = load_robot("irb1600")
    points = Points(np.array([[0.6, -0.2, 0.5], [0.6, 0.2, 0.5]]), LEVEL)
    for kind in (Way.LINE, Way.JOINT):
        refused = follow(robot, points, LEVEL, TOOL_HEAD, Plan(kind, speed=1e-4))
        assert isinstance(refused, Refused)
        assert "s: over 200000 samples" in refused.message
        assert refused.help == "raise --speed, or --dt"
