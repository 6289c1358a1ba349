"""Our kinematics against a solver that others made and configurations that others published.

py-opw-kinematics is asked for the same poses of every ortho-parallel arm, thousands of each.
"""

from typing import Any

import numpy as np
import pytest
from laws import cases
from motion_truth import turns_aside

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.confdata import confdata_of
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.kinematics.closed_form.opw import OrthoParallel
from rapidsim.motion.kinematics.closed_form.opw_geometry import OpwGeometry
from rapidsim.motion.robot.catalogue import arm_from_geometry
from rapidsim.motion.robot.robot import Robot, load_robot, robot_names

POSES = cases(10_000)
OPW_SLOT_OF_BRANCH = [0, 4, 1, 5, 2, 6, 3, 7]
"""py-opw-kinematics numbers wrist, shoulder, elbow; we number shoulder, elbow, wrist."""


def one_robot_a_geometry() -> list[str]:
    """Arms of the catalogue that differ in lengths, zeros, signs or rods."""
    named: dict[OpwGeometry, str] = {}
    for name in robot_names():
        arm = load_robot(name).kinematics
        if isinstance(arm, OrthoParallel):
            named.setdefault(arm.geometry, name)
    return list(named.values())


@pytest.fixture(params=one_robot_a_geometry(), scope="module")
def robot(request: pytest.FixtureRequest) -> Robot:
    return load_robot(request.param)


def test_another_solver_finds_the_same_branches(robot: Robot) -> None:
    """Branch by branch: the same exist, and with the same joints."""
    ours, theirs = both_solutions(robot, random_joints(robot, POSES))
    assert np.array_equal(exists(ours), exists(theirs))
    assert np.abs(turns_aside(ours - theirs))[exists(ours)].max() < 1e-7


def test_where_another_solver_loses_branches_ours_reach_the_pose(robot: Robot) -> None:
    """Axis 5 at 0, the elbow stretched: whatever only one of the two finds is right."""
    arm = robot.kinematics
    assert isinstance(arm, OrthoParallel)
    joints = random_joints(robot, 200)
    joints[:100, 4] = 0.0
    theta = arm.theta_from_joints(joints)
    theta[100:, 2] = -np.arctan2(arm.geometry.a2, arm.geometry.c3)
    joints = arm.joints_from_theta(theta)
    ours, theirs = both_solutions(robot, joints)
    our, their = exists(ours), exists(theirs)
    assert not (their & ~our).any()
    lost = our & ~their
    assert lost[100:].any()
    rows, _ = np.nonzero(lost)
    reached, pose = arm.forward(joints_from_serial(arm, ours[lost])), arm.forward(joints)[rows]
    assert np.abs(reached.matrix - pose.matrix).max() < 1e-9


IRB_1660ID = OpwGeometry(
    a1=0.150, a2=-0.110, b=0.0, c1=0.4865, c2=0.700, c3=0.678, c4=0.135,
    offsets=(0.0, 0.0, -np.pi / 2.0, 0.0, 0.0, 0.0),
)  # fmt: skip
PUBLISHED_CFX = [
    ((-103.1, -85.03, 19.06, -70.19, -35.87, 185.01), 5),
    ((-116.97, -85.69, 16.82, -63.5, -39.63, 192.76), 5),
    ((-128.14, -86.43, 13.04, -59.66, -40.66, 201.57), 5),
    ((-124.68, -61.16, -20.4, 56.41, -38.79, -24.56), 5),
    ((-127.36, -62.29, -16.83, 59.35, -35.14, -23.42), 5),
    ((-103.1, -85.03, 19.06, 109.81, 35.87, 5.01), 4),
    ((-116.97, -85.69, 16.82, 116.5, 39.63, 12.76), 4),
    ((-128.14, -86.43, 13.04, 120.34, 40.66, 21.57), 4),
    ((-124.68, -61.16, -20.4, -123.59, 38.79, 155.44), 4),
    ((-127.36, -62.29, -16.83, -120.65, 35.14, 156.58), 4),
]
"""Joints [deg] of an IRB 1660ID and cfx, read on a controller.

Source: github CEAD-group/py-opw-kinematics, commit 2f70958, MIT licence: numbers only.
"""


@pytest.mark.parametrize(("joints_deg", "cfx"), PUBLISHED_CFX)
def test_published_configurations_of_an_irb_1660id(joints_deg: tuple[float, ...], cfx: int) -> None:
    arm = arm_from_geometry(IRB_1660ID)
    joints = np.radians(joints_deg)
    assert confdata_of(arm, joints)[3] == cfx
    branches = arm.inverse(arm.forward(joints))
    assert np.abs(turns_aside(branches.joints[cfx] - joints)).max() < 1e-9


def test_the_published_pairs_are_one_pose_in_two_wrists() -> None:
    """The sets come in pairs: bit 0 of cfx alone tells them apart, to the two decimals given."""
    arm = arm_from_geometry(IRB_1660ID)
    for (negative, _), (positive, _) in zip(PUBLISHED_CFX[:5], PUBLISHED_CFX[5:], strict=True):
        pose = arm.forward(np.radians([negative, positive]))
        assert np.abs(pose.translation[0] - pose.translation[1]).max() < 2e-4
        assert np.abs(pose.rotation[0] - pose.rotation[1]).max() < 1e-3


def both_solutions(robot: Robot, joints: Array) -> tuple[Array, Array]:
    """Serial joints (k, 8, 6) [rad] of the poses of joints, ours and theirs; NaN where none is."""
    arm = robot.kinematics
    assert isinstance(arm, OrthoParallel)
    pose = arm.forward(joints)
    branches = arm.inverse(pose)
    ours = branches.joints.copy()
    ours[..., 2] += arm.geometry.coupling * ours[..., 1]
    ours[~branches.exists] = np.nan
    return ours, their_solutions(arm.geometry, pose)


def exists(found: Array) -> Mask:
    return np.asarray(~np.isnan(found).any(axis=-1))


def joints_from_serial(arm: OrthoParallel, serial: Array) -> Array:
    """Joint vectors of an arm from those of one without its rod."""
    joints = serial.copy()
    joints[..., 2] -= arm.geometry.coupling * joints[..., 1]
    return joints


def their_solutions(g: OpwGeometry, pose: Transform) -> Array:
    opw: Any = pytest.importorskip("py_opw_kinematics")
    rigid: Any = pytest.importorskip("scipy.spatial.transform")
    lengths = {name: getattr(g, name) for name in ("a1", "a2", "b", "c1", "c2", "c3", "c4")}
    flipped = tuple(sign < 0 for sign in g.signs)
    model = opw.KinematicModel(**lengths, offsets=g.offsets, flip_axes=flipped)
    reached = opw.Robot(model, degrees=False).reach(rigid.RigidTransform.from_matrix(pose.matrix))
    found: Array = reached.joints[:, OPW_SLOT_OF_BRANCH]
    return found


def random_joints(robot: Robot, count: int) -> Array:
    return np.random.default_rng(3).uniform(robot.lower, robot.upper, (count, 6))
