"""Calibration finds the motion model that made a log, and says what a log does not show."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from rapidsim.applications.calibrate import fit
from rapidsim.applications.calibrate.fit import Calibration, LoggedRun, calibrate
from rapidsim.applications.calibrate.joint_log import JointLog, read_joint_log
from rapidsim.applications.calibrate.log_comparison import MotionByPlace
from rapidsim.files import InputError, SourceFile
from rapidsim.frames.transform import Transform
from rapidsim.jobs.checking.checked_program import load
from rapidsim.motion.geometry.segments import Waypoint
from rapidsim.motion.model import MODELS, MotionModel
from rapidsim.motion.robot.robot import load_robot
from rapidsim.motion.trajectory.trajectory import Trajectory
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.simulate import simulate

ROBOT = load_robot("irb1600-6-1.2")
START_DEG = (0.0, 0.0, 0.0, 0.0, 30.0, 0.0)
TRUTH = MotionModel(
    torque=(0.8, 0.75, 0.8), wrist=0.8, filter_time=0.056, fine_dwell=0.14, zone_share=0.8
)

SHORT_STOPS = """
    FOR i FROM 1 TO 2 DO
      MoveL Offs(home, 0, 30*i, 0), v200, fine, tool0;
    ENDFOR"""
SWINGS = """
    MoveAbsJ [[40,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], vmax, fine, tool0;
    MoveAbsJ [[25,-20,20,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], vmax, fine, tool0;
    MoveAbsJ [[-25,20,-20,60,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]], vmax, fine, tool0;"""
FAST_CORNERS = """
    FOR i FROM 1 TO 1 DO
      MoveL Offs(home, 0, 60*i, 60), vmax, z5, tool0;
      MoveL Offs(home, 0, 60*i+30, 0), vmax, z5, tool0;
    ENDFOR
    MoveL home, v300, fine, tool0;"""


def _program(moves: str) -> str:
    return f"""MODULE moves
  VAR robtarget home;
  PROC main()
    home:=CRobT(\\Tool:=tool0 \\WObj:=wobj0);{moves}
  ENDPROC
ENDMODULE
"""


def _logged(moves: str, every_s: float = 0.008) -> LoggedRun:
    loaded = load([SourceFile("moves.mod", _program(moves), "utf-8")])
    assert loaded.program is not None, loaded.diagnostics
    run = simulate(
        loaded.program,
        ROBOT,
        options=RunOptions(model=TRUTH, start_joints_deg=START_DEG, nearest_configuration=True),
    )
    # A log starts some time before the arm does, at a zero of its own.
    times = np.arange(-0.1, run.only.trajectory.duration + 0.2, every_s)
    joints = run.only.trajectory.at(np.maximum(times, 0.0)).joints
    return LoggedRun(loaded.program, JointLog("moves.csv", times + 12.3, joints))


@pytest.fixture(scope="module")
def stops() -> LoggedRun:
    return _logged(SHORT_STOPS)


@pytest.fixture(scope="module")
def alone(stops: LoggedRun) -> Calibration:
    """What one log says of an arm of which no torques are known."""
    return calibrate([stops], ROBOT, MODELS["1"])


@pytest.fixture(scope="module")
def swings() -> LoggedRun:
    return _logged(SWINGS)


@pytest.fixture(scope="module")
def corners() -> LoggedRun:
    return _logged(FAST_CORNERS)


def test_the_model_that_made_the_logs_is_found(stops: LoggedRun, swings: LoggedRun) -> None:
    found = calibrate([stops, swings], ROBOT, MotionModel())
    truth = dict(zip((f"torque of axis {k}" for k in (1, 2, 3)), TRUTH.torque, strict=True))
    seen = {one.name: one for one in found.parameters if one.seen}
    assert seen.keys() == {"torque of axis 1", "torque of axis 2", "filter_time", "fine_dwell"}
    for name, one in seen.items():
        wanted = truth[name] if name in truth else getattr(TRUTH, name)
        assert one.value == pytest.approx(wanted, abs=one.uncertainty), name
    assert all(log.rms_after_s < 3e-3 < log.rms_before_s for log in found.logs)
    # What the other log alone says of this one.
    assert all(log.rms_left_out_s is not None for log in found.logs)


def test_rows_in_which_the_arm_stands_at_a_stop_do_not_count(swings: LoggedRun) -> None:
    """The way turns there, so that the nearest place of a straight piece is not the stop."""
    rows = fit._rows(swings, ROBOT, TRUTH, 7)
    assert np.abs(fit._misses(rows, ROBOT, TRUTH)).max() < 1e-6


def test_a_way_out_and_back_is_taken_in_its_order() -> None:
    """Every place but the farthest is passed twice; at the end the arm stands as at the start."""
    there = "MoveAbsJ [[0,20,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v300, fine, tool0;"
    back = there.replace("[[0,20,", "[[0,0,")
    out_and_back = _logged(f"\n    {there}\n    {back}")
    rows = fit._rows(out_and_back, ROBOT, TRUTH, 7)
    assert np.abs(fit._misses(rows, ROBOT, TRUTH)).max() < 1e-6


def test_without_torques_one_time_stands_for_all_accelerations(alone: Calibration) -> None:
    names = [one.name for one in alone.parameters]
    assert names == ["acceleration_time", "filter_time", "fine_dwell"]
    assert alone.logs[0].rms_left_out_s is None


def test_where_no_model_meets_a_log_it_shows_little(stops: LoggedRun, alone: Calibration) -> None:
    """A clock that runs unevenly by 20 ms, say: the best fit is not a good one."""
    times = stops.log.times + 0.02 * np.sin(20.0 * stops.log.times)
    uneven = LoggedRun(stops.program, JointLog("moves.csv", times, stops.log.joints))
    told = calibrate([uneven], ROBOT, MODELS["1"])
    _, smoothing, dwell = alone.parameters
    _, uneven_smoothing, uneven_dwell = told.parameters
    assert smoothing.seen
    assert not uneven_smoothing.seen
    assert uneven_dwell.uncertainty > 2.0 * dwell.uncertainty


def test_where_a_way_turns_back_rounding_does_not_choose_the_side() -> None:
    """Each row on the way out is as near to the way back; one taken there takes all after it."""
    out = np.linspace(0.0, 0.7, 401)
    joints = np.concatenate([out, out[-2::-1]])[:, None] * np.array([1.0, 0.0, -0.3])
    trajectory = Trajectory(Waypoint(joints[0], Transform.identity()))
    way = MotionByPlace(trajectory, 0.0, np.arange(801.0), joints)
    rows = np.sort(np.random.default_rng(1).uniform(0.69, 0.7, 300))[:, None] * [1.0, 0.0, -0.3]
    places, distances = way.nearest(rows)
    assert (places <= 400.0).all()
    assert distances.max() < 1e-6


def test_accelerations_that_the_station_gives_stay(stops: LoggedRun) -> None:
    given = MotionModel(acceleration=(10.0,) * 6)
    found = calibrate([stops], ROBOT, given)
    assert found.model.acceleration == given.acceleration
    assert [one.name for one in found.parameters] == ["filter_time", "fine_dwell", "zone_share"]


def test_corners_alone_do_not_show_the_dwell(corners: LoggedRun) -> None:
    found = calibrate([corners], ROBOT, MODELS["1"])
    (dwell,) = (one for one in found.parameters if one.name == "fine_dwell")
    assert not dwell.seen
    assert dwell.value == pytest.approx(dwell.start, abs=0.01)


def test_a_log_of_another_path_is_refused(stops: LoggedRun) -> None:
    joints = stops.log.joints.copy()
    joints[len(joints) // 2 :, 0] += math.radians(20.0)
    with pytest.raises(InputError, match=r"20\.\d degrees off the path"):
        calibrate(
            [LoggedRun(stops.program, JointLog("x.csv", stops.log.times, joints))],
            ROBOT,
            MotionModel(),
        )


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        ([], "is empty"),
        (["time,j1,j2,j3,j4,j5", "0,0,0,0,0,0"], "no column is called j6"),
        ([f"{k},1,2,3,4,5,6" for k in range(3)], "has 3 rows"),
        (["0,1,2,3,4,5,6", "1,1,2,nan,4,5,6"], ":2: `nan` is not a finite number"),
        (["0,1,2,3,4,5,6", "1,1,2,3"], ":2: 4 columns, at least 7 are needed"),
        (["0,1,2,3,4,5,6", "0,1,2,3,4,5,7"] * 6, ":2: the time does not ascend"),
    ],
)
def test_a_log_that_cannot_be_read_says_where(
    tmp_path: Path, lines: Sequence[str], message: str
) -> None:
    file = tmp_path / "log.csv"
    file.write_text("\n".join(lines))
    with pytest.raises(InputError) as error:
        read_joint_log(file, 6)
    assert message in error.value.message


def test_columns_are_found_by_their_names(tmp_path: Path) -> None:
    file = tmp_path / "log.csv"
    rows = "\n".join(f"x;{k * 4};{k};0;0;0;0;90" for k in range(12))
    file.write_text(f"note;time_ms;j1;j2;j3;j4;j5;j6\n{rows}\n")
    log = read_joint_log(file, 6)
    assert log.times[1] == pytest.approx(0.004)
    assert log.joints[2] == pytest.approx(np.radians([2, 0, 0, 0, 0, 90]))


def test_what_a_motion_program_client_writes_is_read(tmp_path: Path) -> None:
    """Its header; a robot beside the first has columns of its own."""
    file = tmp_path / "log.csv"
    rows = "\n".join(f"{k * 0.004},{k},{k},0,0,0,0,90,{k}" for k in range(12))
    file.write_text(f"timestamp, cmd_num, J1, J2, J3, J4, J5, J6, J1_2\n{rows}\n")
    log = read_joint_log(file, 6)
    assert log.times[1] == pytest.approx(0.004)
    assert log.joints[2] == pytest.approx(np.radians([2, 0, 0, 0, 0, 90]))


def test_what_an_egm_client_writes_is_read(tmp_path: Path) -> None:
    """Milliseconds, radians, and rows that come again."""
    file = tmp_path / "log.csv"
    rows = "\n".join(f"{k},{k // 2 * 4},{k // 2},0,0,0,0,1.5" for k in range(24))
    names = ",".join(f"joint_{axis}_rad" for axis in range(1, 7))
    file.write_text(f"seqno,tm,{names}\n{rows}\n")
    log = read_joint_log(file, 6)
    assert len(log.times) == 12
    assert log.times[1] == pytest.approx(0.004)
    assert log.joints[2] == pytest.approx([2, 0, 0, 0, 0, 1.5])


def test_rows_of_a_wait_where_a_line_turns_back_do_not_count() -> None:
    """Both ways are as near there but for the chords between positions."""
    down = "MoveL Offs(home, 0, 0, -31.4), v200, fine, tool0;"
    up = "MoveL Offs(home, 0, 0, 0), v1000, z10, tool0;"
    beside = "MoveL Offs(home, 0, 70.3, 0), v1000, fine, tool0;"
    picked = _logged(f"\n    {down}\n    WaitTime 0.3;\n    {up}\n    {beside}")
    rows = fit._rows(picked, ROBOT, TRUTH, 7)
    assert np.abs(fit._misses(rows, ROBOT, TRUTH)).max() < 1e-4
