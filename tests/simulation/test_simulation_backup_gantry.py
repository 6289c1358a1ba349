"""A robot that hangs from a gantry, which MOC.cfg describes joint by joint."""

from pathlib import Path

import numpy as np
import pytest

from rapidsim.jobs.checking.check_files import check
from rapidsim.jobs.running.run_files import simulate
from rapidsim.module_files import backup_among
from rapidsim.station.backup.backup import backup_station
from rapidsim.station.station import Station

MOC = """MOC:CFG_1.0:6:0::
#
MECHANICAL_UNIT:

      -name "BRIDGE" -use_robot "BRIDGE" -activate_at_start_up
#
ROBOT:

      -name "ROB_1" -use_robot_type "ROB1_1600_1.45_10" -base_frame_coordinated "BRIDGE"\\
      -base_frame_pos_z 0.1 -gravity_beta 3.14159

      -name "BRIDGE" -use_robot_type "BRIDGE_X_Y_Z" -use_joint_0 "B1" -use_joint_1 "B2"\\
      -use_joint_2 "B3" -use_joint_3 "B4" -base_frame_pos_x 1
#
ROBOT_TYPE:

      -name "BRIDGE_X_Y_Z" -type "GEN_KIN" -base_pose_rot_u0 0.707107\\
      -base_pose_rot_u2 0.707107
#
JOINT:

      -name "B1" -logical_axis 7 -use_arm "B1" -use_transmission "B1"

      -name "B2" -logical_axis 8 -use_arm "B2" -use_transmission "B2"

      -name "B3" -logical_axis 9 -use_arm "B3" -use_transmission "B3"

      -name "B4" -logical_axis 10 -use_arm "B4" -lock_joint_in_ipol
#
ARM:

      -name "B1" -use_arm_type "B1" -use_acc_data "B" -upper_joint_bound 9 -lower_joint_bound 0

      -name "B2" -use_arm_type "B2" -use_acc_data "B" -upper_joint_bound 0 -lower_joint_bound -4

      -name "B3" -use_arm_type "B3" -use_acc_data "B" -upper_joint_bound -1 -lower_joint_bound -3
#
ARM_TYPE:

      -name "B1"

      -name "B2" -attitude 1.5708 -theta_home_position 1.5708

      -name "B3" -attitude 1.5708 -offset_z 0.5
#
ACC_DATA:

      -name "B" -wc_acc 1
#
TRANSMISSION:

      -name "B1" -transm_joint 100

      -name "B2" -transm_joint 200

      -name "B3" -transm_joint -200
#
STRESS_DUTY_CYCLE:

      -name "B1" -speed_absolute_max 200

      -name "B2" -speed_absolute_max 200

      -name "B3" -speed_absolute_max 200
"""
TURNED = "[0.7071068,0,0.7071068,0]"
MAIN = """MODULE m
  PROC main()
    MoveAbsJ [[0,0,0,0,30,0],[3000,-1000,-2000,9E9,9E9,9E9]],v1000,fine,tool0;
    TPWrite "at " \\Pos:=CPos(\\Tool:=tool0 \\WObj:=wobj0);
    MoveAbsJ [[0,0,0,0,30,0],[3100,-1200,-2300,9E9,9E9,9E9]],v1000,fine,tool0;
    TPWrite "at " \\Pos:=CPos(\\Tool:=tool0 \\WObj:=wobj0);
  ENDPROC
  PROC service()
    ! The first two are in reach, the third is not, the fourth is past a limit of axis 2.
    MoveJ [[4900,1000,900],DOWN,CONF,[3000,-1000,-2200,NONE]],v1000,z10,tool0;
    MoveL [[4900,2000,900],DOWN,CONF,[3000,-2000,-2200,NONE]],v1000,fine,tool0;
    MoveJ [[4900,2000,900],DOWN,CONF,[3000,-200,-2200,NONE]],v1000,fine,tool0;
    MoveJ [[4900,5000,900],DOWN,CONF,[3000,-5000,-2200,NONE]],v1000,fine,tool0;
  ENDPROC
ENDMODULE
"""
for short, value in {"DOWN": TURNED, "CONF": "[0,0,0,0]", "NONE": "9E9,9E9,9E9"}.items():
    MAIN = MAIN.replace(short, value)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name, text in {
        "RAPID/TASK1/m.mod": MAIN,
        "BACKINFO/backinfo.txt": ">>TASK1: (T_ROB1,,)\n",
        "SYSPAR/MOC.cfg": MOC,
    }.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    return tmp_path


