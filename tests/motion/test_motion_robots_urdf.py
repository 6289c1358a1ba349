"""URDF files: those that ship say what the catalogue says; others are recognised or refused."""

import re
from hashlib import sha256
from pathlib import Path

import numpy as np
import pytest

from rapidsim.motion.kinematics.arm import METRES_PER_UNIT
from rapidsim.motion.kinematics.closed_form.palletizer import Palletizer
from rapidsim.motion.kinematics.numerical.solver import Numerical
from rapidsim.motion.robot.catalogue import find_entry, robots_folder
from rapidsim.motion.robot.robot import Robot, RobotError, load_robot, robot_names

MEGABYTE = 1_000_000
SCRIPTS = Path(__file__).parents[2] / "scripts"


SERIAL = (
    "irb120-3-0.58",
    "irb1600-6-1.2",
    "irb6640-180-2.55",
    "kr10-r1100-sixx",
    "kr120-r2500-pro",
)
"""One of each kind whose joints turn one axis each."""


@pytest.fixture(
    params=[*SERIAL, "irb2400-16-1.55", "irb4400l-30-2.43", "irb920t-6-0.45", "irb910sc-3-0.55"],
    scope="module",
)
def robot(request: pytest.FixtureRequest) -> Robot:
    return load_robot(request.param)


@pytest.mark.parametrize("name", robot_names())
def test_the_description_needs_only_the_catalogue(name: str) -> None:
    """Relative mesh paths that exist, no collision shapes, names of ROS-Industrial, under 1 MB."""
    robot = load_robot(name)
    assert robot.urdf is not None
    text = robot.urdf.read_text(encoding="utf-8")
    meshes = re.findall(r'filename="([^"]+)"', text)
    links = ["base_link", *(f"link_{n}" for n in range(1, robot.kinematics.joint_count + 1))]
    assert [Path(mesh).stem for mesh in meshes[: len(links)]] == links
    # Only palletizers show the rods that move them.
    assert bool(meshes[len(links) :]) == isinstance(robot.kinematics, Palletizer)
    assert "collision" not in text
    sizes = [(robot.urdf.parent / mesh).stat().st_size for mesh in meshes]
    assert sum(sizes) + robot.urdf.stat().st_size < MEGABYTE


