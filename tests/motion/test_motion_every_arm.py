"""Laws that every arm with a closed form keeps everywhere, also at its singularities.

What "the same joints" means: all of them to 1e-7 rad. Where a pose leaves joints undetermined, the
same joints come back if they are given as the ones that stand before: axis 4 with axis 5 at 0, axis
1 with the wrist centre on it. Where two elbows meet, a pose rounded in its last digit moves the
elbow by the square root of that, so there it is 1e-5 rad; the pose stays exact.
"""

from collections.abc import Mapping

import numpy as np
import pytest
from laws import cases
from numpy.typing import NDArray

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.confdata import (
    confdata_of,
    configurations,
    has_branches,
    select,
)
from rapidsim.motion.configurations.reachability import limit_excess
from rapidsim.motion.kinematics.arm import Branches, Kinematics
from rapidsim.motion.kinematics.closed_form.five_axis import FiveAxis
from rapidsim.motion.kinematics.closed_form.opw import OrthoParallel
from rapidsim.motion.kinematics.closed_form.palletizer import Palletizer
from rapidsim.motion.kinematics.closed_form.scara import Scara
from rapidsim.motion.robot.robot import Robot, load_robot, robot_names

EXACT = 1e-9
"""Way [m] and turn [rad] between a pose and what its solutions reach."""
SAME = 1e-7
SAME_WHERE_ELBOWS_MEET = 1e-5
BENT = 0.3
"""Least |sin| of axis 5 [rad] where the wrist shall not blow up what the elbow has lost."""
VECTORS = cases(5_000)
"""Of each arm, of some hundred that three kinds of formulas serve."""
SINGULAR_VECTORS = cases(100)
NUDGES = (0.0, 1e-12, -1e-12, 1e-9, -1e-9)
CLOSED_FORM = [name for name in robot_names() if has_branches(load_robot(name).kinematics)]
Names = NDArray[np.str_]
SEARCHED = [name for name in robot_names() if name not in CLOSED_FORM]


@pytest.fixture(params=CLOSED_FORM, scope="module")
def robot(request: pytest.FixtureRequest) -> Robot:
    return load_robot(request.param)


def test_joints_to_pose_and_confdata_and_back(robot: Robot) -> None:
    """Random vectors within the limits, and every solution of their poses."""
    rng = np.random.default_rng(1)
    joints = random_joints(robot, VECTORS, rng)
    elsewhere = random_joints(robot, VECTORS, rng)
    pose, named = robot.forward(joints), confdata_of(robot.kinematics, joints)
    selected = select(robot, pose, named, elsewhere)
    assert selected.exists.all()
    assert not selected.quarters_off.any()
    assert np.abs(selected.joints - joints).max() < SAME
    assert_solutions_reach(robot.kinematics, pose, robot.inverse(pose))


def test_singular_vectors_are_among_the_solutions(robot: Robot) -> None:
    arm = robot.kinematics
    places, joints = all_singular_vectors(robot)
    pose, own = arm.forward(joints), arm.branch_of(joints)
    branches = arm.inverse(pose)
    assert_all(branches.exists[np.arange(len(joints)), own], places)
    on_the_border = np.char.startswith(places, "wrist centre on axis 1")
    assert not (own[on_the_border] & 4).any(), "on the border it counts as in front"
    assert_solutions_reach(arm, pose, branches)
    told = np.char.find(places, "onto axis 2") < 0
    for branch in np.unique(own[told]):
        rows = told & (own == branch)
        followed = arm.inverse_on_branch(pose[rows], int(branch), joints[rows])
        assert_all(followed.exists, places[rows])
        off = np.abs(followed.joints - joints[rows]).max(axis=-1)
        assert_all(off < same_joints(places[rows]), places[rows])


def test_singular_vectors_come_back_by_their_confdata(robot: Robot) -> None:
    """Without help from a vector before, what comes back may differ, but pose and confdata hold."""
    arm = robot.kinematics
    places, joints = all_singular_vectors(robot)
    within = ~limit_excess(robot, joints).any(axis=-1)
    places, joints = places[within], joints[within]
    elsewhere = random_joints(robot, SINGULAR_VECTORS, np.random.default_rng(4))
    elsewhere = np.resize(elsewhere, joints.shape)
    pose, named = arm.forward(joints), confdata_of(arm, joints)
    selected = select(robot, pose, named, joints)
    assert_all((selected.quarters_off == 0).all(axis=-1), places)
    assert_all(np.abs(selected.joints - joints).max(axis=-1) < same_joints(places), places)
    other = select(robot, pose, named, elsewhere)
    assert_all(other.exists, places)
    # Up to 1e-7 rad of axis 5 confdata may share out axes 4 and 6: twice that is the price.
    way, turn = distances(arm.forward(other.joints), pose)
    assert_all(np.maximum(way, turn) < 3.0 * EXACT, places)
    assert_all(other.quarters_off[:, 0] == 0, places)
    sure = np.char.find(places, "axis 1") < 0
    assert_all((other.quarters_off[sure] == 0).all(axis=-1), places[sure])


