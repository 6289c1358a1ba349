"""Arms without a closed form: six axes with an offset wrist, seven axes, SciPy's solvers."""

from pathlib import Path

import numpy as np
import pytest

from rapidsim.frames.transform import Transform
from rapidsim.motion.configurations.pose_solutions import solve_pose
from rapidsim.motion.configurations.reachability import limit_excess, unreachable_reason
from rapidsim.motion.configurations.scipy_solvers import (
    METHODS,
    METRES_PER_RADIAN,
    _Target,
    search,
)
from rapidsim.motion.kinematics.numerical.offset_wrist import near_arm
from rapidsim.motion.kinematics.numerical.revolute_chain import AxisRowGeometry
from rapidsim.motion.kinematics.numerical.solver import Numerical
from rapidsim.motion.kinematics.serial_chain import AxesAtZero, SerialChain
from rapidsim.motion.kinematics.unwrapping import principal
from rapidsim.motion.robot.robot import Robot, load_robot

JOINT = """
  <link name="link_{n}"/>
  <joint name="joint_{n}" type="revolute">
    <parent link="{parent}"/><child link="link_{n}"/>
    <origin xyz="{xyz}" rpy="0 0 0"/><axis xyz="{axis}"/>
    <limit lower="{lower}" upper="{upper}" velocity="2" effort="1"/>
  </joint>
"""
X, Y, Z = "1 0 0", "0 1 0", "0 0 1"
OFFSET_WRIST = [
    ("0 0 0", Z),
    ("0 0 0.265", Y),
    ("0 0 0.444", Y),
    ("0 0 0.110", X),
    ("0.470 0 0", Y),
    ("0.101 0 0.080", X),
]
SEVEN_AXES = [
    ("0 0 0.166", Z),
    ("0.03 0 0.1", Y),
    ("-0.03 0 0.1515", Z),
    ("0.0405 0 0.1", Y),
    ("0.165 0 0.0405", X),
    ("0.1 0 -0.027", Y),
    ("0.036 0 -0.027", X),
]


def urdf_file(folder: Path, axes: list[tuple[str, str]], limit: float = 2.8) -> Path:
    text = '<robot name="bench">\n  <link name="base"/>'
    for number, (xyz, axis) in enumerate(axes, start=1):
        parent = "base" if number == 1 else f"link_{number - 1}"
        text += JOINT.format(n=number, parent=parent, xyz=xyz, axis=axis, lower=-limit, upper=limit)
    file = folder / f"bench{len(axes)}.urdf"
    file.write_text(text + "</robot>\n")
    return file