@pytest.mark.parametrize("name", robot_names())
def test_the_description_is_what_the_generator_writes(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    robot = load_robot(name)
    monkeypatch.syspath_prepend(str(SCRIPTS))
    generator = pytest.importorskip("build_robots", reason="scripts/ is not part of a wheel")
    assert robot.urdf is not None
    written_text = generator.urdf_text(find_entry(robot.name))
    text = robot.urdf.read_text(encoding="utf-8")
    assert re.sub(r'"\.\./[\w.-]+/meshes/', '"meshes/', text) == written_text


def test_no_mesh_is_there_twice() -> None:
    sums = [sha256(mesh.read_bytes()).digest() for mesh in robots_folder().glob("*/meshes/*.glb")]
    assert len(sums) == len(set(sums)) > 500


@pytest.mark.parametrize(
    "name",
    [
        *SERIAL,
        "irb2400-16-1.55",
        "irb4400-60-1.95",
        "rv-m1",
        "irb460",
        "gofa",
        "irb14000",
        "irb910sc",
    ],
)
def test_the_description_moves_like_the_catalogue(name: str) -> None:
    """Our forward kinematics against yourdfpy's, link by link and at tool0; rods included."""
    robot = load_robot(name)
    yourdfpy = pytest.importorskip("yourdfpy")
    description = yourdfpy.URDF.load(str(robot.urdf), load_meshes=False)
    assert description.actuated_joint_names == [joint.name for joint in robot.joints]
    for joints in np.random.default_rng(2).uniform(
        robot.lower, robot.upper, (20, len(robot.joints))
    ):
        slid = METRES_PER_UNIT * joints
        description.update_cfg(np.where(robot.kinematics.slides, slid, joints))
        links = robot.kinematics.link_frames(joints)
        for number in range(len(robot.joints)):
            theirs = description.get_transform(f"link_{number + 1}", "base_link")
            assert np.max(np.abs(theirs - links[number].matrix)) < 1e-12
        flange = description.get_transform("tool0", "base_link")
        assert np.max(np.abs(flange - robot.forward(joints).matrix)) < 1e-12


@pytest.mark.parametrize(
    "name", [*SERIAL, "irb2400-16-1.55", "kr240-r3330", "rv-m1", "irb460", "gofa", "irb14000"]
)
def test_the_shapes_stand_on_the_floor_and_end_in_the_flange(name: str) -> None:
    trimesh = pytest.importorskip("trimesh")
    robot = load_robot(name)
    assert robot.urdf is not None
    count = len(robot.joints)
    files = re.findall(r'filename="([^"]+)"', robot.urdf.read_text(encoding="utf-8"))
    foot = trimesh.load(robot.urdf.parent / files[0]).to_geometry()
    assert foot.bounds[0, 2] == pytest.approx(0.0, abs=1e-6)
    last = trimesh.load(robot.urdf.parent / files[count]).to_geometry()
    zero = np.zeros(count)
    base_from_last = robot.kinematics.link_frames(zero)[-1]
    in_flange = robot.forward(zero).inverse().apply(base_from_last.apply(last.vertices))
    assert 0.0 <= in_flange[:, 2].max() < 0.003
    assert np.abs(in_flange[:, :2]).max() < 0.15


def test_a_urdf_gives_the_same_robot(robot: Robot) -> None:
    assert robot.urdf is not None
    loaded = load_robot(robot.urdf)
    assert loaded.name == robot.name
    assert [j.name for j in loaded.joints] == [j.name for j in robot.joints]
    assert loaded.lower == pytest.approx(robot.lower, abs=1e-12)
    # A description has no speeds that another arm lends.
    speeds = find_entry(robot.name).max_speeds
    for theirs, own, speed in zip(loaded.joints, robot.joints, speeds, strict=True):
        assert theirs.slides is own.slides
        assert theirs.max_speed == (speed and pytest.approx(speed, rel=1e-12))
    joints = np.random.default_rng(4).uniform(robot.lower, robot.upper, (200, len(robot.joints)))
    ours, same = robot.forward(joints), loaded.forward(joints)
    assert np.max(np.abs(ours.matrix - same.matrix)) < 1e-12
    frames, their_frames = (
        robot.kinematics.link_frames(joints),
        loaded.kinematics.link_frames(joints),
    )
    assert np.max(np.abs(frames.matrix - their_frames.matrix)) < 1e-12
    branches, their_branches = robot.inverse(ours), loaded.inverse(ours)
    assert np.array_equal(branches.exists, their_branches.exists)
    assert np.array_equal(robot.kinematics.branch_of(joints), loaded.kinematics.branch_of(joints))
    reached = loaded.forward(their_branches.joints)
    difference = (reached.matrix - ours.matrix[:, None])[their_branches.exists]
    assert np.max(np.abs(difference)) < 1e-9


ODD_ARM = """<robot name="odd">
  <link name="world"/><link name="stand"/>
  <joint name="foot" type="fixed"><parent link="world"/><child link="stand"/>
    <origin xyz="0.3 -0.2 0.5" rpy="0.1 0.2 0.3"/></joint>
  {joints}
  <link name="flange"/>
  <joint name="end" type="fixed"><parent link="l6"/><child link="flange"/>
    <origin xyz="0.02 0.01 0.09" rpy="0.4 -0.3 0.2"/></joint>
</robot>"""
TWO_QUARTERS = "1.5707963267948966"
ODD_JOINTS = (
    # parent, origin xyz, origin rpy, axis: signs and zeros that no maker uses
    ("stand", "0 0 0.2", "0 0 0.7", "0 0 -1"),
    ("l1", "0.12 0.05 0.2", f"{TWO_QUARTERS} 0 0", "0 0 1"),
    ("l2", "0.1 0.4 0.03", "0 0 0.4", "0 0 -1"),
    ("l3", "0.05 0.3 0", f"-{TWO_QUARTERS} 0 0", "0 0 1"),
    ("l4", "0 0 0.1", f"{TWO_QUARTERS} 0.0 0", "0 0 -1"),
    ("l5", "0 0 0", f"-{TWO_QUARTERS} 0 0", "0 0 -1"),
)


def odd_arm(joints: tuple[tuple[str, str, str, str], ...] = ODD_JOINTS) -> str:
    return ODD_ARM.format(
        joints="".join(
            f'<link name="l{number}"/><joint name="j{number}" type="revolute">'
            f'<parent link="{parent}"/><child link="l{number}"/>'
            f'<origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="{axis}"/>'
            '<limit lower="-3" upper="3" velocity="2" effort="1"/></joint>'
            for number, (parent, xyz, rpy, axis) in enumerate(joints, 1)
        )
    )


def written(tmp_path: Path, text: str) -> Path:
    file = tmp_path / "odd.urdf"
    file.write_text(text)
    return file


def test_an_arm_of_any_signs_zeros_and_stand_is_recognised(tmp_path: Path) -> None:
    yourdfpy = pytest.importorskip("yourdfpy")
    file = written(tmp_path, odd_arm())
    robot = load_robot(str(file))
    description = yourdfpy.URDF.load(str(file))
    joints = np.random.default_rng(6).uniform(-3.0, 3.0, (50, 6))
    for row in joints:
        description.update_cfg(row)
        theirs = description.get_transform("flange", "world")
        assert np.max(np.abs(theirs - robot.forward(row).matrix)) < 1e-12
    pose = robot.forward(joints)
    branches = robot.inverse(pose)
    own = robot.kinematics.branch_of(joints)
    difference = branches.joints[np.arange(50), own] - joints
    difference -= 2.0 * np.pi * np.round(difference / (2.0 * np.pi))
    assert np.max(np.abs(difference)) < 1e-8


@pytest.mark.parametrize(
    ("axis", "changed", "reason"),
    [
        (1, ("l1", "0.12 0.05 0.2", "1.572 0 0", "0 0 1"), "axis 2 is not perpendicular to axis 1"),
        (2, ("l2", "0.1 0.4 0.03", "0.1 0 0.4", "0 0 -1"), "axis 3 is not parallel to axis 2"),
        (5, ("l5", "0.08 0 0", f"-{TWO_QUARTERS} 0 0", "0 0 -1"), "do not meet in one point"),
    ],
)
def test_other_arms_are_searched_and_say_why(
    tmp_path: Path, axis: int, changed: tuple[str, str, str, str], reason: str
) -> None:
    joints = (*ODD_JOINTS[:axis], changed, *ODD_JOINTS[axis + 1 :])
    robot = load_robot(written(tmp_path, odd_arm(joints)))
    assert isinstance(robot.kinematics, Numerical)
    assert reason in robot.notices[0]


def test_right_angles_of_few_digits_are_right(tmp_path: Path) -> None:
    """Exporters write 1.571 for 90 deg: the arm is the exact one, which a notice says."""
    rounded = [
        (link, xyz, rpy.replace(TWO_QUARTERS, "1.571"), axis) for link, xyz, rpy, axis in ODD_JOINTS
    ]
    found = load_robot(written(tmp_path, odd_arm(tuple(rounded))))
    assert "angles up to 0.0117 deg off a right angle are taken as right" in found.notices[0]
    exact = load_robot(written(tmp_path, odd_arm()))
    joints = np.random.default_rng(7).uniform(-3.0, 3.0, (20, 6))
    assert not isinstance(found.kinematics, Numerical)
    assert not exact.notices
    np.testing.assert_allclose(
        found.forward(joints).matrix, exact.forward(joints).matrix, atol=1e-12
    )


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        (odd_arm(ODD_JOINTS[:1]).replace('"l6"', '"l1"'), "1 moving joint;"),
        (odd_arm().replace('"revolute"', '"prismatic"', 1), "prismatic joint `j1`"),
        ('<!DOCTYPE r [<!ENTITY a "b">]>' + odd_arm(), "entities"),
        ("this is no XML", "not a readable URDF"),
    ],
)
def test_files_that_are_not_understood_are_refused(tmp_path: Path, text: str, reason: str) -> None:
    with pytest.raises(RobotError, match=reason):
        load_robot(written(tmp_path, text))


