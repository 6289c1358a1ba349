"""Every recorded list of kinematics: forward, all branches, configurations, Jacobians, reach.

Recorded with eleven digits: poses hold to 1e-9 m, joints modulo whole turns, Jacobians and singular
values to 1e-8.
"""

from typing import Any

import numpy as np
import pytest
from motion_truth import assert_same_set
from reference_numbers import recorded

from rapidsim.frames.transform import Array, Transform, quaternion_from_matrix
from rapidsim.motion.configurations.confdata import confdata_of, configurations
from rapidsim.motion.configurations.reachability import limit_excess, turns_within_limits
from rapidsim.motion.configurations.singularities import differential, pseudo_inverse
from rapidsim.motion.kinematics.closed_form.opw import OrthoParallel
from rapidsim.motion.robot.robot import Robot, load_robot

EXACT = 1e-9
QUARTER = np.pi / 2.0
X_OUT_FROM_TOOL0 = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
"""Exercises for the IRB 120 let x point out of the flange; tool0 has z."""
TARGETS = ("p10", "p20", "p30", "p40", "p50", "p60")


def pose_of(frame: dict[str, Any]) -> Transform:
    return Transform(np.array(frame["R"]), np.array(frame["p_m"]))


def assert_pose(pose: Transform, frame: dict[str, Any]) -> None:
    assert pose.translation == pytest.approx(frame["p_m"], abs=EXACT)
    assert pose.rotation == pytest.approx(np.array(frame["R"]), abs=EXACT)
    if "q_wxyz" in frame:
        q = quaternion_from_matrix(pose.rotation)
        assert abs(float(q @ np.array(frame["q_wxyz"]))) == pytest.approx(1.0, abs=1e-10)


def found(robot: Robot, pose: Transform) -> Array:
    """All joint vectors (k, n) [rad] of a pose, before limits."""
    branches = robot.inverse(pose)
    return branches.joints[branches.exists]


def test_irb_1600_forward() -> None:
    truth, robot = recorded("irb1600"), load_robot("irb1600")
    assert len(truth["fk_random"]) == 10
    for case in truth["fk_random"]:
        assert_pose(robot.forward(np.array(case["q"])), case)
    assert_pose(robot.forward(np.zeros(6)), truth["home_tool0"])


@pytest.mark.parametrize(("name", "key"), [("irb1600", "6_12"), ("irb1600-8-1.45", "8_145")])
def test_irb_1600_limits_and_speeds(name: str, key: str) -> None:
    """The recorded ones are rounded to four digits; ours are those in degrees."""
    truth, robot = recorded("irb1600"), load_robot(name)
    limits = np.stack([robot.lower, robot.upper], axis=-1)
    assert limits == pytest.approx(np.array(truth[f"limits_{key}"]), abs=2e-4)
    speeds = [joint.max_speed for joint in robot.joints]
    assert speeds == pytest.approx(truth[f"velocity_{key}"], abs=5e-4)


def test_irb_120_forward() -> None:
    truth, robot = recorded("irb120"), load_robot("irb120")
    cases = [*truth["fk_random"], {"q": np.zeros(6), **truth["zero"]}]
    cases += [{"q": np.full(6, np.pi / 6.0), **truth["check_pi_6"]}]
    assert len(cases) == 12
    for case in cases:
        pose = robot.forward(np.array(case["q"]))
        turned = Transform(pose.rotation @ X_OUT_FROM_TOOL0.T, pose.translation)
        assert_pose(turned, case)
    tip = robot.forward(np.full(6, np.pi / 6.0)).translation
    assert tip == pytest.approx(truth["claimed_pi_6"], abs=5e-5)
    limits = np.stack([robot.lower, robot.upper], axis=-1)
    assert limits == pytest.approx(np.array(truth["limits_ros_industrial"]), abs=1e-4)


@pytest.mark.parametrize("name", TARGETS)
def test_all_branches_of_the_drawing_targets(name: str) -> None:
    """Eight solutions each, their limits and their confdata."""
    target, robot = recorded("rapid_program")["targets"][name], load_robot("irb1600")
    pose = pose_of(target["tool0_base"])
    theirs = np.array([solution["q"] for solution in target["ik_6_12"]])
    assert_same_set(found(robot, pose), theirs, 1e-8)
    within = {tuple(s["conf_cf1_cf4_cf6_cfx"]) for s in target["ik_6_12"] if s["in_limits"]}
    ours = {one.confdata for one in configurations(robot, pose)}
    assert within <= ours
    for solution in target["ik_6_12"]:
        named = confdata_of(robot.kinematics, np.array(solution["q"]))
        assert list(named) == solution["conf_cf1_cf4_cf6_cfx"]


