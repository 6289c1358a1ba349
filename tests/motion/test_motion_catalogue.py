"""All arms of the catalogue: complete, sane, their own inverse; and the KR 10 against its table."""

import subprocess
import sys
import tomllib

import numpy as np
import pytest
from reference_numbers import recorded

from rapidsim.frames.transform import Array
from rapidsim.motion.kinematics.closed_form.opw import OrthoParallel
from rapidsim.motion.kinematics.closed_form.opw_geometry import OpwGeometry
from rapidsim.motion.robot.catalogue import aliases, aliases_of, find_entry, robots_folder
from rapidsim.motion.robot.robot import LARGEST_EXCESS, Robot, load_robot, robot_names

MAKERS = {"ABB", "KUKA", "Mitsubishi"}
LONGEST_REACH_M = 4.0
FASTEST_DEG_S = 1000.0
FASTEST_SPLINE = 2400.0
"""Of SCARAs: axis 4 [deg/s], and axis 3 [mm/s] below it."""
ORTHO_PARALLEL = [
    name for name in robot_names() if isinstance(load_robot(name).kinematics, OrthoParallel)
]


@pytest.fixture(params=robot_names(), scope="module")
def robot(request: pytest.FixtureRequest) -> Robot:
    return load_robot(request.param)


def test_names_and_aliases_are_unique() -> None:
    names = robot_names()
    assert len(set(names)) == len(names)
    assert all(name == name.lower() for name in (*names, *aliases()))
    assert not set(names) & set(aliases())
    assert set(aliases().values()) <= set(names)
    titles = [load_robot(name).title for name in names]
    assert len(set(titles)) == len(titles)


def test_numbers_in_names_are_sorted_by_value() -> None:
    names = robot_names()
    assert names.index("irb120-3-0.58") < names.index("irb1600-6-1.2")
    assert names.index("kr16-2") < names.index("kr120-r2700-2")


def test_aliases_name_the_arms_of_the_books() -> None:
    assert load_robot("kr10").name == "kr10-r1100-sixx"
    assert load_robot("RVM1").name == "rv-m1"
    assert aliases_of("irb1600-6-1.2") == ("irb1600",)
    assert aliases_of("irb1600-6-1.45") == ()


@pytest.mark.process
def test_an_arm_is_found_without_reading_the_others() -> None:
    """Names come from the folders and one file of aliases; only the arm's own entry is opened."""
    script = (
        "import sys\n"
        "opened = []\n"
        "sys.addaudithook(lambda event, what: opened.append(str(what[0])) if event == 'open' "
        "else None)\n"
        "from rapidsim.motion.robot.robot import load_robot\n"
        "load_robot('kr10')\n"
        "print(sum(name.endswith('robot.toml') for name in opened))\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, check=True, text=True
    )
    assert done.stdout.split() == ["1"]


def test_every_file_says_only_what_is_read(robot: Robot) -> None:
    text = (robots_folder() / robot.name / "robot.toml").read_text(encoding="utf-8")
    table = tomllib.loads(text)
    known = "name title maker structure payload_kg reach_m sources checks notes not_modelled flange"
    tables = "notices geometry_mm zero joint dynamics shape torques accelerations picking_cycle"
    tables += " wrist_centre_volume"
    assert set(table) <= {*known.split(), *tables.split(), "link_excess_mm", "unconfirmed_speeds"}
    assert table["maker"] in MAKERS
    assert table["title"].startswith(table["maker"])


def test_links_that_were_compared_say_how_far_they_are_off(robot: Robot) -> None:
    excess = robot.link_excess_m
    assert len(excess) in (0, len(robot.joints) + 1)
    if excess and robot.reach_m:
        assert min(excess) >= 0.0
        assert max(excess) <= LARGEST_EXCESS[0] * robot.reach_m
        assert max(excess[3:]) <= LARGEST_EXCESS[1] * robot.reach_m


def test_lent_speeds_are_those_of_an_arm_of_the_same_kind(robot: Robot) -> None:
    """The lender has speeds of its own, and no source gives those of the borrower."""
    entry = find_entry(robot.name)
    if None not in entry.max_speeds or robot.name == "rv-m1":
        assert robot.axis_speeds_from is None
        assert tuple(joint.max_speed for joint in robot.joints) == entry.max_speeds
        return
    assert robot.axis_speeds_from is not None
    lender = find_entry(robot.axis_speeds_from)
    assert None not in lender.max_speeds
    assert lender.maker == entry.maker
    assert type(lender.geometry) is type(entry.geometry)
    assert tuple(joint.max_speed for joint in robot.joints) == lender.max_speeds
    assert any(lender.name in notice for notice in robot.notices)


@pytest.mark.parametrize(
    ("name", "lender"),
    [
        # The same family, nearest in reach and payload.
        ("irb6700-245-3.0", "irb6700-235-2.65"),
        # The same number of the type.
        ("irb2400l-7-1.8", "irb2400-10-1.55"),
        ("crb1300-7-1.4", "irb1300-10-1.15"),
        # Neither: the nearest of the same structure.
        ("irb460-110-2.4", "irb660-180-3.15"),
        ("irb920-6-0.65", "irb910sc-3-0.65"),
        ("irb5720-155-2.6-lid", "irb6700-155-2.85"),
    ],
)
def test_the_nearest_arm_lends_its_speeds(name: str, lender: str) -> None:
    assert load_robot(name).axis_speeds_from == lender


