"""SCARAs: published numbers, the stroke that has no turns, the unit of the axis that slides."""

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from laws import examples

from rapidsim.files import SourceFile
from rapidsim.frames.rotation_vectors import rotation_from_vector
from rapidsim.frames.transform import Array, Transform
from rapidsim.jobs.checking.checked_program import load
from rapidsim.motion.configurations.branch_choice import least_motion
from rapidsim.motion.configurations.confdata import (
    confdata_of,
    configurations,
    distinct,
    named,
    select,
)
from rapidsim.motion.configurations.pose_solutions import solve_pose
from rapidsim.motion.configurations.reach_suggestions import reachable
from rapidsim.motion.configurations.reachability import (
    limit_excess,
    turns_within_limits,
    unreachable_reason,
)
from rapidsim.motion.configurations.singularities import differential, joint_speeds, rapid_speeds
from rapidsim.motion.kinematics.arm import METRES_PER_UNIT
from rapidsim.motion.robot.catalogue import RobotError, find_entry, read_entry
from rapidsim.motion.robot.robot import Robot, load_robot
from rapidsim.motion.waypoints.branch_paths import branch_paths
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.simulate import simulate

ARM = load_robot("irb910sc")
G = ARM.kinematics.geometry  # type: ignore[attr-defined]
JOINTS = st.tuples(*(st.floats(a, b) for a, b in zip(ARM.lower, ARM.upper, strict=True))).map(
    np.array
)
MM = float(np.radians(1.0))
DOWN = np.diag([1.0, -1.0, -1.0])


@cache
def long_arm() -> Robot:
    """The same arm with a stroke of 800 mm: longer than what a whole turn would be."""
    joints = list(ARM.joints)
    joints[2] = joints[2].within(-0.8, 0.0)
    return replace(ARM, joints=tuple(joints))


def down_at(x: float, y: float, z: float, yaw: float = 0.0) -> Transform:
    """The flange at a place [m], pointing down."""
    turn = rotation_from_vector(np.array([0.0, 0.0, yaw]))
    return Transform(turn @ DOWN, np.array([x, y, z]))


def test_the_published_result_of_a_controller() -> None:
    """CalcJointT on an IRB 920T-6/0.55: x 300, y -210 mm, the tool straight down."""
    arm = load_robot("irb920t").kinematics
    branches = arm.inverse(down_at(0.3, -0.21, 0.175))
    assert branches.exists.all()
    assert np.degrees(branches.joints[0]) == pytest.approx([-79.8, 96.7, -65.5, 16.9], abs=0.05)
    assert confdata_of(arm, branches.joints).tolist() == [[-1, 0, 0, 0], [0, -1, 0, 1]]


STORED = (
    # x, y, q2, q3 and confdata
    (645.361628388, -74.377374159, -0.439613657, 0.89818697, (-1, 1, 0, 1)),
    (273.164682924, 565.04175531, -0.34517174, 0.938539541, (0, 2, 0, 0)),
    (282.890575697, -475.913992853, 0.509754155, 0.860320115, (-1, 2, 0, 0)),
    (35.242533768, 552.520741896, -0.67125191, 0.741229299, (0, 2, 0, 0)),
    (50.960408769, -437.765098633, 0.517953512, 0.855408768, (-2, 2, 0, 0)),
    (-128.840894088, 593.296446909, 0.892793921, -0.450465332, (0, -2, 0, 0)),
    (-176.287904502, -470.577490734, -0.534224663, 0.84534254, (-2, -4, 0, 0)),
)
"""Targets in a public backup of a controller of an IRB 910SC-3/0.65 (RobotWare 6.08), stored by it;
at heights of 41.892741812 and 161.892741812 mm, q1 and q4 are 0."""


@pytest.mark.parametrize("height_mm", [41.892741812, 161.892741812])
@pytest.mark.parametrize(("x", "y", "q2", "q3", "conf"), STORED)
def test_targets_of_a_controller_are_reached_in_their_configuration(
    x: float, y: float, q2: float, q3: float, conf: tuple[int, int, int, int], height_mm: float
) -> None:
    arm = load_robot("irb910sc-3-0.65")
    pose = Transform.from_quaternion((0.0, q2, q3, 0.0), 1e-3 * np.array([x, y, height_mm]))
    (found,) = [one for one in configurations(arm, pose) if one.confdata == conf]
    assert np.degrees(found.joints[2]) == pytest.approx(height_mm - 220.0)
    reached = arm.forward(found.joints)
    assert np.abs(reached.matrix - pose.matrix).max() < 1e-9