def test_which_drawing_targets_fit_their_confdata_in_an_unturned_object_frame() -> None:
    truth, robot = recorded("rapid_program"), load_robot("irb1600")
    tool = truth["tool_t4"]
    uframe = truth["wobj1"]["uframe"]
    base_from_user = pose_in_mm(uframe["p"], uframe["q"])
    flange_from_tcp = pose_in_mm(tool["trans_mm"], tool["rot"])
    for name in TARGETS:
        target = truth["targets"][name]
        user_from_tcp = pose_in_mm(target["trans_mm"], target["rot"])
        pose = base_from_user @ user_from_tcp @ flange_from_tcp.inverse()
        ours = [list(one.confdata) for one in configurations(robot, pose)]
        for theirs in truth["conf_with_identity_oframe_6_12"][name]:
            assert theirs in ours, name


def test_the_tool_less_targets_of_a_report() -> None:
    """In the principal turn one of six is reached; a whole turn of axis 3 brings all of them."""
    truth, robot = recorded("invented_targets"), load_robot("irb1600")
    principal_ways = []
    for point in truth["points_mm"]:
        pose = pose_in_mm(point, [0.924672, 0.0, 0.380768, 0.0])
        ways = [one for one in configurations(robot, pose) if one.confdata[3] in (0, 1)]
        principal_ways.append(len({one.confdata[3] for one in ways}))
        behind = [one for one in configurations(robot, pose) if one.confdata[3] in (6, 7)]
        assert {one.confdata[3] for one in behind} == {6, 7}
        for one in behind:
            assert -235.0 < np.degrees(one.joints[2]) < -180.0
            assert robot.forward(one.joints).matrix == pytest.approx(pose.matrix, abs=EXACT)
    assert principal_ways == truth["reach_tool0_6_12"]


def test_kr_10_reach_and_zero() -> None:
    truth, robot = recorded("kr10"), load_robot("kr10")
    arm = robot.kinematics
    assert isinstance(arm, OrthoParallel)
    g = arm.geometry
    assert g.a1 + g.reach == pytest.approx(truth["reach_m"], abs=1e-9)
    fore = float(np.hypot(g.a2, g.c3))
    ring = [abs(g.c2 - fore), g.c2 + fore]
    assert ring == pytest.approx(truth["wrist_annulus_around_axis2_m"], abs=1e-9)
    zero = arm.forward(kuka_axes_from_dh(np.zeros(6)))
    beyond_flange = truth["tool_z"] - g.c4
    tip = zero.translation + beyond_flange * zero.rotation[:, 2]
    assert tip == pytest.approx(truth["zero_pose"]["p_m"], abs=EXACT)
    assert zero.rotation == pytest.approx(np.array(truth["zero_pose"]["R"]), abs=EXACT)
    speeds = np.degrees([joint.max_speed or 0.0 for joint in robot.joints])
    assert speeds == pytest.approx(truth["speeds_ros_industrial_deg_s"])


@pytest.mark.parametrize(("rows", "counts"), [("fixed_8", None), ("eight_quad", 0)])
def test_kr_10_point_sets(rows: str, counts: int | None) -> None:
    """How many branches reach each point, and how many within the ranges the set was made for."""
    truth, robot = recorded("kr10"), load_robot("kr10")
    arm = robot.kinematics
    assert isinstance(arm, OrthoParallel)
    beyond_flange = truth["tool_z"] - arm.geometry.c4
    ranges = np.radians(np.array(truth["reported_axis_limits_kuka_convention_deg"]))
    for case in truth["datasets"][rows]:
        rotation = euler_xyz(np.pi * np.array(case["orientation_pi"]))
        flange = Transform(rotation, np.array(case["p"]) - beyond_flange * rotation[:, 2])
        branches = robot.inverse(flange)
        assert branches.exists.sum() == case["reachable_geometric"]
        if counts == 0:
            assert not branches.exists.any()
            assert branches.shortfall > 0.1
            continue
        middle = ranges.mean(axis=-1)
        joints = branches.joints[branches.exists]
        joints = joints + 2.0 * np.pi * np.round((middle - joints) / (2.0 * np.pi))
        within = (joints >= ranges[:, 0]) & (joints <= ranges[:, 1])
        assert within.all(axis=-1).sum() == case["reachable_within_reported_limits"]


def test_rv_m1_poses_jacobians_and_branches() -> None:
    truth, robot = recorded("rvm1"), load_robot("rvm1")
    for case in (*truth["random"], truth["program5"], truth["program12"]):
        assert_pose(robot.forward(np.array(case["q"])), case)
    assert_pose(robot.forward(np.zeros(5)), truth["home"])
    for case in truth["random"]:
        joints = np.array(case["q"])
        here = differential(robot.kinematics, joints)
        assert here.jacobian == pytest.approx(np.array(case["J"]), abs=1e-8)
        assert here.singular_values == pytest.approx(case["singular_values"], abs=1e-8)
        placing = np.linalg.svd(here.jacobian[:3, :4], compute_uv=False)
        assert placing == pytest.approx(case["position_J_singular_values_joints1_4"], abs=1e-8)
        inverse = pseudo_inverse(here.jacobian)
        assert inverse == pytest.approx(np.array(case["pseudo_inverse_J"]), abs=1e-7)
        origins = robot.kinematics.link_frames(joints).translation
        recorded_origins = np.array(case["joint_origins"])
        assert origins[1:4] == pytest.approx(recorded_origins[1:4], abs=EXACT)
        assert origins[4] == pytest.approx(recorded_origins[5], abs=EXACT)
        theirs = np.array([solution["q"] for solution in case["ik"] if solution["reachable"]])
        ours = found(robot, robot.forward(joints))
        assert_same_set(ours, theirs, 1e-8)
        within = ~limit_excess(robot, turns_within_limits(robot, ours)).any(axis=-1)
        assert within.sum() == sum(solution["in_limits"] for solution in case["ik"])


