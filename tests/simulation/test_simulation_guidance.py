"""Programs whose robot a sensor guides: what it says and when is up to each test."""

from __future__ import annotations

import numpy as np
import pytest
from simulation_program import Ran
from simulation_sensor import Devices, Script, end_s, joints_at, sensed

from rapidsim.controller.cell.description import (
    CellIo,
    SignalDeclaration,
    SignalKind,
)
from rapidsim.motion.guidance.feedback import Feedback, Guided, ProgramData
from rapidsim.motion.guidance.sensor import SensorAnswer

HEAD = r"""MODULE guided
  VAR egmident id;
  CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC prepare(num timeout)
    VAR egm_minmax near := [-0.01, 0.01];
    MoveAbsJ home, v1000, fine, tool0;
    EGMGetId id;
    EGMSetupUC ROB_1, id, "default", "UCdevice:" \Joint \CommTimeout:=timeout;
    EGMActJoint id,\Tool:=tool0 \J1:=near \J2:=near \J3:=near \J4:=near \J5:=near \J6:=near
      \LpFilter:=100 \MaxSpeedDeviation:=90;
  ENDPROC
"""
RUN = r"EGMRunJoint id, EGM_STOP_HOLD, \J1 \J2 \J3 \J4 \J5 \J6 \CondTime:=0.1 \RampInTime:=0.05"
GOAL = (10.0, -5.0, 4.0, 3.0, 32.0, -7.0)


def guided(body: str, script: Script, head: str = HEAD) -> tuple[Ran, Devices]:
    return sensed(f"{head}  PROC main()\n{body}\n  ENDPROC\nENDMODULE\n", script)


def to(goal: tuple[float, ...]) -> Script:
    return lambda told: SensorAnswer(joints=goal)


