"""The path of one robot, planned as late as possible and no later.

Moves are put on the path one by one. Nothing is planned until somebody must know: a stop point ends
the block, or the program looks at time or position. What was planned before the program could say
more is tentative; `commit` fixes the part that has been travelled, and the rest is planned again
when another move arrives, from the same place with the same speed.

A move that arrives when the robot is already within the zone of the last one is too late: that
corner has become a stop (corner path failure).
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.language.controller import Move, Place
from rapidsim.language.data import ConfData, ToolData, WobjData
from rapidsim.motion.corners import Corner
from rapidsim.motion.following import PathFault
from rapidsim.motion.limits import Limits, limits_of
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path import Path, build_path
from rapidsim.motion.robot import Robot
from rapidsim.motion.segments import Segment, Waypoint
from rapidsim.motion.timing import Timing, plan
from rapidsim.motion.trajectory import Piece, Trajectory
from rapidsim.motion.turns import vector_from_rotation
from rapidsim.simulation.journal import Instant
from rapidsim.simulation.result import CornerKind, ExecutedMove

MAX_OPEN_MOVES = 2000
"""So many moves are planned in one go; a longer block is committed as it is planned."""
LOOK_AHEAD_SLACK_S = 0.01
"""The program may think this long at a fly-by point before it makes a difference to the path."""
TOLERATED_EXCESS = 0.01
"""Share of the path speed by which a re-planned start may be too fast to brake for a new corner."""


class MotionError(Exception):
    """The path cannot be travelled; the robot stops before the move that is to blame."""

    def __init__(self, queued: QueuedMove, fault: PathFault) -> None:
        """Name the move and what is wrong with it."""
        super().__init__(fault.reason)
        self.queued = queued
        self.fault = fault


@dataclass(slots=True, eq=False)
class QueuedMove:
    """A move on the path and what becomes of it."""

    move: Move
    place: Place
    segment: Segment
    conf: ConfData
    started: Instant
    """When the robot starts the move, in command time."""
    corner: CornerKind
    zone_m: float = 0.0
    start_place_m: float = 0.0
    end_place_m: float = 0.0
    """Where the move begins and ends on the path of the whole run."""
    length_m: float = 0.0
    command_start_s: float | None = None
    """Command time of the start, for the first move of a block only."""
    ended_s: float | None = None
    """Command time of the end, as far as it is planned."""


@dataclass(frozen=True, slots=True)
class _Commit:
    """Up to here the path is fixed: a distance past the start of one of the block's moves."""

    time_s: float
    move: int
    distance_m: float
    speed_m_s: float


@dataclass(frozen=True, slots=True)
class _Plan:
    """A tentative plan of the open part of the block."""

    path: Path
    timing: Timing
    first: int
    """Index in the block of the path's first segment."""
    from_m: float
    """Where on the path the plan starts."""
    start_s: float
    """Command time at that place."""

    def time_at(self, s: float) -> float:
        return self.start_s + self.timing.time_at(s)

    def start_of(self, index: int) -> float:
        return float(self.path.segment_starts[index - self.first])


