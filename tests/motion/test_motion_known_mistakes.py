"""Mistakes that reports on these arms have made: each pinned by what is right instead."""

from collections.abc import Callable

import numpy as np
import pytest
from motion_truth import assert_same_set
from reference_numbers import recorded

from rapidsim.frames.rotation_vectors import rotation_from_vector, vector_from_rotation
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.reachability import (
    limit_excess,
    turns_within_limits,
    unreachable_reason,
)
from rapidsim.motion.configurations.singularities import differential, joint_speeds, pseudo_inverse
from rapidsim.motion.kinematics.closed_form.opw import OrthoParallel
from rapidsim.motion.robot.robot import Robot, load_robot

QUARTER = np.pi / 2.0
KR_10_TOOL = 0.24
"""Wrist centre to the tip of the report's tool [m]; the flange stands at 80 mm."""
RV_M1_ROWS = [(0.152, 0.0, QUARTER), (0.0, 0.25, 0.0), (0.0, 0.16, 0.0), (0.0, 0.0, QUARTER),
              (0.072, 0.0, 0.0)]  # fmt: skip
"""d [m], a [m] and alpha [rad] of the standard DH table."""
RV_M1_ZEROS = np.array([0.0, 0.0, 0.0, QUARTER, -QUARTER])


def test_kr_10_axes_2_and_3_are_parallel_not_square() -> None:
    """A printed twist of 90 deg between them moves the tip by a third of a metre and more.

    The reach cannot tell the two tables apart, so it proves nothing.
    """
    robot = load_robot("kr10")
    rng, apart = np.random.default_rng(6), []
    for theta in rng.uniform(-1.0, 1.0, (200, 6)):
        parallel, square = (kr_10_by_dh(theta, twist) for twist in (np.pi, QUARTER))
        flange = robot.forward(kuka_axes_from_dh(theta))
        ours = flange.translation + (KR_10_TOOL - 0.08) * flange.rotation[:, 2]
        assert ours == pytest.approx(parallel[:3, 3], abs=1e-9)
        apart.append(float(np.linalg.norm(parallel[:3, 3] - square[:3, 3])))
    assert min(apart) > 0.3


def test_kr_10_transforms_are_rigid() -> None:
    """A printed matrix ends in 0 and turns by theta where it must turn by alpha."""
    links = load_robot("kr10").kinematics.link_frames(np.linspace(-1.0, 1.0, 6)).matrix
    assert np.array_equal(links[:, 3], np.tile([0.0, 0.0, 0.0, 1.0], (6, 1)))
    turns = links[:, :3, :3]
    assert turns @ np.swapaxes(turns, -1, -2) == pytest.approx(np.tile(np.eye(3), (6, 1, 1)))


def test_kr_10_wrist_centre_gives_axis_1_by_both_coordinates() -> None:
    """The way ahead of axis 2 is Px cos + Py sin - a1, with the angle from both signs."""
    robot = load_robot("kr10")
    arm = robot.kinematics
    assert isinstance(arm, OrthoParallel)
    for case in recorded("kr10")["fk_ik_random"]:
        x, y, _ = case["wrist_centre"]
        pose = robot.forward(kuka_axes_from_dh(np.array(case["q"])))
        centre = pose.translation - arm.geometry.c4 * pose.rotation[:, 2]
        assert centre == pytest.approx(case["wrist_centre"], abs=1e-9)
        front = robot.inverse(pose).joints[0, 0]
        theta_1 = -front  # KUKA counts axis 1 the other way
        assert np.hypot(x, y) == pytest.approx(x * np.cos(theta_1) + y * np.sin(theta_1), abs=1e-9)


def test_kr_10_all_eight_branches_reach_the_pose() -> None:
    """Misprints in the wrist angles cost the printed formulas decimetres; here every one holds."""
    robot, branches = load_robot("kr10"), 0
    for case in recorded("kr10")["fk_ik_random"]:
        pose = robot.forward(kuka_axes_from_dh(np.array(case["q"])))
        found = robot.inverse(pose)
        ours = found.joints[found.exists]
        theirs = [kuka_axes_from_dh(np.array(s["q"])) for s in case["ik"] if s["reachable"]]
        assert_same_set(ours, np.array(theirs), 1e-8)
        assert np.abs(robot.forward(ours).matrix - pose.matrix).max() < 1e-9
        branches += len(ours)
    assert branches > 70


