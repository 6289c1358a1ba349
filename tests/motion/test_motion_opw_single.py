"""One pose in plain floats is a batch of one: the same joints, the same poses, the same branch."""

from math import pi

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rapidsim.frames import rigid
from rapidsim.frames.transform import Transform, matrix_from_quaternion
from rapidsim.motion.configurations.confdata import confdata_of, configurations, named
from rapidsim.motion.kinematics.closed_form.opw import OrthoParallel
from rapidsim.motion.kinematics.closed_form.opw_geometry import OpwGeometry
from rapidsim.motion.kinematics.unwrapping import in_turn_of, turned_towards
from rapidsim.motion.robot.catalogue import arm_from_geometry
from rapidsim.motion.robot.robot import Robot, load_robot

ARMS = (
    "irb120-3-0.58",
    "irb1600-6-1.2",
    "irb6640-180-2.55",
    "irb4400-60-1.95",
    "kr10-r1100-sixx",
    "rod",
    "aside",
)
"""Each kind of zero, sign and frame; the last two have a rod and a wrist beside the middle."""
MADE = {
    "rod": OpwGeometry(0.1, -0.135, 0.0, 0.615, 0.705, 0.755, 0.085, (0.0,) * 6, coupling=-1),
    "aside": OpwGeometry(
        *(0.025, -0.035, 0.04, 0.4, 0.56, 0.515, 0.08),
        (0.0, -pi / 2, 0.0, 0.0, 0.0, 0.0),
        (-1, 1, 1, -1, 1, -1),
    ),
}

angle = st.one_of(st.floats(-7.0, 7.0), st.sampled_from([0.0, pi / 2, -pi / 2, pi, -pi, 1e-9]))
six = st.tuples(*[angle] * 6)
near = st.tuples(*[st.floats(-1.0, 1.0)] * 6)


def _arm(name: str) -> OrthoParallel:
    made = MADE.get(name)
    kinematics = load_robot(name).kinematics if made is None else arm_from_geometry(made)
    assert isinstance(kinematics, OrthoParallel)
    return kinematics


arms = st.sampled_from([_arm(name) for name in ARMS])


def twice(joints: tuple[float, ...]) -> np.ndarray:
    """A row of two, which takes the way of batches."""
    return np.array([joints, joints])


@given(arms, six)
def test_forward_and_branch_are_those_of_a_batch(
    arm: OrthoParallel, joints: tuple[float, ...]
) -> None:
    one, rows = np.array(joints), twice(joints)
    pose, poses = arm.forward(one), arm.forward(rows)
    assert pose.rotation == pytest.approx(poses.rotation[0], abs=1e-13)
    assert pose.translation == pytest.approx(poses.translation[0], abs=1e-13)
    assert confdata_of(arm, one).tolist() == confdata_of(arm, rows)[0].tolist()


@given(arms, six, near, st.integers(0, 7))
def test_inverse_is_that_of_a_batch(
    arm: OrthoParallel, joints: tuple[float, ...], near: tuple[float, ...], branch: int
) -> None:
    pose = arm.forward(np.array(joints))
    held = np.array(joints) + np.array(near)
    one = arm.inverse_on_branch(pose[None], branch, held)
    rows = arm.inverse_on_branch(
        Transform(np.stack([pose.rotation] * 2), np.stack([pose.translation] * 2)), branch, held
    )
    assert one.joints.shape == (1, 6)
    assert one.exists.tolist() == rows.exists[:1].tolist()
    # Near the stretched elbow a rounding of the pose is its square root in the joints; near a
    # straight wrist it is what axis 5 magnifies. What both ways must agree in is the pose.
    if one.exists[0]:
        again, batch = arm.forward(one.joints[0]), arm.forward(rows.joints)[0]
        assert again.translation == pytest.approx(batch.translation, abs=1e-9)
        assert again.rotation == pytest.approx(batch.rotation, abs=1e-6)
        sine = min(abs(np.sin(arm.theta_from_joints(row)[4])) for row in rows.joints)
        if sine > 1e-3:
            # Half a turn away both turns are nearest, and rounding chooses.
            turns = np.round((one.joints[0] - rows.joints[0]) / (2.0 * pi))
            assert one.joints[0] - 2.0 * pi * turns == pytest.approx(rows.joints[0], abs=2e-7)
            assert np.abs(one.joints[0] - held).max() < pi + 1e-9
            assert again.rotation == pytest.approx(pose.rotation, abs=1e-9)
    else:
        assert not one.joints.any()


