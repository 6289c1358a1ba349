"""What the MOC.cfg of a backup says of arms, their bounds, tracks and positioners."""

from pathlib import Path

import numpy as np
import pytest

from rapidsim.jobs.asked import Asked
from rapidsim.jobs.check_files import check
from rapidsim.jobs.job import job
from rapidsim.jobs.run_files import simulate
from rapidsim.module_files import backup_among
from rapidsim.motion.robot.robot import load_robot
from rapidsim.station.backup.backup import backup_station
from rapidsim.station.backup.robots import catalogue_name
from rapidsim.station.robot import StationRobot
from rapidsim.station.station import Station

MAIN = """MODULE m
  PROC main()
    MoveAbsJ [[100,0,0,0,30,0],[9E9,0,9E9,9E9,9E9,9E9]],v1000,fine,tool0;
    ActUnit TRACK_1;
  ENDPROC
ENDMODULE
"""
ARMS = "\n".join(
    f'      -name "rob1_{n}" -upper_joint_bound {2.0 if n > 1 else 1.0} -lower_joint_bound -1.5\n'
    for n in range(1, 7)
)
MOC = f"""MOC:CFG_1.0:6:0::
#
MECHANICAL_UNIT:

      -name "TRACK_1" -use_single_0 "T1" -activate_at_start_up

      -name "STN_1" -use_single_0 "S1"
#
ROBOT:

      -name "ROB_1" -use_robot_type "THE_ARM"\\
      -use_joint_0 "rob1_1" -use_joint_1 "rob1_2" -use_joint_2 "rob1_3"\\
      -use_joint_3 "rob1_4" -use_joint_4 "rob1_5" -use_joint_5 "rob1_6"\\
      -base_frame_coordinated "TRACK_1"
#
SINGLE:

      -name "T1" -use_single_type "LINE" -use_joint "T1" -base_frame_orient_u0 0.707107\\
      -base_frame_orient_u3 0.707107

      -name "S1" -use_single_type "IRBP" -use_joint "S1"
#
SINGLE_TYPE:

      -name "LINE" -mechanics "TRACK"
#
JOINT:

      -name "T1" -logical_axis 8 -use_arm "T1" -use_transmission "T1"
#
TRANSMISSION:

      -name "T1" -transm_joint -200
#
ACC_DATA:

      -name "T1" -wc_acc 2.5
#
STRESS_DUTY_CYCLE:

      -name "T1" -speed_absolute_max 300
#
ARM:

{ARMS}
      -name "T1" -use_acc_data "T1" -upper_joint_bound 4 -lower_joint_bound -0.1
"""


def backup(folder: Path, arm: str = "ROB1_1200_0.7_7") -> Path:
    for name, text in {
        "RAPID/TASK1/m.mod": MAIN,
        "BACKINFO/backinfo.txt": ">>TASK1: (T_ROB1,,)\n",
        "SYSPAR/MOC.cfg": MOC.replace("THE_ARM", arm),
    }.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return folder


def said(folder: Path) -> Station:
    backup = backup_among([str(folder)])
    assert backup is not None
    return backup_station(backup)


@pytest.mark.parametrize("name", ["ROB1_910SC_0.55_3", "ROB1_IRB910SC_3_0.55"])
def test_reach_and_payload_of_a_type_stand_in_either_order(name: str) -> None:
    assert catalogue_name(name) == "irb910sc-3-0.55"


def test_a_backup_bounds_an_axis_that_slides_in_metres() -> None:
    robot = StationRobot(name="irb910sc", bounds=((-1.0, 1.0), None, (-0.1, -0.02), None))
    arm = robot.fitted(load_robot("irb910sc"))
    assert (arm.lower[0], arm.upper[0]) == (-1.0, 1.0)
    assert np.degrees([arm.lower[2], arm.upper[2]]) == pytest.approx([-100.0, -20.0])


@pytest.mark.parametrize("name", ["ROB_L_14000_05_05", "ROB_R_14000_0.5_0.5"])
def test_the_arms_of_a_yumi_are_known_by_their_names(name: str) -> None:
    assert catalogue_name(name) == "irb14000-0.5-0.5"


def test_a_track_is_read_with_all_that_it_can_do(tmp_path: Path) -> None:
    station = said(backup(tmp_path))
    (track,) = station.external_axes
    assert (track.unit, track.letter, track.carries) == ("TRACK_1", "b", "robot")
    assert track.linear
    assert (track.lower, track.upper) == (-0.1, 4.0)
    assert (track.max_speed, track.max_acceleration) == (1.5, 2.5)
    assert np.allclose(track.direction, (0.0, 1.0, 0.0), atol=1e-6)
    assert station.other_units == ("STN_1",)
    (remark,) = station.remarks
    assert "STN_1" in remark


