"""Stored configurations as controllers hold them: cfx as stored, the rest within a quarter turn."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rapidsim.motion.configurations.compliance import Match, hold, match
from rapidsim.motion.configurations.confdata import confdata_of, configurations, named
from rapidsim.motion.configurations.reachability import POSE_TOLERANCE
from rapidsim.motion.robot.robot import Robot, load_robot

ROBOTS = [load_robot(name) for name in ("irb1600", "irb120", "irb4600-40-2.55", "irb140")]
robots = st.sampled_from(ROBOTS)
shares = st.tuples(*(st.floats(0.02, 0.98),) * 6)
quarters = st.tuples(*(st.integers(-1, 1),) * 3)


def _joints(robot: Robot, share: tuple[float, ...]) -> np.ndarray:
    return robot.lower + np.array(share) * (robot.upper - robot.lower)


def _is_plain(robot: Robot, joints: np.ndarray) -> bool:
    """Whether no singularity and no border of a quarter turn is near."""
    counted = joints[[0, 3, 5]] / (np.pi / 2.0)
    in_quarter = np.abs(counted - np.round(counted)).min() > 0.01
    smallest = np.linalg.svd(robot.kinematics.jacobian(joints))[1].min()
    return bool(in_quarter and smallest > 1e-3)


@given(robots, shares, quarters)
def test_each_quarter_may_be_one_off(
    robot: Robot, share: tuple[float, ...], off: tuple[int, int, int]
) -> None:
    joints = _joints(robot, share)
    assume(_is_plain(robot, joints))
    stored = confdata_of(robot.kinematics, joints)
    stored[:3] += off
    found = hold(robot, robot.forward(joints)[None], stored[None], joints)
    assert found.possible[0]
    assert found.match[0] == (Match.COMPLIANT if any(off) else Match.EXACT)
    assert found.joints[0] == pytest.approx(joints, abs=1e-6)
    assert match(robot.kinematics, joints, stored) == found.match[0]


@given(robots, shares, st.integers(0, 2), st.sampled_from([-2, 2]))
def test_two_quarters_off_is_another_turn_and_the_nearer_of_two(
    robot: Robot, share: tuple[float, ...], axis: int, off: int
) -> None:
    joints = _joints(robot, share)
    assume(_is_plain(robot, joints))
    stored = confdata_of(robot.kinematics, joints)
    stored[axis] += off
    found = hold(robot, robot.forward(joints)[None], stored[None], joints)
    assert found.possible[0]
    assert found.match[0] == Match.TURNED
    # The arm comes from these joints, so of two turns these are nearer.
    assert found.joints[0] == pytest.approx(joints, abs=1e-6)


@given(robots, shares, st.integers(0, 7))
def test_another_branch_is_never_met(robot: Robot, share: tuple[float, ...], branch: int) -> None:
    joints = _joints(robot, share)
    assume(_is_plain(robot, joints))
    stored = confdata_of(robot.kinematics, joints)
    assume(branch != stored[3])
    stored[3] = branch
    assert match(robot.kinematics, joints, stored) == Match.OTHER
    found = hold(robot, robot.forward(joints)[None], stored[None], joints)
    if found.possible[0]:
        assert robot.kinematics.branch_of(found.joints[0]) == branch


@given(robots, st.lists(st.tuples(shares, quarters, st.integers(0, 7)), min_size=2, max_size=6))
def test_a_batch_decides_as_one_pose_does(
    robot: Robot, rows: list[tuple[tuple[float, ...], tuple[int, int, int], int]]
) -> None:
    joints = np.array([_joints(robot, share) for share, _, _ in rows])
    assume(all(_is_plain(robot, row) for row in joints))
    stored = confdata_of(robot.kinematics, joints)
    stored[:, :3] += np.array([off for _, off, _ in rows])
    stored[1::2, 3] = [branch for *_, branch in rows][1::2]
    poses = robot.forward(joints)
    near = joints + 0.3
    batch = hold(robot, poses, stored, near)
    for row in range(len(rows)):
        one = hold(robot, poses[row][None], stored[row : row + 1], near[row])
        assert one.possible[0] == batch.possible[row]
        assert one.match[0] == batch.match[row]
        assert one.joints[0] == pytest.approx(batch.joints[row], abs=1e-7)
        # What plain floats find without the others is the same, too.
        for tolerated in (0, 1):
            quick = named(robot, poses[row], tuple(stored[row].tolist()), tolerated)
            if quick is not None:
                assert batch.match[row] <= (Match.COMPLIANT if tolerated else Match.EXACT)
                assert quick.joints == pytest.approx(batch.joints[row], abs=1e-6)
            elif batch.match[row] == Match.EXACT:
                assert np.abs(batch.excess[row]).any() or (batch.joints[row] > robot.upper).any()


@pytest.mark.parametrize("robot", ROBOTS, ids=lambda robot: robot.name)
@pytest.mark.parametrize("axis", [0, 2, 3, 4])
def test_a_rounding_past_a_limit_is_possible_and_more_is_not(robot: Robot, axis: int) -> None:
    joints = np.radians([10.0, 20.0, -20.0, 30.0, 40.0, 50.0])
    for share, possible in ((0.5, True), (1.5, False)):
        joints[axis] = robot.upper[axis] + share * POSE_TOLERANCE
        assume_plain = abs(joints[4]) > 0.1
        assert assume_plain
        pose, stored = robot.forward(joints)[None], confdata_of(robot.kinematics, joints)
        found = hold(robot, pose, stored[None], joints)
        assert found.possible[0] == possible
        assert found.joints[0] == pytest.approx(joints, abs=1e-6)


def test_a_turn_past_its_limit_is_not_given_up_for_one_a_turn_away() -> None:
    robot = ROBOTS[0]
    joints = np.radians([10.0, 20.0, -20.0, 170.0, 40.0, 50.0])
    stored = confdata_of(robot.kinematics, joints - np.radians([0, 0, 0, 360.0, 0, 0]))
    pose = robot.forward(joints)[None]
    found = hold(robot, pose, stored[None], joints)
    # Axis 4 would be at 190 - 360 = -190 deg; within the limits are 170 deg and -190 deg.
    assert found.possible[0]
    joints[3] = np.radians(130.0)
    stored = confdata_of(robot.kinematics, joints - np.radians([0, 0, 0, 360.0, 0, 0]))
    found = hold(robot, robot.forward(joints)[None], stored[None], joints)
    assert not found.possible[0]
    assert np.degrees(found.excess[0, 3]) == pytest.approx(-30.0)
    assert configurations(robot, robot.forward(joints))