robots = st.sampled_from([load_robot(name) for name in ARMS if name not in MADE])
quarter = st.integers(-5, 4)


@given(robots, six, st.tuples(quarter, quarter, quarter, st.integers(-1, 8)))
def test_confdata_names_what_it_names_among_all(
    robot: Robot, joints: tuple[float, ...], other: tuple[int, int, int, int]
) -> None:
    pose = robot.forward(np.clip(joints, robot.lower, robot.upper))
    every = configurations(robot, pose)
    for wanted in {other, *(one.confdata for one in every)}:
        found = named(robot, pose, wanted)
        first = next((one for one in every if one.confdata == wanted), None)
        if first is None:
            assert found is None
        elif found is None:
            # A straight wrist or a wrist centre on axis 1: there axes share out what they turn, or
            # two branches meet.
            assert min(np.linalg.svd(robot.kinematics.jacobian(first.joints))[1]) < 1e-6
        else:
            assert found.confdata == wanted
            assert found.joints == pytest.approx(first.joints, abs=1e-7)


@pytest.mark.parametrize("branch", [0, 1])
def test_an_undetermined_axis_4_stays(branch: int) -> None:
    arm, straight = _arm("irb120-3-0.58"), np.array((0.3, 0.2, 0.1, 0.4, 0.0, -0.5))
    held = straight + 0.1
    found = arm.inverse_on_branch(arm.forward(straight)[None], branch, held)
    assert found.joints[0, 3] == held[3]


@given(arms)
def test_what_is_out_of_reach_is_so_for_one_pose(arm: OrthoParallel) -> None:
    far = Transform(np.eye(3)[None], np.array([[9.0, 0.0, 0.0]]))
    assert not arm.inverse_on_branch(far, 0, np.zeros(6)).exists.any()


@given(st.floats(-20.0, 20.0), st.floats(-20.0, 20.0))
@example(0.0, pi)
@example(0.0, -pi)
@example(0.0, 3.0 * pi)
@example(pi, -2.0 * pi)
def test_an_angle_turns_as_in_a_row(before: float, angle: float) -> None:
    row = in_turn_of(np.array([[angle]]), np.array([True]), np.array([before]))
    assert turned_towards(before, angle) == row[0, 0]


quaternion = st.tuples(*[st.floats(-1.0, 1.0)] * 4).filter(lambda q: sum(x * x for x in q) > 0.01)
point = st.tuples(*[st.floats(-5.0, 5.0)] * 3)


@given(quaternion, point, quaternion, point)
def test_a_rigid_is_the_transform_of_its_numbers(
    q: tuple[float, float, float, float],
    p: tuple[float, float, float],
    r: tuple[float, float, float, float],
    s: tuple[float, float, float],
) -> None:
    a_from_b = Transform(matrix_from_quaternion(np.array(q)), np.array(p))
    b_from_c = Transform(matrix_from_quaternion(np.array(r)), np.array(s))
    plain = rigid.composed(rigid.from_quaternion(q, p), rigid.from_transform(b_from_c))
    for one, other in (
        (rigid.to_transform(plain), a_from_b @ b_from_c),
        (rigid.to_transform(rigid.inverse(plain)), (a_from_b @ b_from_c).inverse()),
    ):
        assert one.rotation == pytest.approx(other.rotation, abs=1e-14)
        assert one.translation == pytest.approx(other.translation, abs=1e-13)


@pytest.mark.parametrize("name", ["irb120", "irb460", "rv-m1", "gofa", "irb14000"])
def test_every_arm_answers_for_one_pose_as_for_a_batch(name: str) -> None:
    robot = load_robot(name)
    arm, rows = robot.kinematics, np.random.default_rng(7)
    for _ in range(5):
        joints = 0.4 * rows.uniform(robot.lower.clip(-2.0), robot.upper.clip(max=2.0))
        pose, branch = arm.forward(joints[None]), int(arm.branch_of(joints[None])[0])
        single = arm.single.forward(joints.tolist())
        assert np.allclose(rigid.to_transform(single).matrix, pose[0].matrix, atol=1e-12)
        assert arm.single.branch_of(joints.tolist()) == branch
        found = arm.single.inverse_on_branch(single, branch, joints.tolist())
        followed = arm.inverse_on_branch(pose, branch, joints[None])
        assert followed.exists[0]
        assert found == pytest.approx(followed.joints[0].tolist(), abs=1e-9)