def test_a_rotation_vector_is_not_a_set_of_euler_angles() -> None:
    """Reading one as the other breaks the way there and back for all but single-axis turns."""
    robot, vector = load_robot("kr10"), np.array([0.7, -0.4, 1.1])
    pose = Transform(rotation_from_vector(vector), np.array([0.6, 0.2, 0.5]))
    misread = Transform(by_euler_angles(vector), pose.translation)
    assert np.abs(misread.rotation - pose.rotation).max() > 0.2
    branches = robot.inverse(pose)
    assert branches.exists.any()
    for joints in branches.joints[branches.exists]:
        back = vector_from_rotation(robot.forward(joints).rotation)
        assert back == pytest.approx(vector, abs=1e-9)


def test_a_cube_of_180_cm_is_out_of_the_reach_of_the_kr_10() -> None:
    """Points in all eight quadrants are no test of anything if all are unreachable."""
    robot = load_robot("kr10")
    for x in (-0.9, 0.9):
        for y in (-0.9, 0.9):
            for z in (-0.9, 0.9):
                why = unreachable_reason(robot, Transform(np.eye(3), np.array([x, y, z])))
                assert why is not None
                assert why.joint is None
                assert 0.1 < why.shortfall < 1.0
                assert "beyond reach" in why.message


def test_the_kr_10_has_the_maker_s_limits_speeds_and_no_weight_of_5_kg() -> None:
    """Soft limits of one installation, and a payload read as the arm's weight, are not the arm."""
    robot = load_robot("kr10")
    degrees = np.degrees(np.stack([robot.lower, robot.upper], axis=-1))
    wanted = [[-170, 170], [-190, 45], [-120, 156], [-185, 185], [-120, 120], [-350, 350]]
    assert degrees == pytest.approx(np.array(wanted, dtype=np.float64))
    speeds = np.degrees([joint.max_speed or 0.0 for joint in robot.joints])
    assert speeds == pytest.approx([300, 225, 225, 381, 311, 492])
    assert robot.payload_kg == 10.0


def test_rv_m1_table_is_standard_dh_not_modified() -> None:
    """The other reading of the same table puts the tip a third of a metre away."""
    joints = np.array([0.3, 0.4, -0.5, 0.2, 0.1])
    ours = load_robot("rvm1").forward(joints).translation
    standard = rv_m1_by_dh(joints, standard_dh)[:3, 3]
    modified = rv_m1_by_dh(joints, modified_dh)[:3, 3]
    truth = recorded("rvm1")["eq3_modified_dh_on_printed_table"]
    assert ours == pytest.approx(standard, abs=1e-12)
    assert ours == pytest.approx(truth["tip_standard_dh"], abs=1e-6)
    assert modified == pytest.approx(truth["tip_eq3"], abs=1e-6)
    assert np.linalg.norm(ours - modified) == pytest.approx(truth["distance_m"], abs=1e-4)


def test_rv_m1_closed_form_counts_joint_4_from_elsewhere() -> None:
    """A published closed form is this arm with joint 4 90 deg on and y the other way.

    Its wrist lacks the last 72 mm, which its gripper then has again.
    """
    robot, rng = load_robot("rvm1"), np.random.default_rng(7)
    assert np.degrees([robot.lower[3], robot.upper[3]]) == pytest.approx([-90.0, 90.0])
    for q in rng.uniform(robot.lower, robot.upper, (50, 5)):
        q1, q2, q3, published_4, _ = q + np.array([0.0, 0.0, 0.0, QUARTER, 0.0])
        level = 0.25 * np.cos(q2) + 0.16 * np.cos(q2 + q3)
        level += 0.072 * np.sin(q2 + q3 + published_4)
        up = 0.152 + 0.25 * np.sin(q2) + 0.16 * np.sin(q2 + q3)
        up -= 0.072 * np.cos(q2 + q3 + published_4)
        published = [level * np.cos(q1), -level * np.sin(q1), up]
        mirrored = np.array([1.0, -1.0, 1.0]) * published
        assert robot.forward(q).translation == pytest.approx(mirrored, abs=1e-12)