def test_a_sensor_brings_the_joints_where_it_wants_them() -> None:
    # The run ends when all joints have been within 0.01 degrees for 0.1 s; the program finds the
    # robot there, and the next move begins there.
    it, devices = guided(
        f"""    VAR jointtarget there;
    prepare 1;
    {RUN};
    TPWrite "state " \\Num:=EGMGetState(id);
    there := CJointT();
    TPWrite ValToStr(Round(there.robax.rax_1 \\Dec:=1));
    MoveAbsJ home, v1000, fine, tool0;
    EGMReset id;""",
        to(GOAL),
    )
    assert it.end == "ended"
    assert devices.opened == ["UCdevice"]
    assert it.texts == ["state 1", "10"]
    heard = devices.sensor.heard
    times = np.array([one.time_s for one in heard])
    assert np.allclose(np.diff(times), 0.004, atol=1e-12)
    assert {one.guided for one in heard[:-1]} == {Guided.RUNNING}
    assert heard[-1].guided is Guided.STOPPED
    # What the sensor is told is where the trajectory has the robot, then and there.
    for one in heard[:: len(heard) // 7]:
        assert np.allclose(joints_at(it, one.time_s), one.joints, atol=1e-9)
    assert np.allclose(heard[-1].joints, GOAL, atol=0.01)
    assert np.allclose(joints_at(it, end_s(it)), (0, 0, 0, 0, 30, 0), atol=1e-6)
    # The arm is never seen where the program had it before.
    begins_s = it.run.robots[0].trajectory.pieces[-1].start_time
    for later_s in (0.001, 0.01):
        assert np.allclose(joints_at(it, begins_s + later_s), GOAL, atol=0.5)


def test_no_axis_is_faster_than_asked_or_jumps() -> None:
    it, _devices = guided(f"    prepare 1;\n    {RUN};", to(GOAL))
    (one,) = it.run.robots
    times = np.arange(0.0, end_s(it), 0.0005)
    joints = np.degrees(one.trajectory.at(times).joints)
    speed = np.diff(joints, axis=0) / 0.0005
    assert np.abs(speed).max() < 90.0 + 1e-6
    assert np.abs(np.diff(speed, axis=0)).max() < 90.0 * 0.05


def test_who_says_nothing_is_an_error_where_the_program_waits() -> None:
    it, _ = guided(
        f"""    prepare 0.5;
    {RUN};
  ERROR
    IF ERRNO = ERR_UDPUC_COMM TPWrite "silent in state " \\Num:=EGMGetState(id);
    TRYNEXT;""",
        lambda told: None,
    )
    assert it.texts == ["silent in state 1"]
    assert end_s(it) == pytest.approx(0.577, abs=0.01)


def test_an_unhandled_silence_names_the_line() -> None:
    it, _ = guided(f"    prepare 0.5;\n    {RUN};", lambda told: None)
    assert it.end == "error"
    assert ("R101", 14) in it.findings


def test_a_silence_that_nobody_waits_for_ends_the_program() -> None:
    it, _ = guided(
        f"""    prepare 0.2;
    {RUN.replace("HOLD,", "HOLD," + chr(92) + "NoWaitCond")};
    WaitTime 5;
  ERROR
    TPWrite "never";
    TRYNEXT;""",
        lambda told: None,
    )
    assert it.end == "error"
    assert it.texts == []


def test_the_program_goes_on_beside_the_guidance() -> None:
    # EGMStop ends it, and with RAMP_DOWN the robot goes back to where it began, in half a second.
    it, _devices = guided(
        f"""    VAR clock watch;
    prepare 1;
    {RUN.replace("HOLD,", "HOLD," + chr(92) + "NoWaitCond").replace("0.1", "1E9")};
    TPWrite "state " \\Num:=EGMGetState(id);
    WaitTime 2;
    TPWrite "axis 1 at " \\Num:=Round(axis1() \\Dec:=1);
    ClkStart watch;
    EGMStop id, EGM_STOP_RAMP_DOWN \\RampOutTime:=0.5;
    ClkStop watch;
    TPWrite "back at " \\Num:=Round(axis1() \\Dec:=3);
    TPWrite "took half a second: " \\Bool:=Abs(ClkRead(watch) - 0.5) < 0.02;""",
        to(GOAL),
        HEAD
        + """  FUNC num axis1()
    VAR jointtarget now;
    now := CJointT();
    RETURN now.robax.rax_1;
  ENDFUNC
""",
    )
    assert it.texts == [
        "state 2",
        "axis 1 at 10",
        "back at 0",
        "took half a second: TRUE",
    ]


def test_axes_that_are_not_chosen_stay() -> None:
    it, _ = guided(
        "    prepare 1;\n    " + RUN.replace(r" \J2 \J3 \J4 \J5 \J6", "") + ";", to(GOAL)
    )
    assert it.end == "ended"
    assert np.allclose(joints_at(it, end_s(it)), (10, 0, 0, 0, 30, 0), atol=0.01)


def test_without_axes_nothing_moves() -> None:
    it, _ = guided(
        "    prepare 1;\n    " + RUN.replace(r" \J1 \J2 \J3 \J4 \J5 \J6", "") + ";", to(GOAL)
    )
    assert it.end == "ended"
    assert np.allclose(joints_at(it, end_s(it)), (0, 0, 0, 0, 30, 0), atol=1e-9)
    # The program goes on at once.
    assert end_s(it) < 0.2


def test_no_axis_gets_further_from_its_start_than_permitted() -> None:
    head = HEAD.replace(r"\MaxSpeedDeviation:=90", r"\MaxPosDeviation:=4 \MaxSpeedDeviation:=90")
    it, _ = guided(
        "    prepare 1;\n    "
        + RUN.replace("0.1", "1E9").replace("HOLD,", r"HOLD,\NoWaitCond")
        + ";\n    WaitTime 3;\n    EGMStop id, EGM_STOP_HOLD;",
        to(GOAL),
        head,
    )
    assert np.allclose(joints_at(it, end_s(it)), (4, -4, 4, 3, 32, -4), atol=0.01)
    assert not [code for code, _line in it.findings if code == "R119"]


def test_speeds_alone_move_the_robot_where_the_gain_is_nought() -> None:
    it, _ = guided(
        "    prepare 1;\n    "
        + RUN.replace("0.1", "1E9").replace("HOLD,", r"HOLD,\NoWaitCond")
        + r""" \PosCorrGain:=0;
    WaitTime 1;
    EGMStop id, EGM_STOP_HOLD;""",
        lambda told: SensorAnswer(joints=GOAL, joint_speed=(6.0, 0, 0, 0, 0, 0)),
    )
    assert joints_at(it, end_s(it))[0] == pytest.approx(6.0, abs=0.35)


def test_limits_of_axes_hold_whatever_the_sensor_wants() -> None:
    it, devices = guided(
        "    prepare 1;\n    "
        + RUN.replace("0.1", "1E9").replace("HOLD,", r"HOLD,\NoWaitCond")
        + ";\n    WaitTime 8;\n    EGMStop id, EGM_STOP_HOLD;",
        to((1e9, 0.0, 0.0, 0.0, 30.0, 0.0)),
    )
    (one,) = it.run.robots
    upper = np.degrees(one.robot.upper[0])
    axis_1 = np.array([told.joints[0] for told in devices.sensor.heard])
    assert axis_1.max() <= upper + 1e-9
    assert axis_1[-1] == pytest.approx(upper, abs=0.01)


def test_moves_are_refused_while_a_sensor_has_the_robot() -> None:
    it, _ = guided(
        "    prepare 1;\n    "
        + RUN.replace("0.1", "1E9").replace("HOLD,", r"HOLD,\NoWaitCond")
        + ";\n    MoveAbsJ home, v1000, fine, tool0;",
        to(GOAL),
    )
    assert it.end == "error"


def test_a_stream_tells_where_the_robot_is_on_its_way() -> None:
    # Every 8 ms, from its start to its end, and what it tells is what the trajectory has.
    it, devices = guided(
        r"""    MoveAbsJ home, v1000, fine, tool0;
    EGMGetId id;
    EGMSetupUC ROB_1, id, "default", "UCdevice";
    EGMStreamStart id \SampleRate:=8;
    MoveAbsJ [[30,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v500, fine, tool0;
    WaitTime 0.1;
    EGMStreamStop id;
    MoveAbsJ home, v1000, fine, tool0;""".replace("\\\\", "\\"),
        lambda told: None,
    )
    told = devices.sensor.streamed
    assert not devices.sensor.heard
    times = np.array([one.time_s for one in told])
    assert np.allclose(np.diff(times), 0.008, atol=1e-9)
    assert times[-1] < end_s(it)
    for one in told[::9]:
        assert np.allclose(joints_at(it, one.time_s), one.joints, atol=1e-6)
    assert max(one.joints[0] for one in told) == pytest.approx(30.0)
    assert {one.guided for one in told} == {Guided.NOT_YET}


def test_a_stream_runs_until_a_guidance_or_egm_stop_ends_it() -> None:
    it, devices = guided(
        f"""    prepare 1;
    EGMStreamStart id;
    WaitTime 0.1;
    TPWrite "streams: " \\Num:=EGMGetState(id);
    EGMStop id, EGM_STOP_HOLD;
    TPWrite "stopped: " \\Num:=EGMGetState(id);
    WaitTime 0.1;
    EGMStreamStart id;
    {RUN};
    TPWrite "guided: " \\Num:=EGMGetState(id);
    WaitTime 0.1;""",
        to(GOAL),
    )
    assert it.texts == ["streams: 2", "stopped: 1", "guided: 1"]
    streamed = [one.time_s for one in devices.sensor.streamed]
    assert len(streamed) < 40


EXCHANGED = HEAD.replace(
    "  PROC prepare",
    "  PERS dnum out{2} := [1,2];\n  PERS dnum got{3} := [0,0,0];\n  PROC prepare",
).replace(
    r"id,\Tool:=tool0",
    r"id,\Tool:=tool0 \DOToSensor:=doReady \DIFromSensor:=diGo \DataToSensor:=out"
    r" \DataFromSensor:=got",
)
BOTH = CellIo(
    signals=(
        SignalDeclaration("doReady", SignalKind.DO),
        SignalDeclaration("diGo", SignalKind.DI),
        SignalDeclaration("doOther", SignalKind.DO, value=1.0),
    )
)


def test_data_and_signals_go_both_ways_with_the_messages() -> None:
    # The array and the output are read with each message; what the sensor sends is there at once.
    def script(told: Feedback) -> SensorAnswer:
        return SensorAnswer(joints=GOAL, values=(5.0, 6.0), digital=told.sent.digital)

    body = f"""    prepare 1;
    {RUN.replace("HOLD,", "HOLD," + chr(92) + "NoWaitCond").replace("0.1", "1E9")};
    WaitTime 0.5;
    TPWrite ValToStr(got) + " " + ValToStr(DOutput(doReady)) + ValToStr(TestDI(diGo));
    SetDO doReady, 1;
    out := [3,4];
    WaitDI diGo, 1 \\MaxTime:=0.1;
    WaitTime 0.1;
    EGMStop id, EGM_STOP_HOLD;"""
    it, devices = sensed(f"{EXCHANGED}  PROC main()\n{body}\n  ENDPROC\nENDMODULE\n", script, BOTH)
    assert (it.end, it.texts) == ("ended", ["[5,6,0] 0FALSE"])
    sent = [one.sent for one in devices.sensor.heard if one.guided is Guided.RUNNING]
    assert sent[0] == ProgramData(False, (1.0, 2.0))
    assert sent[-1] == ProgramData(True, (3.0, 4.0))
    assert not [code for code, _line in it.findings if code == "R119"]


def test_a_run_may_exchange_other_data_than_its_activation() -> None:
    body = f"    prepare 1;\n    {RUN} \\DOToSensor:=doOther;"
    it, devices = sensed(
        f"{EXCHANGED}  PROC main()\n{body}\n  ENDPROC\nENDMODULE\n", to(GOAL), BOTH
    )
    assert it.end == "ended"
    assert devices.sensor.heard[0].sent == ProgramData(True, (1.0, 2.0))


def test_a_stream_exchanges_data_as_well() -> None:
    body = r"""    MoveAbsJ home, v1000, fine, tool0;
    EGMGetId id;
    EGMSetupUC ROB_1, id, "default", "UCdevice" \Joint;
    EGMActJoint id \StreamStart \SampleRate:=8 \DataToSensor:=out \DataFromSensor:=got
      \DIFromSensor:=diGo;
    WaitDI diGo, 1 \MaxTime:=1;
    TPWrite ValToStr(got);
    EGMStreamStop id;"""

    def script(told: Feedback) -> SensorAnswer:
        return SensorAnswer(values=(told.time_s,), digital=told.time_s > 0.3)

    it, devices = sensed(f"{EXCHANGED}  PROC main()\n{body}\n  ENDPROC\nENDMODULE\n", script, BOTH)
    assert it.end == "ended"
    heard = devices.sensor.heard
    assert np.allclose(np.diff([one.time_s for one in heard]), 0.008, atol=1e-9)
    assert it.texts == [f"[{heard[-1].time_s:g},0,0]"]
    assert {one.guided for one in heard} == {Guided.NOT_YET}


POSE = r"""MODULE guided
  VAR egmident id;
  CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS wobjdata table := [FALSE,TRUE,"",[[100,50,0],[0.7071068,0,0,0.7071068]],[[0,0,0],[1,0,0,0]]];
  PERS tooldata pen := [TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  PROC prepare()
    VAR egm_minmax near := [-0.01, 0.01];
    VAR pose here := [[0,0,0],[1,0,0,0]];
    MoveAbsJ home, v1000, fine, pen;
    EGMGetId id;
    EGMSetupUC ROB_1, id, "default", "UCdevice" \Pose;
    EGMActPose id \Tool:=pen \WObj:=table, here, EGM_FRAME_WOBJ, here, EGM_FRAME_WOBJ
      \x:=near \y:=near \z:=near \rx:=near \ry:=near \rz:=near \LpFilter:=100
      \MaxSpeedDeviation:=90;
  ENDPROC
"""
RUN_POSE = r"EGMRunPose id, EGM_STOP_HOLD \x \y \z \rx \ry \rz \CondTime:=0.1 \RampInTime:=0.05"


def beside(x_mm: float, z_mm: float) -> Script:
    """A goal so far beside where the robot began."""
    first: list[Feedback] = []

    def script(told: Feedback) -> SensorAnswer:
        first.append(told)
        x, y, z = first[0].position
        return SensorAnswer(
            position=(x + x_mm, y, z + z_mm), orientation=tuple(first[0].orientation)
        )

    return script


def test_poses_are_meant_in_the_frame_of_the_sensor() -> None:
    it, devices = guided(
        f"""    VAR robtarget before;
    VAR robtarget after;
    prepare;
    before := CRobT(\\Tool:=pen \\WObj:=table);
    {RUN_POSE};
    after := CRobT(\\Tool:=pen \\WObj:=table);
    TPWrite ValToStr(Round(after.trans.x - before.trans.x \\Dec:=1));
    TPWrite ValToStr(Round(after.trans.y - before.trans.y \\Dec:=1));
    TPWrite ValToStr(Round(after.trans.z - before.trans.z \\Dec:=1));""",
        beside(30.0, 20.0),
        POSE,
    )
    assert it.texts == ["30", "0", "20"]
    first, last = devices.sensor.heard[0], devices.sensor.heard[-1]
    assert np.allclose(np.subtract(last.position, first.position), (30, 0, 20), atol=0.02)


def test_of_a_pose_only_what_is_chosen_counts() -> None:
    _it, devices = guided(
        "    prepare;\n    " + RUN_POSE.replace(r" \y \z \rx \ry \rz", "") + ";",
        beside(30.0, 20.0),
        POSE,
    )
    first, last = devices.sensor.heard[0], devices.sensor.heard[-1]
    assert np.allclose(np.subtract(last.position, first.position), (30, 0, 0), atol=0.02)


def test_a_pose_out_of_reach_ends_the_program() -> None:
    it, _ = guided(f"    prepare;\n    {RUN_POSE};", beside(5000.0, 0.0), POSE)
    assert it.end == "error"


RUNS = "prepare 1;\n" + RUN.replace("0.1", "1E9").replace("HOLD,", r"HOLD,\NoWaitCond") + ";\n"
SET_UP = 'EGMGetId id;\nEGMSetupUC ROB_1, id, "default", "x" '
NO_IDENTITY = ": the EGM identity is not there; EGMGetId makes it"


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ("EGMRunJoint id, EGM_STOP_HOLD;", f"EGMRunJoint{NO_IDENTITY}"),
        ("EGMStreamStart id;", f"EGMStreamStart{NO_IDENTITY}"),
        ("EGMGetId id;\nEGMReset id;\nEGMStreamStart id;", f"EGMStreamStart{NO_IDENTITY}"),
        (
            "EGMGetId id;\nEGMRunJoint id, EGM_STOP_HOLD;",
            "no sensor is connected with the EGM identity; EGMSetupUC comes first",
        ),
        (
            f"{SET_UP}\\Joint;\nEGMRunJoint id, EGM_STOP_HOLD;",
            "EGMRunJoint or EGMRunPose: EGMActJoint or EGMActPose comes first",
        ),
        (
            RUNS + 'EGMSetupUC ROB_1, id, "default", "x" \\Joint;',
            "EGMSetupUC: the sensor guides the robot; EGMStop ends that",
        ),
        (RUNS + "EGMActJoint id;", "the sensor guides the robot; EGMStop ends that"),
        (RUNS + f"{RUN};", "a sensor guides the robot already; EGMStop ends that"),
        (
            "prepare 1;\nEGMRunPose id, EGM_STOP_HOLD \\x;",
            "EGMRunJoint follows EGMActJoint, and EGMRunPose EGMActPose (ABB 41826)",
        ),
        (
            f"{SET_UP}\\Pose;\nEGMActJoint id;",
            "EGMSetupUC has not set this EGM identity up with \\Joint (ABB 41826)",
        ),
        (
            f"{SET_UP}\\Joint;\nEGMActMove id, tool0.tframe;",
            "EGMSetupUC has not set this EGM identity up with \\PathCorr (ABB 41826)",
        ),
    ],
)
def test_what_is_missing_before_a_run_or_comes_too_late_is_named(body: str, message: str) -> None:
    it, _ = guided(body, to(GOAL))
    (found,) = [one.violation for one in it.run.diagnostics if one.code == "R101"]
    assert found.message + (f" ({found.cf})" if found.cf else "") == message


def test_a_task_has_four_identities_at_a_time() -> None:
    data = " ".join(f"VAR egmident id{n};" for n in range(1, 6))
    four = " ".join(f"EGMGetId id{n};" for n in range(1, 5))
    it, _ = guided(f"{data}\n{four} EGMReset id2; EGMGetId id2;\nEGMGetId id5;", to(GOAL))
    (found,) = [one for one in it.run.diagnostics if "EGMGetId" in one.violation.message]
    assert "all 4 identities of the task are used" in found.violation.message
    assert found.line == 15


def test_a_pose_is_reached_within_a_millimetre_by_default() -> None:
    # 0.9 mm beside the goal is near enough where \x is not given.
    head = POSE.replace(r"\x:=near \y:=near \z:=near \rx:=near \ry:=near \rz:=near ", "")
    it, devices = guided(
        "    prepare;\n    " + RUN_POSE + r" \PosCorrGain:=0;", beside(0.9, -0.9), head
    )
    assert it.end == "ended"
    first, last = devices.sensor.heard[0], devices.sensor.heard[-1]
    assert np.allclose(first.position, last.position)
