"""Torques of SCARAs and offset wrists, accelerations of seven-axis arms and palletizers."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples

from rapidsim.frames.transform import Array
from rapidsim.motion.model import MODELS, MotionModel
from rapidsim.motion.robot.dynamics import Dynamics, ElbowDynamics
from rapidsim.motion.robot.robot import Robot, load_robot
from rapidsim.motion.robot.scara_dynamics import ScaraDynamics
from rapidsim.motion.timing.axis_limits import limits_of

SCARA = "irb910sc-3-0.65"
GOFA = "crb15000-5-0.95"
angles = st.floats(-2.0, 2.0)
rates = st.tuples(*(st.floats(-3.0, 3.0) for _ in range(2)))


def _dynamics(robot: Robot) -> Dynamics:
    assert robot.constants.dynamics is not None
    return robot.constants.dynamics


def _shares(robot: Robot, q: Array, rate: Array, change: Array, load: float = 0.0) -> Array:
    """Shares (3,) of the torques at joints q (n,)."""
    stance = robot.kinematics.stance(q[None])
    found = _dynamics(robot).shares(stance, rate[None], change[None], np.array([load]))
    shares: Array = found[0]
    return shares


@examples(40)
@given(angles, rates, st.sampled_from([0.0, 1.0]))
def test_products_of_speeds_of_a_scara_follow_from_its_inertia(
    q2: float, rate: tuple[float, float], load: float
) -> None:
    """Lagrange, of which only joint 2 changes the inertia; the limits of both torques differ."""
    robot, speed = load_robot(SCARA), np.array([*rate, 0.0])
    limit = np.array([380.0, 171.0])

    def inertia(at: float) -> Array:
        q = np.array([0.0, at, 0.0, 0.0])
        columns = [_shares(robot, q, np.zeros(3), unit, load)[:2] * limit for unit in np.eye(3)[:2]]
        return np.stack(columns, axis=1)

    step = 1e-5
    slope = (inertia(q2 + step) - inertia(q2 - step)) / (2.0 * step)
    expected = slope @ speed[:2] * speed[1]
    expected[1] -= 0.5 * speed[:2] @ slope @ speed[:2]
    found = _shares(robot, np.array([0.0, q2, 0.0, 0.0]), speed, np.zeros(3), load)[:2] * limit
    assert found == pytest.approx(expected, abs=1e-4)
    assert np.allclose(inertia(q2), inertia(q2).T)


def test_a_stretched_scara_accelerates_as_its_picking_cycle_demands() -> None:
    """91 rad/s2 on axis 1, 59 m/s2 at the tip; a folded arm accelerates more."""
    robot = load_robot(SCARA)
    own = robot.constants
    assert isinstance(own.dynamics, ScaraDynamics)
    first, _, third = own.dynamics.least_accelerations
    assert first == pytest.approx(91.2, rel=0.01)
    assert robot.joints[2].unit * third == pytest.approx(50.0)
    folded = _shares(robot, np.radians([0.0, 140.0, 0.0, 0.0]), np.zeros(3), np.eye(3)[0])[0]
    assert 1.0 / folded > 1.6 * first
    assert own.zone_share == 1.0
    assert (own.factor, own.cycle_percent) == (1.4, 15.0)
    assert load_robot("irb920-6-0.65").constants.cycle_percent == 25.0


def test_gravity_takes_most_of_an_arm_that_is_stretched_out_and_nothing_of_an_upright_one() -> None:
    robot = load_robot(GOFA)
    dynamics = _dynamics(robot)
    assert isinstance(dynamics, ElbowDynamics)
    free = ElbowDynamics(dynamics.torques, dynamics.geometry)
    level = np.radians([0.0, 90.0, -90.0, 0.0, 0.0, 0.0])
    t = dynamics.torques
    lean = np.degrees(np.arctan2(t.z, t.x))
    upright = np.radians([0.0, 0.0, -(90.0 - lean), 0.0, 0.0, 0.0])

    def remaining(q: Array, load: float) -> Array:
        stance, none = robot.kinematics.stance(q[None]), np.zeros((1, 3))
        hangs, change = np.array([load]), np.ones((1, 3))
        found = free.shares(stance, none, change, hangs) / dynamics.shares(
            stance, none, change, hangs
        )
        shares: Array = found[0, 1:]
        return shares

    # 57 % and 32 % of axes 2 and 3 hold the arm, and 5 kg another 27 % of axis 2.
    assert np.sqrt(1.0 - remaining(level, 0.0)) == pytest.approx((0.56, 0.30), abs=0.03)
    assert np.sqrt(1.0 - remaining(level, 1.0))[0] == pytest.approx(0.82, abs=0.04)
    assert remaining(upright, 0.0) == pytest.approx((1.0, 1.0), abs=0.01)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("irb14000-0.5-0.5", (1125, 1125, 1125, 1125, 8000, 8000, 8000)),
        ("irb14050-0.5-0.5", (1125, 1125, 1125, 1125, 8000, 8000, 8000)),
        ("irb660-180-3.15", (1083, 1083, 1083, 2500)),
        ("kr6-r900-2", (2250, 1875, 2250, 2812, 2812, 3375)),
    ],
)
def test_accelerations_of_arms_without_torques(name: str, expected: tuple[float, ...]) -> None:
    robot = load_robot(name)
    limits = limits_of(robot, MotionModel())
    assert not limits.arms
    assert np.degrees(limits.max_acceleration) == pytest.approx(expected, abs=1.0)
    as_before = limits_of(robot, MODELS["2"])
    assert as_before.max_acceleration == pytest.approx(as_before.max_speed / 0.16)
    asked = limits_of(robot, MotionModel(acceleration_time=0.2, own_accelerations=False))
    assert asked.max_acceleration == pytest.approx(asked.max_speed / 0.2)


def test_speeds_that_no_source_confirms_are_only_suggested() -> None:
    robot = load_robot("irb460-110-2.4")
    assert robot.axis_speeds_from == "irb660-180-3.15"
    assert [joint.max_speed for joint in robot.joints] == [
        joint.max_speed for joint in load_robot("irb660-180-3.15").joints
    ]
    assert any("no source confirms them: [145, 110, 120, 400]" in one for one in robot.notices)
