"""The path of one robot, planned as late as possible and no later.

Moves are put on the path one by one. Nothing is planned until somebody must know: a stop point ends
the block, or the program looks at time or position. What was planned before the program could say
more is tentative; `commit` fixes the part that has been travelled, and the rest is planned again
when another move arrives, from the same place with the same speed.

A move that arrives when the robot is already within the zone of the last one is too late: that
corner has become a stop (corner path failure).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from rapidsim.controller.moves.executed_move import CornerKind, ExecutedMove
from rapidsim.controller.moves.queued_move import (
    MotionError,
    QueuedMove,
    executed_move,
    frames_of,
    nominal_s,
)
from rapidsim.motion.geometry.blends import Corner
from rapidsim.motion.geometry.segments import Segment, Waypoint
from rapidsim.motion.interruption import Look, undisturbed
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.path.path import Path, build_path
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.timing.axis_limits import Limits, limits_of
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.timing.time_scaling import Timing
from rapidsim.motion.trajectory.command import Piece
from rapidsim.motion.trajectory.trajectory import Samples, Trajectory

MAX_OPEN_MOVES = 2000
"""So many moves are planned in one go; a longer block is committed as it is planned."""
LOOK_AHEAD_SLACK_S = 0.01
"""The program may think this long at a fly-by point before it makes a difference to the path."""
TOLERATED_EXCESS = 0.01
"""Share of the path speed by which a re-planned start may be too fast to brake for a new corner."""


@dataclass(frozen=True, slots=True)
class Commit:
    """Up to here the path is fixed: a distance past the start of one of the block's moves."""

    time_s: float
    move: int
    distance_m: float
    speed_m_s: float


@dataclass(frozen=True, slots=True)
class Plan:
    """A tentative plan of the open part of the block."""

    path: Path
    timing: Timing
    first: int
    """Index in the block of the path's first segment."""
    from_m: float
    """Where on the path the plan starts."""
    start_s: float
    """Command time at that place."""
    lost_corner: int | None = None
    """Index in the block of a move that ends with a stop instead of the corner it was to have."""

    def time_at(self, s: float) -> float:
        """Command time [s] at a place of the path."""
        return self.start_s + self.timing.time_at(s)

    def start_of(self, index: int) -> float:
        """Where on the path a move of the block starts [m]."""
        return float(self.path.segment_starts[index - self.first])


