"""A robot as a member of a motion queue: its arm, its moves and the fixed part of its motion."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import field
from operator import attrgetter
from typing import Protocol

import numpy as np

from rapidsim.controller.moves.executed_moves import ExecutedMoves, MoveColumns, MoveRows
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.controller.moves.settled_lines import SettledLines
from rapidsim.controller.queue.move_log import MoveLog
from rapidsim.controller.queue.plan_cache import PlanCache
from rapidsim.controller.queue.planning_costs import PlanningCosts
from rapidsim.frames.rotation_vectors import vector_from_rotation
from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.segments import Segment, Waypoint
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.timing.axis_limits import Limits, limits_of, model_of
from rapidsim.motion.trajectory.guided_section import GuidedSection
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.motion.trajectory.trajectory import Trajectory
from rapidsim.values import value_class

REGAINED_M = 0.010
"""Distance [m] of the TCP from where it left its path up to which it returns by itself."""
REGAINED = np.radians(20.0)
"""Rotation [rad] of the tool up to which the robot returns by itself."""
_OTHER_STANCE = np.radians(90.0)
"""An axis that differs by this much has another configuration, even if the tool is close."""


class GuidedMotion(Protocol):
    """A robot guided by a sensor."""

    @property
    def section(self) -> GuidedSection:
        """Recorded motion so far; it grows."""
        ...

    def release(self) -> None:
        """Brake now and rest until the end of the section."""
        ...


class CorrectedMotion(Protocol):
    """A robot whose path is corrected by a sensor."""

    def end(self) -> None:
        """Bring the robot to rest; its path continues from there."""
        ...

    def settle(self) -> None:
        """Leave the robot at rest where it is; its path continues from there."""
        ...


@value_class(slots=True, eq=False)
class Member:
    """A robot, whatever queue it moves through, alone or with others."""

    robot: Robot
    model: MotionModel
    """Motion model of its controller."""
    limits: Limits
    """Axis speeds and accelerations for timing."""
    trajectory: Trajectory
    """Its motion as far as it is fixed."""
    end: Waypoint
    """End of its last queued move."""
    moves: MoveLog = field(default_factory=MoveLog)
    """All moves that it ever got."""
    repeats: PlanCache = field(default_factory=PlanCache)
    """Plans of blocks that it made alone."""
    costs: PlanningCosts = field(default_factory=PlanningCosts)
    """Processor time of the plans that it led."""
    ready_s: float = 0.0
    """Earliest command time at which its next block may start."""
    waited_s: float = 0.0
    """Part [s] of `ready_s` that it waits at its last stop point."""
    settled_s: float = -math.inf
    """Time [s] at which it comes to rest at the end of its last block."""
    level: int = 0
    """Number of stored paths."""
    guided: GuidedMotion | None = None
    """Guidance that moves the robot now; None while it follows its path."""
    corrected: CorrectedMotion | None = None
    """Path correction that offsets the robot from its path; None if there is none."""
    start_is_free: bool = False
    """Whether the arm may begin elsewhere: it has not moved, and its position is not known to the
    station or the program."""

    @property
    def is_guided(self) -> bool:
        """Whether a sensor guides the robot or corrects its path, or a belt takes it along."""
        return self.guided is not None or self.corrected is not None or self.rides

    @property
    def rides(self) -> bool:
        """Whether a belt takes the robot along at the end of its fixed motion."""
        return bool(self.trajectory.riding()[0])

    def add(self, moves: Sequence[QueuedMove]) -> None:
        """Add moves to the log, with their numbers."""
        for number, queued in enumerate(moves, len(self.moves)):
            queued.number, queued.level = number, self.level
        self.moves.extend(moves)
        self.end = moves[-1].segment.end

    def guide(self, guided: GuidedMotion) -> None:
        """Let a guidance, not the path, move a robot at rest."""
        self.guided = guided
        self.trajectory.guide(guided.section)

    def at_past(self, time_s: float) -> Samples:
        """The arm at a time [s] that is past, one sample."""
        return self.trajectory.at(np.array([time_s]))

    def standing(self) -> Waypoint:
        """Waypoint at the end of the command, of the flange without a tool."""
        samples = self.at_past(self.trajectory.duration)
        joints: Array = samples.joints[0]
        return Waypoint(joints, self.robot.forward(joints), samples.external[0])

    def end_of_command(self) -> Waypoint:
        """Waypoint at the end of the path, from which a belt may have taken the arm along."""
        last = self.trajectory.pieces[-1]
        wide = last.path.joints_at(np.array([last.to_s]))[0]
        joints, rest = np.split(wide, [len(self.robot.joints)])
        return Waypoint(joints, self.robot.forward(joints), rest[: len(self.robot.external)])

    def settle_correction(self) -> None:
        """End a path correction of a robot at rest; its path continues where it is."""
        if self.corrected is not None:
            self.corrected.settle()

    def distance_from(self, left_at: Waypoint, segment: Segment) -> str:
        """Distance of the arm from where it left a segment, as text; empty if it can return."""
        tool = segment.tcp_from_flange.inverse()
        stands = self.standing()
        here, there = (one.base_from_tcp @ tool for one in (stands, left_at))
        way = float(np.linalg.norm(there.translation - here.translation))
        turn = float(np.linalg.norm(vector_from_rotation(there.rotation @ here.rotation.T)))
        if way > REGAINED_M or turn > REGAINED:
            return f"{1e3 * way:.1f} mm and {np.degrees(turn):.1f} deg"
        off = np.abs(stands.joints - left_at.joints)
        axis = int(np.argmax(off))
        return (
            f"with axis {axis + 1} {np.degrees(off[axis]):.0f} {self.robot.joints[axis].measure}"
            if off[axis] > _OTHER_STANCE
            else ""
        )

    def executed(self, task: str) -> ExecutedMoves:
        """All planned moves, with the times at which the arm makes them, lag included."""
        rows = MoveRows([_planned(part) for part in self.moves.parts])
        index = rows.column(SettledLines.numbers, attrgetter("number")).astype(np.int64)
        both = np.stack(
            [rows.column(*2 * [attrgetter(name)]) for name in ("start_place_m", "end_place_m")],
            axis=-1,
        )
        # Most moves begin where the previous one ends.
        places, row = np.unique(both.reshape(-1), return_inverse=True)
        start_s, end_s = self.trajectory.time_at_place(places)[row].reshape(-1, 2).T
        # The arm may have been at rest for a while where a block begins.
        at_rest = rows.column(
            lambda lines: np.full(len(lines), np.nan), attrgetter("command_start_s")
        )
        start_s = np.where(np.isnan(at_rest), start_s, at_rest)
        end_s = np.maximum(start_s, end_s)
        return ExecutedMoves(MoveColumns(index, start_s, end_s, (task,) * len(rows), rows))


def _planned(part: Sequence[QueuedMove]) -> Sequence[QueuedMove]:
    """Return the moves of a part that have been planned; settled lines have."""
    if isinstance(part, SettledLines):
        return part
    return tuple(one for one in part if one.ended_s is not None and one.started.time is not None)


def member_at_rest(robot: Robot, model: MotionModel, start: Waypoint) -> Member:
    """A robot at rest at time zero.

    Args:
        robot: The arm.
        model: Motion model of its controller.
        start: Its position.
    """
    model = model_of(robot, model)
    trajectory = Trajectory(start, model.window, model.smoothing, model.filter_averages)
    return Member(robot, model, limits_of(robot, model), trajectory, start)
