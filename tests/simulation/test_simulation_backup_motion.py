"""What the MOC.cfg of a backup says of arms, their bounds, tracks and positioners."""

import json
from pathlib import Path

import numpy as np
import pytest
from command_line import call

from rapidsim.jobs.checking.check_files import check
from rapidsim.jobs.inputs.job import job
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.jobs.running.run_files import simulate
from rapidsim.module_files import backup_among
from rapidsim.motion.robot.robot import load_robot
from rapidsim.station.backup.backup import backup_station
from rapidsim.station.backup.robots import arm_type, catalogue_name
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


def test_the_letter_of_an_arm_on_the_floor_is_no_part_of_its_model() -> None:
    assert catalogue_name("ROB1_1300F_1.4_7") == "irb1300-7-1.4"
    assert catalogue_name("ROB1_1300G_1.4_7") is None


def test_arms_with_their_cables_inside_have_types_of_their_own() -> None:
    assert catalogue_name("ROB1_5720_90_3.00_LID") == "irb5720-90-3.0-lid"
    assert catalogue_name("ROB1_5720_90_3.00") is None
    assert arm_type("irb5720-90-3.0-lid") == "ROB1_5720_3.0_90_LID"


def test_a_backup_bounds_an_axis_that_slides_in_metres() -> None:
    robot = StationRobot(name="irb910sc", bounds=((-1.0, 1.0), None, (-0.1, -0.02), None))
    arm = robot.fitted(load_robot("irb910sc"))
    assert (arm.lower[0], arm.upper[0]) == (-1.0, 1.0)
    assert np.degrees([arm.lower[2], arm.upper[2]]) == pytest.approx([-100.0, -20.0])


@pytest.mark.parametrize(
    ("name", "arm"),
    [
        ("ROB_L_14000_05_05", "irb14000-0.5-0.5-left"),
        ("ROB_R_14000_0.5_0.5", "irb14000-0.5-0.5-right"),
        ("ROB_R_14000_05_05_TYPEA", "irb14000-0.5-0.5-right"),
    ],
)
def test_the_arms_of_a_yumi_are_known_by_their_names(name: str, arm: str) -> None:
    assert catalogue_name(name) == arm


HOME_OF_YUMI = """MODULE m
  PROC main()
    MoveAbsJ [[0,-130,30,0,40,0],[{eax_a},9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;
    TPWrite "at " \\Pos:=CPos(\\Tool:=tool0 \\WObj:=wobj0);
  ENDPROC
ENDMODULE
"""
MOC_OF_YUMI = """MOC:CFG_1.0:6:0::
#
ROBOT:

      -name "ROB_R" -use_robot_type "ROB_R_14000_05_05" -gravity_alpha 0.629233

      -name "ROB_L" -use_robot_type "ROB_L_14000_05_05" -gravity_alpha -0.629233
"""
SYS_OF_YUMI = """SYS:CFG_1.0:6:0::
#
CAB_TASKS:

      -Name "T_ROB_R" -Type "NORMAL" -UseMechanicalUnitGroup "rob_R" -MotionTask

      -Name "T_ROB_L" -Type "NORMAL" -UseMechanicalUnitGroup "rob_L" -MotionTask
#
MECHANICAL_UNIT_GROUP:

      -Name "rob_R" -Robot "ROB_R"

      -Name "rob_L" -Robot "ROB_L"
"""