def test_limits_are_sane(robot: Robot) -> None:
    """No joint is locked or endless, speeds are in degrees, and zero or the start is within."""
    span = np.degrees(robot.upper - robot.lower)
    assert (span >= 90.0).all()
    assert (span <= 800.0).all()
    speeds = [joint.max_speed for joint in robot.joints]
    fastest = FASTEST_SPLINE if robot.kinematics.slides.any() else FASTEST_DEG_S
    assert all(v is None or 30.0 <= np.degrees(v) <= fastest for v in speeds)
    assert len({speed is None for speed in speeds}) == 1
    if speeds[0] is None:
        assert [note for note in robot.notes if "speeds" in note]
    assert robot.reach_m is not None
    assert 0.3 <= robot.reach_m <= LONGEST_REACH_M
    assert (robot.lower <= robot.start).all()
    assert (robot.start <= robot.upper).all()


@pytest.mark.parametrize("name", ORTHO_PARALLEL)
def test_home_is_where_the_lengths_say(name: str) -> None:
    """Lower arm upright, forearm level, wrist straight: one corner in the plane of axis 1."""
    robot = load_robot(name)
    arm = robot.kinematics
    assert isinstance(arm, OrthoParallel)
    g = arm.geometry
    upright = arm.joints_from_theta(np.array([0.0, 0.0, np.pi / 2.0, 0.0, 0.0, 0.0]))
    flange = arm.forward(upright)
    expected = [g.a1 + g.c3 + g.c4, g.b, g.c1 + g.c2 - g.a2]
    assert flange.translation == pytest.approx(expected, abs=1e-12)
    assert flange.rotation[:, 2] == pytest.approx([1.0, 0.0, 0.0], abs=1e-12)
    if robot.maker == "ABB":
        assert upright == pytest.approx(np.zeros(6), abs=1e-12)


def test_a_run_starts_away_from_singularities(robot: Robot) -> None:
    jacobian = robot.kinematics.jacobian(robot.start)
    scaled = jacobian / np.array([robot.reach_m] * 3 + [1.0] * 3)[:, None]
    assert np.linalg.svd(scaled, compute_uv=False)[-1] > 0.02


@pytest.mark.parametrize("name", ["irb2400-10-1.55", "irb4400-60-1.95"])
def test_a_rod_keeps_the_forearm_level(name: str) -> None:
    """Joint 3 is the angle of the forearm to the horizontal, wherever joint 2 stands."""
    robot = load_robot(name)
    for q2 in np.radians([-50.0, 0.0, 60.0]):
        flange = robot.forward(np.array([0.0, q2, 0.0, 0.0, 0.0, 0.0]))
        assert flange.rotation[:, 2] == pytest.approx([1.0, 0.0, 0.0], abs=1e-12)
    assert robot.not_modelled


def test_the_kr_10_is_its_dh_table() -> None:
    """KUKA's axes mapped to the table's angles give the table's tip."""
    truth = recorded("kr10")
    robot = load_robot("kr10")
    geometry = find_entry("kr10").geometry
    assert isinstance(geometry, OpwGeometry)
    beyond_flange = truth["tool_z"] - geometry.c4
    for case in truth["fk_ik_random"]:
        axes = kuka_axes_from_dh(np.array(case["q"]))
        flange = robot.forward(axes)
        tip = flange.translation + beyond_flange * flange.rotation[:, 2]
        assert tip == pytest.approx(case["tool_T"]["p_m"], abs=1e-9)
        assert flange.rotation == pytest.approx(np.array(case["tool_T"]["R"]), abs=1e-9)
        ours = robot.inverse(flange)
        listed = [
            kuka_axes_from_dh(np.array(solution["q"]))
            for solution in case["ik"]
            if solution["reachable"]
        ]
        assert ours.exists.sum() == len(listed)
        for theirs in listed:
            gap = np.abs(turns_aside(ours.joints[ours.exists] - theirs)).max(axis=-1)
            assert gap.min() < 1e-6
    limits = [np.degrees([joint.lower, joint.upper]).tolist() for joint in robot.joints]
    assert np.array(limits) == pytest.approx(
        np.array(truth["limits_ros_industrial_kr10r1100sixx_deg"])
    )


def test_the_rv_m1_is_its_dh_table() -> None:
    truth = recorded("rvm1")
    robot = load_robot("rvm1")
    for case in truth["random"]:
        flange = robot.forward(np.array(case["q"]))
        assert flange.translation == pytest.approx(case["p_m"], abs=1e-9)
        assert flange.rotation == pytest.approx(np.array(case["R"]), abs=1e-9)
    limits = np.degrees([robot.lower, robot.upper]).T
    assert limits == pytest.approx(np.array(truth["limits_deg"]))


def kuka_axes_from_dh(theta: Array) -> Array:
    """A1 to A6 [rad] of the angles of the DH table."""
    quarter = np.pi / 2.0
    return np.array(
        [-theta[0], -theta[1], theta[2] + quarter, -theta[3], theta[4], np.pi - theta[5]]
    )


def turns_aside(difference: Array) -> Array:
    """Differences of angles [rad] without whole turns."""
    return difference - 2.0 * np.pi * np.round(difference / (2.0 * np.pi))