def test_rv_m1_inverse_has_plus_signs_where_a_print_has_minus() -> None:
    """With the printed gamma none of 50 poses is solved; the triangle that is right solves all."""
    robot, rng = load_robot("rvm1"), np.random.default_rng(8)
    a2, a3 = 0.25, 0.16
    for q in rng.uniform(robot.lower, robot.upper, (50, 5)):
        pose = robot.forward(q)
        alpha = a2 * np.cos(q[1]) + a3 * np.cos(q[1] + q[2])
        beta = a2 * np.sin(q[1]) + a3 * np.sin(q[1] + q[2])
        solved = {}
        for name, sign in (("right", 1.0), ("printed", -1.0)):
            gamma = (a2**2 - a3**2 + sign * (alpha**2 + beta**2)) / (2.0 * a2)
            beside = np.sqrt(max(alpha**2 + beta**2 - gamma**2, 0.0))
            along = np.arctan2(beta, alpha)
            solved[name] = [along + side * np.arctan2(beside, gamma) for side in (1.0, -1.0)]
        assert min(abs(q2 - q[1]) for q2 in solved["right"]) < 1e-6
        assert min(abs(q2 - q[1]) for q2 in solved["printed"]) > 1e-3
        branches = robot.inverse(pose)
        reached = robot.forward(branches.joints[branches.exists])
        assert np.abs(reached.matrix - pose.matrix).max() < 1e-9


def test_rv_m1_jacobian_columns_turn_about_their_own_axes() -> None:
    """Each column's lever starts at its own joint; the last joint moves the flange not at all."""
    arm, step = load_robot("rvm1").kinematics, 1e-6
    for case in recorded("rvm1")["random"]:
        q = np.array(case["q"])
        jacobian = arm.jacobian(q)
        for joint in range(5):
            nudge = step * np.eye(5)[joint]
            ahead, behind = arm.forward(q + nudge), arm.forward(q - nudge)
            velocity = (ahead.translation - behind.translation) / (2.0 * step)
            assert jacobian[:3, joint] == pytest.approx(velocity, abs=1e-8)
        assert np.abs(jacobian[:3, 4]).max() < 1e-15


def test_joint_speeds_at_a_singularity_are_finite() -> None:
    """The inverse of J'J does not exist there; the one by singular values does."""
    jacobian = load_robot("rvm1").kinematics.jacobian(np.radians([20.0, 30.0, 0.0, 0.0, 10.0]))
    square = jacobian.T @ jacobian
    assert np.linalg.cond(square) > 1e15
    inverse = pseudo_inverse(jacobian)
    assert np.abs(inverse).max() < 10.0
    assert jacobian @ inverse @ jacobian == pytest.approx(jacobian, abs=1e-12)
    speeds, missed = joint_speeds(jacobian, np.array([0.1, 0.0, 0.0, 0.0, 0.0, 0.0]))
    assert np.isfinite(speeds).all()
    assert np.isfinite(missed).all()


@pytest.mark.parametrize(
    ("joints_deg", "placing_rank"),
    [
        ((20, 30, 0, 0, 10), 2),  # straight arm: true
        ((20, 80, 0, 0, 10), 2),
        ((20, -30, -30, 0, 10), 3),  # joint 2 at -30 alone: false
        ((20, -30, -60, 0, 10), 3),
        ((20, -30, -90, 90, 10), 3),
        ((17.18873385392, 90, -20, 69.46814424985, 11.45915590262), 2),  # on the waist axis: missed
        ((17.18873385392, 100, -10, -37.08111459443, 11.45915590262), 2),
    ],
)
def test_rv_m1_singular_sets_that_are_true_false_and_missed(
    joints_deg: tuple[float, ...], placing_rank: int
) -> None:
    """Straight with joint 4 at 0 is one, joint 2 at -30 is none, the flange on axis 1 is one."""
    robot = load_robot("rvm1")
    found = differential(robot.kinematics, np.radians(joints_deg))
    values = np.linalg.svd(found.jacobian[:3], compute_uv=False)
    assert int(np.count_nonzero(values > 1e-9)) == placing_rank
    assert bool(found.near) == (placing_rank == 2)
    assert not limit_excess(robot, np.radians(joints_deg)).any()


def test_rv_m1_elbow_angles_of_an_example_are_outside_the_limits() -> None:
    robot = load_robot("rvm1")
    for elbow_deg in (90.0, 60.0):
        over = limit_excess(robot, np.radians([0.0, 45.0, elbow_deg, 0.0, 0.0]))
        assert np.degrees(over[2]) == pytest.approx(elbow_deg)


def test_rv_m1_zeros_are_part_of_the_arm() -> None:
    """Left out on one side of a comparison they move the tip by 102 mm, not by 0."""
    truth = recorded("rvm1")["program6_zero_error_claim"]
    joints = np.array(truth["q"])
    with_zeros = load_robot("rvm1").forward(joints).translation
    without = rv_m1_by_dh(joints - RV_M1_ZEROS, standard_dh)[:3, 3]
    assert with_zeros == pytest.approx(truth["with_offset"], abs=1e-9)
    assert without == pytest.approx(truth["toolbox_without_offset"], abs=1e-9)
    assert np.linalg.norm(with_zeros - without) == pytest.approx(truth["difference_m"], abs=1e-9)