@pytest.fixture(scope="module", params=[OFFSET_WRIST, SEVEN_AXES], ids=["offset", "seven"])
def robot(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Robot:
    return load_robot(urdf_file(tmp_path_factory.mktemp("urdf"), request.param))


def poses(robot: Robot, count: int) -> tuple[np.ndarray, Transform]:
    joints = np.random.default_rng(5).uniform(robot.lower, robot.upper, (count, len(robot.joints)))
    return joints, robot.forward(joints)


def test_a_urdf_without_a_closed_form_is_searched_and_says_so(robot: Robot) -> None:
    assert isinstance(robot.kinematics, Numerical)
    assert "found by a numerical search" in robot.notices[0]


def test_random_poses_are_solved_within_the_limits(robot: Robot) -> None:
    _, pose = poses(robot, 12)
    branches = robot.inverse(pose)
    assert branches.exists[:, 0].all()
    assert branches.searched
    reached = robot.forward(branches.joints)
    assert np.abs(reached.matrix - pose.matrix[:, None])[branches.exists].max() < 1e-8
    assert not limit_excess(robot, branches.joints[branches.exists]).any()


def test_solutions_are_distinct_and_the_same_in_every_run(robot: Robot) -> None:
    _, pose = poses(robot, 3)
    first, second = robot.inverse(pose), robot.inverse(pose)
    assert np.array_equal(first.joints, second.joints)
    for joints, exists in zip(first.joints, first.exists, strict=True):
        found = joints[exists]
        apart = np.abs(principal(found[:, None] - found)).max(axis=-1)
        assert (apart + np.eye(len(found)) > 1e-5).all()


def test_the_offset_wrist_finds_the_joints_themselves(tmp_path: Path) -> None:
    robot = load_robot(urdf_file(tmp_path, OFFSET_WRIST))
    joints, pose = poses(robot, 20)
    branches = robot.inverse(pose)
    apart = np.abs(principal(branches.joints - joints[:, None])).max(axis=-1)
    found = ((apart < 1e-4) & branches.exists).any(axis=-1)
    assert found.mean() >= 0.95


def test_a_path_is_followed_without_jumps(robot: Robot) -> None:
    start = 0.3 * np.ones(len(robot.joints))
    joints = np.linspace(start, start + 0.5, 60)
    pose = robot.forward(joints)
    alone = robot.kinematics.inverse_on_branch(pose, 0, start)
    beside = robot.kinematics.inverse_on_branch(pose, 0, joints + 0.01)
    for followed in (alone, beside):
        assert followed.exists.all()
        assert np.abs(robot.forward(followed.joints).matrix - pose.matrix).max() < 1e-8
    assert np.abs(np.diff(alone.joints, axis=0)).max() < 0.05


def test_out_of_reach_says_how_near_the_search_came(robot: Robot) -> None:
    pose = Transform(np.eye(3), np.array([3.0, 0.0, 0.5]))
    why = unreachable_reason(robot, pose)
    assert why is not None
    assert "the search came no nearer than" in why.message
    assert 1.0 < why.beyond <= why.shortfall
    assert f"flange at least {1000.0 * why.beyond:.1f} mm beyond reach" in why.message
    assert solve_pose(robot, pose, everything=True).solutions == ()


def test_no_joints_bring_the_flange_further_than_the_stretched_arm(robot: Robot) -> None:
    arm = robot.kinematics
    assert isinstance(arm, Numerical)
    foot, longest = arm.stretched
    away = np.linalg.norm(poses(robot, 20_000)[1].translation - foot, axis=-1)
    assert 0.8 * longest < away.max() <= longest + 1e-12


def test_the_chain_agrees_with_yourdfpy(robot: Robot) -> None:
    yourdfpy = pytest.importorskip("yourdfpy")
    description = yourdfpy.URDF.load(str(robot.urdf), load_meshes=False)
    count = len(robot.joints)
    for joints in poses(robot, 5)[0]:
        description.update_cfg(joints)
        frames = robot.kinematics.link_frames(joints)
        for number in range(count):
            theirs = description.get_transform(f"link_{number + 1}", "base")
            assert np.abs(theirs - frames[number].matrix).max() < 1e-12


def test_the_chain_is_the_closed_form_where_there_is_one() -> None:
    arm = load_robot("irb120").kinematics
    zero = np.zeros(6)
    jacobian = arm.jacobian(zero)
    links = arm.link_frames(zero)
    axes = AxesAtZero(jacobian[3:].T, links.translation, links, arm.forward(zero))
    chain = SerialChain.uncoupled(axes)
    joints = np.random.default_rng(1).uniform(-2.0, 2.0, (50, 6))
    assert np.abs(chain.forward(joints).matrix - arm.forward(joints).matrix).max() < 1e-12
    assert np.abs(chain.jacobian(joints) - arm.jacobian(joints)).max() < 1e-12
    near = near_arm(axes)
    assert near is not None
    assert np.abs(near.offsets).max() < 1e-12


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("name", ["irb120", "rvm1"])
def test_scipy_agrees_with_the_closed_form(name: str, method: str) -> None:
    robot = load_robot(name)
    _, pose = poses(robot, 4)
    for row in range(4):
        found = search(robot, pose[row], method)
        assert found.solved
        closed = robot.inverse(pose[row])
        apart = np.abs(principal(closed.joints[closed.exists] - found.joints)).max(axis=-1)
        assert apart.min() < 1e-3


def test_the_derivative_of_a_residual_is_exact() -> None:
    """A small turn counts as an error of as many metres as its angle has radians."""
    robot = load_robot("irb120")
    joints, pose = poses(robot, 1)
    target = _Target(robot.kinematics, pose[0])
    beside = joints[0] + np.array([0.1, -0.05, 0.02, 0.1, 0.1, -0.1])
    step = 1e-6
    slopes = [
        (target.residual(beside + step * unit) - target.residual(beside - step * unit))
        / (2.0 * step)
        for unit in np.eye(6)
    ]
    assert target.derivative(beside) == pytest.approx(np.stack(slopes, axis=1), abs=1e-8)
    assert np.abs(target.residual(joints[0])).max() < 1e-12
    turned = joints[0] + np.array([0.0, 0.0, 0.0, 0.0, 0.0, 1e-4])
    assert np.linalg.norm(target.residual(turned)[3:]) == pytest.approx(1e-4 * METRES_PER_RADIAN)


def test_scipy_gives_up_with_numbers() -> None:
    found = search(load_robot("irb120"), Transform(np.eye(3), np.array([2.0, 0.0, 0.5])), "lm")
    assert not found.solved
    assert found.distance > 0.5


def test_directions_of_axes_may_have_any_length() -> None:
    points = ((0.0, 0.0, 0.1), (0.2, 0.0, 0.3), (0.4, 0.1, 0.3))
    unit = ((0.0, 0.0, 1.0), (0.0, -1.0, 0.0), (0.6, 0.0, 0.8))
    longer = ((0.0, 0.0, 2.0), (0.0, -0.5, 0.0), (3.0, 0.0, 4.0))
    flange = (0.5, 0.0, 0.3), (0.0, 2.0, 0.0, 0.0)
    one, other = (AxisRowGeometry(points, each, *flange).axes for each in (unit, longer))
    assert other.directions == pytest.approx(np.array(unit))
    assert other.directions == pytest.approx(one.directions)
    assert other.base_from_flange.rotation == pytest.approx(np.diag([1.0, -1.0, -1.0]))
    links = other.base_from_link
    assert links.translation == pytest.approx(np.array([*points[:2], (0.5, 0.0, 0.3)]))
    assert links.rotation == pytest.approx(np.tile(np.eye(3), (3, 1, 1)))