@given(JOINTS)
def test_forward_is_the_published_formula(joints: Array) -> None:
    q1, q2, q3, q4 = joints.tolist()
    pose = ARM.forward(joints)
    x = G.a1 * np.cos(q1) + G.a2 * np.cos(q1 + q2)
    y = G.a1 * np.sin(q1) + G.a2 * np.sin(q1 + q2)
    assert pose.translation == pytest.approx([x, y, G.flange_up + 1e-3 * np.degrees(q3)])
    yaw = rotation_from_vector(np.array([0.0, 0.0, q1 + q2 - q4]))
    assert pose.rotation == pytest.approx(yaw @ DOWN)
    assert ARM.kinematics.link_frames(joints)[-1].translation == pytest.approx(pose.translation)


@given(JOINTS)
def test_jacobian_is_the_derivative_of_forward(joints: Array) -> None:
    step = 1e-6
    jacobian = ARM.kinematics.jacobian(joints)
    for joint in range(4):
        ahead, behind = (ARM.forward(joints + sign * step * np.eye(4)[joint]) for sign in (1, -1))
        velocity = (ahead.translation - behind.translation) / (2.0 * step)
        assert velocity == pytest.approx(jacobian[:3, joint], abs=1e-8)
        assert jacobian[3:, joint] == pytest.approx([0.0, 0.0, (1.0, 1.0, 0.0, -1.0)[joint]])


@examples(200)
@given(JOINTS, st.floats(-3.0, 3.0), st.integers(-3, 3))
def test_nothing_outside_the_stroke_is_reached(joints: Array, beyond: float, turns: int) -> None:
    """Whatever way above or below it, 360 mm and its multiples too: a way is no angle."""
    up = beyond + 0.36 * turns
    joints = np.where([False, False, True, False], joints[2] + up / METRES_PER_UNIT, joints)
    off = limit_excess(ARM, joints)[2]
    pose, conf = ARM.forward(joints), confdata_of(ARM.kinematics, joints)
    near = turns_within_limits(ARM, np.zeros(4))
    selected = select(ARM, pose[None], conf[None], near)
    assert selected.joints[0, 2] == pytest.approx(joints[2])
    assert turns_within_limits(ARM, joints)[2] == pytest.approx(joints[2])
    if off == 0.0:
        assert unreachable_reason(ARM, pose) is None
        assert configurations(ARM, pose)
        return
    why = unreachable_reason(ARM, pose)
    assert why is not None
    assert why.joint == 3
    assert " mm at its " in why.message
    assert not reachable(ARM, pose[None]).any()
    assert configurations(ARM, pose) == ()
    assert named(ARM, pose, tuple(conf.tolist())) is None
    assert not any(one.within_limits for one in solve_pose(ARM, pose, everything=True).solutions)
    assert least_motion(ARM, pose[None]) == 0
    assert limit_excess(ARM, selected.joints).any()


@given(JOINTS)
def test_vectors_360_mm_apart_are_two(joints: Array) -> None:
    lower = joints - [0.0, 0.0, 360.0 * MM, 0.0]
    assert len(distinct(np.array([joints, lower]), ARM.kinematics.turns)) == 2
    around = joints - [2.0 * np.pi, 0.0, 0.0, 0.0]
    assert len(distinct(np.array([joints, around]), ARM.kinematics.turns)) == 1


def test_ways_of_a_configuration_are_followed_over_more_than_half_a_turn() -> None:
    """Two poses 600 mm apart in height, and 13 that are close to one another."""
    arm = long_arm()
    for count in (2, 13):
        heights = G.flange_up - np.linspace(0.0, 0.6, count)
        row = Transform.stacked([down_at(0.3, 0.2, z) for z in heights])
        followed = arm.kinematics.inverse_on_branch(row, 0, arm.start)
        assert np.degrees(followed.joints[:, 2]) == pytest.approx(-np.linspace(0.0, 600.0, count))
        chosen = least_motion(arm, row)
        assert not isinstance(chosen, int)
        assert np.degrees(chosen.joints[:, 2]) == pytest.approx(-np.linspace(0.0, 600.0, count))
        assert branch_paths(arm, np.arange(float(count)), row)[0].message is None