def test_tags_out_of_place_are_told_with_their_lines_and_left_out(tmp_path: Path) -> None:
    """As exporters write them: an origin inside a geometry, a colour on a link, notes of others."""
    odd = (
        '<link name="extra">\n'
        '  <visual>\n    <geometry>\n      <origin xyz="0 0 0"/>\n'
        '      <box size="0.1 0.1 0.1"/>\n    </geometry>\n  </visual>\n'
        "  <colour><red/></colour>\n</link>\n<gazebo><anything/></gazebo>\n</robot>"
    )
    text = odd_arm().replace("</robot>", odd)
    file = written(tmp_path, text)
    robot = load_robot(file)
    lines = text.splitlines()
    origin = 1 + next(k for k, line in enumerate(lines) if '<origin xyz="0 0 0"/>' in line)
    colour = 1 + next(k for k, line in enumerate(lines) if "<colour>" in line)
    assert robot.notices[:2] == (
        f"{file}:{origin}: `origin` is not allowed inside `geometry` and is skipped",
        f"{file}:{colour}: `colour` is not allowed inside `link` and is skipped",
    )
    plain = load_robot(written(tmp_path, odd_arm()))
    joints = np.full(6, 0.3)
    assert robot.forward(joints).matrix == pytest.approx(plain.forward(joints).matrix)


