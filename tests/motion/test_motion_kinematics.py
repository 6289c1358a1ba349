"""Laws of forward and inverse kinematics: each undoes the other, on every branch, everywhere."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.closed_form.opw import OrthoParallel
from rapidsim.motion.kinematics.closed_form.opw_geometry import OpwGeometry
from rapidsim.motion.robot.catalogue import arm_from_geometry
from rapidsim.motion.robot.robot import load_robot

QUARTER = np.pi / 2.0
CATALOGUE_ARMS = (
    "irb120-3-0.58",
    "irb1600-6-1.2",
    "irb1600-8-1.45",
    "irb6640-180-2.55",
    "irb4400-60-1.95",
    "irb6650s-125-3.5",
    "kr10-r1100-sixx",
    "kr16-2",
)
"""Each kind of zero, sign and offset that the catalogue has; `test_motion_catalogue` takes all."""
ABB_ZERO = (0.0, 0.0, -QUARTER, 0.0, 0.0, 0.0)


def _catalogue_arm(name: str) -> OrthoParallel:
    arm = load_robot(name).kinematics
    assert isinstance(arm, OrthoParallel)
    return arm


def _rod_arm() -> OrthoParallel:
    """An arm whose rod keeps the forearm's tilt when axis 2 moves."""
    geometry = OpwGeometry(0.1, -0.135, 0.0, 0.615, 0.705, 0.755, 0.085, ABB_ZERO, coupling=-1)
    return arm_from_geometry(geometry)


def _sideways_arm() -> OrthoParallel:
    """An arm of another make: signs and zeros differ, and the wrist stands off the middle."""
    return arm_from_geometry(
        OpwGeometry(
            0.025, -0.035, 0.04, 0.4, 0.56, 0.515, 0.08,
            (0.0, -QUARTER, 0.0, 0.0, 0.0, 0.0), (-1, 1, 1, -1, 1, -1),
        )
    )  # fmt: skip


ARMS: dict[str, Callable[[], OrthoParallel]] = {
    **{name: (lambda name=name: _catalogue_arm(name)) for name in CATALOGUE_ARMS},  # type: ignore[misc]
    "parallel rod": _rod_arm,
    "other signs": _sideways_arm,
}


@pytest.fixture(params=ARMS, scope="module")
def arm(request: pytest.FixtureRequest) -> OrthoParallel:
    return ARMS[request.param]()


def random_joints(count: int, seed: int = 7) -> Array:
    return np.random.default_rng(seed).uniform(-np.pi, np.pi, (count, 6))


def same_turn(joints: Array, other: Array) -> Array:
    """The largest difference (...,) of joint vectors, whole turns aside."""
    difference = joints - other
    difference -= 2.0 * np.pi * np.round(difference / (2.0 * np.pi))
    largest: Array = np.max(np.abs(difference), axis=-1)
    return largest


def assert_same_pose(pose: Transform, other: Transform, tolerance: float) -> None:
    assert np.max(np.abs(pose.translation - other.translation), initial=0.0) < tolerance
    assert np.max(np.abs(pose.rotation - other.rotation), initial=0.0) < tolerance


def test_every_branch_reaches_the_pose(arm: OrthoParallel) -> None:
    pose = arm.forward(random_joints(2000))
    branches = arm.inverse(pose)
    rows, _ = np.nonzero(branches.exists)
    assert_same_pose(arm.forward(branches.joints[branches.exists]), pose[rows], 1e-9)


def test_inverse_contains_the_joints(arm: OrthoParallel) -> None:
    joints = random_joints(2000)
    branches = arm.inverse(arm.forward(joints))
    own = arm.branch_of(joints)
    rows = np.arange(len(joints))
    assert branches.exists[rows, own].all()
    assert np.max(same_turn(branches.joints[rows, own], joints)) < 1e-7


def test_branches_are_in_their_place(arm: OrthoParallel) -> None:
    branches = arm.inverse(arm.forward(random_joints(2000)))
    index = np.broadcast_to(np.arange(8), branches.exists.shape)
    assert np.array_equal(arm.branch_of(branches.joints)[branches.exists], index[branches.exists])


def test_what_does_not_exist_is_zero_and_short_of_nothing_is_reachable(arm: OrthoParallel) -> None:
    rng = np.random.default_rng(3)
    pose = Transform(arm.forward(random_joints(2000)).rotation, rng.uniform(-3.0, 3.0, (2000, 3)))
    branches = arm.inverse(pose)
    assert np.isfinite(branches.joints).all()
    assert not branches.joints[~branches.exists].any()
    assert np.array_equal(branches.exists.any(axis=-1), branches.shortfall == 0.0)
    assert (branches.shortfall >= 0.0).all()
    assert (~branches.exists).any()
    assert branches.exists.any()