@dataclass(eq=False)
class PathQueue:
    """The moves of one robot and the trajectory they give."""

    robot: Robot
    model: MotionModel
    trajectory: Trajectory
    end: Waypoint
    """Where the last queued move ends."""
    moves: list[QueuedMove] = field(default_factory=list)
    _block: list[QueuedMove] = field(default_factory=list)
    _commit: _Commit | None = None
    _plan: _Plan | None = None
    _reckoned: tuple[_Commit, int, float] | None = None
    """From which commit, up to the start of which move, to what time `nominal_last_start` got."""
    _ready_s: float = 0.0
    """Earliest command time at which the next block may start."""

    @property
    def is_open(self) -> bool:
        """Whether a block of moves waits for its end."""
        return bool(self._block)

    @property
    def open_moves(self) -> int:
        """How many moves of the open block have not been travelled."""
        return len(self._block) - self._commit.move if self._commit else 0

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
        if not self._block:
            start_s = max(now_s, self._ready_s)
            self._commit = _Commit(start_s, 0, 0.0, 0.0)
            queued.started.time = start_s
            queued.command_start_s = start_s
        elif _frames(self._block[-1]) != _frames(queued):
            # Source: RAPID Overview, "Motion and I/O principles": a change of tool or work object
            # within a zone makes the corner path joint interpolated.
            last = self._block[-1]
            last.segment = replace(last.segment, joint_corner=True)
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
        self._block[-1].corner = corner
        tentative = self._planned()
        end_s = self._travel(tentative, len(self._block), tentative.path.length)
        self._ready_s = end_s + self.model.fine_dwell
        self._block = []
        self._commit = None
        self._plan = None
        return end_s

    def nominal_last_start(self) -> float:
        """About when the robot starts the last move [s]: at programmed speeds, without ramps."""
        commit = self._commit
        assert commit is not None
        if self._reckoned is None or self._reckoned[0] is not commit:
            self._reckoned = (commit, commit.move, commit.time_s)
        _, begin, start_s = self._reckoned
        last = len(self._block) - 1
        # Each move is added once, however often somebody asks.
        start_s += sum(_nominal_s(queued.segment) for queued in self._block[begin:last])
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
        tentative = self._planned()
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

    def joints_at(self, now_s: float) -> Array:
        """Joints (n,) [rad] of the arm now, which fixes the path up to now.

        Raises:
            MotionError: See `append`.
        """
        self._advance(now_s)
        joints: Array = self.trajectory.at(np.array([now_s])).joints[0]
        return joints

    def executed(self, task: str) -> tuple[ExecutedMove, ...]:
        """All moves that were planned, with the times at which the arm is seen to make them."""
        done = [
            (index, queued)
            for index, queued in enumerate(self.moves)
            if queued.end_place_m >= queued.start_place_m and queued.started.time is not None
        ]
        places = [[queued.start_place_m, queued.end_place_m] for _, queued in done]
        seen_s = self.trajectory.time_at_place(np.array(places).reshape(-1)).reshape(-1, 2)
        return tuple(
            _executed(index, task, queued, float(start_s), float(end_s))
            for (index, queued), (start_s, end_s) in zip(done, seen_s, strict=True)
        )

    def _planned(self) -> _Plan:
        """The open part of the block, planned to a stop at its last move."""
        if self._plan is not None:
            return self._plan
        assert self._commit is not None
        commit = self._commit
        # The corner into the first open move is half travelled: its geometry needs the move before.
        first = max(commit.move - 1, 0)
        segments = [queued.segment for queued in self._block[first:]]
        path = build_path(self.robot, segments, self.model)
        if isinstance(path, PathFault):
            self._stop_before(first + path.segment)
            raise MotionError(self._block[first + path.segment], path)
        from_m = float(path.segment_starts[commit.move - first]) + commit.distance_m
        timing = plan(path, self.limits, start=from_m, start_speed=commit.speed_m_s)
        under_way = self._block[commit.move]
        if timing.start_excess > TOLERATED_EXCESS * commit.speed_m_s and under_way.segment.zone:
            # The corner that the next move has added is too tight for the speed the arm has: it
            # was learnt too late, as if it had come after the zone was reached.
            under_way.segment = replace(under_way.segment, zone=None)
            under_way.corner = CornerKind.STOP_CORNER_PATH_FAILURE
            return self._planned()
        self._plan = _Plan(path, timing, first, from_m, commit.time_s)
        return self._plan

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
        tentative = self._planned()
        s = tentative.start_of(index)
        time_s = self._travel(tentative, index, s)
        speed = tentative.timing.speed_at(time_s - tentative.start_s)
        self._commit = _Commit(time_s, index, 0.0, speed)
        self._plan = None
        return time_s

    def _advance(self, now_s: float) -> None:
        """Fix what has been travelled by now; too late for the corner, and it becomes a stop."""
        if self._commit is None or now_s <= self._commit.time_s + LOOK_AHEAD_SLACK_S:
            return
        tentative = self._planned()
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
        self._commit = _Commit(now_s, index, s - tentative.start_of(index), speed)
        self._plan = None

    def _travel(self, tentative: _Plan, moves_begun: int, to_m: float) -> float:
        """Append a stretch of a plan to the trajectory and date the moves that begin on it."""
        piece = Piece(
            start_time=tentative.start_s,
            path=tentative.path,
            timing=tentative.timing,
            from_s=tentative.from_m,
            to_s=to_m,
        )
        offset_m = self.trajectory.append(piece) - tentative.from_m
        starts = [float(s) for s in tentative.path.segment_starts]
        ends = [*starts[1:], tentative.path.length]
        for index in range(tentative.first, moves_begun):
            queued = self._block[index]
            k = index - tentative.first
            if queued.started.time is None:
                queued.started.time = tentative.time_at(starts[k])
            if starts[k] >= tentative.from_m - 1e-12:
                queued.start_place_m = offset_m + starts[k]
            queued.end_place_m = offset_m + ends[k]
            queued.length_m = float(tentative.path.lengths[k])
            queued.ended_s = tentative.time_at(ends[k])
            self._note_corner(queued, tentative.path.corners[k])
        return tentative.time_at(to_m)

    def _note_corner(self, queued: QueuedMove, corner: Corner) -> None:
        """What became of the end of a move; the last of the open block is still undecided."""
        queued.zone_m = corner.radius
        if corner.stops and queued.corner is CornerKind.FLY_BY and queued is not self._block[-1]:
            queued.corner = CornerKind.STOP

    def _braking_distance_m(self, segment: Segment) -> float:
        """More than the TCP needs to stop from the programmed speed."""
        return segment.speed.tcp * self.braking_s / segment.acceleration_share


def _executed(
    index: int, task: str, queued: QueuedMove, start_s: float, end_s: float
) -> ExecutedMove:
    if queued.command_start_s is not None:
        # The arm may have stood at this place for a while.
        start_s = queued.command_start_s
    return ExecutedMove(
        index=index,
        task=task,
        move=queued.move,
        place=queued.place,
        corner=queued.corner,
        zone_m=queued.zone_m,
        start_s=start_s,
        end_s=max(start_s, end_s),
        length_m=queued.length_m,
        base_from_tcp=queued.segment.end.base_from_tcp,
        tcp_from_flange=queued.segment.tcp_from_flange,
        joints=queued.segment.end.joints,
        conf=queued.conf,
    )


def _nominal_s(segment: Segment) -> float:
    """Time [s] of a move at its programmed speeds, straight from start to end."""
    if segment.duration is not None:
        return segment.duration
    start, end = segment.start.base_from_tcp, segment.end.base_from_tcp
    way = float(np.linalg.norm(end.translation - start.translation))
    turn = float(np.linalg.norm(vector_from_rotation(end.rotation @ start.rotation.T)))
    return max(way / segment.speed.tcp, turn / segment.speed.reorientation)


def _frames(queued: QueuedMove) -> tuple[ToolData, WobjData]:
    return queued.move.tool, queued.move.wobj
