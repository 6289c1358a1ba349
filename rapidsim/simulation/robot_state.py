"""State of a task and its robot at the current statement, as a person wants to see it.

Finding the time of a statement may plan the path, and let time pass up to it: the program runs
ahead of the robot. An observer that must not change the run calls this in a copy of the process.
"""

from __future__ import annotations

import numpy as np

from rapidsim.controller.moves.queued_move import MotionError
from rapidsim.language.data import JointTarget, RobTarget
from rapidsim.language.moves import Place
from rapidsim.simulation.task_run import TaskRun
from rapidsim.values import value_class

_STEP_S = 1e-3
"""Interval [s] over which the speed is measured."""


@value_class(frozen=True, slots=True)
class RobotState:
    """A task and its robot at one instant."""

    time_s: float
    """Virtual time of the statement."""
    joints: JointTarget
    """[deg, mm]"""
    target: RobTarget
    """The TCP of the active tool in the active work object [mm]."""
    tool: str
    wobj: str
    tcp_speed_mm_s: float
    move: Place | None
    """The move that the robot executes; None while it is at rest."""


def robot_state(run: TaskRun) -> RobotState:
    """Return the state at the current statement; see the module for its effects.

    Raises:
        MotionError: If a move before the statement proves impossible.
        Stopped: If a limit of the run is reached before.
    """
    controller = run.controller
    now_s = controller.clock.resolve_time()
    unit = controller.execution.unit
    times = np.array([now_s, now_s + _STEP_S])
    try:
        samples = unit.seen(now_s, times)
    except MotionError:
        samples = unit.at_past(now_s)
    resolver, motion = controller.coordination.resolver, controller.motion
    tool, wobj = motion.active_tool(), motion.active_wobj()
    place = controller.clock.place

    def target(k: int) -> RobTarget:
        joints, external = samples.joints[k], samples.external[k]
        return controller.clock.at_time(
            now_s, lambda: resolver.target(joints, external, tool, wobj, place)
        )

    here, there = target(0), target(len(samples.joints) - 1)
    way_mm = float(np.linalg.norm(np.subtract(there.trans, here.trans)))
    move, moves = int(samples.move[0]), unit.moves
    is_moving = now_s < unit.trajectory.duration and move < len(moves)
    names = motion.active_names()
    return RobotState(
        now_s,
        resolver.joint_target(samples.joints[0], samples.external[0]),
        here,
        *names,
        way_mm / _STEP_S,
        moves[move].place if is_moving else None,
    )
