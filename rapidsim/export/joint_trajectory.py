"""Motion of a run as a ROS joint trajectory: the message `JointTrajectory` as JSON.

Joint names are those in the robot's description, prefixed with the task if several robots move;
external axes are only in the other traces.
Positions are in rad, speeds in rad/s, accelerations in rad/s2 (m for a sliding joint), times in
seconds and nanoseconds from the start, as in `trajectory_msgs/JointTrajectory`.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from rapidsim.export.table import BLOCK, UNIT_DECIMALS, rounded, sample_times
from rapidsim.frames.transform import Array
from rapidsim.output_files import whole_file
from rapidsim.simulation.results.sampling import evaluate, joint_rates
from rapidsim.simulation.results.simulation import RobotRun, Simulation

SUFFIX = ".ros.json"
_NANOSECONDS = 1_000_000_000


def write_joint_trajectory(simulation: Simulation, path: Path, dt: float) -> Path:
    """Write a joint trajectory.

    Args:
        simulation: The run.
        path: The file to write.
        dt: Time [s] between points; one more point is at the exact end.

    Returns:
        The path written.

    Raises:
        InputError: For an invalid `dt`, or a path that cannot be written.
    """
    times = sample_times(simulation, dt)
    robots = simulation.robots
    several = len(robots) > 1
    names = [
        f"{one.task}_{joint.name}" if several else joint.name
        for one in robots
        for joint in one.robot.joints
    ]
    head = {"header": {"frame_id": "world" if several else "base"}, "joint_names": names}
    with (
        whole_file(path) as temporary,
        temporary.open("w", encoding="utf-8", newline="") as file,
    ):
        file.write(json.dumps(head)[:-1] + ', "points": [')
        separator = "\n"
        for begin in range(0, len(times), BLOCK):
            instants = times[begin : begin + BLOCK]
            columns = zip(*(_columns(one, instants) for one in robots), strict=True)
            joints, speed, acceleration = (np.concatenate(all_of, axis=1) for all_of in columns)
            for row, time_s in enumerate(instants.tolist()):
                rates = (joints[row], speed[row], acceleration[row])
                file.write(separator + json.dumps(_point(time_s, *rates)))
                separator = ",\n"
        file.write("\n]}\n")
    return path


def _columns(robot_run: RobotRun, times: Array) -> tuple[Array, Array, Array]:
    """Return joints (k, n) [rad, m], their speeds and accelerations at some instants (k,) [s]."""
    units = np.array([joint.unit for joint in robot_run.robot.joints])
    samples = evaluate(robot_run.trajectory, times)
    speed, acceleration = joint_rates(robot_run.trajectory, samples)
    return (
        rounded(units * samples.joints, UNIT_DECIMALS),
        rounded(units * speed),
        rounded(units * acceleration),
    )


def _point(time_s: float, joints: Array, speed: Array, acceleration: Array) -> dict[str, object]:
    whole, rest = divmod(round(time_s * _NANOSECONDS), _NANOSECONDS)
    return {
        "positions": joints.tolist(),
        "velocities": speed.tolist(),
        "accelerations": acceleration.tolist(),
        "time_from_start": {"sec": whole, "nanosec": rest},
    }
