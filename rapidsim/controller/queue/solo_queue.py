"""Motion queue of a robot that moves alone, with its stored paths."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field, replace
from functools import partial
from typing import Protocol

import numpy as np

from rapidsim.controller.moves.executed_move import CornerKind, ExecutedMove
from rapidsim.controller.moves.queued_move import MotionError, QueuedMove, executed_move
from rapidsim.controller.queue import stopping
from rapidsim.controller.queue.block import MotionBlock
from rapidsim.controller.queue.move_log import MoveLog
from rapidsim.controller.queue.path_planner import BlockPlanner
from rapidsim.controller.queue.plan_cache import PlanCache
from rapidsim.frames.rotation_vectors import vector_from_rotation
from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.segments import Segment, Waypoint
from rapidsim.motion.interruption import Look, undisturbed
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.building import build_path
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.path.path import Path
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.timing.axis_limits import limits_of, model_of
from rapidsim.motion.trajectory.guided_section import GuidedSection
from rapidsim.motion.trajectory.trajectory import Samples, Trajectory
from rapidsim.values import value_class

REGAINED_M = 0.010
"""Distance [m] of the TCP from where it left its path up to which it returns by itself."""
REGAINED = np.radians(20.0)
"""Rotation [rad] of the tool up to which the robot returns by itself."""
_OTHER_STANCE = np.radians(90.0)
"""An axis that differs by this much has another configuration, even if the tool is close."""


@value_class(frozen=True, slots=True)
class _Stored:
    """A path stored by StorePath."""

    block: MotionBlock
    end: Waypoint
    position: Waypoint
    """Position of the arm when the path was stored."""


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
class SoloQueue:
    """Implements `MotionQueue` for a robot that moves alone."""

    robot: Robot
    planner: BlockPlanner
    end: Waypoint
    """End of the last queued move."""
    _stored: list[_Stored] = field(default_factory=list)
    guided: GuidedMotion | None = None
    """Guidance that moves the robot now; None while it follows its path."""
    corrected: CorrectedMotion | None = None
    """Path correction that offsets the robot from its path; None if there is none."""
    start_is_free: bool = False
    """Whether the arm may begin elsewhere: it has not moved, and its position is not known to the
    station or the program."""
    _left_at: Waypoint | None = None
    """Position at which the resumed path had been left."""

    @property
    def trajectory(self) -> Trajectory:
        """The robot's motion as far as it is fixed."""
        return self.planner.trajectory

    @property
    def moves(self) -> MoveLog:
        """All moves the robot ever got, alone or with others."""
        return self.planner.moves

    @property
    def version(self) -> int:
        """Changes whenever the planned motion of the robot may change."""
        return self.planner.version

    @property
    def is_open(self) -> bool:
        """Whether a block of moves is open: its end is not decided."""
        return self.planner.is_open

    @property
    def is_halted(self) -> bool:
        """Whether a stop keeps the robot where it is."""
        return self.planner.is_halted

    @property
    def open_moves(self) -> int:
        """Number of moves of the open block that are not yet travelled."""
        return self.planner.open_moves

    @property
    def braking_s(self) -> float:
        """More time [s] than the arm needs to stop."""
        return self.planner.braking_s

    @property
    def stored(self) -> int:
        """Number of stored paths."""
        return len(self._stored)

    @property
    def is_guided(self) -> bool:
        """Whether a sensor guides the robot or corrects its path."""
        return self.guided is not None or self.corrected is not None

    def begin_at(self, start: Waypoint) -> None:
        """Let an arm that has not moved begin elsewhere."""
        self.planner.trajectory.begin_at(start)
        self.planner.version += 1
        self.end = start

    def append(self, queued: QueuedMove, now_s: float) -> None:
        """Append a move to the path; see `BlockPlanner.append`."""
        queued.level = self.stored
        self.planner.append(queued, now_s)
        self.end = queued.segment.end

    def take(self, queued: QueuedMove) -> None:
        """Record a move that the robot makes in a team; the team plans it."""
        queued.number, queued.level = len(self.moves), self.stored
        self.moves.append(queued)
        self.end = queued.segment.end

    def close(self, corner: CornerKind = CornerKind.STOP) -> float:
        """End the block with a stop; see `BlockPlanner.close`."""
        return self.planner.close(corner)

    def commit_last_start(self) -> float:
        """Fix the path up to the start of the last move."""
        return self.planner.commit_last_start()

    def commit_ahead(self) -> float | None:
        """Fix what later moves cannot change."""
        return self.planner.commit_ahead()

    def nominal_last_start(self) -> float:
        """About when the robot starts the last move [s]."""
        return self.planner.nominal_last_start()

    def preview(self) -> Trajectory:
        """Trajectory if no further move is queued."""
        return self.planner.preview()

    def places_of(self, queued: QueuedMove) -> tuple[float, float] | None:
        """Path positions [m] of start and end of a move of the current block; None for others."""
        return self.planner.places_of(queued)

    def path_ratio(self, queued: QueuedMove) -> float:
        """Return 1: for a robot alone, path position and travelled distance are the same."""
        del queued
        return 1.0

    def seen(self, now_s: float, times: Array) -> Samples:
        """The arm at times (k,) [s] around now; see `MotionQueue.seen`."""
        self.planner.end_if_late(now_s)
        is_decided = float(times[-1]) <= self.trajectory.command_end
        return (self.trajectory if is_decided else self.preview()).at(times)

    def at_past(self, time_s: float) -> Samples:
        """The arm at a time [s] that is past, one sample."""
        return self.trajectory.at(np.array([time_s]))

    def halt(self, now_s: float, in_s: float = 0.0) -> float:
        """Stop on the path, or stop whatever guides the robot; see `stopping.halt`."""
        if self.guided is not None:
            self.end_guidance()
            now_s = max(now_s, self.trajectory.duration)
        return stopping.halt(self.planner, now_s, in_s)

    def guide(self, guided: GuidedMotion) -> None:
        """Let a guidance, not the path, move a robot at rest."""
        self.guided = guided
        self.trajectory.guide(guided.section)

    def end_guidance(self) -> None:
        """Bring the robot to rest where it is; the next move begins there."""
        guided, self.guided = self.guided, None
        if guided is not None:
            guided.release()
            self.continue_from(guided.section.end_s)
            self.end = self.standing()

    def resume(self, now_s: float) -> None:
        """Continue from where the robot was stopped; return there first if it has moved since."""
        left_at, self._left_at = self._left_at, None
        if left_at is not None and self.is_open:
            now_s = stopping.regain(self.planner, self.standing(), left_at, now_s)
        stopping.resume(self.planner, now_s)

    def leave(self) -> None:
        """Leave the robot in motion and stop planning; see `stopping.leave`."""
        stopping.leave(self.planner)

    def clear(self) -> None:
        """Discard the remaining path of a robot at rest."""
        self._left_at = None
        stopping.clear(self.planner)
        if self.corrected is not None:
            self.corrected.settle()
        self.end = self.standing()

    def store(self) -> None:
        """Store the path of a robot at rest, and begin another."""
        if self.corrected is not None:
            self.corrected.settle()
        self.planner.version += 1
        stands = self.standing()
        # A restored path that was not continued keeps the position at which it was left first.
        left_at, self._left_at = self._left_at or stands, None
        self._stored.append(_Stored(self.planner.block, self.end, left_at))
        self.planner.block, self.end = MotionBlock(), stands

    def restore(self) -> None:
        """Restore the path stored last at the position where it was left."""
        self.planner.version += 1
        kept = self._stored.pop()
        self.planner.block, self.end, self._left_at = kept.block, kept.end, kept.position
        kept.block.plan = None
        if not kept.block.is_open:
            # No move of it remains: the next move begins at the position of the arm.
            self.end, self._left_at = self.standing(), None

    def continue_from(self, ready_s: float) -> None:
        """Continue alone from where the robot has moved with others up to a time [s]."""
        planner = self.planner
        planner.version += 1
        planner.ready_s = max(planner.ready_s, ready_s)
        planner.block = MotionBlock(is_halted=planner.is_halted)

    def off_path_reason(self) -> str:
        """Distance of the arm from where it left its path, as text; empty if near enough."""
        block, left_at = self.planner.block, self._left_at
        if left_at is None or not block.is_open:
            return ""
        return self.distance_from(left_at, block.moves[block.commit.move].segment)

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

    def standing(self) -> Waypoint:
        """Waypoint at the end of the command, of the flange without a tool."""
        samples = self.at_past(self.trajectory.duration)
        joints: Array = samples.joints[0]
        return Waypoint(joints, self.robot.forward(joints), samples.external[0])

    def executed(self, task: str) -> tuple[ExecutedMove, ...]:
        """All planned moves, with the times at which the arm makes them, lag included."""
        done = [
            (index, queued)
            for index, queued in self.moves.numbered()
            if queued.ended_s is not None and queued.started.time is not None
        ]
        both = np.array([[queued.start_place_m, queued.end_place_m] for _, queued in done])
        # Most moves begin where the previous one ends.
        places, row = np.unique(both.reshape(-1), return_inverse=True)
        seen_s = self.trajectory.time_at_place(places)[row].reshape(-1, 2)
        return tuple(
            executed_move(index, task, queued, float(start_s), float(end_s))
            for (index, queued), (start_s, end_s) in zip(done, seen_s, strict=True)
        )


def solo_queue(
    robot: Robot, model: MotionModel, start: Waypoint, check_deadline: Look = undisturbed
) -> SoloQueue:
    """Queue of a robot at rest at time zero.

    Args:
        robot: The arm.
        model: Motion model of its controller.
        start: Its position.
        check_deadline: Called during planning; raises to interrupt it.
    """
    model = model_of(robot, model)
    trajectory = Trajectory(start, model.window, model.smoothing, model.filter_averages)
    build = partial(_path, robot, model, check_deadline)
    limits, repeats = limits_of(robot, model), PlanCache()
    planner = BlockPlanner(
        trajectory, model, limits, build, check_deadline=check_deadline, repeats=repeats
    )
    return SoloQueue(robot, planner, start)


def _path(
    robot: Robot,
    model: MotionModel,
    check_deadline: Look,
    moves: Sequence[QueuedMove],
    lost_corner: int | None,
) -> Path:
    segments = [queued.segment for queued in moves]
    if lost_corner is not None:
        segments[lost_corner] = replace(segments[lost_corner], zone=None)
    path = build_path(robot, segments, model, check_deadline)
    if isinstance(path, PathFault):
        raise MotionError(moves[path.segment], path)
    return path
