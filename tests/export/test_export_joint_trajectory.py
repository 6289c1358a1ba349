"""The joint trajectory that other tools drive a robot with."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np

import rapidsim
from rapidsim.export.trace import write_trace
from rapidsim.motion.timing.axis_limits import limits_of

PROGRAM = """MODULE Turn
  PROC main()
    MoveAbsJ [[40,10,-20,30,50,-60],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;
    MoveAbsJ [[-40,0,10,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vmax,fine,tool0;
  ENDPROC
ENDMODULE
"""


def test_its_rates_are_the_derivatives_of_its_positions(tmp_path: Path) -> None:
    program = tmp_path / "Turn.mod"
    program.write_text(PROGRAM)
    run = rapidsim.simulate([program], robot="irb120")
    message = json.loads(write_trace(run, tmp_path / "turn.ros.json", 0.004).read_text())
    assert message["joint_names"] == [joint.name for joint in run.only.robot.joints]
    points = message["points"]
    stamps = [point["time_from_start"] for point in points]
    times = np.array([stamp["sec"] + stamp["nanosec"] * 1e-9 for stamp in stamps])
    assert times[0] == 0.0
    assert np.isclose(times[-1], run.time_s)
    position, speed, acceleration = (
        np.array([point[name] for point in points])
        for name in ("positions", "velocities", "accelerations")
    )
    assert np.allclose(position, run.only.trajectory.at(times).joints, atol=6e-9)
    between = np.diff(position, axis=0) / np.diff(times)[:, None]
    assert np.abs(between - 0.5 * (speed[1:] + speed[:-1])).max() < 0.02
    limits = limits_of(run.only.robot, run.model)
    assert (np.abs(speed).max(axis=0) <= 1.01 * limits.max_speed).all()
    assert np.abs(speed).max() > 0.5
    # The run begins and ends at rest.
    assert np.abs(speed[[0, -1]]).max() < 0.05
    assert np.abs(acceleration).max() > 1.0


def test_it_has_the_joints_of_all_robots(tmp_path: Path) -> None:
    program = tmp_path / "Turn.mod"
    program.write_text(PROGRAM)
    run = rapidsim.simulate([program], robot="irb120")
    both = replace(run, robots=(run.only, replace(run.only, task="T_ROB2")))
    message = json.loads(write_trace(both, tmp_path / "turn.ros.json", 0.5).read_text())
    names = [joint.name for joint in run.only.robot.joints]
    assert message["header"] == {"frame_id": "world"}
    tasks = ("T_ROB1", "T_ROB2")
    assert message["joint_names"] == [f"{task}_{name}" for task in tasks for name in names]
    for point in message["points"]:
        for rates in (point["positions"], point["velocities"], point["accelerations"]):
            assert rates[:6] == rates[6:]