def test_rv_m1_singular_values_at_singular_places() -> None:
    truth, arm = recorded("rvm1")["singularities"], load_robot("rvm1").kinematics
    cases = [case for rows in truth.values() if isinstance(rows, list) for case in rows]
    assert len(cases) == 13
    for case in cases:
        here = differential(arm, np.radians(case["q_deg"]))
        assert here.singular_values == pytest.approx(case["full_J_sigma"], abs=1e-8)
        placing = np.linalg.svd(here.jacobian[:3], compute_uv=False)
        assert placing == pytest.approx(case["pos_J_sigma"], abs=1e-8)


def test_rv_m1_pitches_along_the_line() -> None:
    """In which pitches, to half a degree, each point of the line can be held within the limits."""
    line, robot = recorded("rvm1")["line_follower"], load_robot("rvm1")
    pitches = np.arange(-180.0, 180.0, 0.5)
    cp, sp = np.cos(np.radians(pitches)), np.sin(np.radians(pitches))
    zero, one = np.zeros_like(cp), np.ones_like(cp)
    left, up, out = (zero, one, zero), (-sp, zero, cp), (cp, zero, sp)
    rotation = np.stack([np.stack(axis, axis=-1) for axis in (left, up, out)], axis=-1)
    for point, expected in zip(line["points_m"], line["feasible_pitch_deg_range"], strict=True):
        places = np.broadcast_to(np.array(point), (len(pitches), 3))
        branches = robot.inverse(Transform(rotation, places))
        assert branches.exists.any()
        joints = turns_within_limits(robot, branches.joints)
        within = branches.exists & ~limit_excess(robot, joints).any(axis=-1)
        held = pitches[within.any(axis=-1)]
        assert (held.size > 0) == (expected is not None)
        if expected is not None:
            assert [held.min(), held.max()] == pytest.approx(expected, abs=0.51)


@pytest.mark.parametrize("rule", [0, 1])
def test_rv_m1_joints_along_the_letter(rule: int) -> None:
    """Both placements that the whole letter can be drawn in: on a wall and on a table."""
    placement = recorded("letter_d")["placements_fully_reachable"][rule]
    arm = load_robot("rvm1").kinematics
    pitch = (0.0, -QUARTER)[rule]
    for point, joints in zip(placement["points_m"], placement["q"], strict=True):
        pose = arm.forward(np.array(joints))
        assert pose.translation == pytest.approx(point, abs=EXACT)
        assert pose.rotation[2, 2] == pytest.approx(np.sin(pitch), abs=EXACT)
        branches = arm.inverse(pose)
        ours = branches.joints[arm.branch_of(np.array(joints))]
        assert ours == pytest.approx(np.array(joints), abs=1e-8)
    least = [
        np.linalg.svd(arm.jacobian(np.array(q))[:3], compute_uv=False)[-1] for q in placement["q"]
    ]
    whole = [np.linalg.svd(arm.jacobian(np.array(q)), compute_uv=False)[-1] for q in placement["q"]]
    assert placement["min_sigma"] in (
        pytest.approx(min(least), abs=1e-8),
        pytest.approx(min(whole), abs=1e-8),
    )


def pose_in_mm(position: list[float], q: list[float]) -> Transform:
    length = float(np.linalg.norm(q))
    return Transform.from_quaternion([v / length for v in q], [v / 1000.0 for v in position])


def euler_xyz(angles: Array) -> Array:
    """Rz(c) Ry(b) Rx(a) of angles a, b, c [rad]."""
    (ca, cb, cc), (sa, sb, sc) = np.cos(angles), np.sin(angles)
    about_x = np.array([[1, 0, 0], [0, ca, -sa], [0, sa, ca]])
    about_y = np.array([[cb, 0, sb], [0, 1, 0], [-sb, 0, cb]])
    about_z = np.array([[cc, -sc, 0], [sc, cc, 0], [0, 0, 1]])
    turned: Array = about_z @ about_y @ about_x
    return turned


def kuka_axes_from_dh(theta: Array) -> Array:
    """A1 to A6 [rad] of the angles of the DH table."""
    return np.array(
        [-theta[0], -theta[1], theta[2] + QUARTER, -theta[3], theta[4], np.pi - theta[5]]
    )