def test_vectors_at_a_limit_are_within_it(robot: Robot) -> None:
    """On each limit, 1e-9 rad within it, and as much beyond as rounding may take them."""
    rng = np.random.default_rng(5)
    count = len(robot.joints)
    for limit, inward in ((robot.lower, 1.0), (robot.upper, -1.0)):
        for off in (0.0, 1e-9, -5e-10):
            joints = well_bent(robot, random_joints(robot, 40, rng), rng)[:count]
            joints[np.arange(count), np.arange(count)] = limit + inward * off
            pose, named = robot.forward(joints), confdata_of(robot.kinematics, joints)
            selected = select(robot, pose, named, np.zeros(count))
            assert np.abs(selected.joints - joints).max() < SAME
            assert not limit_excess(robot, selected.joints).any()
            axis = int(rng.integers(count))
            listed = np.array([one.joints for one in configurations(robot, pose[axis])])
            assert np.abs(listed - joints[axis]).max(axis=-1).min() < SAME


@pytest.mark.parametrize("name", SEARCHED)
def test_arms_without_a_closed_form_are_searched(name: str) -> None:
    """What is found reaches the pose within the limits; from near joints these come back."""
    robot = load_robot(name)
    assert "found by a numerical search" in robot.notices[0]
    rng = np.random.default_rng(6)
    joints = well_bent(robot, random_joints(robot, cases(12), rng), rng)
    pose = robot.forward(joints)
    branches = robot.inverse(pose)
    assert branches.exists[:, 0].all()
    assert_solutions_reach(robot.kinematics, pose, branches)
    assert not limit_excess(robot, branches.joints[branches.exists]).any()
    followed = robot.kinematics.inverse_on_branch(pose, 0, joints + 1e-3)
    assert followed.exists.all()
    way, turn = distances(robot.forward(followed.joints), pose)
    assert way.max() < EXACT
    assert turn.max() < EXACT
    assert np.abs(followed.joints - joints).max() < (2e-2 if len(robot.joints) > 6 else 1e-6)


def random_joints(robot: Robot, count: int, rng: np.random.Generator) -> Array:
    return rng.uniform(robot.lower, robot.upper, (count, len(robot.joints)))


def well_bent(robot: Robot, joints: Array, rng: np.random.Generator) -> Array:
    """Vectors (k, n) [rad] with their singularities not near, so that no digit is lost."""
    while True:
        condition = np.linalg.cond(robot.kinematics.jacobian(joints))
        poor = condition > 200.0
        if not poor.any():
            return joints
        joints[poor] = random_joints(robot, int(poor.sum()), rng)


def all_singular_vectors(robot: Robot) -> tuple[Names, Array]:
    """Where each is (k,), and the joint vectors (k, n) [rad]."""
    vectors = singular_vectors(robot)
    counts = [len(joints) for joints in vectors.values()]
    return np.repeat(list(vectors), counts), np.concatenate(list(vectors.values()))


def same_joints(places: Names) -> Array:
    """How far [rad] the same joints may be apart."""
    return np.where(np.char.find(places, "elbow") < 0, SAME, SAME_WHERE_ELBOWS_MEET)


def assert_all(holds: NDArray[np.bool_], places: Names) -> None:
    assert not set(places[~holds])


def singular_vectors(robot: Robot) -> Mapping[str, Array]:
    """Joint vectors (k, n) [rad] by where they are; the other joints are random, within limits."""
    joints = random_joints(robot, SINGULAR_VECTORS, np.random.default_rng(2))
    arm = robot.kinematics
    match arm:
        case OrthoParallel():
            return singular_ortho_parallel(arm, joints)
        case FiveAxis():
            return singular_five_axis(arm, joints)
        case Palletizer():
            return singular_palletizer(arm, joints)
        case Scara():
            return singular_scara(joints)
        case _:
            raise AssertionError(f"{robot.name} is of a kind without a test")


