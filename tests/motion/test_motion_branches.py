"""The choice of branches along a path: least motion, in limits, never worse than one branch."""

from itertools import pairwise

import numpy as np

from rapidsim.frames.transform import Transform
from rapidsim.motion.configurations.branch_choice import LeastMotion, least_motion
from rapidsim.motion.configurations.confdata import configurations
from rapidsim.motion.configurations.reachability import limit_excess
from rapidsim.motion.robot.robot import load_robot

ROBOT = load_robot("irb120")


def path(count: int = 60) -> tuple[np.ndarray, Transform]:
    """A path on branch 0 and its poses; axis 6 makes more than half a turn."""
    joints = np.linspace(
        np.radians([-40.0, -10.0, -20.0, 30.0, 40.0, 100.0]),
        np.radians([50.0, 30.0, 10.0, -40.0, 60.0, 320.0]),
        count,
    )
    return joints, ROBOT.forward(joints)


def test_a_smooth_path_is_found_again() -> None:
    joints, poses = path()
    found = least_motion(ROBOT, poses, start=joints[0])
    assert isinstance(found, LeastMotion)
    assert np.abs(found.joints - joints).max() < 1e-9
    assert (found.branch == 0).all()
    assert abs(found.travel - np.abs(np.diff(joints, axis=0)).sum()) < 1e-9


def test_no_single_choice_is_shorter() -> None:
    """Against every combination of solutions of a few scattered poses."""
    rng = np.random.default_rng(8)
    poses = ROBOT.forward(rng.uniform(0.4 * ROBOT.lower, 0.4 * ROBOT.upper, (3, 6)))
    found = least_motion(ROBOT, poses)
    assert isinstance(found, LeastMotion)
    every = [[c.joints for c in configurations(ROBOT, poses[row])] for row in range(3)]
    shortest = min(
        np.abs(a - b).sum() + np.abs(b - c).sum()
        for a in every[0]
        for b in every[1]
        for c in every[2]
    )
    assert abs(found.travel - shortest) < 1e-9
    assert not limit_excess(ROBOT, found.joints).any()
    assert abs(found.travel - sum(np.abs(b - a).sum() for a, b in pairwise(found.joints))) < 1e-12


def test_a_pose_out_of_reach_is_named() -> None:
    joints, poses = path(5)
    places = poses.translation.copy()
    places[3] += 5.0
    assert least_motion(ROBOT, Transform(poses.rotation, places), joints[0]) == 3


def test_arms_of_other_kinds_are_chosen_for_too() -> None:
    robot = load_robot("rvm1")
    joints = np.linspace(np.radians([-20, 20, -80, 10, 0]), np.radians([40, 50, -30, -20, 90]), 30)
    found = least_motion(robot, robot.forward(joints), joints[0])
    assert isinstance(found, LeastMotion)
    assert np.abs(found.joints - joints).max() < 1e-9
