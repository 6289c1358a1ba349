"""Torques of main axes: the law against its own energy, the published tables, the prior's table."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples
from motion_programs import HOME, V500, Programmer, path_of

from rapidsim.frames.transform import Array
from rapidsim.motion.model import MODELS, MotionModel
from rapidsim.motion.robot.dynamics import ElbowDynamics
from rapidsim.motion.robot.robot import Robot, load_robot, robot_names
from rapidsim.motion.timing.active_constraints import limiters_of_segments
from rapidsim.motion.timing.axis_limits import combined_limits, limits_of, model_of
from rapidsim.motion.timing.planning import plan

MEASURED = ("irb6640-180-2.55", "irb1200-5-0.9")
angles = st.tuples(*(st.floats(-1.2, 1.2) for _ in range(3)))
rates = st.tuples(*(st.floats(-3.0, 3.0) for _ in range(3)))


def _dynamics(robot: Robot) -> ElbowDynamics:
    assert isinstance(robot.constants.dynamics, ElbowDynamics)
    return robot.constants.dynamics


def _shares(robot: Robot, q: Array, rate: Array, change: Array, load: float = 0.0) -> Array:
    stance = robot.kinematics.stance(np.append(q, [0.0, 0.5, 0.0])[None])
    found = _dynamics(robot).shares(stance, rate[None], change[None], np.array([load]))
    shares: Array = found[0]
    return shares


def _inertia(robot: Robot, q: Array, load: float) -> Array:
    """The symmetric inertia (3, 3): row 3 without the factor between the limits of axes 2 and 3."""
    columns = [_shares(robot, q, np.zeros(3), unit, load) for unit in np.eye(3)]
    matrix = np.stack(columns, axis=1)
    matrix[2] /= _dynamics(robot).torques.kappa
    return matrix


@examples(40)
@given(angles, rates, st.sampled_from([0.0, 1.0]), st.sampled_from(MEASURED))
def test_products_of_speeds_follow_from_the_inertia(
    q: tuple[float, ...], rate: tuple[float, ...], load: float, name: str
) -> None:
    """Lagrange: tau = M q'' + M' q' - d/dq (q' M q' / 2), M by differences."""
    robot, at, speed = load_robot(name), np.array(q), np.array(rate)
    step = 1e-5
    slopes = [
        (_inertia(robot, at + step * one, load) - _inertia(robot, at - step * one, load))
        / (2.0 * step)
        for one in np.eye(3)
    ]
    change = np.einsum("kij,k->ij", np.array(slopes), speed) @ speed
    pull = np.array([0.5 * speed @ slope @ speed for slope in slopes])
    found = _shares(robot, at, speed, np.zeros(3), load)
    assert found[0] == pytest.approx((change - pull)[0], abs=1e-6)
    # What axis 1 throws outwards is taken for as much of the limits of axes 2 and 3 as of its own.
    outwards = 0.5 * np.array([slope[0, 0] for slope in slopes[1:]]) * speed[0] ** 2
    kappa = _dynamics(robot).torques.kappa
    others = (found[1:] + outwards) / (1.0, kappa)
    assert others == pytest.approx((change - pull)[1:] + outwards, abs=1e-6)


def test_swings_of_single_axes_have_the_accelerations_of_the_tables() -> None:
    """What one axis can do alone, in degrees per second squared."""
    robot = load_robot("irb6640-180-2.55")
    stretched, drawn_in = np.radians([0.0, 90.0, -90.0]), np.radians([0.0, 0.0, 0.0])
    for pose, axis, expected in (
        (stretched, 0, 200.0),
        (drawn_in, 0, 533.0),
        (np.radians([0.0, -34.0, 52.0]), 0, 773.0),
        (np.radians([0.0, 20.0, -66.5]), 1, 244.0),
        (np.radians([0.0, 20.0, 30.0]), 2, 621.0),
    ):
        share = _shares(robot, pose, np.zeros(3), np.eye(3)[axis])[axis]
        assert np.degrees(1.0 / share) == pytest.approx(expected, rel=0.01), (pose, axis)


@pytest.mark.parametrize(
    ("name", "stretched", "wrist", "zone_share", "percent"),
    [
        ("irb120-3-0.58", (3966, 3148, 6155), (8000, 8000, 10500), 1.0, 20),
        ("irb1100-4-0.475", (7376, 4965, 8183), (14000, 10500, 18750), 1.0, 20),
        ("irb1600-6-1.2", (885, 847, 2012), (4530, 5662, 6370), 0.833, 15),
        ("irb2400-16-1.55", (591, 578, 1411), (4079, 4079, 5099), 0.762, 20),
        ("irb6700-200-2.6", (223, 244, 669), (1373, 1084, 1517), 0.636, 15),
        ("irb7600-150-3.5", (133, 120, 352), (558, 558, 1060), 0.573, 15),
    ],
)
def test_arms_that_were_not_measured_are_scaled(
    name: str,
    stretched: tuple[float, ...],
    wrist: tuple[float, ...],
    zone_share: float,
    percent: float,
) -> None:
    robot = load_robot(name)
    own = robot.constants
    assert not own.is_measured
    least = np.degrees(_dynamics(robot).least_accelerations)
    assert least == pytest.approx(stretched, rel=0.005)
    assert np.degrees(_dynamics(robot).torques.wrist) == pytest.approx(wrist, rel=0.002)
    assert own.zone_share == pytest.approx(zone_share, abs=0.001)
    assert (own.factor, own.cycle_percent) == (1.5, percent)


@pytest.mark.parametrize(
    ("name", "stretched", "drawn_in", "second", "third", "wrist"),
    [
        ("irb120-3-0.58", 2612, 6557, 2566, 3877, (3200, 3200, 4200)),
        ("irb1600-6-1.2", 758, 1618, 794, 1768, (3200, 4000, 4500)),
        ("irb6700-200-2.6", 256, 584, 252, 748, (1900, 1500, 2100)),
        ("irb7600-150-3.5", 173, 327, 102, 346, (1000, 1000, 1900)),
    ],
)
def test_version_2_of_the_model_keeps_its_constants(
    name: str,
    stretched: float,
    drawn_in: float,
    second: float,
    third: float,
    wrist: tuple[float, ...],
) -> None:
    robot = load_robot(name)
    robot = replace(robot, constants=robot.constants_2)
    least = np.degrees(_dynamics(robot).least_accelerations)
    assert least == pytest.approx((stretched, second, third), rel=0.005)
    share = _shares(robot, np.zeros(3), np.zeros(3), np.eye(3)[0])[0]
    assert np.degrees(1.0 / share) == pytest.approx(drawn_in, rel=0.005)
    assert np.degrees(_dynamics(robot).torques.wrist) == pytest.approx(wrist)
    limits = limits_of(robot, MODELS["2"])
    assert set(limits.zone_share) == {0.64}
    assert limits.max_acceleration[0] == pytest.approx(np.radians(stretched), rel=0.005)


def test_who_has_torques() -> None:
    """Arms of ABB but palletizers and seven-axis arms; two of them were measured."""
    known = {name: load_robot(name) for name in robot_names()}
    with_torques = {name for name, robot in known.items() if robot.constants.dynamics is not None}
    measured = {name for name in with_torques if known[name].constants.is_measured}
    assert measured == set(MEASURED)
    assert all(known[name].maker == "ABB" for name in with_torques)
    assert "kr10-r1100-sixx" not in with_torques
    assert len(with_torques) > 30


@pytest.mark.parametrize("name", robot_names())
def test_smoothing_dwell_and_share_in_zones_follow_the_reach(name: str) -> None:
    """A small arm is smoothed over a shorter time, torques known or not."""
    own = load_robot(name).constants
    reach = load_robot(name).reach_m
    assert reach is not None
    assert own.filter_time == pytest.approx(0.068 * reach**0.35, rel=0.02)
    assert own.fine_dwell == pytest.approx(0.025 + 0.058 * reach**0.35, rel=0.04)
    assert own.zone_share == pytest.approx(min(1.0, 0.64 * (2.55 / reach) ** 0.35))


def test_wrist_of_which_lower_bounds_were_measured_is_scaled() -> None:
    robot = load_robot("irb1200-5-0.9")
    speeds = np.array([joint.max_speed for joint in robot.joints[3:]])
    assert np.array(_dynamics(robot).torques.wrist) == pytest.approx(speeds / 0.055)
    assert (robot.constants.factor, robot.constants.cycle_percent) == (1.6, 25.0)


def test_robots_that_share_a_path_use_their_own_share_in_zones() -> None:
    large, small = (limits_of(load_robot(name), MotionModel()) for name in MEASURED)
    both = combined_limits([large, small])
    assert both.zone_share[:6] == pytest.approx(0.64)
    assert both.zone_share[6:] == pytest.approx(0.921, abs=0.001)
    asked = limits_of(load_robot(MEASURED[1]), MotionModel(zone_share=0.7))
    assert set(asked.zone_share) == {0.7}


def test_a_line_outwards_is_held_back_by_the_torque_of_axis_2() -> None:
    """The forearm keeps its direction, so that what counts is n22 - n23."""
    robot = load_robot("irb6640-180-2.55")
    joints = np.radians([0.0, 20.0, -66.0, 0.0, 46.0, 0.0])
    fast = replace(V500, tcp=10.0)
    program = Programmer(joints=joints, robot=robot, speed=fast)
    program.line((-0.3, 0.0, 0.0)).line((0.3, 0.0, 0.0))
    model = model_of(robot, MotionModel())
    path = path_of(program, model=model)
    timing = plan(path, limits_of(robot, model))
    assert str(limiters_of_segments(path, timing)[1]) == "torque of axis 2"


@examples(20)
@given(st.floats(0.0, 1.5), st.floats(-0.3, 0.3), st.floats(-0.3, 0.3))
def test_a_load_never_makes_a_move_quicker(load: float, y: float, z: float) -> None:
    robot = load_robot("irb1600-6-1.2")
    model = model_of(robot, MotionModel())
    times = []
    for hangs in (0.0, load):
        program = Programmer(joints=HOME).line((0.05, y, z))
        program.segments[0] = replace(program.segments[0], load=hangs)
        times.append(plan(path_of(program, model=model), limits_of(robot, model)).duration)
    assert times[1] >= times[0] * (1.0 - 1e-3)


def test_an_acceleration_in_the_station_replaces_torques() -> None:
    robot = load_robot("irb6640-180-2.55")
    assert limits_of(robot, MotionModel()).arms
    for model in (
        MotionModel(own_accelerations=False),
        MotionModel(acceleration=(1.0,) * 6),
        MODELS["1"],
    ):
        assert not limits_of(robot, model).arms
    version_1 = np.degrees(limits_of(robot, MODELS["1"]).max_acceleration)
    assert version_1 == pytest.approx([410, 380, 600, 1400, 1030, 1400])


def test_smoothing_and_dwell_are_those_of_the_arm() -> None:
    small, large = (model_of(load_robot(name), MotionModel()) for name in MEASURED[::-1])
    assert small.window < large.window
    assert small.dwell < large.dwell
    asked = model_of(load_robot(MEASURED[0]), MotionModel(filter_time=0.05, fine_dwell=0.2))
    assert (asked.window, asked.dwell) == (0.05, 0.2)
    real = replace(large, controller="real")
    assert real.dwell - large.dwell == pytest.approx(0.018)
