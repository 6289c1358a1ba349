"""Poses in the base of a robot, or in the frame in which a picture of the robot is drawn.

That frame is the base of a stationary robot, as users think of targets there, and the world if a
track moves the base or several robots share a cell.
"""

from __future__ import annotations

import numpy as np

from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.targets import world_from_base_at
from rapidsim.motion.robot.robot import Robot
from rapidsim.simulation.results.simulation import RobotRun, Simulation


def is_on_track(robot: Robot) -> bool:
    """Whether external axes move the robot's base."""
    return any(axis.carries == "robot" for axis in robot.external)


def is_shown_in_world(simulation: Simulation) -> bool:
    """Whether pictures of a run are drawn in the world, not in the base of its only robot."""
    robots = simulation.robots
    return len(robots) > 1 or is_on_track(robots[0].robot)


def shown_from_base(robot_run: RobotRun, external: Array, *, in_world: bool) -> Transform:
    """Pose of a robot's base (k,) for external axes (k, e) [m or rad], in the frame of pictures."""
    if not in_world:
        return Transform(np.tile(np.eye(3), (len(external), 1, 1)), np.zeros((len(external), 3)))
    return world_from_base_at(robot_run.robot.external, robot_run.world_from_base, external)


def shown_from_world(robot_run: RobotRun, *, in_world: bool) -> Transform:
    """Pose of the world in the frame of pictures of a robot."""
    return Transform.identity() if in_world else robot_run.world_from_base.inverse()


def shown_end(robot_run: RobotRun, move: ExecutedMove, *, in_world: bool) -> Transform:
    """Programmed end of a move in the frame of pictures."""
    return (
        shown_from_base(robot_run, move.external[None], in_world=in_world)[0] @ move.base_from_tcp
    )
