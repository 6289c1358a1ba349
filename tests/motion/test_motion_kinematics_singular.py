"""Where branches meet: axis 5 at 0, the elbow stretched, the wrist centre on axis 1."""

import numpy as np
import pytest

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.closed_form.opw import OrthoParallel
from rapidsim.motion.robot.robot import load_robot

IRB_120_STRETCHED = np.arctan2(0.070, 0.302) - np.pi / 2.0


def arm_of(name: str) -> OrthoParallel:
    arm = load_robot(name).kinematics
    assert isinstance(arm, OrthoParallel)
    return arm


def worst(arm: OrthoParallel, joints: Array, pose: Transform) -> float:
    reached = arm.forward(joints)
    return float(
        max(
            np.max(np.abs(reached.translation - pose.translation)),
            np.max(np.abs(reached.rotation - pose.rotation)),
        )
    )


@pytest.mark.parametrize("name", ["irb120", "irb1600"])
@pytest.mark.parametrize("axis_5", [0.0, 1e-15, 1e-12, 1e-9, 1.7e-8, 1e-7, 1e-6, -1e-9, -1e-6])
@pytest.mark.parametrize("others", [(0, 0, 0, 0, 0), (0.3, -0.4, 0.2, 1.1, -2.0)])
def test_no_branch_is_lost_at_axis_5_zero(
    name: str, axis_5: float, others: tuple[float, ...]
) -> None:
    arm = arm_of(name)
    joints = np.array([*others[:4], axis_5, others[4]])
    pose = arm.forward(joints)
    branches = arm.inverse(pose)
    # The wrist cannot cost a branch: those of the first three axes come in pairs.
    assert np.array_equal(branches.exists[0::2], branches.exists[1::2])
    assert branches.exists[arm.branch_of(joints)]
    for row in branches.joints[branches.exists]:
        assert worst(arm, row, pose) < 1e-9


def test_axis_4_keeps_its_value_where_axis_5_is_zero() -> None:
    arm = arm_of("irb1600")
    joints = np.array([0.2, 0.3, -0.2, 1.234, 0.0, 0.5])
    followed = arm.inverse_on_branch(arm.forward(joints[None]), 0, joints)
    assert np.max(np.abs(followed.joints[0] - joints)) < 1e-9


def test_axis_4_keeps_its_value_along_a_row_that_touches_axis_5_zero() -> None:
    arm = arm_of("irb1600")
    row = np.tile([0.2, 0.3, -0.2, 0.9, 0.0, 0.5], (101, 1))
    row[:, 4] = np.abs(np.linspace(-0.5, 0.5, 101))
    assert row[50, 4] == 0.0
    followed = arm.inverse_on_branch(arm.forward(row), 0, row[0])
    assert np.max(np.abs(followed.joints - row)) < 1e-9


@pytest.mark.parametrize("beyond", [0.0, 1e-12, -1e-12, 1.7e-8, -1.7e-8])
def test_no_branch_is_lost_at_the_stretched_elbow(beyond: float) -> None:
    arm = arm_of("irb120")
    joints = np.array([0.4, 0.3, IRB_120_STRETCHED + beyond, 0.5, 0.6, 0.7])
    pose = arm.forward(joints)
    branches = arm.inverse(pose)
    assert branches.shortfall == 0.0
    assert branches.exists.all()
    for row in branches.joints:
        assert worst(arm, row, pose) < 1e-9


@pytest.mark.parametrize("name", ["irb120", "irb1600"])
def test_a_wrist_centre_on_axis_1_leaves_axis_1_where_it_is(name: str) -> None:
    arm = arm_of(name)
    g = arm.geometry
    # Axis 3 so that the wrist centre comes above axis 2 by as much as axis 2 stands ahead.
    distance, fore = 0.4, float(np.hypot(g.a2, g.c3))
    elbow = -np.arccos((distance**2 - g.c2**2 - fore**2) / (2.0 * g.c2 * fore))
    lean = np.arcsin(-g.a1 / distance)
    axis_2 = lean - np.arctan2(fore * np.sin(elbow), g.c2 + fore * np.cos(elbow))
    axis_3 = elbow - np.arctan2(g.a2, g.c3) - np.pi / 2.0
    joints = np.array([0.6109, axis_2, axis_3, 0.4, 0.5, 0.6])
    pose = arm.forward(joints)
    wrist_centre = pose.translation - g.c4 * pose.rotation[:, 2]
    assert np.hypot(*wrist_centre[:2]) < 1e-12

    branches = arm.inverse(pose)
    assert branches.exists.all()
    for row in branches.joints:
        assert worst(arm, row, pose) < 1e-9
    branch = int(arm.branch_of(joints))
    followed = arm.inverse_on_branch(pose[None], branch, joints)
    assert np.max(np.abs(followed.joints[0] - joints)) < 1e-9


def test_borders_count_as_in_front_and_positive() -> None:
    arm = arm_of("irb120")
    assert arm.branch_of(np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0])) == 0
    assert arm.branch_of(np.array([0.0, 0.3, IRB_120_STRETCHED, 0.0, -0.0, 0.0])) == 0


def test_a_gap_in_a_row_is_a_value_and_the_row_goes_on() -> None:
    """A straight line that leaves the reach of the arm and comes back."""
    arm = arm_of("irb120")
    y = np.linspace(-0.45, 0.45, 181)
    points = np.column_stack([np.full_like(y, 0.45), y, np.full_like(y, 0.55)])
    line = Transform(np.broadcast_to(arm.forward(np.zeros(6)).rotation, (181, 3, 3)), points)
    followed = arm.inverse_on_branch(line, 0, np.zeros(6))
    assert not followed.exists[0]
    assert not followed.exists[-1]
    assert followed.exists[90]
    inside = followed.joints[followed.exists]
    assert np.isfinite(followed.joints).all()
    assert np.max(np.abs(np.diff(inside, axis=0))) < 0.5
