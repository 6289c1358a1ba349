"""Current positions of the robots of a controller that stays on."""

from __future__ import annotations

from enum import StrEnum
from typing import TypeVar

import numpy as np

from rapidsim.controller.moves.queued_move import MotionError
from rapidsim.frames.transform import Array
from rapidsim.language.data import (
    WOBJ0,
    JointTarget,
    Pose,
    RobTarget,
    ToolData,
    WobjData,
)
from rapidsim.language.moves import Place
from rapidsim.motion.configurations import targets
from rapidsim.simulation.live.live_task import LiveTask
from rapidsim.simulation.live.states import RefusalReason, RequestRefused
from rapidsim.simulation.live.symbols import find, value_of
from rapidsim.values import value_class


class Coordinates(StrEnum):
    """Frame of a position."""

    BASE = "Base"
    WORLD = "World"
    WOBJ = "Wobj"


def joints(task: LiveTask) -> JointTarget:
    """Current positions of the axes of a task's robot [deg, mm]."""
    arm, external = _joints_now(task)
    resolver = task.run.controller.coordination.resolver
    return resolver.joint_target(arm, external)


def target(task: LiveTask, tool: str, wobj: str, frame: Coordinates) -> RobTarget:
    """Current pose of the TCP of a task's robot [mm].

    Args:
        task: The task.
        tool: Name of the tool.
        wobj: Name of the work object; used only if the frame is that of the work object.
        frame: The frame of the result.

    Raises:
        RequestRefused: If there is no such tool or work object.
    """
    arm, external = _joints_now(task)
    resolver = task.run.controller.coordination.resolver
    carried = _value(task, tool, ToolData)
    held = _value(task, wobj, WobjData) if frame is Coordinates.WOBJ else WOBJ0
    clock = task.run.controller.clock
    # Another robot may hold the work object: its pose now, not at the program's next read.
    found = clock.at_time(
        task.scheduler.now_s, lambda: resolver.target(arm, external, carried, held, task.place)
    )
    if frame is not Coordinates.BASE:
        return found
    world_from_tcp = targets.transform(Pose(found.trans, found.rot))
    pose = targets.pose(resolver.base_from_world @ world_from_tcp)
    return found._replace(trans=pose.trans, rot=pose.rot)


@value_class(frozen=True, slots=True)
class PositionSnapshot:
    """Position of a robot for an observer; reading it does not affect the run."""

    joints: JointTarget
    """[deg, mm]"""
    target: RobTarget
    """The TCP of the tool of the last move, in its work object [mm]."""
    move: Place | None
    """The active move; None while the arm is at rest."""


def position_snapshot(task: LiveTask) -> PositionSnapshot:
    """Current position of a task's robot, without effect on the run."""
    now_s, path = task.scheduler.now_s, task.unit.foreseen()
    samples = path.at(np.array([now_s]))
    arm, external, move = samples.joints[0], samples.external[0], int(samples.move[0])
    resolver, motion = task.run.controller.coordination.resolver, task.run.controller.motion
    tool, wobj = motion.active_tool(), motion.active_wobj()
    moves = task.unit.moves
    # The robot may be guided or jogged later; that is no move.
    moves_on = now_s < path.seen_s(path.command_end)
    clock = task.run.controller.clock
    return PositionSnapshot(
        resolver.joint_target(arm, external),
        clock.at_time(now_s, lambda: resolver.target(arm, external, tool, wobj, task.place)),
        moves[move].place if moves_on and move < len(moves) else None,
    )


def active_frames(task: LiveTask) -> tuple[str, str]:
    """Names of the tool and the work object of the last move."""
    return task.run.controller.motion.active_names()


def _joints_now(task: LiveTask) -> tuple[Array, Array]:
    """Current joints (n,) [rad] and external axes (e,) [m or rad]."""
    now_s, unit = task.scheduler.now_s, task.unit
    try:
        samples = unit.seen(now_s, np.array([now_s]))
    except MotionError:
        # The program that queued the move gets the error; the arm is at the end of its path.
        samples = unit.at_past(now_s)
    return samples.joints[0], samples.external[0]


T = TypeVar("T", ToolData, WobjData)


def _value(task: LiveTask, name: str, of: type[T]) -> T:
    value = value_of(task, find(task, name))
    if not isinstance(value, of):
        raise RequestRefused(RefusalReason.NO_SYMBOL, f"{name} is no {of.__name__.lower()}")
    return value
