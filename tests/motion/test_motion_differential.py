"""Singular values, singularities and joint speeds."""

import numpy as np
import pytest

from rapidsim.frames.rotation_vectors import rotation_from_vector
from rapidsim.frames.transform import Transform
from rapidsim.motion.configurations.singularities import (
    differential,
    joint_speeds,
    pseudo_inverse,
    tcp_jacobian,
)
from rapidsim.motion.kinematics.closed_form.opw import OrthoParallel
from rapidsim.motion.kinematics.numerical.solver import Numerical
from rapidsim.motion.kinematics.serial_chain import AxesAtZero, SerialChain
from rapidsim.motion.robot.robot import load_robot

ARM = load_robot("irb120").kinematics
STRETCHED_DEG = -76.9502  # the angle at which elbow and wrist centre line up with axis 2
USUAL = np.radians([10.0, 20.0, -20.0, 15.0, 40.0, 5.0])


@pytest.mark.parametrize(
    ("joints_deg", "near"),
    [
        ([0, 20, -30, 30, 0, 0], ("wrist",)),
        ([0, 20, -30, 30, 2, 0], ("wrist",)),
        ([0, 20, STRETCHED_DEG, 0, 40, 0], ("elbow",)),
        ([10, 20, -20, 15, 40, 5], ()),
    ],
)
def test_singularities_are_named(joints_deg: list[float], near: tuple[str, ...]) -> None:
    assert differential(ARM, np.radians(joints_deg)).near == near


def test_a_wrist_centre_on_axis_1_is_the_shoulder() -> None:
    assert isinstance(ARM, OrthoParallel)
    pose = ARM.forward(USUAL)
    wrist = pose.translation - pose.rotation[:, 2] * 0.072
    above = Transform(pose.rotation, pose.translation - [wrist[0], wrist[1], -0.2])
    branches = ARM.inverse(above)
    joints = branches.joints[branches.exists][0]
    found = differential(ARM, joints)
    assert "shoulder" in found.near
    assert found.rank < 6


def test_the_determinant_is_the_product_of_the_distances() -> None:
    """Up to the lengths of the arm, so no singularity is missing and none is too many."""
    joints = np.random.default_rng(4).uniform(-1.5, 1.5, (40, 6))
    shares = []
    for row in joints:
        product = np.prod([s.distance for s in ARM.singularities(row)])
        shares.append(abs(np.linalg.det(ARM.jacobian(row))) / product)
    assert np.ptp(shares) < 1e-9 * np.mean(shares)
    assert differential(ARM, joints[0]).manipulability == pytest.approx(
        abs(np.linalg.det(ARM.jacobian(joints[0])))
    )


def test_joint_speeds_give_the_twist() -> None:
    twist = np.array([0.1, -0.2, 0.05, 0.3, 0.0, -0.4])
    speeds, missed = joint_speeds(ARM.jacobian(USUAL), twist)
    assert np.abs(missed).max() < 1e-12
    step = 1e-6
    ahead, behind = ARM.forward(USUAL + step * speeds), ARM.forward(USUAL - step * speeds)
    velocity = (ahead.translation - behind.translation) / (2.0 * step)
    assert velocity == pytest.approx(twist[:3], abs=1e-8)


def test_in_a_singularity_speeds_stay_finite_and_say_what_is_missed() -> None:
    jacobian = ARM.jacobian(np.radians([0.0, 20.0, -30.0, 0.0, 0.0, 0.0]))
    speeds, missed = joint_speeds(jacobian, np.array([0.0, 0.1, 0.0, 0.0, 0.0, 0.0]))
    assert np.abs(speeds).max() < 10.0
    assert np.abs(missed).max() > 1e-3
    assert np.isfinite(pseudo_inverse(np.zeros((6, 6)))).all()


def test_the_jacobian_of_a_tool_is_the_derivative_of_its_tcp() -> None:
    tool = Transform(rotation_from_vector(np.array([0.1, 0.2, 0.3])), np.array([0.05, 0.0, 0.2]))
    jacobian = tcp_jacobian(ARM, USUAL, tool)
    step = 1e-6
    for joint in range(6):
        ahead = ARM.forward(USUAL + step * np.eye(6)[joint]) @ tool
        behind = ARM.forward(USUAL - step * np.eye(6)[joint]) @ tool
        velocity = (ahead.translation - behind.translation) / (2.0 * step)
        assert velocity == pytest.approx(jacobian[:3, joint], abs=1e-8)


@pytest.mark.parametrize(
    ("joints_deg", "name"),
    [([0, 20, -30, 30, 0, 0], "wrist"), ([0, 20, STRETCHED_DEG, 10, 40, 0], "elbow")],
)
def test_arms_without_formulas_are_named_by_what_moves_in_vain(
    joints_deg: list[float], name: str
) -> None:
    zero = np.zeros(6)
    links = ARM.link_frames(zero)
    axes = AxesAtZero(ARM.jacobian(zero)[3:].T, links.translation, links, ARM.forward(zero))
    limit = np.full(6, 3.0)
    arm = Numerical(SerialChain.uncoupled(axes), -limit, limit)
    assert differential(arm, np.radians(joints_deg)).near == (name,)
    assert differential(arm, USUAL).near == ()
