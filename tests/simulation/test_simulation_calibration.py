"""Calibration finds the motion model that made a log, and says what a log does not show."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from rapidsim.files import InputError, SourceFile
from rapidsim.jobs.checked_program import load
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.robot import load_robot
from rapidsim.simulation.calibration.fit import LoggedRun, calibrate
from rapidsim.simulation.calibration.joint_log import JointLog, read_joint_log
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.simulate import simulate

ROBOT = load_robot("irb1600-6-1.2")
START_DEG = (0.0, 0.0, 0.0, 0.0, 30.0, 0.0)
TRUTH = MotionModel(acceleration_time=0.22, filter_time=0.056, fine_dwell=0.14)

SHORT_STOPS = """
    FOR i FROM 1 TO 2 DO
      MoveL Offs(home, 0, 30*i, 0), v200, fine, tool0;
    ENDFOR"""
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
def corners() -> LoggedRun:
    return _logged(FAST_CORNERS)


def test_the_model_that_made_the_logs_is_found(stops: LoggedRun, corners: LoggedRun) -> None:
    found = calibrate([stops, corners], ROBOT, MotionModel())
    for parameter in found.parameters:
        assert parameter.seen
        truth = getattr(TRUTH, parameter.name)
        assert parameter.value_s == pytest.approx(truth, rel=0.08), parameter.name
    assert all(log.rms_after_s < 3e-3 < log.rms_before_s for log in found.logs)


def test_corners_alone_do_not_show_the_dwell(corners: LoggedRun) -> None:
    found = calibrate([corners], ROBOT, MotionModel())
    dwell = found.parameters[2]
    assert not dwell.seen
    assert dwell.value_s == pytest.approx(MotionModel().fine_dwell, abs=0.01)


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
        (["0,1,2,3,4,5,6"] * 3, "has 3 rows"),
        (["0,1,2,3,4,5,6", "1,1,2,nan,4,5,6"], ":2: `nan` is not a finite number"),
        (["0,1,2,3,4,5,6", "1,1,2,3"], ":2: 4 columns, at least 7 are needed"),
        (["0,1,2,3,4,5,6"] * 12, ":2: the time does not ascend"),
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
