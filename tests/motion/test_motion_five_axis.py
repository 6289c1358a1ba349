"""The RV-M1: its DH table, its four branches, what five axes cannot do, where it is singular."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference_numbers import recorded

from rapidsim.frames.rotation_vectors import rotation_from_vector
from rapidsim.frames.transform import Transform
from rapidsim.motion.configurations.confdata import confdata_of, select
from rapidsim.motion.configurations.reachability import (
    limit_excess,
    turns_within_limits,
    unreachable_reason,
)
from rapidsim.motion.configurations.singularities import differential, pseudo_inverse
from rapidsim.motion.kinematics.closed_form.five_axis import FiveAxis, FiveAxisGeometry
from rapidsim.motion.kinematics.unwrapping import principal
from rapidsim.motion.robot.robot import load_robot

ARM = FiveAxis(FiveAxisGeometry(d1=0.152, a2=0.25, a3=0.16, d5=0.072))
JOINTS = st.lists(st.floats(-3.1, 3.1), min_size=5, max_size=5).map(np.array)


@pytest.fixture(scope="module")
def ground_truth() -> dict[str, Any]:
    return recorded("rvm1")


def test_forward_and_jacobian(ground_truth: dict[str, Any]) -> None:
    named = [ground_truth["program5"], ground_truth["program12"]]
    for case in (*ground_truth["random"], *named):
        joints = np.array(case["q"])
        pose = ARM.forward(joints)
        assert pose.translation == pytest.approx(case["p_m"], abs=1e-10)
        assert pose.rotation == pytest.approx(np.array(case["R"]), abs=1e-10)
    for case in ground_truth["random"]:
        found = differential(ARM, np.array(case["q"]))
        assert found.jacobian == pytest.approx(np.array(case["J"]), abs=1e-10)
        assert found.singular_values == pytest.approx(case["singular_values"], abs=1e-10)
        expected = np.array(case["pseudo_inverse_J"])
        assert pseudo_inverse(found.jacobian) == pytest.approx(expected, abs=1e-8)


def test_all_four_branches(ground_truth: dict[str, Any]) -> None:
    for case in ground_truth["random"]:
        branches = ARM.inverse(ARM.forward(np.array(case["q"])))
        assert branches.exists.all()
        for ours, theirs in zip(branches.joints, case["ik"], strict=True):
            assert np.abs(principal(ours - np.array(theirs["q"]))).max() < 1e-9


@pytest.mark.parametrize(
    ("joints_deg", "near"),
    [
        ([20, 30, 0, 0, 10], ("elbow",)),
        ([20, 30, 0, 50, 10], ("elbow",)),
        ([20, -30, -30, 0, 10], ()),
        ([20, -30, -60, 0, 10], ()),
        ([20, -30, -90, 90, 10], ()),
        ([17.18873385392, 90, -20, 69.46814424985, 11.45915590262], ("shoulder",)),
    ],
)
def test_singular_sets(joints_deg: Sequence[float], near: tuple[str, ...]) -> None:
    """The straight elbow and the flange on the waist axis; not the set with joint 2 at -30."""
    found = differential(ARM, np.radians(joints_deg))
    assert found.near == near
    assert found.rank == (4 if "elbow" in near else 5)


def test_a_flange_on_the_waist_axis_moves_in_a_plane(ground_truth: dict[str, Any]) -> None:
    for case in ground_truth["singularities"]["radius_zero_inside_limits"]:
        jacobian = ARM.jacobian(np.radians(case["q_deg"]))
        assert np.linalg.svd(jacobian[:3], compute_uv=False)[-1] < 1e-9


@given(JOINTS)
def test_inverse_contains_the_joints(joints: np.ndarray) -> None:
    pose = ARM.forward(joints)
    branches = ARM.inverse(pose)
    branch = int(ARM.branch_of(joints))
    reached = ARM.forward(branches.joints[branches.exists])
    assert np.abs(reached.matrix - pose.matrix).max() < 1e-7
    assert branches.exists[branch]


@given(JOINTS)
def test_one_branch_agrees_with_all(joints: np.ndarray) -> None:
    pose = ARM.forward(joints[None])
    branches = ARM.inverse(pose)
    for branch in range(4):
        followed = ARM.inverse_on_branch(pose, branch, joints)
        assert followed.exists[0] == branches.exists[0, branch]
        reached = ARM.forward(followed.joints[followed.exists])
        assert np.abs(reached.matrix - pose.matrix).max(initial=0.0) < 1e-7


def test_an_orientation_out_of_the_plane_is_refused_with_its_angle() -> None:
    robot = load_robot("rvm1")
    pose = robot.forward(np.radians([10.0, 40.0, -60.0, -30.0, 0.0]))
    sideways = rotation_from_vector(np.array([0.0, 0.0, np.radians(7.0)]))
    turned = Transform(sideways @ pose.rotation, pose.translation)
    assert not robot.inverse(turned).exists.any()
    why = unreachable_reason(robot, turned)
    assert why is not None
    assert 1.0 < np.degrees(why.tilt) < 7.5
    assert "deg from what the axes of this arm can give" in why.message


def test_a_pose_too_far_says_how_far() -> None:
    robot = load_robot("rvm1")
    pose = robot.forward(np.zeros(5))
    farther = pose.translation + np.array([0.1, 0.0, 0.0])
    why = unreachable_reason(robot, Transform(pose.rotation, farther))
    assert why is not None
    assert why.message == "wrist centre 100.0 mm beyond reach"


def test_which_points_of_a_known_line_have_a_pitch_within_the_limits(
    ground_truth: dict[str, Any],
) -> None:
    """All eleven points are within reach; the first five need a joint beyond its limit."""
    robot = load_robot("rvm1")
    line = ground_truth["line_follower"]
    pitches = np.radians(np.arange(-180.0, 180.0, 0.5))
    c, s, zero = np.cos(pitches), np.sin(pitches), np.zeros_like(pitches)
    left, up = np.stack([zero, zero + 1.0, zero], axis=-1), np.stack([-s, zero, c], axis=-1)
    rotation = np.stack([left, up, np.stack([c, zero, s], axis=-1)], axis=-1)
    flags = []
    for point in line["points_m"]:
        branches = robot.inverse(Transform(rotation, np.broadcast_to(point, (len(pitches), 3))))
        assert branches.exists.any()
        joints = turns_within_limits(robot, branches.joints)
        within = branches.exists & ~limit_excess(robot, joints).any(axis=-1)
        flags.append(bool(within.any()))
    assert flags == line["flags_within_limits"]


def test_confdata_finds_the_joints_again() -> None:
    robot = load_robot("rvm1")
    joints = np.random.default_rng(3).uniform(robot.lower, robot.upper, (200, 5))
    named = confdata_of(robot.kinematics, joints)
    selected = select(robot, robot.forward(joints), named, np.zeros(5))
    assert selected.exists.all()
    assert not selected.quarters_off.any()
    assert np.abs(selected.joints - joints).max() < 1e-6
