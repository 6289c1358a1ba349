"""Lazy planning of a path: as late as possible and no later.

Moves are appended to the path one by one. Planning waits until a result is needed: a stop point
ends the block, or the program reads time or position. A plan made before the program could queue
more is tentative; `commit` fixes the travelled part, and the rest is planned again when another
move arrives, from the same place with the same speed.

A move that arrives when the robot is already within the zone of the last one is too late: that
corner has become a stop (corner path failure).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TypeAlias

import numpy as np

from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.queued_move import MotionError, QueuedMove, frames_of, nominal_s
from rapidsim.controller.queue.block import BlockPlan, Commit, MotionBlock
from rapidsim.controller.queue.move_log import MoveLog
from rapidsim.controller.queue.plan_cache import PlanCache
from rapidsim.motion.geometry.blends import Corner
from rapidsim.motion.geometry.segments import Segment
from rapidsim.motion.interruption import Look, undisturbed
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.path import Path
from rapidsim.motion.timing.axis_limits import Limits
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.timing.time_scaling import TimeScaling
from rapidsim.motion.trajectory.command import Piece
from rapidsim.motion.trajectory.trajectory import Trajectory

MAX_OPEN_MOVES = 2000
"""Maximum number of moves planned in one go; a longer block is committed as it is planned."""
LOOK_AHEAD_SLACK_S = 0.01
"""The program may compute this long at a fly-by point before it affects the path, and after a stop
before it counts as waiting."""
_ROUNDING_S = 1e-9
TOLERATED_EXCESS = 0.01
"""Share of the path speed by which a re-planned start may be too fast to brake for a new corner."""

Build: TypeAlias = Callable[[Sequence[QueuedMove], int | None], Path]
"""Builds the geometry of moves, one of which, by its index, may stop where it has a zone; raises a
`MotionError` that blames a move."""
Moved: TypeAlias = Callable[[Sequence[QueuedMove], Path | None], None]
"""Receives moves that were timed, withdrawn or truncated, with the path on which they began."""


def untold(moves: Sequence[QueuedMove], path: Path | None) -> None:
    """Ignore the moves: for robots without an observer of them."""


@dataclass(eq=False)
class BlockPlanner:
    """Turns moves into motion, block by block, for one robot or several that move as one."""

    trajectory: Trajectory
    model: MotionModel
    limits: Limits
    """Axis speeds and accelerations for timing."""
    build: Build
    moved: Moved = untold
    check_deadline: Look = undisturbed
    """Called while planning; raises to interrupt it."""
    repeats: PlanCache | None = None
    """Plans kept for repeated blocks; None if they are not kept."""
    ready_s: float = 0.0
    """Earliest command time at which the next block may start."""
    settled_s: float = -math.inf
    """Time [s] at which the arm comes to rest at the end of the last block."""
    moves: MoveLog = field(default_factory=MoveLog)
    """All moves that were ever appended to the path."""
    block: MotionBlock = field(default_factory=MotionBlock)
    version: int = 0
    """Changes whenever the planned motion of the robot may change."""
    _preview: tuple[int, Trajectory] | None = None
    _estimated: tuple[Commit, int, float] | None = None
    """Progress of `nominal_last_start`: its commit, the move reached, the start of that [s]."""

    @property
    def is_open(self) -> bool:
        """Whether a block of moves is open: its end is not decided."""
        return self.block.is_open

    @property
    def is_halted(self) -> bool:
        """Whether a stop keeps the robot where it is."""
        return self.block.is_halted

    @property
    def open_moves(self) -> int:
        """Number of moves of the open block that are not yet travelled."""
        return len(self.block.moves) - self.block.commit.move if self.is_open else 0

    @cached_property
    def braking_s(self) -> float:
        """More time [s] than the arm needs to stop: the longest braking time of any axis."""
        return float(np.max(self.limits.max_speed / self.limits.max_acceleration))

    def append(self, queued: QueuedMove, now_s: float) -> None:
        """Append a move to the path.

        Args:
            queued: The move.
            now_s: Command time [s] of the program. While the path of a block is planned lazily, the
                time at which the robot starts the last move will do.

        Raises:
            MotionError: When a move already on the path turns out not to be passable.
        """
        self.advance(now_s)
        self.version += 1
        if not self.is_open:
            start_s = self._next_start_s(now_s)
            commit = Commit(start_s, 0, 0.0, 0.0)
            self.block = MotionBlock(commit=commit, is_halted=self.block.is_halted)
            queued.started.time = start_s
            queued.command_start_s = start_s
        else:
            last = self.block.moves[-1]
            if frames_of(last) != frames_of(queued):
                # Source: RAPID Overview, "Motion and I/O principles": a change of tool or work
                # object within a zone makes the corner path joint interpolated.
                last.segment = replace(last.segment, joint_corner=True)
            if queued.segment.ramp > last.segment.ramp:
                # The window of the smoothing becomes narrower only where it is empty.
                queued.segment = replace(queued.segment, ramp=last.segment.ramp)
        queued.number = len(self.moves)
        self.block.moves.append(queued)
        self.moves.append(queued)
        self.block.plan = None

    def _next_start_s(self, now_s: float) -> float:
        """Command time [s] at which a block begins that the program starts at a time [s].

        After a slow stop the command continues before the arm is quite at rest, but the program has
        waited for that. Computing since then counts from the time at which the program was delayed.
        """
        thought_s = now_s - self.settled_s
        at_once = -_ROUNDING_S < thought_s < LOOK_AHEAD_SLACK_S
        kept_s = max(0.0, self.settled_s - self.ready_s) if at_once else 0.0
        return max(now_s - kept_s, self.ready_s)

    def close(self, corner: CornerKind = CornerKind.STOP) -> float:
        """End the block with a stop at its last move and plan all of it.

        Returns:
            Command time [s] at which the stop point is reached.

        Raises:
            MotionError: See `append`.
        """
        if self.block.moves[-1].corner is CornerKind.FLY_BY:
            self.block.moves[-1].corner = corner
        tentative = self._to_travel()
        end_s = self._travel(tentative, len(self.block.moves), tentative.path.length)
        stop = self.block.moves[-1].move.stop
        lag_s = self.trajectory.lag_s(end_s)
        pause_s = lag_s + stop.seconds if stop else 0.0
        # A window that a ramp has widened takes longer to run empty; the standstill has the same
        # duration, and the next move waits until the window is empty.
        dwell_s = self.model.dwell_after(tentative.timing.braking_s) + (lag_s - self.model.window)
        if self.trajectory.has_ramps:
            dwell_s = max(dwell_s, lag_s)
        self.ready_s = end_s + max(dwell_s, pause_s)
        # Without motion there is nothing to bring to rest.
        self.settled_s = end_s + lag_s if tentative.timing.braking_s > 0.0 else -math.inf
        self.block.is_closed = True
        self.block.plan = None
        return end_s

    def forget(self, before_s: float, keep_from: int | None = None) -> None:
        """Discard what no read at a time [s] or later needs.

        Args:
            before_s: That time.
            keep_from: Number of a move that is kept with all that follow; None for none.
        """
        self.trajectory.forget(before_s)
        before, gone = self.block.commit, self.block.forget(before_s)
        if self._estimated is not None and self._estimated[0] is before:
            _, last, start_s = self._estimated
            self._estimated = (self.block.commit, last - gone, start_s)
        needed = self.block.moves[0].number if self.block.moves else len(self.moves)
        self.moves.forget(before_s, needed if keep_from is None else min(needed, keep_from))

    def preview(self) -> Trajectory:
        """Trajectory if no further move is queued.

        Raises:
            MotionError: See `append`.
        """
        if not self.is_open or self.block.is_halted:
            return self.trajectory
        if self._preview is None or self._preview[0] != self.version:
            plan = self.planned()
            first = self.block.moves[plan.first].number
            rest = Piece(plan.start_s, plan.path, plan.timing, plan.from_m, plan.path.length, first)
            self._preview = (self.version, self.trajectory.extended(rest))
        return self._preview[1]

    def places_of(self, queued: QueuedMove) -> tuple[float, float] | None:
        """Path positions [m] of start and end of a move of the current block; None for others."""
        moves = self.block.moves
        index = queued.number - moves[0].number if moves else -1
        if not 0 <= index < len(moves) or moves[index] is not queued:
            return None
        plan = self.planned() if self.is_open and not self.block.is_halted else None
        if plan is None or index < plan.first:
            return queued.start_place_m, queued.end_place_m
        offset = self.trajectory.length - plan.from_m
        end = float(plan.path.segment_bounds[index - plan.first + 1])
        return offset + plan.start_of(index), offset + end

    def nominal_last_start(self) -> float:
        """About when the robot starts the last move [s]: at programmed speeds, without ramps."""
        commit = self.block.commit
        if self._estimated is None or self._estimated[0] is not commit:
            self._estimated = (commit, commit.move, commit.time_s)
        _, begin, start_s = self._estimated
        last = len(self.block.moves) - 1
        # Each move is added once, however often this is called.
        start_s += sum(nominal_s(queued.segment) for queued in self.block.moves[begin:last])
        self._estimated = (commit, last, start_s)
        return start_s

    def commit_last_start(self) -> float:
        """Plan what is known and fix it up to the start of the last move.

        Returns:
            Command time [s] of that start.

        Raises:
            MotionError: See `append`.
        """
        return self._commit_start(len(self.block.moves) - 1)

    def commit_ahead(self) -> float | None:
        """Fix as much as later moves cannot change: a braking distance remains open.

        Returns:
            Command time [s] up to which the path is fixed; None if nothing could be fixed.

        Raises:
            MotionError: See `append`.
        """
        tentative = self._to_travel()
        index = len(self.block.moves) - 1
        ahead_m = 0.0
        while index > self.block.commit.move:
            ahead_m = tentative.path.length - tentative.start_of(index)
            if ahead_m >= self._braking_distance_m(self.block.moves[index].segment):
                break
            index -= 1
        if index <= self.block.commit.move:
            return None
        return self._commit_start(index)

    def planned(self) -> BlockPlan:
        """The open part of the block, planned to a stop at its last move; nothing else changes.

        Raises:
            MotionError: If a section of it cannot be travelled.
        """
        block, commit = self.block, self.block.commit
        if block.plan is not None:
            return block.plan
        block.plan = self._plan_from(commit)
        too_fast = block.plan.timing.start_excess > TOLERATED_EXCESS * commit.speed_m_s
        if too_fast and block.moves[commit.move].segment.zone:
            # The corner that the next move has added is too tight for the speed of the arm: that
            # move came too late, as if after the zone was reached. If a stop there does not help,
            # the corner is not the cause: plans on other grid points differ slightly.
            stopped = self._plan_from(commit, lost_corner=commit.move)
            if stopped.timing.start_excess < 0.5 * block.plan.timing.start_excess:
                block.plan = stopped
        return block.plan

    def _plan_from(self, commit: Commit, *, lost_corner: int | None = None) -> BlockPlan:
        first = self._first_open
        lost = None if lost_corner is None else lost_corner - first
        moves, begun = self.block.moves[first:], commit.move - first

        def made() -> tuple[Path, TimeScaling]:
            path = self.build(moves, lost)
            timing = plan(
                path,
                self.limits,
                start=float(path.segment_starts[begun]) + commit.distance_m,
                start_speed=commit.speed_m_s,
                spent_s=commit.spent_s,
                check_deadline=self.check_deadline,
            )
            return path, timing

        if self.repeats is None or lost is not None:
            path, timing = made()
        else:
            start = (begun, commit.distance_m, commit.speed_m_s, commit.spent_s)
            path, timing = self.repeats.plan([one.segment for one in moves], start, made)
        from_m = float(path.segment_starts[begun]) + commit.distance_m
        return BlockPlan(path, timing, first, from_m, commit.time_s, lost_corner)

    @property
    def _first_open(self) -> int:
        """Index of the first move that a plan needs: the corner after it is half travelled."""
        return max(self.block.commit.move - 1, 0)

    def _to_travel(self) -> BlockPlan:
        """The plan of the open part; the robot makes the moves before one that it cannot make.

        Raises:
            MotionError: See `append`.
        """
        try:
            return self.planned()
        except MotionError as error:
            self._stop_before(self._first_open + error.fault.segment)
            raise

    def _stop_before(self, index: int) -> None:
        """Plan the moves before the one that the robot cannot make, up to a stop."""
        moves = self.block.moves
        if index > self.block.commit.move:
            self.block.moves = moves[:index]
            self.close()
        self.block.moves = moves

    def _commit_start(self, index: int) -> float:
        """Fix the path up to the start of a move of the block; return its command time [s]."""
        if index <= self.block.commit.move:
            return self.block.commit.time_s
        tentative = self._to_travel()
        s = tentative.start_of(index)
        time_s = self._travel(tentative, index, s)
        speed = tentative.timing.speed_at(time_s - tentative.start_s)
        self.block.commit = Commit(time_s, index, 0.0, speed)
        self.block.plan = None
        return time_s

    def advance(self, now_s: float, slack_s: float = LOOK_AHEAD_SLACK_S) -> None:
        """Fix what has been travelled by now; too late for its corner, the block ends with a stop.

        Args:
            now_s: Command time [s].
            slack_s: Time [s] that need not be fixed.

        Raises:
            MotionError: See `append`.
        """
        tentative = self._open_plan(now_s, slack_s)
        if tentative is None:
            return
        s = tentative.timing.s_at(now_s - tentative.start_s)
        starts = tentative.path.segment_starts
        index = tentative.first + int(np.searchsorted(starts, s, side="right")) - 1
        index = max(index, self.block.commit.move)
        self._travel(tentative, index + 1, s)
        speed = tentative.timing.speed_at(now_s - tentative.start_s)
        spent_s = self._spent_s(index, now_s)
        self.block.commit = Commit(now_s, index, s - tentative.start_of(index), speed, spent_s)
        self.block.plan = None

    def end_if_late(self, now_s: float) -> None:
        """End the block if it is too late for a corner now [s]; the rest remains open.

        Raises:
            MotionError: See `append`.
        """
        self._open_plan(now_s, 0.0)

    def _open_plan(self, now_s: float, slack_s: float) -> BlockPlan | None:
        """Plan of an open block that has to be fixed further; None if none, or if it ended late."""
        if not self.is_open or self.block.is_halted:
            return None
        if now_s <= self.block.commit.time_s + slack_s:
            return None
        tentative = self._to_travel()
        last = self.block.moves[-1].segment
        radius = last.zone.position if last.zone else 0.0
        length = tentative.path.length - tentative.start_of(len(self.block.moves) - 1)
        entry = tentative.path.length - min(radius, length / 2.0)
        if now_s >= tentative.time_at(entry):
            self.close(CornerKind.STOP_CORNER_PATH_FAILURE)
            return None
        return tentative

    def _spent_s(self, index: int, now_s: float) -> float | None:
        """Time [s] that a move of the block has taken up to now; None if it was stopped."""
        commit, started = self.block.commit, self.block.moves[index].started.time
        if index > commit.move and started is not None:
            return now_s - started
        return None if commit.spent_s is None else commit.spent_s + (now_s - commit.time_s)

    def _travel(self, tentative: BlockPlan, moves_started: int, to_m: float) -> float:
        """Append a section of a plan to the trajectory and time the moves that begin on it."""
        path, timing = tentative.path, tentative.timing
        if tentative.lost_corner is not None:
            late = self.block.moves[tentative.lost_corner]
            late.segment = replace(late.segment, zone=None)
            late.corner = CornerKind.STOP_CORNER_PATH_FAILURE
        first = self.block.moves[tentative.first].number
        piece = Piece(tentative.start_s, path, timing, tentative.from_m, to_m, first)
        offset_m = self.trajectory.append(piece) - tentative.from_m
        self.block.driven.append(tentative)
        self.version += 1
        count = moves_started - tentative.first
        bounds = path.segment_bounds[: count + 1]
        times = (tentative.start_s + tentative.timing.time_at(bounds)).tolist()
        places, lengths = bounds.tolist(), tentative.path.lengths.tolist()
        for k, queued in enumerate(self.block.moves[tentative.first : moves_started]):
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
        self.moved(self.block.moves[tentative.first : moves_started], path)
        return tentative.time_at(to_m)

    def _note_corner(self, queued: QueuedMove, corner: Corner) -> None:
        """Record the corner at the end of a move; that of the last open move is undecided."""
        queued.zone_m, queued.corner_reason = corner.radius, corner.reason
        is_last = queued is self.block.moves[-1]
        if corner.stops and queued.corner is CornerKind.FLY_BY and not is_last:
            queued.corner = CornerKind.STOP

    def _braking_distance_m(self, segment: Segment) -> float:
        """Distance [m] above that which the TCP needs to stop from the programmed speed."""
        return segment.speed.tcp * self.braking_s / segment.acceleration_share