def test_the_arms_of_a_yumi_stand_on_its_body(tmp_path: Path) -> None:
    """MOC.cfg of a YuMi has no base frames: both arms share that of the body."""
    for name, text in {
        "RAPID/TASK1/m.mod": HOME_OF_YUMI.format(eax_a=-135),
        "RAPID/TASK2/m.mod": HOME_OF_YUMI.format(eax_a=135),
        "BACKINFO/backinfo.txt": ">>TASK1: (T_ROB_R,,)\n>>TASK2: (T_ROB_L,,)\n",
        "SYSPAR/MOC.cfg": MOC_OF_YUMI,
        "SYSPAR/SYS.cfg": SYS_OF_YUMI,
    }.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    assert not [one for one in check([tmp_path]).diagnostics if one.severity == "error"]
    run = simulate([tmp_path])
    said = {one.task: one.message for one in run.events if one.kind.value == "text"}
    # Where a controller has tool0 in the home position [mm].
    for task, side in (("T_ROB_R", -1.0), ("T_ROB_L", 1.0)):
        place = [float(word) for word in said[task].strip("at []").split(",")]
        assert place == pytest.approx([-9.5784, side * 182.6099, 198.6278], abs=2e-3)


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
    same, other = (
        job(RunRequest(paths=(str(folder),), robot=one)) for one in (name, "irb4600-40-2.55")
    )
    assert [joint.lower for joint in same.arm().joints] == [-1.5] * 6
    assert other.arm().joints == load_robot("irb4600-40-2.55").joints
    told = f"shapes and joint limits given for {name} are not used for irb4600-40-2.55"
    assert told not in same.station.remarks
    assert told in other.station.remarks


def test_moves_of_an_arm_that_is_not_known_are_judged_as_a_guess(tmp_path: Path) -> None:
    """MOC.cfg bounds axis 1 of the guess, too."""
    folder = backup(tmp_path, "ROB1_9999_9.99_999")
    result = check([folder])
    found = [one for one in result.diagnostics if one.violation.code[0] == "K"]
    assert [(one.violation.code, one.severity.value) for one in found] == [("K602", "warning")]
    assert result.arm is not None
    assert "the catalogue has no ROB1_9999_9.99_999" in result.arm.text
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


SEVERAL = """MODULE m
  PROC main()
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;
    MoveJ [[{x},0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;
  ENDPROC
ENDMODULE
"""
SENDER = 'MODULE s\n  PROC main()\n    TPWrite "sends";\n  ENDPROC\nENDMODULE\n'
MOC_OF_SEVERAL = """MOC:CFG_1.0:6:0::
#
ROBOT:

      -name "ROB_1" -use_robot_type "ROB1_120_0.58_3"

      -name "ROB_2" -use_robot_type "ROB2_6700_2.60_200"
"""
SYS_OF_SEVERAL = """SYS:CFG_1.0:6:0::
#
CAB_TASKS:

      -Name "T_SEND" -Type "NORMAL" -UseMechanicalUnitGroup "rob1"

      -Name "T_ROB2" -Type "NORMAL" -UseMechanicalUnitGroup "rob2" -MotionTask

      -Name "T_ROB1" -Type "NORMAL" -UseMechanicalUnitGroup "rob1" -MotionTask
#
MECHANICAL_UNIT_GROUP:

      -Name "rob1" -Robot "ROB_1"

      -Name "rob2" -Robot "ROB_2"
"""


@pytest.mark.parametrize("configured", [True, False])
def test_tasks_without_backinfo_move_each_its_own_robot(tmp_path: Path, configured: bool) -> None:
    """TASK1 and TASK2 are of the two robots, whatever the order in SYS.cfg."""
    files = {
        "RAPID/TASK1/m.mod": SEVERAL.format(x=300),
        "RAPID/TASK2/m.mod": SEVERAL.format(x=2000),
        "SYSPAR/MOC.cfg": MOC_OF_SEVERAL,
    }
    if configured:
        files |= {"RAPID/TASK3/s.mod": SENDER, "SYSPAR/SYS.cfg": SYS_OF_SEVERAL}
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    station = said(tmp_path)
    moved = {task.name: task.robot_number for task in station.tasks}
    assert moved == {"T_ROB1": 0, "T_ROB2": 1} | ({"T_SEND": None} if configured else {})
    # 2 m are beyond the reach of the first arm.
    assert not [one for one in check([tmp_path]).diagnostics if one.severity == "error"]
    run = simulate([tmp_path])
    assert [one.robot.name for one in run.robots] == ["irb120-3-0.58", "irb6700-200-2.6"]
    assert not [one for one in run.diagnostics if one.severity == "error"]


def joints(count: int) -> str:
    return " ".join(f'-use_joint_{n} "rob1_{n + 1}"' for n in range(count))


