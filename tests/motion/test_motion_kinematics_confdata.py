"""confdata names one joint vector: both ways, at borders of quarters, at axis 5 zero."""

import numpy as np
import pytest

from rapidsim.motion.configurations.confdata import confdata_of, configurations, select
from rapidsim.motion.robot.robot import Robot, load_robot


@pytest.fixture(params=["irb120", "irb1600", "irb6640-180-2.55"], scope="module")
def robot(request: pytest.FixtureRequest) -> Robot:
    return load_robot(request.param)


def test_confdata_names_the_joints(robot: Robot) -> None:
    """20,000 random joint vectors, axis 6 through more than two turns."""
    rng = np.random.default_rng(1)
    joints = rng.uniform(robot.lower, robot.upper, (20_000, 6))
    confdata = confdata_of(robot.kinematics, joints)
    elsewhere = rng.uniform(robot.lower, robot.upper, (20_000, 6))
    selected = select(robot, robot.forward(joints), confdata, elsewhere)
    assert selected.exists.all()
    assert not selected.quarters_off.any()
    assert np.max(np.abs(selected.joints - joints)) < 1e-8


@pytest.mark.parametrize(
    ("name", "lacks"), [("irb120", None), ("irb460", 1), ("irb910sc", 2), ("rvm1", None)]
)
def test_one_vector_has_the_confdata_of_its_row(name: str, lacks: int | None) -> None:
    """The digit of an axis 4 or 6 that an arm lacks is 0."""
    kinematics = load_robot(name).kinematics
    joints = np.random.default_rng(2).uniform(-2.5, 2.5, (50, kinematics.joint_count))
    rows = confdata_of(kinematics, joints)
    assert [confdata_of(kinematics, row).tolist() for row in joints] == rows.tolist()
    assert [digit for digit in range(3) if not rows[:, digit].any()] == (
        [] if lacks is None else [lacks]
    )


@pytest.mark.parametrize(
    ("degrees", "quarter"),
    [(0, 0), (-0.0, 0), (45, 0), (90, 1), (89.999, 0), (-1e-9, 0), (-45, -1), (-90, -1),
     (-90.001, -2), (180, 2), (-180, -2), (359, 3), (400, 4), (-400, -5)],
)  # fmt: skip
def test_quarters_count_from_zero_downwards_from_minus_one(degrees: float, quarter: int) -> None:
    joints = np.radians([degrees, 0.0, 0.0, degrees, 30.0, degrees])
    kinematics = load_robot("irb120").kinematics
    assert list(confdata_of(kinematics, joints)) == [quarter, quarter, quarter, 0]


@pytest.mark.parametrize(
    ("joints", "cfx"),
    [
        ((0, 0, 0, 0, 30, 0), 0),
        ((0, 0, 0, 0, -30, 0), 1),
        ((0, 100, -170, 0, 30, 0), 2),
        ((0, 100, -170, 0, -30, 0), 3),
        ((0, -100, 0, 0, 30, 0), 4),
        ((0, -100, 0, 0, -30, 0), 5),
        ((0, -60, -150, 0, 30, 0), 6),
        ((0, -60, -150, 0, -30, 0), 7),
    ],
)
def test_cfx_tells_where_the_wrist_centre_is(joints: tuple[float, ...], cfx: int) -> None:
    kinematics = load_robot("irb1600").kinematics
    assert confdata_of(kinematics, np.radians(joints))[3] == cfx


@pytest.mark.parametrize("quarters", [(0, 0), (0, -1), (-1, 0), (1, -2), (-2, 1)])
def test_axis_5_at_zero_is_shared_out_as_confdata_says(quarters: tuple[int, int]) -> None:
    robot = load_robot("irb120")
    home = robot.forward(np.zeros((1, 6)))
    selected = select(robot, home, np.array([[0, *quarters, 0]]), np.zeros(6))
    assert not selected.quarters_off.any()
    reached = robot.forward(selected.joints)
    assert np.max(np.abs(reached.translation - home.translation)) < 1e-9
    assert np.max(np.abs(reached.rotation - home.rotation)) < 1e-9


def test_axis_5_at_zero_keeps_axis_4_where_confdata_allows() -> None:
    robot = load_robot("irb120")
    joints = np.radians([[10.0, 20.0, 10.0, 33.0, 0.0, 44.0]])
    confdata = confdata_of(robot.kinematics, joints)
    selected = select(robot, robot.forward(joints), confdata, joints[0])
    assert np.max(np.abs(selected.joints - joints)) < 1e-9


def test_a_confdata_that_does_not_fit_says_how_far_off_it_is() -> None:
    robot = load_robot("irb120")
    joints = np.radians([[10.0, 20.0, 10.0, 33.0, 40.0, 44.0]])
    confdata = confdata_of(robot.kinematics, joints) + np.array([1, 0, -2, 0])
    selected = select(robot, robot.forward(joints), confdata, joints[0])
    assert selected.exists.all()
    assert list(selected.quarters_off[0]) == [-1, 0, 2]


@pytest.mark.parametrize("cfx", [-1, 8, 11])
def test_a_cfx_that_is_no_branch_selects_nothing(cfx: int) -> None:
    robot = load_robot("irb120")
    selected = select(
        robot, robot.forward(np.zeros((1, 6))), np.array([[0, 0, 0, cfx]]), np.zeros(6)
    )
    assert not selected.exists.any()
    assert not selected.joints.any()


def test_configurations_reach_the_pose_within_limits_and_are_told_apart(robot: Robot) -> None:
    rng = np.random.default_rng(5)
    for joints in rng.uniform(robot.lower, robot.upper, (40, 6)):
        pose = robot.forward(joints)
        found = configurations(robot, pose)
        assert any(np.max(np.abs(one.joints - joints)) < 1e-7 for one in found)
        assert len({one.confdata for one in found}) == len(found)
        for one in found:
            assert (one.joints >= robot.lower - 1e-8).all()
            assert (one.joints <= robot.upper + 1e-8).all()
            reached = robot.forward(one.joints)
            assert np.max(np.abs(reached.translation - pose.translation)) < 1e-9
            assert tuple(confdata_of(robot.kinematics, one.joints)) == one.confdata


def test_branches_that_meet_are_listed_once() -> None:
    robot = load_robot("irb120")
    stretched = np.arctan2(0.070, 0.302) - np.pi / 2.0
    found = configurations(robot, robot.forward(np.array([0.4, 0.3, stretched, 0.5, 0.6, 0.7])))
    vectors = [one.joints for one in found]
    for index, joints in enumerate(vectors):
        for other in vectors[:index]:
            assert np.max(np.abs(joints - other)) > 1e-6
