"""DH tables, screws and Euler angles: laws, and numbers that textbooks and reports give."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples
from reference_numbers import recorded

from rapidsim.frames.euler import Convention, euler_from_rotation, rotation_from_euler
from rapidsim.frames.rotation_vectors import rotation_from_vector
from rapidsim.frames.transform import matrix_from_quaternion
from rapidsim.library.positions import orient_zyx
from rapidsim.motion.kinematics.axis_tables import dh_table_of, screws_of
from rapidsim.motion.kinematics.closed_form.opw import OrthoParallel
from rapidsim.motion.kinematics.closed_form.palletizer import Palletizer
from rapidsim.motion.robot.robot import load_robot, robot_names

angles = st.floats(-180.0, 180.0)


@pytest.mark.parametrize("name", robot_names())
def test_every_arm_without_rods_has_tables_that_move_like_it(name: str) -> None:
    arm = load_robot(name).kinematics
    dh, screws = dh_table_of(arm), screws_of(arm)
    rods = isinstance(arm, Palletizer) or (
        isinstance(arm, OrthoParallel) and arm.geometry.coupling != 0
    )
    assert (dh is None) == (screws is None) == rods
    if dh is None or screws is None:
        return
    for joints in np.random.default_rng(7).uniform(-2.0, 2.0, (3, arm.joint_count)):
        right = arm.forward(joints).matrix
        assert dh.forward(joints).matrix == pytest.approx(right, abs=1e-9)
        assert screws.forward(joints).matrix == pytest.approx(right, abs=1e-9)


def test_the_rv_m1_has_the_table_of_its_report() -> None:
    """Its standard DH table: d 152, a 250 and 160, d5 72 mm, joint 4 from +90 deg."""
    table = dh_table_of(load_robot("rvm1").kinematics)
    assert table is not None
    assert 1000.0 * table.d == pytest.approx([152.0, 0.0, 0.0, 0.0, 72.0])
    assert 1000.0 * table.a == pytest.approx([0.0, 250.0, 160.0, 0.0, 0.0])
    assert np.degrees(table.alpha) == pytest.approx([90.0, 0.0, 0.0, 90.0, 0.0])
    assert np.degrees(table.theta) == pytest.approx([0.0, 0.0, 0.0, 90.0, -90.0])
    for case in recorded("rvm1")["random"][:3]:
        assert table.forward(np.array(case["q"])).translation == pytest.approx(
            case["p_m"], abs=1e-9
        )


def test_a_scara_has_the_table_of_textbooks() -> None:
    """Both arms, then an axis that slides: its way is in d, and theta stands still."""
    table = dh_table_of(load_robot("irb910sc").kinematics)
    assert table is not None
    assert table.slides.tolist() == [False, False, True, False]
    assert 1000.0 * table.a == pytest.approx([300.0, 250.0, 0.0, 0.0], abs=1e-9)
    assert np.degrees(table.alpha) == pytest.approx([0.0, 0.0, 180.0, 0.0], abs=1e-9)
    assert 1000.0 * table.d == pytest.approx([0.0, 0.0, 0.0, -220.0])  # z 4 points down
    assert np.degrees(table.theta) == pytest.approx(np.zeros(4), abs=1e-9)
    screws = screws_of(load_robot("irb910sc").kinematics)
    assert screws is not None
    assert screws.turns[2] == pytest.approx([0.0, 0.0, 0.0])
    assert screws.moments_mm[2] == pytest.approx([0.0, 0.0, 1.0])
    assert screws.moments_mm[1] == pytest.approx([0.0, -300.0, 0.0])


@examples(200)
@given(st.tuples(angles, angles, angles), st.sampled_from(Convention))
def test_euler_angles_undo_rotations(given_deg: tuple[float, ...], convention: Convention) -> None:
    rotation = rotation_from_euler(np.radians(given_deg), convention)
    assert rotation @ rotation.T == pytest.approx(np.eye(3), abs=1e-12)
    back = euler_from_rotation(rotation, convention)
    assert rotation_from_euler(back, convention) == pytest.approx(rotation, abs=1e-9)


@pytest.mark.parametrize("convention", Convention)
@pytest.mark.parametrize("middle", [-90.0, 0.0, 90.0, 180.0])
def test_a_locked_middle_angle_loses_nothing(convention: Convention, middle: float) -> None:
    rotation = rotation_from_euler(np.radians([40.0, middle, 25.0]), convention)
    back = euler_from_rotation(rotation, convention)
    assert rotation_from_euler(back, convention) == pytest.approx(rotation, abs=1e-9)


def test_zyx_is_the_order_of_orientzyx() -> None:
    z, y, x = 30.0, -20.0, 70.0
    ours = rotation_from_euler(np.radians([z, y, x]), Convention.ZYX)
    theirs = orient_zyx(z, y, x)
    assert ours == pytest.approx(matrix_from_quaternion(np.array(theirs)), abs=1e-6)
    # Roll, pitch and yaw are the same turns about axes that stand still.
    assert rotation_from_euler(np.radians([x, y, z]), Convention.RPY) == pytest.approx(ours)


def test_euler_angles_are_no_rotation_vector() -> None:
    vector = np.array([0.7, -0.4, 1.1])
    assert (
        np.abs(rotation_from_euler(vector, Convention.XYZ) - rotation_from_vector(vector)).max()
        > 0.2
    )
