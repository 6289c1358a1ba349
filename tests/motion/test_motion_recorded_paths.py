"""Recorded numbers along paths, by kinematics alone: lengths, joint ranges, bows of joint moves."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from reference_numbers import recorded

from rapidsim.frames.transform import Array, Transform, quaternion_from_matrix, slerp
from rapidsim.motion.configurations.reachability import limit_excess, turns_within_limits
from rapidsim.motion.robot.robot import Robot, load_robot

SAMPLES = 2001
AT_THEIR_SAMPLES = 1e-5
"""Extremes inside a path were recorded from fewer samples [m, rad]."""


@pytest.fixture(scope="module")
def robot() -> Robot:
    return load_robot("irb1600")


@pytest.fixture(scope="module")
def program() -> dict[str, Any]:
    return recorded("rapid_program")


def tcp(program: dict[str, Any], name: str) -> Transform:
    frame = program["targets"][name]["tcp_base"]
    return Transform(np.array(frame["R"]), np.array(frame["p_m"]))


def flange_from_tcp(program: dict[str, Any]) -> Transform:
    tool = program["tool_t4"]
    return Transform.from_quaternion(tool["rot"], np.array(tool["trans_mm"]) / 1000.0)


def line(start: Transform, end: Transform) -> Transform:
    """Poses (SAMPLES,) on a straight line, turning evenly."""
    share = np.linspace(0.0, 1.0, SAMPLES)
    q = slerp(quaternion_from_matrix(start.rotation), quaternion_from_matrix(end.rotation), share)
    places = start.translation + share[:, None] * (end.translation - start.translation)
    return Transform.from_quaternion(q, places)


def bow(points: Array) -> float:
    """The largest distance [m] of points (k, 3) from the chord between the first and the last."""
    chord = points[-1] - points[0]
    along = (points - points[0]) @ chord / (chord @ chord)
    off = points - points[0] - along[:, None] * chord
    return float(np.linalg.norm(off, axis=-1).max())


@pytest.mark.parametrize("key", ["path_rapid_draw", "path_matlab_calls"])
def test_lengths_of_the_drawing(program: dict[str, Any], key: str) -> None:
    truth = program[key]
    corners = np.array([tcp(program, name).translation for name in truth["sequence"]])
    lengths = np.linalg.norm(np.diff(corners, axis=0), axis=-1)
    assert lengths == pytest.approx(truth["segments_m"], abs=1e-9)
    assert lengths.sum() == pytest.approx(truth["total_m"], abs=1e-9)


def test_joints_along_the_lines_of_the_drawing(robot: Robot, program: dict[str, Any]) -> None:
    """Limits are kept, the wrist stays 11.6 deg from straight, speeds are as recorded."""
    truth, tool = program["movel_tracking_6_12"], flange_from_tcp(program)
    first = program["targets"]["p10"]["ik_6_12"][0]["q"]
    sequence = program["path_rapid_draw"]["sequence"]
    near, rows, speeds = np.array(first), [], []
    for start, end in pairwise(sequence):
        poses = line(tcp(program, start), tcp(program, end))
        followed = robot.kinematics.inverse_on_branch(poses @ tool.inverse(), 0, near)
        assert followed.exists.all()
        reached = (robot.forward(followed.joints) @ tool).translation
        assert np.abs(reached - poses.translation).max() < 1e-9
        step = np.linalg.norm(poses.translation[-1] - poses.translation[0]) / (SAMPLES - 1)
        speeds.append(np.abs(np.diff(followed.joints, axis=0)).max(axis=0) * 0.2 / step)
        near = followed.joints[-1]
        rows.append(followed.joints)
    joints = np.concatenate(rows)
    assert joints.min(axis=0) == pytest.approx(truth["q_min"], abs=AT_THEIR_SAMPLES)
    assert joints.max(axis=0) == pytest.approx(truth["q_max"], abs=AT_THEIR_SAMPLES)
    assert joints[-1] == pytest.approx(truth["q_at_end"], abs=1e-8)
    assert not limit_excess(robot, joints).any()
    fastest = np.max(speeds, axis=0)
    # Recorded over longer steps, which flatten the peaks by some per cent.
    flattened = fastest / np.array(truth["max_joint_speed_rad_s_at_200mm_s"])
    assert flattened.min() > 0.999
    assert flattened.max() < 1.04
    least = np.linalg.svd(robot.kinematics.jacobian(joints), compute_uv=False)[:, -1].min()
    # The least lies inside a line, between two of their samples.
    assert 0.99 * truth["min_sigma_J"] < least < truth["min_sigma_J"]
    bent = np.degrees(np.abs(joints[:, 4]).min())
    assert bent == pytest.approx(truth["min_abs_q5_deg"], abs=1e-6)


def test_how_far_joint_moves_bow_out(robot: Robot, program: dict[str, Any]) -> None:
    tool, truth = flange_from_tcp(program), program["movej_home_to_p10"]
    share = np.linspace(0.0, 1.0, SAMPLES)[:, None]
    start, end = np.array(truth["q_start"]), np.array(truth["q_end"])
    points = (robot.forward(start + share * (end - start)) @ tool).translation
    assert points[0] == pytest.approx(truth["tcp_start"], abs=1e-9)
    assert points[-1] == pytest.approx(truth["tcp_end"], abs=1e-9)
    assert points[SAMPLES // 2] == pytest.approx(truth["tcp_at_half"], abs=1e-9)
    assert np.linalg.norm(points[-1] - points[0]) == pytest.approx(truth["chord_m"], abs=1e-9)
    arc = np.linalg.norm(np.diff(points, axis=0), axis=-1).sum()
    assert arc == pytest.approx(truth["arc_m"], abs=1e-5)
    assert bow(points) == pytest.approx(truth["max_deviation_from_chord_m"], abs=AT_THEIR_SAMPLES)
    p10, p20 = (np.array(program["targets"][name]["ik_6_12"][0]["q"]) for name in ("p10", "p20"))
    between = (robot.forward(p10 + share * (p20 - p10)) @ tool).translation
    recorded_bow = program["movej_p10_to_p20_deviation_from_line_m"]
    assert bow(between) == pytest.approx(recorded_bow, abs=AT_THEIR_SAMPLES)


def test_a_flange_that_points_into_the_arm_reaches_none_of_the_targets(
    robot: Robot, program: dict[str, Any]
) -> None:
    """A description whose last frame has z the wrong way leaves every target out of its limits."""
    facts = recorded("urdf_in_millimetres")
    lower, upper = np.array(facts["limits"]).T
    backward = np.diag([1.0, -1.0, -1.0])
    counts = facts["ik_counts"]
    for name in program["targets"]:
        pose = tcp(program, name)
        right = pose @ flange_from_tcp(program).inverse()
        for rotation, key in (
            (np.eye(3), "consistent_metres_tool0_within_limits"),
            (backward, "consistent_metres_link6_passive_within_limits"),
        ):
            flange = Transform(right.rotation @ rotation, right.translation)
            branches = robot.inverse(flange)
            joints = turns_within_limits(robot, branches.joints)
            within = branches.exists & ((joints >= lower) & (joints <= upper)).all(axis=-1)
            assert within.sum() == counts[key][name]


def test_points_of_a_straight_line() -> None:
    truth = recorded("example_line")
    start, end = np.array(truth["p0"]), np.array(truth["p1"])
    share = np.linspace(0.0, 1.0, truth["n_points"])[:, None]
    points = start + share * (end - start)
    assert points == pytest.approx(np.array(truth["points"]), abs=1e-10)
    assert np.linalg.norm(end - start) == pytest.approx(truth["length"], abs=1e-10)
    assert bow(points) < 1e-12