PROGRAM = """MODULE m
  CONST robtarget top:=[[300,200,210],[0,1,0,0],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS num at{5};
  PROC main()
    VAR jointtarget now;
    MoveAbsJ [[0,90,0,90,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;
    MoveJ top,v1000,fine,tool0;
    Noted 1;
    MoveL Offs(top,0,0,-300),v1000,fine,tool0;
    Noted 2;
    MoveL Offs(top,50,0,-600),v1000,z50,tool0;
    MoveJ Offs(top,0,0,0),v1000,fine,tool0;
    Noted 3;
    MoveAbsJ [[0,90,-790,90,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;
    Noted 4;
    now:=CalcJointT(top,tool0);
    at{5}:=now.robax.rax_3;
  ENDPROC
  PROC Noted(num n)
    VAR jointtarget now;
    now:=CJointT();
    at{n}:=now.robax.rax_3;
  ENDPROC
ENDMODULE
"""


@cache
def the_run() -> Simulation:
    loaded = load([SourceFile("m.mod", PROGRAM, "utf-8")])
    assert loaded.program is not None, [d.violation.message for d in loaded.diagnostics]
    return simulate(loaded.program, long_arm(), options=RunOptions())


def test_lines_and_joint_moves_of_300_mm_and_more_go_straight_down() -> None:
    run = the_run()
    assert run.end.value == "ended"
    (robot,) = run.robots
    assert not robot.failed_moves
    times = np.linspace(0.0, robot.trajectory.duration, 400)
    samples = robot.trajectory.at(times)
    height = samples.base_from_tcp.translation[:, 2]
    assert height == pytest.approx(G.flange_up + 1e-3 * np.degrees(samples.joints[:, 2]), abs=1e-9)
    stretch = times.max() / (len(times) - 1)
    step = np.abs(np.diff(samples.joints[:, 2])) / stretch
    assert step.max() <= long_arm().joints[2].max_speed * 1.001  # type: ignore[operator]
    (found,) = [one.new for one in run.persistents if one.name == "at"]
    assert [float(number) for number in found.strip("[]").split(",")] == pytest.approx(
        [-10.0, -310.0, -10.0, -790.0, -10.0], abs=1e-3
    )


def test_the_axis_that_slides_keeps_its_own_speed() -> None:
    """1.02 m/s at most, and that within rounding where MoveAbsJ asks for more."""
    (robot,) = the_run().robots
    times = np.arange(0.0, robot.trajectory.duration, 1e-3)
    joints = robot.trajectory.at(times).joints
    fastest = np.degrees(np.abs(np.diff(joints[:, 2]))).max() / 1e-3
    assert 0.5 * 1020.0 < fastest <= 1020.0 * 1.001


@given(JOINTS, st.floats(-100.0, 100.0))
def test_joint_speeds_are_told_in_the_unit_of_each_joint(joints: Array, up_mm_s: float) -> None:
    assume(abs(np.sin(joints[1])) > 0.1)
    found = differential(ARM.kinematics, joints)
    assert found.jacobian[:, 2] == pytest.approx([0.0, 0.0, 1.0, 0.0, 0.0, 0.0])
    twist = np.array([0.0, 0.0, 1e-3 * up_mm_s, 0.0, 0.0, 0.5])
    speeds, missed = joint_speeds(found.jacobian, twist)
    told = rapid_speeds(ARM.kinematics, speeds)
    assert told == pytest.approx([0.0, 0.0, up_mm_s, -np.degrees(0.5)], abs=1e-6)
    assert missed == pytest.approx(np.zeros(6), abs=1e-9)


@pytest.mark.parametrize(
    ("up_mm", "said"),
    [
        (80.0, "joint 3 over by 80.0 mm at its upper limit"),
        (-540.0, "joint 3 over by 360.0 mm at its lower limit"),
        (0.04, None),  # a target on top of the stroke, written with one digit
        (-180.04, None),
    ],
)
def test_how_far_outside_the_stroke_is_told_in_mm(up_mm: float, said: str | None) -> None:
    why = unreachable_reason(ARM, down_at(0.35, 0.15, G.flange_up + 1e-3 * up_mm))
    assert (why.message if why else None) == said


def test_a_tilted_flange_is_refused_with_its_angle() -> None:
    pose = ARM.forward(np.radians([10.0, 40.0, -50.0, 30.0]))
    tilted = rotation_from_vector(np.array([np.radians(5.0), 0.0, 0.0]))
    why = unreachable_reason(ARM, Transform(tilted @ pose.rotation, pose.translation))
    assert why is not None
    assert why.message == "orientation 5 deg from what the axes of this arm can give"


