"""Motion queue of one robot, or of several that move as one, with lazy planning.

Moves are appended to the path one by one: a move of the queue consists of one move of each robot.
Planning waits until a result is needed: a stop point ends the block, or the program reads time or
position. A plan made before the program could queue more is tentative; `commit` fixes the travelled
part, and the rest is planned again when another move arrives, from the same place with the same
speed.

A move that arrives when the robot is already within the zone of the last one is too late: that
corner has become a stop (corner path failure).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.queued_move import MotionError, QueuedMove, frames_of, nominal_s
from rapidsim.controller.queue.block import BlockPlan, Commit, empty_block
from rapidsim.controller.queue.brief_moves import (
    WAIT_AFTER,
    WAIT_BEFORE,
    shares_a_wait,
    with_less_torque,
)
from rapidsim.controller.queue.member import Member
from rapidsim.controller.queue.path_planner import PathPlanner, PlanStart
from rapidsim.controller.queue.synchronised_tasks import SynchronisedTasks
from rapidsim.frames.transform import Transform
from rapidsim.motion.geometry.blends import Corner
from rapidsim.motion.geometry.segments import Segment, Waypoint
from rapidsim.motion.interruption import Look, undisturbed
from rapidsim.motion.path.path import Path
from rapidsim.motion.trajectory.command import Piece
from rapidsim.motion.trajectory.trajectory import Trajectory

MAX_OPEN_MOVES = 2000
"""Maximum number of moves planned in one go; a longer block is committed as it is planned."""
REMEMBERED_S = 10.0
"""Motion history [s] kept of a robot: more than any reader, or smoothing, needs."""
LOOK_AHEAD_SLACK_S = 0.01
"""The program may compute this long at a fly-by point before it affects the path, and after a stop
before it counts as waiting."""
_ROUNDING_S = 1e-9
_ROUNDING_M = 1e-12
_NO_WAY_M = 1e-6
"""A robot that moves no farther than this [m] is at rest, or is carried along."""
TOLERATED_EXCESS = 0.004
"""Share of the path speed by which a re-planned start may be too fast to brake for a new corner."""


class MotionQueue:
    """Turns moves into motion, block by block.

    Every method that plans raises `MotionError` if the path turns out not to be passable.
    """

    def __init__(
        self,
        members: Sequence[Member],
        check_deadline: Look = undisturbed,
        team: SynchronisedTasks | None = None,
    ) -> None:
        """Begin without moves.

        Args:
            members: The robots, at rest.
            check_deadline: Called while planning; raises to interrupt it.
            team: Their tasks, if their moves are synchronised; None for a robot that moves alone.
        """
        self.members, self.team = tuple(members), team
        self.planner = PathPlanner(members, check_deadline)
        self.block = empty_block(len(members))
        self.version = 0
        """Changes whenever the planned motion of the robots may change."""
        self.left_at: dict[int, Waypoint] = {}
        """Waypoints at which robots, by number, left the path, until it is resumed."""
        self.stored_by: set[int] = set()
        """Numbers of the robots whose tasks have stored the path; all stay halted meanwhile."""
        self.next_level: MotionQueue | None = None
        """Queue through which the robots move together while this path is stored."""
        # In logs of two synchronised arms with different durations of smoothing its middle is the
        # same: the command of the quicker arm is later by half of the difference.
        windows_s = [one.model.window for one in members]
        self.delays_s = tuple(0.5 * (max(windows_s) - window_s) for window_s in windows_s)
        """Delay [s] of each robot's command."""
        limits = self.planner.limits
        self.braking_s = float(np.max(limits.max_speed / limits.max_acceleration))
        """More time [s] than any arm needs to stop: the longest braking time of any axis."""
        self._previews: tuple[int, dict[int, Trajectory]] = 0, {}
        self._estimated: tuple[Commit, int, float] | None = None
        """Progress of `nominal_last_start`: its commit, the move reached, the start of that [s]."""

    @property
    def is_open(self) -> bool:
        """Whether a block of moves is open: its end is not decided."""
        return self.block.is_open

    @property
    def is_halted(self) -> bool:
        """Whether a stop keeps the robots where they are."""
        return self.block.is_halted

    @property
    def open_moves(self) -> int:
        """Number of moves of the open block that are not yet travelled."""
        return len(self.block.moves) - self.block.commit.move if self.is_open else 0

    @property
    def command_end(self) -> float:
        """End [s] of the fixed motion; 0 without any."""
        return self.members[0].trajectory.command_end - self.delays_s[0]

    @property
    def ready_s(self) -> float:
        """Earliest command time at which the next block may start."""
        return max(one.ready_s for one in self.members)

    def append(self, parts: Sequence[QueuedMove], now_s: float) -> None:
        """Append a move to the path.

        Args:
            parts: The move of each robot; all have the same start, kind of corner and ramps.
            now_s: Command time [s] of the program. While the path of a block is planned lazily, the
                time at which the robot starts the last move will do.

        Raises:
            MotionError: When a move already on the path turns out not to be passable.
        """
        self.advance(now_s)
        self.version += 1
        start_s = None
        if not self.is_open:
            is_brief = shares_a_wait(self.planner, self.members, parts)
            if is_brief:
                for member, queued in zip(self.members, parts, strict=True):
                    member.ready_s -= (1.0 - WAIT_BEFORE) * member.waited_s
                    with_less_torque(queued)
            start_s = self._next_start_s(now_s)
            self.block = empty_block(len(self.members), is_halted=self.block.is_halted)
            self.block.commit = Commit(start_s, 0, 0.0, 0.0)
            self.block.is_brief = is_brief
        for member, row, queued in zip(self.members, self.block.rows, parts, strict=True):
            if start_s is not None:
                queued.started.time = queued.command_start_s = start_s
            else:
                last = row[-1]
                if frames_of(last) != frames_of(queued):
                    # Source: RAPID Overview, "Motion and I/O principles": a change of tool or work
                    # object within a zone makes the corner path joint interpolated.
                    last.segment = replace(last.segment, joint_corner=True)
                if queued.segment.ramp > last.segment.ramp:
                    # The window of the smoothing becomes narrower only where it is empty.
                    queued.segment = replace(queued.segment, ramp=last.segment.ramp)
            row.append(queued)
            member.add((queued,))
        self.block.plan = None

    def extend(self, moves: Sequence[QueuedMove]) -> None:
        """Append moves of a robot alone like the last one, whose statements follow it at once."""
        (member,), (row,) = self.members, self.block.rows
        self.version += 1
        row.extend(moves)
        member.add(moves)
        self.block.plan = None

    def _next_start_s(self, now_s: float) -> float:
        """Command time [s] at which a block begins that the program starts at a time [s].

        After a slow stop the command continues before the arm is quite at rest, but the program has
        waited for that. Computing since then counts from the time at which the program was delayed.
        """
        settled_s = max(one.settled_s for one in self.members)
        at_once = -_ROUNDING_S < now_s - settled_s < LOOK_AHEAD_SLACK_S
        kept_s = max(0.0, settled_s - self.ready_s) if at_once else 0.0
        return max(now_s - kept_s, self.ready_s)

    def close(self, corner: CornerKind = CornerKind.STOP) -> float:
        """End the block with a stop at its last move and plan all of it.

        Returns:
            Command time [s] at which the stop point is reached.
        """
        last = [row[-1] for row in self.block.rows]
        for queued in last:
            if queued.corner is CornerKind.FLY_BY:
                queued.corner = corner
        tentative = self._to_travel()
        end_s = self._travel(tentative, len(self.block.moves), tentative.path.length)
        lead = self.members[0]
        lag_s = lead.trajectory.lag_s(end_s + self.delays_s[0])
        pause_s = max(lag_s + one.move.stop.seconds if one.move.stop else 0.0 for one in last)
        # A window that a ramp has widened takes longer to run empty; the standstill has the same
        # duration, and the next move waits until the window is empty.
        dwell_s = lead.model.dwell_after(tentative.timing.braking_s) + (lag_s - lead.model.window)
        if self.block.is_brief:
            dwell_s *= WAIT_AFTER
        if lead.trajectory.has_ramps:
            dwell_s = max(dwell_s, lag_s)
        for member in self.members:
            member.waited_s = dwell_s
            member.ready_s = end_s + max(dwell_s, pause_s)
            # Without motion there is nothing to bring to rest.
            member.settled_s = end_s + lag_s if tentative.timing.braking_s > 0.0 else -math.inf
        self.block.is_closed = True
        self.block.plan = None
        return end_s

    def begin_again(self, ready_s: float) -> None:
        """Continue without moves from where the robots have moved otherwise, up to a time [s]."""
        self.version += 1
        for member in self.members:
            member.ready_s = max(member.ready_s, ready_s)
        self.block = empty_block(len(self.members), is_halted=self.is_halted)

    def forget(self, before_s: float) -> None:
        """Discard the moves of the block that no read at a time [s] or later needs."""
        before, gone = self.block.commit, self.block.forget(before_s)
        if self._estimated is not None and self._estimated[0] is before:
            _, last, start_s = self._estimated
            self._estimated = (self.block.commit, last - gone, start_s)

    def preview(self, number: int) -> Trajectory:
        """Trajectory of the robot of this number if no further move is queued."""
        own = self.members[number].trajectory
        if not self.is_open or self.is_halted:
            return own
        if self._previews[0] != self.version:
            self._previews = self.version, {}
        preview = self._previews[1].get(number)
        if preview is None:
            plan = self.planned()
            rest = self._piece(number, plan, plan.path.length)
            preview = self._previews[1][number] = own.extended(rest)
        return preview

    def _piece(self, number: int, plan: BlockPlan, to_m: float) -> Piece:
        """A plan up to a position [m] of its path, as motion of the robot of this number."""
        start_s, path = plan.start_s + self.delays_s[number], plan.path.parts[number]
        first = self.block.rows[number][plan.first].number
        return Piece(start_s, path, plan.timing, plan.from_m, to_m, first)

    def drive(self, plan: BlockPlan, to_m: float) -> list[float]:
        """Append a plan up to a position [m] of its path to the motion of the robots.

        Returns:
            Position [m] of the start of its path on the path of each robot's whole run.
        """
        return [
            member.trajectory.append(self._piece(number, plan, to_m)) - plan.from_m
            for number, member in enumerate(self.members)
        ]

    def places_of(self, number: int, queued: QueuedMove) -> tuple[float, float] | None:
        """Path positions [m] of start and end of a robot's move of the block; None for others."""
        index = self.block.index_of(number, queued)
        if index is None:
            return None
        plan = self.planned() if self.is_open and not self.is_halted else None
        if plan is None or index < plan.first:
            return queued.start_place_m, queued.end_place_m
        offset = self.members[number].trajectory.length - plan.from_m
        end = float(plan.path.segment_bounds[index - plan.first + 1])
        return offset + plan.start_of(index), offset + end

    def path_ratio(self, number: int, queued: QueuedMove) -> float:
        """Change [m] of the path position per metre that the TCP travels on a robot's move."""
        index, places = self.block.index_of(number, queued), self.places_of(number, queued)
        if len(self.members) == 1 or index is None or places is None:
            return 1.0
        length_m = queued.length_m
        if self.is_open and not self.is_halted:
            plan = self.planned()
            if index >= plan.first:
                length_m = float(plan.path.parts[number].lengths[index - plan.first])
        return (places[1] - places[0]) / length_m if length_m > _NO_WAY_M else 1.0

    def nominal_last_start(self) -> float:
        """About when the robots start the last move [s]: at programmed speeds, without ramps."""
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
        """
        return self._commit_start(len(self.block.moves) - 1)

    def commit_ahead(self) -> float | None:
        """Fix as much as later moves cannot change: a braking distance remains open.

        Returns:
            Command time [s] up to which the path is fixed; None if nothing could be fixed.
        """
        tentative = self._to_travel()
        index = len(self.block.moves) - 1
        while index > self.block.commit.move:
            ahead_m = tentative.path.length - tentative.start_of(index)
            segment = tentative.path.segments[index - tentative.first]
            if ahead_m >= self._braking_distance_m(segment):
                break
            index -= 1
        if index <= self.block.commit.move:
            return None
        time_s = self._commit_start(index)
        self._settle()
        return time_s

    def _settle(self) -> None:
        """Forget the travelled moves of a long block, and let them settle in the logs."""
        if self.block.commit.move < MAX_OPEN_MOVES // 2:
            return
        self.forget(self.block.commit.time_s - REMEMBERED_S)
        for member, row in zip(self.members, self.block.rows, strict=True):
            if not member.level:
                member.moves.settle(row[0].number)

    def planned(self) -> BlockPlan:
        """The open part of the block, planned to a stop at its last move; nothing else changes."""
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
        rows = [row[first:] for row in self.block.rows]
        begun = commit.move - first
        start = PlanStart(begun, commit.distance_m, commit.speed_m_s, commit.spent_s, commit.time_s)
        path, timing = self.planner.plan(rows, start, lost)
        from_m = float(path.segment_starts[begun]) + commit.distance_m
        return BlockPlan(path, timing, first, from_m, commit.time_s, lost_corner)

    @property
    def _first_open(self) -> int:
        """Index of the first move that a plan needs: the corner after it is half travelled."""
        return max(self.block.commit.move - 1, 0)

    def _to_travel(self) -> BlockPlan:
        """The plan of the open part; the robots make the moves before one that cannot be made."""
        try:
            return self.planned()
        except MotionError as error:
            self._stop_before(self._first_open + error.fault.segment)
            raise

    def _stop_before(self, index: int) -> None:
        """Plan the moves before the one that a robot cannot make, up to a stop."""
        rows = self.block.rows
        if index > self.block.commit.move:
            self.block.rows = tuple(row[:index] for row in rows)
            self.close()
        self.block.rows = rows

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
        """End the block if it is too late for a corner now [s]; the rest remains open."""
        self._open_plan(now_s, 0.0)

    def _open_plan(self, now_s: float, slack_s: float) -> BlockPlan | None:
        """Plan of an open block that has to be fixed further; None if none, or if it ended late."""
        if not self.is_open or self.is_halted:
            return None
        if now_s <= self.block.commit.time_s + slack_s:
            return None
        tentative = self._to_travel()
        zone = tentative.path.segments[-1].zone
        radius = zone.position if zone else 0.0
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
        """Append a section of a plan to the motion and time the moves that begin on it."""
        path, first = tentative.path, tentative.first
        if tentative.lost_corner is not None:
            for row in self.block.rows:
                late = row[tentative.lost_corner]
                late.segment = replace(late.segment, zone=None)
                late.corner = CornerKind.STOP_CORNER_PATH_FAILURE
        self.block.driven.append(tentative)
        self.version += 1
        bounds = path.segment_bounds[: moves_started - first + 1]
        times = (tentative.start_s + tentative.timing.time_at(bounds)).tolist()
        places = bounds.tolist()
        if path.belts is not None:
            self._keep_on_belt(path, first, moves_started + 1)
        offsets = self.drive(tentative, to_m)
        for row, part, offset_m in zip(self.block.rows, path.parts, offsets, strict=True):
            lengths, corners = part.lengths.tolist(), part.corners
            for k, queued in enumerate(row[first:moves_started]):
                # A move that was stopped before any of it was fixed began before this plan.
                if queued.ended_s is None or places[k] >= tentative.from_m - _ROUNDING_M:
                    queued.start_place_m = offset_m + places[k]
                if queued.started.time is None:
                    queued.started.time = times[k]
                queued.length_m = lengths[k]
                # A move that ended before this plan begins keeps its end.
                if queued.ended_s is None or places[k + 1] >= tentative.from_m - _ROUNDING_M:
                    queued.ended_s = times[k + 1]
                    queued.end_place_m = offset_m + places[k + 1]
                self._note_corner(queued, corners[k], path.corners[k], is_last=queued is row[-1])
        return tentative.time_at(to_m)

    def _keep_on_belt(self, path: Path, first: int, until: int) -> None:
        """Let moves of a robot on a belt be those of a plan, which the robot has begun."""
        member, row = self.members[0], self.block.rows[0]
        for queued, segment in zip(row[first:until], path.segments, strict=False):
            before = queued.segment
            # With the speeds of the program: each plan finds anew which the belt allows.
            queued.segment = replace(
                segment,
                speed=before.speed,
                duration=before.duration,
                acceleration_share=before.acceleration_share,
                slowed_for_belt=False,
            )
            here, there = map(member.robot.forward, (before.end.joints, segment.end.joints))
            pose, moved = queued.base_from_tcp, there.translation - here.translation
            queued.base_from_tcp = Transform(pose.rotation, pose.translation + moved)
            if queued is row[-1]:
                member.end = segment.end

    def _note_corner(
        self, queued: QueuedMove, own: Corner, common: Corner, *, is_last: bool
    ) -> None:
        """Record the corner at the end of a move; that of the last open move is undecided."""
        queued.zone_m, queued.corner_reason = own.radius, own.reason
        if common.stops and queued.corner is CornerKind.FLY_BY and not is_last:
            queued.corner = CornerKind.STOP

    def _braking_distance_m(self, segment: Segment) -> float:
        """Distance [m] above that which the TCP needs to stop from the programmed speed."""
        return segment.speed.tcp * self.braking_s / segment.acceleration_share
