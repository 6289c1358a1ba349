"""The law of motion for other kinds of arms than the usual one, and for a team."""

from __future__ import annotations

import numpy as np
import pytest
from laws import cases
from motion_law import command_of, excess_of, off_curve
from motion_programs import ROBOT, Programmer, zone

from rapidsim.motion.geometry.segments import Segment, Speed
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.building import build_path
from rapidsim.motion.path.path import Path
from rapidsim.motion.path.shared_path import shared_path
from rapidsim.motion.robot.robot import load_robot
from rapidsim.motion.timing.axis_limits import Limits, combined_limits, limits_of, model_of
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.timing.time_scaling import TimeScaling
from rapidsim.motion.trajectory.command import Piece
from rapidsim.motion.trajectory.trajectory import Trajectory

HOMES_DEG = {
    "irb910sc-3-0.65": (20.0, 60.0, -90.0, 0.0),
    "crb15000-5-0.95": (0.0, -10.0, 20.0, 10.0, 60.0, 20.0),
    "irb14050-0.5-0.5": (30.0, -60.0, 20.0, 30.0, 10.0, 60.0, 20.0),
    "irb460-110-2.4": (10.0, 20.0, 30.0, 20.0),
    ROBOT.name: (0.0, -10.0, 20.0, 10.0, 60.0, 20.0),
}
SPEEDS = (0.1, 0.5, 2.0, 7.0)


def random_moves(name: str, random: np.random.Generator) -> list[Segment]:
    """Three moves with any zones and at one speed; of seven axes joint moves only."""
    robot, home = load_robot(name), np.radians(HOMES_DEG[name])
    branch = int(robot.kinematics.branch_of(home))
    speed = Speed(float(random.choice(SPEEDS)), np.radians(500.0))
    program = Programmer(robot=robot, joints=home, branch=branch, speed=speed)
    for left in (2, 1, 0):
        z = zone(float(random.choice([1.0, 10.0, 50.0]))) if left else None
        if len(home) <= len(ROBOT.joints) and random.random() < 0.6:
            program.line(random.uniform(-0.04, 0.04, 3).tolist(), z=z)
        else:
            program.move(random.uniform(-0.15, 0.15, len(home)).tolist(), z)
    return program.segments


def path_of_moves(name: str, random: np.random.Generator) -> Path:
    """The path of the first moves drawn that the arm can make."""
    robot = load_robot(name)
    model = model_of(robot, MotionModel())
    paths = (build_path(robot, random_moves(name, random), model) for _ in range(9))
    return next(path for path in paths if isinstance(path, Path))


def assert_lawful(path: Path, timing: TimeScaling, limits: Limits, *, alone: bool = True) -> None:
    """The command keeps the limits and the path, and the smoothed axes their speeds: no jumps.

    Where robots set the pace together, a programmed speed is no limit at each instant, and that
    they keep their paths is looked at in `test_motion_team_path`.
    """
    start, model = path.segments[0].start, path.model
    for smoothing in ("path", "axes"):
        trajectory = Trajectory(start, model.window, smoothing, model.filter_averages)
        trajectory.append(Piece(0.0, path, timing, 0.0, path.length))
        assert excess_of(trajectory, limits).axis_speed < 1.001
        if smoothing == "path":
            command = excess_of(command_of(trajectory), limits)
            assert max(command.axis_speed, command.tcp_speed * alone) < 1.001
            assert command.axis_acceleration < 1.01
            assert not alone or off_curve(trajectory) < 1e-6


@pytest.mark.parametrize("name", [name for name in HOMES_DEG if name != ROBOT.name])
def test_every_kind_of_arm_keeps_curves_and_limits(name: str) -> None:
    random = np.random.default_rng(1)
    robot = load_robot(name)
    limits = limits_of(robot, model_of(robot, MotionModel()))
    for _ in range(cases(48)):
        path = path_of_moves(name, random)
        assert_lawful(path, plan(path, limits), limits)


def test_each_robot_of_a_team_keeps_curves_and_limits() -> None:
    random = np.random.default_rng(1)
    names = (ROBOT.name, "irb910sc-3-0.65")
    limits = [limits_of(robot, MotionModel()) for robot in map(load_robot, names)]
    for _ in range(cases(48)):
        team = shared_path([path_of_moves(name, random) for name in names])
        timing = plan(team, combined_limits(limits))
        for part, own in zip(team.parts, limits, strict=True):
            assert_lawful(part, timing, own, alone=False)