def station_of(folder: Path) -> Station:
    backup = backup_among([str(folder)])
    assert backup is not None
    return backup_station(backup)


def test_axes_and_base_follow_from_the_joints(folder: Path) -> None:
    station = station_of(folder)
    assert not station.remarks
    (robot,) = station.robots
    assert (robot.name, robot.carried_by) == ("irb1600-10-1.45", None)
    axes = station.external_axes
    assert [(axis.unit, axis.letter, axis.carries) for axis in axes] == [
        ("BRIDGE", letter, "robot") for letter in "abc"
    ]
    directions = [axis.direction for axis in axes]
    np.testing.assert_allclose(directions, [[1, 0, 0], [0, -1, 0], [0, 0, -1]], atol=1e-5)
    assert [(axis.lower, axis.upper) for axis in axes] == [(0, 9), (-4, 0), (-3, -1)]
    assert [axis.max_speed for axis in axes] == [2, 1, 1]
    assert [axis.start for axis in axes] == [0, 0, -1]
    # The robot hangs: its z axis points down, 0.6 m below the zero of axis 3.
    np.testing.assert_allclose(robot.world_from_base.rotation, np.diag([1, -1, -1]), atol=1e-5)
    np.testing.assert_allclose(robot.world_from_base.translation, [1, 0, -0.6], atol=1e-5)


def test_the_axes_move_the_robot(folder: Path) -> None:
    texts = [one.message for one in simulate([folder]).events if one.kind.value == "text"]
    first, second = (
        np.array([float(word) for word in text.strip("at []").split(",")]) for text in texts
    )
    np.testing.assert_allclose(second - first, [100, 200, 300], atol=2e-2)
    np.testing.assert_allclose(first[1], 1000, atol=2e-2)


def test_targets_are_checked_with_the_values_of_their_axes(folder: Path) -> None:
    result = check([folder])
    found = [
        (one.violation.code, one.span.line)
        for one in result.diagnostics
        if one.severity == "error" and one.span is not None
    ]
    assert found == [("K601", 12), ("K602", 13)]
    assert (result.coverage.by_value, result.coverage.by_run) == (4, 2)


def test_targets_of_a_unit_that_may_not_be_active_are_not_checked(folder: Path) -> None:
    program = folder / "RAPID/TASK1/m.mod"
    program.write_text(MAIN.replace("PROC service()", "PROC service()\n    DeactUnit BRIDGE;"))
    result = check([folder])
    assert not [one for one in result.diagnostics if one.severity == "error"]
    assert [one.span.line for one in result.coverage.unchecked] == [11, 12, 13, 14]
    assert "a mechanical unit is not active" in result.coverage.unchecked[0].reason


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('"B2" -transm_joint 200', '"B2" -transm_joint 200 -rotating_move'),
        ('"B2" -attitude', '"B2" -offset_y 0.1 -attitude'),
        (" -activate_at_start_up", ""),
    ],
)
def test_other_chains_are_known_by_name(old: str, new: str, folder: Path) -> None:
    assert old in MOC
    (folder / "SYSPAR/MOC.cfg").write_text(MOC.replace(old, new))
    station = station_of(folder)
    assert not station.external_axes
    assert [robot.carried_by for robot in station.robots] == ["BRIDGE"]
    assert any("ROB_1 is mounted on BRIDGE" in remark for remark in station.remarks)
