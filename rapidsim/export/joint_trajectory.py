"""The motion of a run as a ROS joint trajectory: the message `JointTrajectory` as JSON.

Names are those of the joints in the robot's description; external axes are in the other traces.
Positions are rad, speeds rad/s, accelerations rad/s2, times seconds and nanoseconds from the start,
as `trajectory_msgs/JointTrajectory` has them.
"""

from __future__ import annotations

import json
from pathlib import Path

from rapidsim.export.table import BLOCK, sample_times
from rapidsim.frames.transform import Array
from rapidsim.output_files import whole_file
from rapidsim.simulation.results.sampling import evaluate, joint_rates
from rapidsim.simulation.results.simulation import Simulation

SUFFIX = ".ros.json"
_NANOSECONDS = 1_000_000_000


def write_joint_trajectory(simulation: Simulation, path: Path, dt: float) -> Path:
    """Write a joint trajectory.

    Args:
        simulation: The run.
        path: Where to write.
        dt: Time [s] between points; the exact end has one too.

    Returns:
        The path written.

    Raises:
        InputError: For a `dt` that makes no sense, or a path that cannot be written.
    """
    times = sample_times(simulation, dt)
    names = [joint.name for joint in simulation.robot.joints]
    head = {"header": {"frame_id": "base"}, "joint_names": names}
    with (
        whole_file(path) as temporary,
        temporary.open("w", encoding="utf-8", newline="") as file,
    ):
        file.write(json.dumps(head)[:-1] + ', "points": [')
        separator = "\n"
        for begin in range(0, len(times), BLOCK):
            samples = evaluate(simulation.trajectory, times[begin : begin + BLOCK])
            speed, acceleration = joint_rates(simulation.trajectory, samples)
            for row, time_s in enumerate(samples.times.tolist()):
                rates = (samples.joints[row], speed[row], acceleration[row])
                file.write(separator + json.dumps(_point(time_s, *rates)))
                separator = ",\n"
        file.write("\n]}\n")
    return path


def _point(time_s: float, joints: Array, speed: Array, acceleration: Array) -> dict[str, object]:
    whole, rest = divmod(round(time_s * _NANOSECONDS), _NANOSECONDS)
    return {
        "positions": joints.tolist(),
        "velocities": speed.tolist(),
        "accelerations": acceleration.tolist(),
        "time_from_start": {"sec": whole, "nanosec": rest},
    }