def test_a_unit_that_does_not_start_active_is_known_by_name(tmp_path: Path) -> None:
    folder = backup(tmp_path)
    moc = (folder / "SYSPAR/MOC.cfg").read_text()
    (folder / "SYSPAR/MOC.cfg").write_text(moc.replace(" -activate_at_start_up", ""))
    station = said(folder)
    assert not station.external_axes
    assert station.units == ("TRACK_1", "STN_1")


def test_the_bounds_of_the_controller_hold(tmp_path: Path) -> None:
    folder = backup(tmp_path)
    found = check([folder]).diagnostics
    assert [one.violation.code for one in found if one.severity == "error"] == ["K602"]
    run = simulate([folder])
    assert run.end == "error"
    assert said(folder).robots[0].bounds == ((-1.5, 1.0), *[(-1.5, 2.0)] * 5)


def test_bounds_hold_for_the_arm_that_they_are_given_for(tmp_path: Path) -> None:
    folder = backup(tmp_path)
    name = said(folder).robots[0].name
    assert name is not None
    same, other = (job(Asked(paths=(str(folder),), robot=one)) for one in (name, "irb4600-40-2.55"))
    assert [joint.lower for joint in same.arm().joints] == [-1.5] * 6
    assert other.arm().joints == load_robot("irb4600-40-2.55").joints
    told = f"shapes and joint limits given for {name} are not used for irb4600-40-2.55"
    assert told not in same.station.remarks
    assert told in other.station.remarks


def test_an_arm_that_is_not_known_is_not_judged(tmp_path: Path) -> None:
    folder = backup(tmp_path, "ROB1_9999_9.99_999")
    result = check([folder])
    assert not [one for one in result.diagnostics if one.violation.code[0] == "K"]
    (unchecked,) = result.coverage.unchecked
    assert unchecked.reason.startswith("arm unknown: the catalogue has no ROB1_9999_9.99_999")
    named = check([folder], robot="irb1200")
    assert named.coverage.checked == 1


def test_a_group_of_units_says_which_robot_a_task_moves(tmp_path: Path) -> None:
    folder = backup(tmp_path)
    moc = (folder / "SYSPAR/MOC.cfg").read_text()
    second = '\n      -name "ROB_2" -use_robot_type "ROB1_120_0.58_3"\n#\nSINGLE:'
    (folder / "SYSPAR/MOC.cfg").write_text(moc.replace("#\nSINGLE:", second, 1))
    (folder / "SYSPAR/SYS.cfg").write_text(
        'MECHANICAL_UNIT_GROUP:\n      -Name "right" -Robot "ROB_2"\n#\nCAB_TASKS:\n'
        '      -Name "T_ROB1" -Type "NORMAL" -UseMechanicalUnitGroup "right" -MotionTask\n'
    )
    (task,) = said(folder).tasks
    assert task.robot_number == 1


@pytest.mark.parametrize("own", [True, False])
def test_a_unit_of_another_group_is_not_the_first_robots(own: bool, tmp_path: Path) -> None:
    folder = backup(tmp_path)
    with_robot, apart = (' -MechanicalUnit_1 "TRACK_1"', "") if own else ("", ' "TRACK_1"')
    other = f'      -Name "axes" -MechanicalUnit_1{apart}\n' if apart else ""
    (folder / "SYSPAR/SYS.cfg").write_text(
        f'MECHANICAL_UNIT_GROUP:\n      -Name "arm" -Robot "ROB_1"{with_robot}\n{other}'
    )
    station = said(folder)
    assert [axis.unit for axis in station.external_axes] == (["TRACK_1"] if own else [])
    assert set(station.units) == {"TRACK_1", "STN_1"}