def in_millimetres(text: str) -> str:
    """The same arm with all lengths of its joints a thousand times as long."""

    def longer(found: re.Match[str]) -> str:
        return f'xyz="{" ".join(str(1000.0 * float(x)) for x in found[1].split())}"'

    return re.sub(r'(?<=<origin )xyz="([^"]*)"', longer, text)


def test_lengths_in_millimetres_are_told_and_can_be_scaled(tmp_path: Path) -> None:
    plain = load_robot(written(tmp_path, odd_arm()))
    file = written(tmp_path, in_millimetres(odd_arm()))
    joints = np.linspace(-0.5, 0.5, 6)
    huge = load_robot(file)
    assert any("seem to be in mm; `--scale 0.001` converts them" in said for said in huge.notices)
    scaled = load_robot(file, scale=0.001)
    assert not any("--scale" in said for said in scaled.notices)
    assert scaled.forward(joints).matrix == pytest.approx(plain.forward(joints).matrix)
    # Its shapes would have the size that the file says.
    assert scaled.urdf is None
    with pytest.raises(RobotError, match="only lengths of a URDF file are scaled"):
        load_robot("irb120", scale=0.001)


def test_xacro_is_named_as_what_it_is(tmp_path: Path) -> None:
    macro = '<robot name="a" xmlns:xacro="http://ros.org/wiki/xacro">\n<xacro:include/>\n</robot>'
    file = tmp_path / "arm.xacro"
    file.write_text(macro)
    with pytest.raises(RobotError, match=r"arm.xacro:2: this is xacro.*`xacro arm.xacro >"):
        load_robot(str(file))
    with pytest.raises(RobotError, match="this is xacro"):
        load_robot(written(tmp_path, odd_arm().replace('"0.12 0.05 0.2"', '"${reach} 0 0"')))


@pytest.mark.parametrize(
    ("said", "instead"),
    [
        ('mimic joint="joint_2" multiplier="-1"', 'mimic joint="joint_2" multiplier="-0.5"'),
        ('mimic joint="joint_2"', 'mimic joint="joint_1"'),
        ('multiplier="-1"', 'multiplier="-1" offset="0.1"'),
    ],
)
def test_joints_that_mimic_otherwise_than_a_rod_are_refused(
    tmp_path: Path, said: str, instead: str
) -> None:
    urdf = find_entry("irb2400").urdf
    assert urdf is not None
    text = urdf.read_text(encoding="utf-8")
    assert said in text
    with pytest.raises(RobotError, match="`joint_3_rod` mimics `joint_"):
        load_robot(written(tmp_path, text.replace(said, instead)))


@pytest.mark.parametrize(
    ("said", "instead", "reason"),
    [
        ('parent link="stand"', 'parent link="l6"', "form a loop through link"),
        ('parent link="stand"', 'parent link="nowhere"', "link `nowhere`, which does not exist"),
        ('child link="l2"', 'child link="l1"', "have the same child link"),
        ('<parent link="stand"/>', "", "a tag is missing"),
        ('axis xyz="', 'axis xyz="nan ', "not a direction"),
        ('axis xyz="', 'axis xyz="0 0 0" was="', "not a direction"),
        ('origin xyz="', 'origin xyz="1e300 0 0" was="', "is too far away"),
        ('lower="', 'lower="nan" was="', "are not finite"),
        ('velocity="', 'velocity="-1" was="', "the wrong way round"),
        ('link name="l1"', "link", "the attribute `name` is missing"),
        ("<robot", "<a>" * 5000 + "<robot", "nested too deeply"),
    ],
)
def test_joints_that_make_no_arm_are_refused(
    tmp_path: Path, said: str, instead: str, reason: str
) -> None:
    text = odd_arm()
    assert said in text
    with pytest.raises(RobotError, match=reason):
        load_robot(written(tmp_path, text.replace(said, instead, 1)))


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-32", "utf-7"])
def test_a_urdf_that_hides_its_document_type_is_refused(tmp_path: Path, encoding: str) -> None:
    text = f'<?xml version="1.0" encoding="{encoding}"?><!DOCTYPE r [<!ENTITY a "b">]>{odd_arm()}'
    file = tmp_path / "arm.urdf"
    file.write_bytes(text.encode(encoding))
    with pytest.raises(RobotError):
        load_robot(file)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(RobotError, match=r"none\.urdf"):
        load_robot(tmp_path / "none.urdf")