def singular_ortho_parallel(arm: OrthoParallel, joints: Array) -> Mapping[str, Array]:
    g = arm.geometry
    fore, tilt = np.hypot(g.a2, g.c3), np.arctan2(g.a2, g.c3)
    places = {}
    for nudge in NUDGES:
        straight = joints.copy()
        straight[:, 4] = nudge
        places[f"axis 5 at {nudge}"] = straight
        # Two equal arms fold onto axis 2, which may then stand anyhow.
        folded = "folded onto axis 2" if np.isclose(fore, g.c2) else "folded"
        for place, elbow in (("stretched", 0.0), (folded, np.pi)):
            theta = arm.theta_from_joints(joints)
            theta[:, 2] = elbow - tilt + nudge
            theta[:, 4] = np.copysign(np.abs(theta[:, 4]) % (np.pi - 2 * BENT) + BENT, theta[:, 4])
            places[f"elbow {place}, {nudge}"] = arm.joints_from_theta(theta)
    # The wrist centre is on axis 1 where a1 + ahead sin(t2) + aside cos(t2) = 0.
    theta = arm.theta_from_joints(joints)
    ahead, aside = g.c2 + fore * np.cos(theta[:, 2] + tilt), fore * np.sin(theta[:, 2] + tilt)
    length = np.hypot(ahead, aside)
    can = length > 1.01 * g.a1
    theta, ahead, aside, length = theta[can], ahead[can], aside[can], length[can]
    theta[:, 1] = np.arcsin(-g.a1 / length) - np.arctan2(aside, ahead)
    above = arm.joints_from_theta(theta)
    above[:, 3:] = joints[can, 3:]
    places["wrist centre on axis 1"] = above
    straight = above.copy()
    straight[:, 4] = 0.0
    places["wrist centre on axis 1, axis 5 at 0"] = straight
    return places


def singular_five_axis(arm: FiveAxis, joints: Array) -> Mapping[str, Array]:
    g = arm.geometry
    places = {}
    for nudge in NUDGES:
        stretched = joints.copy()
        stretched[:, 2] = nudge
        places[f"elbow stretched, {nudge}"] = stretched
    # The wrist is on axis 1 where a2 cos(q2) + a3 cos(q2 + q3) = 0.
    above = joints.copy()
    q3 = above[:, 2]
    above[:, 1] = np.arctan2(g.a2 + g.a3 * np.cos(q3), g.a3 * np.sin(q3))
    places["wrist on axis 1"] = above
    upright = above.copy()
    upright[:, 3] = 0.5 * np.pi - above[:, 1] - above[:, 2]
    places["roll axis on axis 1"] = upright
    return places


def singular_palletizer(arm: Palletizer, joints: Array) -> Mapping[str, Array]:
    g = arm.geometry
    places = {}
    for nudge in NUDGES:
        for place, turn in (("stretched", -0.5 * np.pi), ("folded", 0.5 * np.pi)):
            meeting = joints.copy()
            meeting[:, 2] = meeting[:, 1] + turn + nudge
            places[f"elbow {place}, {nudge}"] = meeting
    above = joints.copy()
    share = -(g.a1 + g.wrist_forward + g.c3 * np.cos(above[:, 2])) / g.c2
    above = above[np.abs(share) < 0.99]
    above[:, 1] = np.arcsin(share[np.abs(share) < 0.99])
    places["flange on axis 1"] = above
    return places


def singular_scara(joints: Array) -> Mapping[str, Array]:
    """Both arms in line, which limits allow stretched only."""
    places = {}
    for nudge in NUDGES:
        stretched = joints.copy()
        stretched[:, 1] = nudge
        places[f"elbow stretched, {nudge}"] = stretched
    return places


def assert_solutions_reach(arm: Kinematics, pose: Transform, branches: Branches) -> None:
    rows, _ = np.nonzero(branches.exists)
    way, turn = distances(arm.forward(branches.joints[branches.exists]), pose[rows])
    assert way.max() < EXACT
    assert turn.max() < EXACT


def distances(reached: Transform, pose: Transform) -> tuple[Array, Array]:
    """Ways (k,) [m] and sines of the turns (k,) between two rows of poses."""
    way = np.linalg.norm(reached.translation - pose.translation, axis=-1)
    r = np.swapaxes(reached.rotation, -1, -2) @ pose.rotation
    twice = [r[..., i, j] - r[..., j, i] for i, j in ((2, 1), (0, 2), (1, 0))]
    return way, 0.5 * np.linalg.norm(np.stack(twice), axis=0)