def test_shortfall_is_the_distance_to_the_envelope() -> None:
    arm = _catalogue_arm("irb120")
    g = arm.geometry
    top = g.c1 + g.reach + g.c4
    upright = Transform(np.eye(3), np.array([[0.0, 0.0, top], [0.0, 0.0, top + 0.0472]]))
    assert arm.inverse(upright).shortfall == pytest.approx([0.0, 0.0472], abs=1e-12)
    folded = abs(g.c2 - float(np.hypot(g.a2, g.c3)))
    inside = Transform(np.eye(3), np.array([0.0, 0.0, g.c1 + 0.25 * folded + g.c4]))
    assert arm.inverse(inside).shortfall == pytest.approx(0.75 * folded, abs=1e-12)


def test_one_branch_agrees_with_all(arm: OrthoParallel) -> None:
    joints = random_joints(500)
    pose = arm.forward(joints)
    branches = arm.inverse(pose)
    for branch in range(arm.branch_count):
        followed = arm.inverse_on_branch(pose, branch, joints)
        assert np.array_equal(followed.exists, branches.exists[:, branch])
        difference = same_turn(followed.joints, branches.joints[:, branch])
        assert np.max(difference[followed.exists], initial=0.0) < 1e-9
        turns = np.abs(followed.joints - joints)[followed.exists]
        assert np.max(turns, initial=0.0) < np.pi + 1e-9


def test_a_row_is_followed_without_jumps(arm: OrthoParallel) -> None:
    """Two whole turns of axis 6 and one of axis 1 come out as they went in."""
    start = np.array([0.1, 0.2, 0.3, 0.4, 0.9, -1.0])
    end = start + np.array([2.0 * np.pi, 0.2, -0.2, 0.4, 0.2, 4.0 * np.pi])
    joints = start + np.linspace(0.0, 1.0, 400)[:, None] * (end - start)
    branch = int(arm.branch_of(start))
    followed = arm.inverse_on_branch(arm.forward(joints), branch, start)
    assert followed.exists.all()
    assert np.max(np.abs(followed.joints - joints)) < 1e-9


def test_jacobian_is_the_derivative_of_forward(arm: OrthoParallel) -> None:
    joints = random_joints(100)
    jacobian = arm.jacobian(joints)
    turned_back = np.swapaxes(arm.forward(joints).rotation, -1, -2)
    step = 1e-6
    for axis in range(6):
        nudge = np.zeros(6)
        nudge[axis] = step
        after, before = arm.forward(joints + nudge), arm.forward(joints - nudge)
        velocity = (after.translation - before.translation) / (2.0 * step)
        spin = (after.rotation - before.rotation) / (2.0 * step) @ turned_back
        omega = np.stack([spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]], axis=-1)
        assert np.max(np.abs(jacobian[:, :3, axis] - velocity)) < 1e-8
        assert np.max(np.abs(jacobian[:, 3:, axis] - omega)) < 1e-8


def test_last_link_carries_the_flange(arm: OrthoParallel) -> None:
    """Between the last link and the flange nothing moves; each link turns about its own origin."""
    joints = random_joints(50)
    links = arm.link_frames(joints)
    flange = links[:, -1].inverse() @ arm.forward(joints)
    assert_same_pose(flange, flange[np.zeros(50, dtype=int)], 1e-12)
    first = arm.link_frames(np.zeros(6))
    assert np.max(np.abs(first.rotation - np.eye(3))) < 1e-12


def test_any_shape_of_batch(arm: OrthoParallel) -> None:
    joints = random_joints(6).reshape(2, 3, 6)
    one = arm.forward(joints[1, 2])
    pose = arm.forward(joints)
    assert pose.translation.shape == (2, 3, 3)
    assert_same_pose(pose[1, 2], one, 1e-15)
    assert arm.inverse(pose).joints.shape == (2, 3, 8, 6)
    assert arm.inverse(one).joints.shape == (8, 6)
    assert arm.jacobian(joints).shape == (2, 3, 6, 6)
    assert arm.link_frames(joints).translation.shape == (2, 3, 6, 3)
    assert arm.branch_of(joints).shape == (2, 3)


angles = st.floats(-3.0, 3.0)


@examples(60)
@given(joints=st.tuples(*[angles] * 6))
def test_forward_undoes_inverse_for_any_joints(joints: tuple[float, ...]) -> None:
    arm = _catalogue_arm("irb120")
    pose = arm.forward(np.array(joints))
    branches = arm.inverse(pose)
    assert branches.exists.any()
    for row in branches.joints[branches.exists]:
        assert_same_pose(arm.forward(row), pose, 1e-8)
