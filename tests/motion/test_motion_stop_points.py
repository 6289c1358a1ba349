"""Stop points are reached by every arm, also where its slow moves take less time there."""

from __future__ import annotations

import numpy as np
from laws import in_turn
from motion_programs import Programmer, path_of

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.segments import Speed
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.robot import Robot, load_robot, robot_names
from rapidsim.motion.timing.axis_limits import limits_of, model_of
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.trajectory.command import Piece
from rapidsim.motion.trajectory.trajectory import Trajectory

MISSED = 5e-5
"""Share of its reach by which an arm may miss a stop point."""
WAY_M = 0.03
SPEEDS = (0.05, 0.1, 0.2, 0.5)


def unlike_robots() -> list[Robot]:
    """Arms of the catalogue with known speeds, one of those that accelerate alike."""
    robots = (load_robot(name) for name in robot_names())
    known = [robot for robot in robots if all(joint.max_speed for joint in robot.joints)]
    return list({str((robot.reach_m, robot.constants)): robot for robot in known}.values())


def missed(robot: Robot, joints: Array, axis: int, speed: float) -> float:
    """Distance [m] from the stop point at which an arm turns around on a move out and back."""
    model = model_of(robot, MotionModel())
    limits = limits_of(robot, model)
    radius = float(np.linalg.norm(robot.kinematics.jacobian(joints)[:3, axis]))
    step = np.eye(len(joints))[axis] * WAY_M / radius
    out = Programmer(robot=robot, joints=joints, speed=Speed(speed, 9.0)).move(step)
    back = Programmer(robot=robot, joints=out.joints, speed=out.speed).move(-step)
    start = out.segments[0].start
    trajectory = Trajectory(start, model.window, model.smoothing, model.filter_averages)
    start_s = 0.0
    for program in (out, back):
        path = path_of(program, model)
        timing = plan(path, limits)
        trajectory.append(Piece(start_s, path, timing, 0.0, path.length))
        start_s += timing.duration + model.dwell_after(timing.braking_s)
    middle_s = 0.5 * trajectory.duration
    seen = trajectory.at(middle_s + np.arange(-model.window, model.window, 1e-3))
    return radius * float(np.abs(seen.joints - out.joints)[:, axis].min())


def test_every_arm_reaches_its_stop_points() -> None:
    for number, robot in enumerate(unlike_robots()):
        joints = np.clip(robot.lower + 0.35 * (robot.upper - robot.lower), -2.0, 2.0)
        for speed in in_turn(SPEEDS, number, 1):
            way_m = missed(robot, joints, 0, speed)
            assert way_m < MISSED * (robot.reach_m or 1.0), (robot.name, speed)


def test_a_slow_move_of_a_quick_arm_stops_as_long_as_a_fast_one() -> None:
    small, large = (model_of(load_robot(name), MotionModel()) for name in ("irb1010", "irb6640"))
    assert small.dwell_after(0.002) == small.dwell
    assert large.dwell_after(0.002) < 0.5 * large.dwell