@dataclass(eq=False)
class PathQueue:
    """The moves of one robot and the trajectory they give."""

    robot: Robot
    model: MotionModel
    trajectory: Trajectory
    end: Waypoint
    """Where the last queued move ends."""
    look: Look = undisturbed
    """Called while it plans; raises to end that."""
    moves: list[QueuedMove] = field(default_factory=list)
    version: int = 0
    """Changes whenever what the robot will do may change."""
    _block: list[QueuedMove] = field(default_factory=list)
    _commit: Commit | None = None
    _plan: Plan | None = None
    _closed: bool = False
    """The block has its end; it stays until the next begins, for it may be stopped on its way."""
    _halted: bool = False
    """StopMove: nothing moves until StartMove."""
    _driven: list[Plan] = field(default_factory=list)
    """The plans whose stretches the block has travelled, in order of time."""
    _preview: tuple[int, Trajectory] | None = None
    _reckoned: tuple[Commit, int, float] | None = None
    """From which commit, up to the start of which move, to what time `nominal_last_start` got."""
    _ready_s: float = 0.0
    """Earliest command time at which the next block may start."""

    @property
    def is_open(self) -> bool:
        """Whether a block of moves waits for its end."""
        return bool(self._block) and not self._closed

    @property
    def is_halted(self) -> bool:
        """Whether a stop keeps the robot where it is."""
        return self._halted

    @property
    def open_moves(self) -> int:
        """How many moves of the open block have not been travelled."""
        return len(self._block) - self._commit.move if self.is_open and self._commit else 0

    @cached_property
    def limits(self) -> Limits:
        """Axis speeds and accelerations for timing."""
        return limits_of(self.robot, self.model)

    @cached_property
    def braking_s(self) -> float:
        """More time [s] than the arm needs to stop: the longest any axis does from full speed."""
        return float(np.max(self.limits.max_speed / self.limits.max_acceleration))

    def append(self, queued: QueuedMove, now_s: float) -> None:
        """Put a move on the path.

        Args:
            queued: The move.
            now_s: When the program says so. Within a block that is still travelled lazily, the time
                the robot starts the last move will do.

        Raises:
            MotionError: When what is already on the path turns out not to be passable.
        """
        self._advance(now_s)
        self.version += 1
        if not self.is_open:
            self._block, self._driven, self._closed = [], [], False
            start_s = max(now_s, self._ready_s)
            self._commit = Commit(start_s, 0, 0.0, 0.0)
            queued.started.time = start_s
            queued.command_start_s = start_s
        else:
            last = self._block[-1]
            if frames_of(last) != frames_of(queued):
                # Source: RAPID Overview, "Motion and I/O principles": a change of tool or work
                # object within a zone makes the corner path joint interpolated.
                last.segment = replace(last.segment, joint_corner=True)
            if queued.segment.ramp > last.segment.ramp:
                # The window of the smoothing becomes narrower only where it is empty.
                queued.segment = replace(queued.segment, ramp=last.segment.ramp)
        if queued.segment.index != len(self.moves):
            queued.segment = replace(queued.segment, index=len(self.moves))
        self._block.append(queued)
        self.moves.append(queued)
        self.end = queued.segment.end
        self._plan = None

    def close(self, corner: CornerKind = CornerKind.STOP) -> float:
        """End the block with a stop at its last move and plan all of it.

        Returns:
            Command time [s] at which the stop point is reached.

        Raises:
            MotionError: See `append`.
        """
        if self._block[-1].corner is CornerKind.FLY_BY:
            self._block[-1].corner = corner
        tentative = self._to_travel()
        end_s = self._travel(tentative, len(self._block), tentative.path.length)
        stop = self._block[-1].move.stop
        lag_s = self.trajectory.lag_s(end_s)
        pause_s = lag_s + stop.seconds if stop else 0.0
        # A window that a ramp has widened takes longer to run empty; the standstill stays as long.
        dwell_s = self.model.fine_dwell + (lag_s - self.model.filter_time)
        self._ready_s = end_s + max(dwell_s, pause_s)
        self._closed = True
        self._plan = None
        return end_s

    def at_past(self, time_s: float) -> Samples:
        """The arm at a time [s] that is past, one sample."""
        return self.trajectory.at(np.array([time_s]))

    def preview(self) -> Trajectory:
        """What the robot will do if nothing more is said.

        Raises:
            MotionError: See `append`.
        """
        if not self.is_open or self._halted:
            return self.trajectory
        if self._preview is None or self._preview[0] != self.version:
            plan = self._planned()
            rest = Piece(plan.start_s, plan.path, plan.timing, plan.from_m, plan.path.length)
            self._preview = (self.version, self.trajectory.extended(rest))
        return self._preview[1]

    def places_of(self, queued: QueuedMove) -> tuple[float, float] | None:
        """Where a move of the current block starts and ends [m] on the preview; None for others."""
        index = queued.segment.index - self._block[0].segment.index if self._block else -1
        if not 0 <= index < len(self._block) or self._block[index] is not queued:
            return None
        plan = self._planned() if self.is_open and not self._halted else None
        if plan is None or index < plan.first:
            return queued.start_place_m, queued.end_place_m
        offset = self.trajectory.length - plan.from_m
        end = float(plan.path.segment_bounds[index - plan.first + 1])
        return offset + plan.start_of(index), offset + end

    def nominal_last_start(self) -> float:
        """About when the robot starts the last move [s]: at programmed speeds, without ramps."""
        commit = self._commit
        assert commit is not None
        if self._reckoned is None or self._reckoned[0] is not commit:
            self._reckoned = (commit, commit.move, commit.time_s)
        _, begin, start_s = self._reckoned
        last = len(self._block) - 1
        # Each move is added once, however often somebody asks.
        start_s += sum(nominal_s(queued.segment) for queued in self._block[begin:last])
        self._reckoned = (commit, last, start_s)
        return start_s

    def commit_last_start(self) -> float:
        """Plan what is known and fix it up to the start of the last move.

        Returns:
            Command time [s] of that start.

        Raises:
            MotionError: See `append`.
        """
        return self._commit_start(len(self._block) - 1)

    def commit_ahead(self) -> float | None:
        """Fix as much as later moves cannot change: a braking distance stays open.

        Returns:
            Command time [s] up to which the path is fixed; None if nothing could be fixed.

        Raises:
            MotionError: See `append`.
        """
        assert self._commit is not None
        tentative = self._to_travel()
        index = len(self._block) - 1
        ahead_m = 0.0
        while index > self._commit.move:
            ahead_m = tentative.path.length - tentative.start_of(index)
            if ahead_m >= self._braking_distance_m(self._block[index].segment):
                break
            index -= 1
        if index <= self._commit.move:
            return None
        return self._commit_start(index)

    def samples_at(self, now_s: float) -> Samples:
        """The arm now, one sample, which fixes the path up to now.

        Raises:
            MotionError: See `append`.
        """
        self._advance(now_s)
        return self.at_past(now_s)

    def executed(self, task: str) -> tuple[ExecutedMove, ...]:
        """All moves that were planned, with the times at which the arm is seen to make them."""
        done = [
            (index, queued)
            for index, queued in enumerate(self.moves)
            if queued.ended_s is not None and queued.started.time is not None
        ]
        both = np.array([[queued.start_place_m, queued.end_place_m] for _, queued in done])
        # Most moves begin where the one before ends.
        places, row = np.unique(both.reshape(-1), return_inverse=True)
        seen_s = self.trajectory.time_at_place(places)[row].reshape(-1, 2)
        return tuple(
            executed_move(index, task, queued, float(start_s), float(end_s))
            for (index, queued), (start_s, end_s) in zip(done, seen_s, strict=True)
        )

    def _planned(self) -> Plan:
        """The open part of the block, planned to a stop at its last move; nothing else changes.

        Raises:
            MotionError: If some of it cannot be travelled.
        """
        if self._plan is not None:
            return self._plan
        assert self._commit is not None
        commit = self._commit
        self._plan = self._plan_from(commit)
        too_fast = self._plan.timing.start_excess > TOLERATED_EXCESS * commit.speed_m_s
        if too_fast and self._block[commit.move].segment.zone:
            # The corner that the next move has added is too tight for the speed the arm has: it
            # was learnt too late, as if it had come after the zone was reached. Where to stop there
            # would not help, it is not to blame: plans that look at other nodes differ a little.
            stopped = self._plan_from(commit, lost_corner=commit.move)
            if stopped.timing.start_excess < 0.5 * self._plan.timing.start_excess:
                self._plan = stopped
        return self._plan

    def _plan_from(self, commit: Commit, *, lost_corner: int | None = None) -> Plan:
        first = self._first_open
        lost = None if lost_corner is None else lost_corner - first
        path = self._build(self._block[first:], lost)
        if isinstance(path, PathFault):
            raise MotionError(self._block[first + path.segment], path)
        from_m = float(path.segment_starts[commit.move - first]) + commit.distance_m
        timing = plan(path, self.limits, start=from_m, start_speed=commit.speed_m_s, look=self.look)
        return Plan(path, timing, first, from_m, commit.time_s, lost_corner)

    @property
    def _first_open(self) -> int:
        """The first move whose geometry a plan needs: the corner after it is half travelled."""
        assert self._commit is not None
        return max(self._commit.move - 1, 0)

    def _to_travel(self) -> Plan:
        """The plan of the open part; the robot makes the moves before one that it cannot make.

        Raises:
            MotionError: See `append`.
        """
        try:
            return self._planned()
        except MotionError as error:
            self._stop_before(self._first_open + error.fault.segment)
            raise

    def _build(self, moves: Sequence[QueuedMove], lost_corner: int | None) -> Path | PathFault:
        """The geometry of some moves of the block, one of which may stop where it has a zone."""
        segments = [queued.segment for queued in moves]
        if lost_corner is not None:
            segments[lost_corner] = replace(segments[lost_corner], zone=None)
        return build_path(self.robot, segments, self.model, self.look)

    def _stop_before(self, index: int) -> None:
        """Let the robot make the moves before one that it cannot make."""
        assert self._commit is not None
        block = self._block
        if index > self._commit.move:
            self._block = block[:index]
            self.close()
        self._block = block

    def _commit_start(self, index: int) -> float:
        """Fix the path up to the start of a move of the block."""
        assert self._commit is not None
        if index <= self._commit.move:
            return self._commit.time_s
        tentative = self._to_travel()
        s = tentative.start_of(index)
        time_s = self._travel(tentative, index, s)
        speed = tentative.timing.speed_at(time_s - tentative.start_s)
        self._commit = Commit(time_s, index, 0.0, speed)
        self._plan = None
        return time_s

    def _advance(self, now_s: float) -> None:
        """Fix what has been travelled by now; too late for the corner, and it becomes a stop."""
        if not self.is_open or self._halted:
            return
        assert self._commit is not None
        if now_s <= self._commit.time_s + LOOK_AHEAD_SLACK_S:
            return
        tentative = self._to_travel()
        last = self._block[-1].segment
        radius = last.zone.position if last.zone else 0.0
        length = tentative.path.length - tentative.start_of(len(self._block) - 1)
        entry = tentative.path.length - min(radius, length / 2.0)
        if now_s >= tentative.time_at(entry):
            self.close(CornerKind.STOP_CORNER_PATH_FAILURE)
            return
        s = tentative.timing.s_at(now_s - tentative.start_s)
        starts = tentative.path.segment_starts
        index = tentative.first + int(np.searchsorted(starts, s, side="right")) - 1
        index = max(index, self._commit.move)
        self._travel(tentative, index + 1, s)
        speed = tentative.timing.speed_at(now_s - tentative.start_s)
        self._commit = Commit(now_s, index, s - tentative.start_of(index), speed)
        self._plan = None

    def _travel(self, tentative: Plan, moves_begun: int, to_m: float) -> float:
        """Append a stretch of a plan to the trajectory and date the moves that begin on it."""
        path, timing = tentative.path, tentative.timing
        if tentative.lost_corner is not None:
            late = self._block[tentative.lost_corner]
            late.segment = replace(late.segment, zone=None)
            late.corner = CornerKind.STOP_CORNER_PATH_FAILURE
        piece = Piece(tentative.start_s, path, timing, tentative.from_m, to_m)
        offset_m = self.trajectory.append(piece) - tentative.from_m
        self._driven.append(tentative)
        self.version += 1
        count = moves_begun - tentative.first
        bounds = path.segment_bounds[: count + 1]
        times = (tentative.start_s + tentative.timing.time_at(bounds)).tolist()
        places, lengths = bounds.tolist(), tentative.path.lengths.tolist()
        for k, queued in enumerate(self._block[tentative.first : moves_begun]):
            if queued.started.time is None:
                queued.started.time = times[k]
            if places[k] >= tentative.from_m - 1e-12:
                queued.start_place_m = offset_m + places[k]
            queued.end_place_m = offset_m + places[k + 1]
            queued.length_m = lengths[k]
            # A move that ended before this plan begins keeps its time.
            if queued.ended_s is None or places[k + 1] >= tentative.from_m - 1e-12:
                queued.ended_s = times[k + 1]
            self._note_corner(queued, tentative.path.corners[k])
        return tentative.time_at(to_m)

    def _note_corner(self, queued: QueuedMove, corner: Corner) -> None:
        """What became of the end of a move; the last of the open block is still undecided."""
        queued.zone_m, queued.corner_reason = corner.radius, corner.reason
        if corner.stops and queued.corner is CornerKind.FLY_BY and queued is not self._block[-1]:
            queued.corner = CornerKind.STOP

    def _braking_distance_m(self, segment: Segment) -> float:
        """More than the TCP needs to stop from the programmed speed."""
        return segment.speed.tcp * self.braking_s / segment.acceleration_share
