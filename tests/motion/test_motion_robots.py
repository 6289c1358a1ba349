"""The catalogue: what it holds, what it refuses, and why a pose cannot be reached."""

from pathlib import Path

import numpy as np
import pytest

from rapidsim.frames.transform import Transform
from rapidsim.motion.configurations.reachability import Unreachable, unreachable_reason
from rapidsim.motion.kinematics.closed_form.opw_geometry import OpwGeometry
from rapidsim.motion.robot.catalogue import find_entry, read_entry
from rapidsim.motion.robot.external_axes import Axes, ExternalAxis
from rapidsim.motion.robot.robot import Robot, RobotError, load_robot, robot_names

MEGABYTE = 1_000_000
DOUBTED = {"irb6700-245-3.0": 0.06, "irb7600-325-3.1": 0.06}
"""By how much [m] lengths from one source reach less far than the name; the entries say so."""


@pytest.fixture(params=robot_names(), scope="module")
def robot(request: pytest.FixtureRequest) -> Robot:
    return load_robot(request.param)


def test_names_and_aliases() -> None:
    assert {"irb120-3-0.58", "irb1600-6-1.2"} <= set(robot_names())
    assert load_robot("irb1600").name == "irb1600-6-1.2"
    assert load_robot("IRB120").title == "ABB IRB 120-3/0.58"


def test_every_entry_is_complete(robot: Robot) -> None:
    entry = find_entry(robot.name)
    assert entry.sources
    assert entry.checks
    count = robot.kinematics.joint_count
    assert [joint.name for joint in robot.joints] == [f"joint_{n}" for n in range(1, count + 1)]
    assert (robot.lower < robot.upper).all()
    assert all(joint.max_speed is None or joint.max_speed > 0.0 for joint in robot.joints)
    assert robot.reach_m is not None
    if isinstance(entry.geometry, OpwGeometry):
        ahead = entry.geometry.a1 + entry.geometry.reach
        assert ahead == pytest.approx(robot.reach_m, abs=DOUBTED.get(robot.name, 0.05))


def test_home_of_the_irb_1600() -> None:
    """Arm forward, flange in front: z out of the flange, x down."""
    home = load_robot("irb1600").forward(np.zeros(6))
    assert home.translation == pytest.approx([0.815, 0.0, 0.9615], abs=1e-12)
    assert home.rotation == pytest.approx(np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]]), abs=1e-12)


def test_an_unknown_name_is_answered_with_near_ones() -> None:
    with pytest.raises(RobotError, match=r"`irb160` .* similar names: .*irb1600"):
        load_robot("irb160")
    with pytest.raises(RobotError, match=r"`zzz` is not in the catalogue$"):
        load_robot("zzz")


def test_a_faulty_entry_says_what_is_wrong(tmp_path: Path) -> None:
    text = (find_entry("irb120").folder / "robot.toml").read_text()
    folder = tmp_path / "irb120-3-0.58"
    folder.mkdir()

    def refused(faulty: str) -> str:
        (folder / "robot.toml").write_text(faulty)
        with pytest.raises(RobotError) as error:
            read_entry(folder)
        return str(error.value)

    assert "structure `delta`" in refused(text.replace("ortho-parallel", "delta"))
    assert "'zero' is missing" in refused(text.replace("[zero]", "[other]"))
    assert "name `irb9`" in refused(text.replace('"irb120-3-0.58"', '"irb9"'))
    assert "c9" in refused(text.replace("c1 =", "c9 ="))
    assert "needs 6 joints" in refused(text[: text.rindex("[[joint]]")])
    assert "robot.toml" in refused("= = =")


def test_out_of_reach_says_by_how_much() -> None:
    robot = load_robot("irb120")
    g = find_entry("irb120").geometry
    assert isinstance(g, OpwGeometry)
    above = Transform(np.eye(3), np.array([0.0, 0.0, g.c1 + g.reach + g.c4 + 0.0472]))
    reason = unreachable_reason(robot, above)
    assert reason is not None
    assert reason.message == "wrist centre 47.2 mm beyond reach"
    assert reason.shortfall == pytest.approx(0.0472)


def test_a_joint_limit_says_which_and_by_how_much() -> None:
    robot = load_robot("irb120")
    pose = robot.forward(np.radians([0.0, 60.0, 74.1, 0.0, 30.0, 0.0]))
    reason = unreachable_reason(robot, pose, branch=0)
    assert reason is not None
    assert (reason.joint, reason.branch) == (3, 0)
    assert reason.message == "joint 3 over by 4.1 deg at its upper limit"


def test_what_is_over_by_little_is_never_over_by_nothing() -> None:
    assert Unreachable(0.0, joint=5, excess=-2e-5).message.startswith("joint 5 over by 0.001 deg")
    assert Unreachable(3e-6).message == "wrist centre 0.003 mm beyond reach"


def test_within_limits_there_is_no_reason() -> None:
    robot = load_robot("irb1600")
    for joints in np.random.default_rng(8).uniform(robot.lower, robot.upper, (50, 6)):
        assert unreachable_reason(robot, robot.forward(joints)) is None


def test_axes_have_their_names_units_and_tolerances() -> None:
    track = ExternalAxis("TRACK", "b", True, -1.0, 3.0, 1.0, 2.0)
    table = ExternalAxis("STN1", "a", False, -1.0, 1.0, 1.0, 2.0)
    axes = Axes(np.zeros(5), np.ones(5), (table, track), (False, False, True))
    assert [axes.name(k) for k in (0, 2, 3, 4)] == [
        *("axis 1", "axis 3", "axis eax_a of STN1", "axis eax_b of TRACK")
    ]
    assert [axes.measure(k) for k in range(5)] == ["deg", "deg", "mm", "deg", "mm"]
    values = [axes.text(k, value) for k, value in ((0, np.pi), (2, np.pi), (3, -np.pi), (4, 0.5))]
    assert values == ["180.0 deg", "180.0 mm", "-180.0 deg", "500.0 mm"]
    rounded = np.radians(0.05)
    assert axes.tolerances == pytest.approx([rounded, rounded, rounded, rounded, 5e-5])
    wider = axes.path_tolerances > axes.tolerances
    assert wider.tolist() == [True, True, False, False, False]