def lacking(folder: Path, type_name: str, count: int, second: str = "") -> Path:
    """A backup with an arm that the catalogue lacks, and a target that nothing reaches."""
    more = f'\n      -name "ROB_2" -use_robot_type "{second}" {joints(count)}\n' if second else ""
    for name, text in {
        "RAPID/TASK1/m.mod": SEVERAL.format(x=9000),
        **({"RAPID/TASK2/m.mod": SEVERAL.format(x=9000)} if second else {}),
        "SYSPAR/MOC.cfg": "MOC:CFG_1.0:6:0::\n#\nROBOT:\n\n"
        f'      -name "ROB_1" -use_robot_type "{type_name}" {joints(count)}\n{more}',
    }.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return folder


@pytest.mark.parametrize(
    ("type_name", "second"), [("ROB1_360_1.6_6", ""), ("ROB1_910SC_0.55_3", "ROB2_360_1.6_6")]
)
def test_a_delta_is_not_run_as_another_arm(tmp_path: Path, type_name: str, second: str) -> None:
    cell = lacking(tmp_path, type_name, 4, second)
    checked = call("check", ".", "--no-cache", cwd=cell)
    assert "arm unknown: the catalogue has no ROB" in " ".join(checked.out.split())
    ran = call("run", ".", "--no-record", cwd=cell)
    assert (ran.code, ran.out) == (2, "")
    assert "the catalogue has no ROB" in ran.err
    assert "_360_1.6_6, the arm of the backup with 4 axes" in ran.err
    assert "--robot NAME" in ran.err
    named = call("run", ".", "--no-record", "--robot", "irb1600", cwd=cell)
    assert "the catalogue has no" not in named.err
    assert "on ABB IRB 1600-6/1.2" in " ".join(named.out.split())


def test_an_unknown_arm_of_six_axes_is_a_guess_at_both_doors(tmp_path: Path) -> None:
    cell = lacking(tmp_path, "ROB1_6700_LeanID_2.65_220", 6)
    checked = call("check", ".", "--no-cache", "--format", "json", cwd=cell)
    ran = call("run", ".", "--no-record", "--format", "json", cwd=cell)
    for done in (checked, ran):
        found = {one["code"]: one["severity"] for one in json.loads(done.out)["diagnostics"]}
        assert found["K601"] == "warning"
    text = " ".join(call("check", ".", "--no-cache", cwd=cell).out.split())
    assert "(by default; the catalogue has no ROB1_6700_LeanID_2.65_220; --robot names" in text or (
        "(the catalogue has no ROB1_6700_LeanID_2.65_220; best of the catalogue:" in text
    )


def test_an_unknown_second_arm_is_said_to_be_a_guess(tmp_path: Path) -> None:
    cell = lacking(tmp_path, "ROB1_120_0.58_3", 6, "ROB2_6700_LeanID_2.65_220")
    checked = call("check", ".", "--no-cache", "--format", "json", cwd=cell)
    found = [one for one in json.loads(checked.out)["diagnostics"] if one["code"] == "K601"]
    assert [(one["file"][-11:], one["severity"]) for one in found] == [
        ("TASK1/m.mod", "error"),
        ("TASK2/m.mod", "warning"),
    ]
    said = "the catalogue has no ROB2_6700_LeanID_2.65_220: the arm of the first robot replaces"
    assert said in " ".join(call("check", ".", "--no-cache", cwd=cell).err.split())


def test_lines_of_seven_axes_are_no_error_of_the_program(tmp_path: Path) -> None:
    line = HOME_OF_YUMI.format(eax_a=-135).replace(
        '    TPWrite "at " \\Pos:=CPos(\\Tool:=tool0 \\WObj:=wobj0);\n',
        "    MoveL Offs(CRobT(\\Tool:=tool0\\WObj:=wobj0),0,0,20),v100,fine,tool0;\n",
    )
    assert "MoveL" in line
    (tmp_path / "m.mod").write_text(line)
    options = ("m.mod", "--robot", "yumi-right", "--format", "json")
    checked = json.loads(call("check", *options, cwd=tmp_path).out)
    ran = json.loads(call("run", *options, cwd=tmp_path).out)
    for report in (checked, ran):
        found = [(one["code"], one["severity"]) for one in report["diagnostics"]]
        assert ("K604", "warning") in found
        assert "error" not in {severity for _, severity in found}
    assert ran["end"] == "error"