@pytest.mark.parametrize(
    ("x", "said"),
    [
        (0.6, "it is 600 mm from axis 1, and both arms stretched reach 550 mm"),
        (0.02, "it is 20 mm from axis 1, and the arms folded come no nearer than 50 mm"),
        (0.5, None),
    ],
)
def test_the_length_that_limits_is_told(x: float, said: str | None) -> None:
    assert ARM.kinematics.limiting_length(down_at(x, 0.0, 0.1)) == said


def test_on_axis_1_equal_arms_keep_what_stands_before() -> None:
    arm = type(ARM.kinematics)(replace(G, a1=0.25))  # type: ignore[call-arg]
    near = np.array([0.7, 3.0, -0.3, 0.2])
    followed = arm.inverse_on_branch(down_at(0.0, 0.0, 0.1)[None], 0, near)
    assert followed.joints[0, 0] == pytest.approx(0.7)
    assert arm.forward(followed.joints[0]).translation == pytest.approx([0.0, 0.0, 0.1])


def test_the_singularity_is_the_stretched_arm() -> None:
    (straight,) = ARM.kinematics.singularities(np.radians([20.0, 0.5, -10.0, 0.0]))
    assert straight.near
    assert straight.reason == "both arms are in line"
    (bent,) = ARM.kinematics.singularities(ARM.start)
    assert bent.distance == pytest.approx(1.0)


def test_an_entry_says_which_joint_slides(tmp_path: Path) -> None:
    text = (find_entry("irb910sc").folder / "robot.toml").read_text(encoding="utf-8")
    folder = tmp_path / "irb910sc-3-0.55"
    folder.mkdir()
    file = folder / "robot.toml"
    file.write_text(text, encoding="utf-8")
    entry = read_entry(folder)
    assert np.degrees(entry.limits[2]) == pytest.approx([-180.0, 0.0])
    assert np.degrees(entry.max_speeds[2] or 0.0) == pytest.approx(1020.0)
    for wrong in (text.replace("limits_mm", "limits_deg"), text.replace("limits_deg", "limits_mm")):
        file.write_text(wrong, encoding="utf-8")
        with pytest.raises(RobotError, match="only joint 3, which slides, must have `limits_mm`"):
            read_entry(folder)


@pytest.mark.parametrize(
    ("said", "instead", "reason"),
    [
        ('xyz="0.3 0 0.0661"', 'xyz="0.3 0.1 0.0661"', "not stretched along x"),
        ('xyz="0 0 0.1916"', 'xyz="0.1 0 0.1916"', "from axis 1 in the base's origin"),
        ('<axis xyz="0 0 1"/>', '<axis xyz="0 0 -1"/>', "axes 1 to 3 do not all point up"),
        ('rpy="3.14159265358979', 'rpy="0.14159265358979', "its flange does not point down"),
        ('"revolute"', '"prismatic"', "only joint 3 of an arm with four joints may slide"),
    ],
)
def test_a_urdf_that_slides_otherwise_is_refused_with_the_reason(
    tmp_path: Path, said: str, instead: str, reason: str
) -> None:
    assert ARM.urdf is not None
    text = ARM.urdf.read_text(encoding="utf-8")
    assert said in text
    file = tmp_path / "arm.urdf"
    file.write_text(text.replace(said, instead, 1), encoding="utf-8")
    with pytest.raises(RobotError, match=f"prismatic joint `joint_.` .* SCARA: .*{reason}"):
        load_robot(file)


def test_a_urdf_in_millimetres_is_scaled_with_its_stroke(tmp_path: Path) -> None:
    assert ARM.urdf is not None
    text = ARM.urdf.read_text(encoding="utf-8")
    for metres, millimetres in (
        ('"0 0 0.1916"', '"0 0 191.6"'),
        ('"0.3 0 0.0661"', '"300 0 66.1"'),
        ('"0.25 0 -0.0377"', '"250 0 -37.7"'),
        ('lower="-0.18" upper="0.0" velocity="1.02"', 'lower="-180" upper="0" velocity="1020"'),
    ):
        assert metres in text
        text = text.replace(metres, millimetres)
    file = tmp_path / "arm.urdf"
    file.write_text(text, encoding="utf-8")
    scaled = load_robot(file, scale=0.001)
    assert scaled.lower == pytest.approx(ARM.lower)
    assert [joint.max_speed for joint in scaled.joints] == pytest.approx(
        [joint.max_speed for joint in ARM.joints]
    )
