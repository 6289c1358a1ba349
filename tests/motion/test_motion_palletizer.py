"""Palletizers: the published formulas, the level flange, the round trip, the catalogue's entry."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rapidsim.frames.rotation_vectors import rotation_from_vector
from rapidsim.frames.transform import Transform
from rapidsim.language.data import ExtJoint, JointTarget, RobJoint
from rapidsim.motion.configurations import targets
from rapidsim.motion.kinematics.closed_form.palletizer import Palletizer, PalletizerGeometry
from rapidsim.motion.kinematics.unwrapping import principal
from rapidsim.motion.robot.catalogue import RobotError, kinematics_of, read_entry
from rapidsim.motion.robot.robot import load_robot

G = PalletizerGeometry(
    a1=0.26, c1=0.745, c2=0.945, c3=1.025, wrist_forward=0.225, flange_down=0.2515
)
ARM = Palletizer(G)
LOWER, UPPER = np.radians([-165, -40, -20, -300]), np.radians([165, 85, 120, 300])
JOINTS = st.tuples(*(st.floats(a, b) for a, b in zip(LOWER, UPPER, strict=True))).map(np.array)
TOML = """
name = "irb460"
title = "ABB IRB 460"
maker = "ABB"
structure = "palletizer"
sources = []
checks = []
notes = []
[geometry_mm]
a1 = 260.0
c1 = 745.0
c2 = 945.0
c3 = 1025.0
wrist_forward = 225.0
flange_down = 251.5
[[joint]]
limits_deg = [-165, 165]
[[joint]]
limits_deg = [-40, 85]
[[joint]]
limits_deg = [-20, 120]
[[joint]]
limits_deg = [-300, 300]
"""


@given(JOINTS)
def test_forward_is_the_published_formula(joints: np.ndarray) -> None:
    q1, q2, q3, q4 = joints.tolist()
    pose = ARM.forward(joints)
    r = G.a1 + G.c2 * np.sin(q2) + G.c3 * np.cos(q3) + G.wrist_forward
    z = G.c1 + G.c2 * np.cos(q2) - G.c3 * np.sin(q3) - G.flange_down
    assert pose.translation == pytest.approx([r * np.cos(q1), r * np.sin(q1), z], abs=1e-12)
    assert pose.rotation[:, 2] == pytest.approx([0.0, 0.0, -1.0], abs=1e-12)
    assert pose.rotation[:, 0] == pytest.approx([np.cos(q1 - q4), np.sin(q1 - q4), 0.0], abs=1e-12)


@given(JOINTS)
def test_inverse_contains_the_joints(joints: np.ndarray) -> None:
    pose = ARM.forward(joints)
    branches = ARM.inverse(pose)
    reached = ARM.forward(branches.joints[branches.exists])
    assert np.abs(reached.matrix - pose.matrix).max() < 1e-9
    branch = int(ARM.branch_of(joints))
    assert branches.exists[branch]
    if abs(np.cos(joints[2] - joints[1])) > 1e-6 and ARM.flange_forward(joints) > 1e-6:
        assert np.abs(principal(branches.joints[branch] - joints)).max() < 1e-6


@given(JOINTS)
def test_jacobian_is_the_derivative_of_forward(joints: np.ndarray) -> None:
    step = 1e-6
    jacobian = ARM.jacobian(joints)
    for joint in range(4):
        ahead = ARM.forward(joints + step * np.eye(4)[joint])
        behind = ARM.forward(joints - step * np.eye(4)[joint])
        velocity = (ahead.translation - behind.translation) / (2.0 * step)
        assert velocity == pytest.approx(jacobian[:3, joint], abs=1e-7)


def test_a_tilted_flange_is_refused_with_its_angle() -> None:
    pose = ARM.forward(np.radians([10.0, 20.0, 30.0, 40.0]))
    tilted = rotation_from_vector(np.array([np.radians(5.0), 0.0, 0.0]))
    branches = ARM.inverse(Transform(tilted @ pose.rotation, pose.translation))
    assert not branches.exists.any()
    assert branches.tilt is not None
    assert np.degrees(branches.tilt) == pytest.approx(5.0)


def test_a_line_is_followed_without_jumps() -> None:
    joints = np.linspace([-2.8, -0.5, 0.6, 5.0], [2.8, 1.2, 0.2, -5.0], 500)
    followed = ARM.inverse_on_branch(ARM.forward(joints), 0, joints[0])
    assert followed.exists.all()
    assert np.abs(followed.joints - joints).max() < 1e-9


def test_the_catalogue_reads_one(tmp_path: Path) -> None:
    folder = tmp_path / "irb460"
    folder.mkdir()
    (folder / "robot.toml").write_text(TOML)
    entry = read_entry(folder)
    assert entry.geometry == G
    assert isinstance(kinematics_of(entry), Palletizer)
    (folder / "robot.toml").write_text(TOML.replace('"palletizer"', '"spider"'))
    with pytest.raises(RobotError, match="structure `spider` is not known"):
        read_entry(folder)


@pytest.mark.parametrize(
    ("name", "axes", "external"),
    [
        ("irb460", (10, 20, 30, 0, 0, 40), 9e9),
        ("irb910sc", (10, 20, 30, 40, 0, 0), 9e9),
        ("rv-m1", (10, 20, 30, 40, 50, 0), 9e9),
        ("irb14000", (1, 2, 4, 5, 6, 7), 3),
    ],
)
def test_joints_stand_where_rapid_keeps_them(
    name: str, axes: tuple[float, ...], external: float
) -> None:
    """The fourth joint of palletizers is axis 6, of SCARAs axis 4; the third of seven is eax_a."""
    arm = load_robot(name).kinematics
    outside = ExtJoint(external, *(9e9,) * 5)
    found = np.degrees(targets.joints(JointTarget(RobJoint(*axes), outside), arm))
    count = arm.joint_count
    expected = [1, 2, 3, 4, 5, 6, 7] if count == 7 else [10, 20, 30, 40, 50][:count]
    assert found == pytest.approx(expected)
    assert targets.rob_joint(np.radians(found), arm) == pytest.approx(axes)


def test_singular_is_the_stretched_arm_and_the_flange_on_axis_1() -> None:
    stretched = ARM.singularities(np.radians([10.0, 20.0, 110.0, 0.0]))
    assert [one.name for one in stretched] == ["elbow", "shoulder"]
    assert stretched[0].distance == pytest.approx(0.0, abs=1e-12)
    assert ARM.singularities(np.radians([10.0, 20.0, 80.0, 0.0]))[0].distance == pytest.approx(0.5)
    joints = np.radians([10.0, 20.0, 30.0, 40.0])
    flange = ARM.forward(joints).translation
    aside = ARM.singularities(joints)[1].distance
    assert aside == pytest.approx(np.hypot(flange[0], flange[1]) / G.reach)
