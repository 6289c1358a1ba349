"""Every recorded table of orientations: products, matrices, and turning from one to another.

Recorded with eleven digits, so all hold to 1e-10.
"""

from itertools import pairwise

import numpy as np
import pytest
from reference_numbers import recorded

from rapidsim.frames import quaternion
from rapidsim.frames.transform import Transform, quaternion_from_matrix, slerp

DIGITS = 1e-10
TABLES = (
    "45 deg about Y",
    "90 deg about Z",
    "negative_dot",
    "z_170deg",
    "p10_to_p20",
)
HALF_TURNS = ((1, 0, 0), (0, 1, 0), (0, 0, 1), (0.6, 0.8, 0), (0, -0.6, 0.8), (0.48, 0.6, -0.64))


def test_quaternion_algebra() -> None:
    """Products, matrices and turned vectors, to ten digits."""
    for case in recorded("irb120")["quaternion_algebra"]:
        a_from_b, b_from_c = tuple(case["q_AB"]), tuple(case["q_BC"])
        product = quaternion.multiply(a_from_b, b_from_c)
        assert product == pytest.approx(case["product"], abs=1e-10)
        pose = Transform.from_quaternion(a_from_b, (0.0, 0.0, 0.0))
        assert pose.rotation == pytest.approx(np.array(case["R_AB"]), abs=1e-10)
        turned = quaternion.rotate(a_from_b, tuple(case["B_r"]))
        assert turned == pytest.approx(case["A_r"], abs=1e-10)
        assert pose.rotation @ case["B_r"] == pytest.approx(case["A_r"], abs=1e-10)


def test_quaternions_to_matrices() -> None:
    """Printed ones are normalised; what comes out is orthogonal to rounding."""
    cases = [c for c in recorded("quat_to_matrix").values() if isinstance(c, dict) and "R" in c]
    assert len(cases) == 14
    for case in cases:
        q = np.array(case["q_in"], dtype=np.float64)
        rotation = Transform.from_quaternion(q / np.linalg.norm(q), (0.0, 0.0, 0.0)).rotation
        assert rotation == pytest.approx(np.array(case["R"]), abs=1e-10)
        assert np.linalg.det(rotation) == pytest.approx(1.0, abs=1e-12)
        assert rotation @ rotation.T == pytest.approx(np.eye(3), abs=1e-12)
        back = quaternion_from_matrix(rotation)
        angle = 2.0 * np.arctan2(np.linalg.norm(back[1:]), abs(back[0]))
        assert np.degrees(angle) == pytest.approx(case["angle_deg"], abs=1e-8)


@pytest.mark.parametrize("name", TABLES)
def test_turning_from_one_orientation_to_another(name: str) -> None:
    """The short way at an even rate, through the recorded quaternions up to their sign."""
    table = recorded("slerp")[name]
    start, end = (np.array(table[key]) for key in ("q0", "q1"))
    start, end = start / np.linalg.norm(start), end / np.linalg.norm(end)
    share = np.array(table["t"])
    ours, theirs = slerp(start, end, share), np.array(table["slerp"])
    signs = np.sign(np.sum(ours * theirs, axis=-1))[:, None]
    assert np.abs(ours - signs * theirs).max() < DIGITS
    turned = np.array([quaternion.angle_between(tuple(start), tuple(q)) for q in ours])
    assert np.degrees(turned) == pytest.approx(table["slerp_angle_deg"], abs=1e-8)
    assert np.degrees(turned[-1]) == pytest.approx(table["total_angle_deg"], abs=1e-8)
    fine = slerp(start, end, np.linspace(0.0, 1.0, 201))
    steps = [
        quaternion.angle_between(tuple(before), tuple(after)) for before, after in pairwise(fine)
    ]
    rate = np.degrees(steps) * 200.0
    low, high = table["slerp_rate_deg_per_t"]["min"], table["slerp_rate_deg_per_t"]["max"]
    assert rate.min() == pytest.approx(low, abs=1e-8)
    assert rate.max() == pytest.approx(high, abs=1e-8)


def test_a_straight_mix_of_quaternions_turns_at_an_uneven_rate() -> None:
    """Mixing and normalising keeps the way and loses the rate: 81 to 95 instead of 90 deg.

    It does not leave the way: both go along the same great circle.
    """
    truth = recorded("slerp")
    start, end = (np.array(truth[TABLES[1]][key]) for key in ("q0", "q1"))
    share = np.linspace(0.0, 1.0, 2001)[:, None]
    mixed = (1.0 - share) * start + share * end
    mixed /= np.linalg.norm(mixed, axis=-1, keepdims=True)
    angles = 2.0 * np.arctan2(mixed[:, 3], mixed[:, 0])
    rate = np.degrees(np.diff(angles)) * 2000.0
    closed = truth["nlerp_closed_form_90deg"]
    assert rate.min() == pytest.approx(closed["rate_end_deg"], abs=0.05)
    assert rate.max() == pytest.approx(closed["rate_mid_deg"], abs=0.05)
    assert np.abs(mixed[:, 1:3]).max() == 0.0
    ours = slerp(start, end, share[:, 0])
    even = np.degrees(np.diff(2.0 * np.arctan2(ours[:, 3], ours[:, 0]))) * 2000.0
    assert np.ptp(even) < 1e-6


@pytest.mark.parametrize("axis", HALF_TURNS)
def test_a_half_turn_has_a_quaternion(axis: tuple[float, float, float]) -> None:
    """Formulas that take signs from differences of the matrix give 0, 0, 0, 0 at half turns."""
    matrix = 2.0 * np.outer(axis, axis) - np.eye(3)
    q = quaternion_from_matrix(matrix)
    assert abs(q[0]) < DIGITS
    assert abs(float(q[1:] @ np.array(axis))) == pytest.approx(1.0, abs=DIGITS)
    assert Transform.from_quaternion(q, np.zeros(3)).rotation == pytest.approx(matrix, abs=DIGITS)


def test_rounding_beside_a_half_turn_gives_no_imaginary_root() -> None:
    """The diagonal may add up to less than -1 by rounding; what comes out is still a unit."""
    for off in (1e-16, -1e-16, 3e-16, -1e-12):
        matrix = np.diag([1.0, -1.0, -1.0]) - off * np.eye(3)
        q = quaternion_from_matrix(matrix)
        assert np.isfinite(q).all()
        assert q == pytest.approx([0.0, 1.0, 0.0, 0.0], abs=DIGITS)