TWO = """MECHANICAL_UNIT_GROUP:

      -Name "left" -Robot "ROB_1"

      -Name "right" -Robot "ROB_2" -MechanicalUnit_1 "TRACK_1"
#
CAB_TASKS:

      -Name "T_ROB1" -Type "NORMAL" -UseMechanicalUnitGroup "left" -MotionTask

      -Name "T_ROB2" -Type "NORMAL" -UseMechanicalUnitGroup "right" -MotionTask
"""
SECOND = """MODULE second
  VAR jointtarget here;
  PROC main()
    MoveAbsJ [[0,0,0,0,30,0],[9E9,{},9E9,9E9,9E9,9E9]],v1000,fine,tool0;
    here:=CJointT();
    TPWrite ""\\Num:=here.extax.eax_b;
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize(("place", "said_of_it"), [(500, []), (5000, ["K602"])])
def test_a_second_robot_has_the_track_of_its_group(
    place: int, said_of_it: list[str], tmp_path: Path
) -> None:
    folder = backup(tmp_path)
    moc = (folder / "SYSPAR/MOC.cfg").read_text()
    second = '\n      -name "ROB_2" -use_robot_type "ROB1_120_0.58_3"\n#\nSINGLE:'
    for name, text in {
        "SYSPAR/MOC.cfg": moc.replace("#\nSINGLE:", second, 1),
        "SYSPAR/SYS.cfg": TWO,
        "BACKINFO/backinfo.txt": ">>TASK1: (T_ROB1,,)\n\n>>TASK2: (T_ROB2,,)\n",
        "RAPID/TASK1/m.mod": "MODULE m\nPROC main()\nENDPROC\nENDMODULE\n",
        "RAPID/TASK2/second.mod": SECOND.format(place),
    }.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    station = said(folder)
    assert not station.external_axes
    assert [axis.unit for axis in station.robots[1].external] == ["TRACK_1"]
    found = check([folder]).diagnostics
    assert [one.violation.code for one in found if one.severity == "error"] == said_of_it
    if not said_of_it:
        texts = [one.message for one in simulate([folder]).events if one.kind.value == "text"]
        assert texts == ["500"]


def test_an_arm_on_a_unit_that_is_not_known_is_not_judged(tmp_path: Path) -> None:
    folder = backup(tmp_path)
    moc = (folder / "SYSPAR/MOC.cfg").read_text()
    moc = moc.replace('coordinated "TRACK_1"', 'coordinated "GANTRY"')
    (folder / "SYSPAR/MOC.cfg").write_text(moc.replace(" -activate_at_start_up", ""))
    (folder / "RAPID/TASK1/m.mod").write_text(
        "MODULE m\nPROC main()\nMoveJ [[19000,0,600],[0,0,1,0],[0,0,0,0],"
        "[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;\nENDPROC\nENDMODULE\n"
    )
    result = check([folder])
    assert not [one for one in result.diagnostics if one.violation.code[0] == "K"]
    assert (
        result.coverage.unchecked[0].reason
        == "ROB_1 is mounted on GANTRY, whose axes are not known"
    )
    assert any("ROB_1 is mounted on GANTRY" in remark for remark in said(folder).remarks)


def test_a_task_that_moves_a_unit_alone_is_said_and_its_moves_are_not_checked(
    tmp_path: Path,
) -> None:
    folder = backup(tmp_path)
    for name, text in {
        "SYSPAR/SYS.cfg": TWO.replace(' -Robot "ROB_2"', ""),
        "BACKINFO/backinfo.txt": ">>TASK1: (T_ROB1,,)\n\n>>TASK2: (T_ROB2,,)\n",
        "RAPID/TASK1/m.mod": MAIN.replace("100", "10").replace("9E9,0,", "9E9,9E9,"),
        "RAPID/TASK2/second.mod": SECOND.format("9E9"),
    }.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    assert any(remark.startswith("T_ROB2 moves none") for remark in said(folder).remarks)
    result = check([folder])
    reasons = [one.reason for one in result.coverage.unchecked]
    assert reasons[-1] == "T_ROB2 moves none of the robots: there are 1"
    assert simulate([folder]).end == "ended"


YUMI = """MOC:CFG_1.0:6:0::
#
ROBOT:

      -name "ROB_L" -use_robot_type "ROB_L_14000_05_05_TYPEA"\\
      -use_joint_0 "rob_L_1" -use_joint_1 "rob_L_2" -use_joint_2 "rob_L_3"\\
      -use_joint_3 "rob_L_4" -use_joint_4 "rob_L_5" -use_joint_5 "rob_L_6"{frame}
"""


def test_the_place_of_an_arm_on_its_body_is_not_guessed(tmp_path: Path) -> None:
    folder = backup(tmp_path)
    main = next(folder.rglob("*.mod"))
    # In front of the foot, not of the body: whether the arm gets there, nobody can say.
    main.write_text(
        "MODULE m\n  PROC main()\n"
        "    MoveJ [[2000,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n"
        "  ENDPROC\nENDMODULE\n"
    )
    (folder / "SYSPAR/MOC.cfg").write_text(YUMI.format(frame=""))
    assert any("where on its body ROB_L is" in remark for remark in said(folder).remarks)
    assert not [one for one in check([folder]).diagnostics if one.severity == "error"]
    run = simulate([folder])
    assert run.end == "error"
    assert {str(one.severity) for one in run.diagnostics if one.code == "K601"} == {"warning"}
    (folder / "SYSPAR/MOC.cfg").write_text(YUMI.format(frame=" -base_frame_pos_z 0.4"))
    assert [one.code for one in check([folder]).diagnostics if one.severity == "error"] == ["K601"]