@pytest.mark.parametrize(
    "placement",
    ["raw (x,y,t)*0.1 m", "plotted (x,y)/40 in the plane z=0",
     "published (x/40+1, 0, y/40+3)"],
)  # fmt: skip
def test_where_a_letter_can_be_drawn_by_the_rv_m1(placement: str) -> None:
    """As printed it is metres away; in two other places part of it is out of the limits."""
    truth, robot = recorded("letter_d")["placements"][placement], load_robot("rvm1")
    geometric, within = 0, []
    for point in truth["points_m"]:
        exists, possible = with_any_pitch(robot, np.array(point))
        geometric += exists
        within.append(possible)
    assert geometric == truth["reachable_any_pitch"]
    assert within == truth["flags_within_limits"]
    assert sum(within) == truth["reachable_any_pitch_within_limits"]


def with_any_pitch(robot: Robot, point: Array) -> tuple[bool, bool]:
    """Whether a point is reached at all with some pitch, and whether within the limits."""
    ahead = np.arctan2(point[1], point[0])
    pitch = np.radians(np.arange(-180.0, 180.0, 0.5))
    cp, sp, zero, one = np.cos(pitch), np.sin(pitch), np.zeros(720), np.ones(720)
    rotation = np.stack(
        [
            np.stack([zero, one, zero], -1),
            np.stack([-sp, zero, cp], -1),
            np.stack([cp, zero, sp], -1),
        ],
        axis=-1,
    )
    turned = rotation_from_vector(np.array([0.0, 0.0, ahead])) @ rotation
    branches = robot.inverse(Transform(turned, np.broadcast_to(point, (720, 3))))
    joints = turns_within_limits(robot, branches.joints)
    within = branches.exists & ~limit_excess(robot, joints).any(axis=-1)
    return bool(branches.exists.any()), bool(within.any())


def standard_dh(theta: float, d: float, a: float, alpha: float) -> Array:
    return about_z(theta) @ shifted(a, 0.0, d) @ about_x(alpha)


def modified_dh(theta: float, d: float, a: float, alpha: float) -> Array:
    return about_x(alpha) @ shifted(a, 0.0, 0.0) @ about_z(theta) @ shifted(0.0, 0.0, d)


def rv_m1_by_dh(joints: Array, link: Callable[[float, float, float, float], Array]) -> Array:
    tip: Array = np.eye(4)
    for theta, (d, a, alpha) in zip(joints + RV_M1_ZEROS, RV_M1_ROWS, strict=True):
        tip = tip @ link(theta, d, a, alpha)
    return tip


def kr_10_by_dh(theta: Array, twist_2: float) -> Array:
    """base_from_tip by the report's table, with the twist between axes 2 and 3 given."""
    rows = [(0.4, 0.025, QUARTER), (0.0, 0.56, twist_2), (0.0, 0.035, -QUARTER),
            (0.515, 0.0, QUARTER), (0.0, 0.0, -QUARTER), (0.0, 0.0, 0.0)]  # fmt: skip
    tip: Array = np.eye(4)
    for angle, (d, a, alpha) in zip(theta, rows, strict=True):
        tip = tip @ standard_dh(float(angle), d, a, alpha)
    return tip @ shifted(0.0, 0.0, KR_10_TOOL)


def kuka_axes_from_dh(theta: Array) -> Array:
    """A1 to A6 [rad] of the angles of the DH table."""
    return np.array(
        [-theta[0], -theta[1], theta[2] + QUARTER, -theta[3], theta[4], np.pi - theta[5]]
    )


def by_euler_angles(angles: Array) -> Array:
    about = [
        rotation_from_vector(angle * axis) for angle, axis in zip(angles, np.eye(3), strict=True)
    ]
    turned: Array = about[2] @ about[1] @ about[0]
    return turned


def about_z(angle: float) -> Array:
    return turning(np.array([0.0, 0.0, angle]))


def about_x(angle: float) -> Array:
    return turning(np.array([angle, 0.0, 0.0]))


def turning(vector: Array) -> Array:
    matrix: Array = np.eye(4)
    matrix[:3, :3] = rotation_from_vector(vector)
    return matrix


def shifted(x: float, y: float, z: float) -> Array:
    matrix: Array = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix
