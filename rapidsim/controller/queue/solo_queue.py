"""The path of one robot, which can be stopped on its way and started again.

Stopping takes back what is fixed beyond the stop: a block stays in the queue when it has its end,
until the next one begins, so that its rest can be planned again.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.controller.queue.path_planner import Commit, PathQueue, Plan
from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.segments import Waypoint
from rapidsim.motion.timing.braking import stop_at
from rapidsim.motion.trajectory.command import Piece

REGAINED_DEG = 1e-3
"""So near [deg] an arm must stand to where it left a path to take it up."""


@dataclass(frozen=True, slots=True)
class _Stored:
    """A path that StorePath keeps."""

    block: list[QueuedMove]
    commit: Commit | None
    closed: bool
    driven: list[Plan]
    halted: bool
    end: Waypoint
    joints: Array
    """Where the arm stood, shape (n,) [rad]."""


@dataclass(eq=False)
class RobotPath(PathQueue):
    """A path queue with StopMove, StartMove, ClearPath, StorePath and RestoPath."""

    _stored: list[_Stored] = field(default_factory=list)
    _left_at: Array | None = None
    """Joints at which the path that was taken up again was left."""

    def halt(self, now_s: float) -> float:
        """Stop on the path as fast as the axes can, from a time [s] up to which it is fixed or not.

        Returns:
            Command time [s] at which the robot stands.

        Raises:
            MotionError: See `append`.
        """
        self._advance(now_s)
        self.version += 1
        self._halted = True
        if not self._block or now_s >= self.trajectory.command_end:
            return now_s
        assert self._commit is not None
        while self._driven and self._driven[-1].start_s >= now_s:
            self._driven.pop()
        self.trajectory.cut(now_s)
        self._closed, self._plan = False, None
        if not self._driven:
            self._commit = Commit(now_s, 0, 0.0, 0.0)
            self._take_back(0)
            return now_s
        under_way = self._driven[-1]
        s = under_way.timing.s_at(now_s - under_way.start_s)
        speed = under_way.timing.speed_at(now_s - under_way.start_s)
        braking = stop_at(under_way.path, self.limits, s, speed)
        to_m = float(braking.s[-1])
        stopping = Plan(under_way.path, braking, under_way.first, s, now_s)
        if to_m > s:
            self.trajectory.append(Piece(now_s, under_way.path, braking, s, to_m))
            self._driven.append(stopping)
        starts = under_way.path.segment_starts
        index = under_way.first + int(np.searchsorted(starts, to_m, side="right")) - 1
        rest_s = now_s + braking.duration
        self._commit = Commit(rest_s, index, to_m - under_way.start_of(index), 0.0)
        self._take_back(index + 1)
        return rest_s

    def leave(self) -> None:
        """Leave the robot on its way, where its path is fixed up to; nothing is planned any more.

        The move that begins there counts as begun, for it is what the arm is about to make.
        """
        if not self.is_open or self._commit is None or not self._driven:
            return
        queued = self._block[self._commit.move]
        if queued.ended_s is None:
            queued.started.time = queued.ended_s = self._commit.time_s
            queued.start_place_m = queued.end_place_m = self.trajectory.length

    def resume(self, now_s: float) -> None:
        """Let the robot go on from where it was stopped."""
        self.version += 1
        self._halted, self._left_at = False, None
        if self.is_open and self._commit is not None:
            self._commit = replace(self._commit, time_s=max(now_s, self._commit.time_s))
            self._plan = None
            if not self._driven:
                self._block[0].command_start_s = self._commit.time_s

    def clear(self) -> None:
        """Forget what is left of the path of a robot that stands."""
        self.version += 1
        if self.is_open:
            self._closed, self._plan = True, None
            self._ready_s = self.trajectory.command_end
            for queued in self._block:
                if queued.started.time is None:
                    # The program waits for it no longer.
                    queued.started.time = self._ready_s
                queued.end_place_m = min(queued.end_place_m, self.trajectory.length)
        self.end = self.standing()

    def store(self) -> None:
        """Keep the path of a robot that stands, and begin another."""
        self.version += 1
        kept = (self._block, self._commit, self._closed, self._driven, self._halted, self.end)
        self._stored.append(_Stored(*kept, self.standing().joints))
        self._block, self._driven, self._closed, self._halted = [], [], False, False
        self.end = self.standing()

    def restore(self) -> None:
        """Take up the path that was kept last, where it was left."""
        self.version += 1
        kept = self._stored.pop()
        self._block, self._commit, self._closed = kept.block, kept.commit, kept.closed
        self._driven, self._halted, self.end = kept.driven, kept.halted, kept.end
        self._left_at, self._plan = kept.joints, None

    def continue_after(self, other: RobotPath) -> None:
        """Let the robot go on alone where it moved with others, or the other way round."""
        self.version += 1
        self._ready_s = max(self._ready_s, other._ready_s)
        self._block, self._driven, self._closed, self._commit = [], [], False, None

    def away_deg(self) -> float:
        """How far [deg] the arm stands from where it left the path it is to take up; 0 if there."""
        if self._left_at is None:
            return 0.0
        off = np.degrees(np.max(np.abs(self.standing().joints - self._left_at)))
        return float(off) if off > REGAINED_DEG else 0.0

    def standing(self) -> Waypoint:
        """Where the command comes to its end, as the flange with no tool."""
        samples = self.at_past(self.trajectory.duration)
        joints: Array = samples.joints[0]
        return Waypoint(joints, self.robot.forward(joints), samples.external[0])

    def _take_back(self, index: int) -> None:
        """The moves of the block from one on have not begun after all."""
        for queued in self._block[index:]:
            queued.started.time = None
            queued.ended_s = None
