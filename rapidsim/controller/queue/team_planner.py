"""Path planning of a team: one path queue, whose moves consist of moves of several robots.

A move of the team consists of one move of each robot. It is appended to the path when the last task
has submitted its part; planning, stopping and starting work as for one robot, on the joint path.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.queued_move import MotionError, QueuedMove, frames_of
from rapidsim.controller.queue import stopping
from rapidsim.controller.queue.move_log import MoveLog
from rapidsim.controller.queue.path_planner import BlockPlanner
from rapidsim.controller.queue.solo_queue import SoloQueue
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.motion.geometry.segments import Waypoint
from rapidsim.motion.path.path import Path
from rapidsim.motion.path.synchronised_path import TeamPath
from rapidsim.motion.path.team_building import TeamFault, build_team
from rapidsim.motion.timing.axis_limits import combined_limits
from rapidsim.motion.trajectory.command import Piece
from rapidsim.motion.trajectory.trajectory import Trajectory

_NO_WAY_M = 1e-6
"""A robot that moves no farther than this [m] is at rest, or is carried along."""


@dataclass(slots=True, eq=False)
class TeamMove(QueuedMove):
    """One move of all robots."""

    parts: tuple[QueuedMove, ...] = ()
    """In the order of the team."""


@dataclass(slots=True, eq=False)
class PendingTeamMove:
    """A move of the team that waits for the parts of other tasks."""

    sync_id: float
    parts: dict[int, QueuedMove] = field(default_factory=dict)
    """By the robot's number in the team."""
    is_complete: bool = False


class _TeamTrajectory(Trajectory):
    """Motion over the common parameter; appends to the motion of each robot, too.

    Arms differ in the duration of the smoothing. In logs of two synchronised arms its middle is the
    same: the command of the quicker arm is later by half of the difference.
    """

    def __init__(self, robots: Sequence[SoloQueue], moves: MoveLog) -> None:
        own = robots[0]
        model = own.planner.model
        super().__init__(own.end, model.window, model.smoothing, model.filter_averages)
        self._robots, self._moves = robots, moves
        widths_s = [robot.planner.model.window for robot in robots]
        self.delays_s = tuple(0.5 * (max(widths_s) - width_s) for width_s in widths_s)

    def append(self, piece: Piece) -> float:
        """Append a piece to the motion of each robot, too."""
        path = piece.path
        assert isinstance(path, TeamPath)
        lead = self._moves[piece.first]
        assert isinstance(lead, TeamMove)
        for number, (robot, delay_s) in enumerate(zip(self._robots, self.delays_s, strict=True)):
            first, later_s = lead.parts[number].number, piece.start_time + delay_s
            own = replace(piece, path=path.part(number), start_time=later_s, first=first)
            robot.trajectory.append(own)
        return super().append(piece)

    def cut(self, time_s: float) -> None:
        """Withdraw the command after a time [s], for each robot, too."""
        for robot, delay_s in zip(self._robots, self.delays_s, strict=True):
            robot.trajectory.cut(time_s + delay_s)
        super().cut(time_s)


class TeamPlanner:
    """Planner of the joint path of several robots, planned like that of one robot."""

    def __init__(self, tasks: Sequence[str], robots: Sequence[SoloQueue]) -> None:
        """Make a team of robots at rest.

        Args:
            tasks: Names of their tasks.
            robots: Their own queues, in the order of the tasks.
        """
        lead, moves = robots[0].planner, MoveLog()
        self.tasks = tuple(tasks)
        self.robots = tuple(robots)
        self.offer: PendingTeamMove | None = None
        self._trajectory = _TeamTrajectory(robots, moves)
        self.planner = BlockPlanner(
            self._trajectory,
            lead.model,
            combined_limits([robot.planner.limits for robot in robots]),
            self._build,
            self._pass_on,
            lead.check_deadline,
            ready_s=max(robot.planner.ready_s for robot in robots),
            moves=moves,
        )
        self.waiting: dict[int, int] = {}
        """Robots whose next move depends on another's, by number, with the number of that other."""
        self.holders: set[int] = set()
        """Numbers of the robots whose tasks have stopped the team and not restarted it."""
        self._offsets = tuple(robot.trajectory.length for robot in robots)
        """Position [m] of the start of the joint path on the path of each robot's whole run."""
        self._start_offsets: dict[int, tuple[float, ...]] = {}
        """The offsets of moves, by number, that began before the path was stored."""
        self._end_offsets: dict[int, tuple[float, ...]] = {}
        """The offsets of moves, by number, that ended before the path was stored."""
        self._stored_by: set[int] = set()
        """Numbers of the robots whose tasks have stored the path."""
        self._left_at: dict[int, Waypoint] = {}
        """Waypoints at which these robots left the path, until it is resumed."""
        self._next_level: TeamPlanner | None = None

    def submitted(self, number: int) -> QueuedMove | None:
        """A robot's part of the next move; None until its task has submitted it."""
        return None if self.offer is None else self.offer.parts.get(number)

    def submit(self, number: int, part: QueuedMove, sync_id: float) -> PendingTeamMove:
        r"""Submit a task's part of the next move.

        Args:
            number: Of its robot in the team.
            part: Its move.
            sync_id: The argument \ID.

        Raises:
            RapidError: ERR_ARGVALERR, if another task has submitted another number.
        """
        if self.offer is None:
            self.offer = PendingTeamMove(sync_id)
        offer = self.offer
        if offer.sync_id != sync_id:
            other, said = next(iter(offer.parts.items()))
            raise rapid_error(
                ERR_ARGVALERR,
                f"{self.tasks[number]} moves with \\ID:={sync_id:g} and {self.tasks[other]} with "
                f"\\ID:={offer.sync_id:g} at line {said.place.span.line}; moves that are made "
                "together need one number",
            )
        offer.parts[number] = part
        return offer

    def begin(self, pending: PendingTeamMove, now_s: float) -> TeamMove:
        """Append a move to the path when all parts are submitted; see `BlockPlanner.append`."""
        parts = tuple(pending.parts[number] for number in range(len(self.robots)))
        lead = parts[0]
        stops = any(part.corner is CornerKind.STOP for part in parts)
        # One smoothing window for all, or they would not stay synchronised.
        ramp = min(part.segment.ramp for part in parts)
        stop_ramp = min(part.segment.stop_ramp for part in parts)
        move = TeamMove(
            lead.move,
            lead.place,
            replace(
                lead.segment,
                zone=None if stops else lead.segment.zone,
                ramp=ramp,
                stop_ramp=stop_ramp,
            ),
            lead.conf,
            lead.started,
            CornerKind.STOP if stops else CornerKind.FLY_BY,
            lead.base_from_tcp,
            lead.tcp_from_flange,
            parts=parts,
        )
        self.offer, pending.is_complete = None, True
        last = self.planner.block.moves[-1] if self.planner.is_open else None
        self.planner.append(move, now_s)
        continues = last is not None and self.planner.block.moves[0] is not move
        for number, (part, robot) in enumerate(zip(parts, self.robots, strict=True)):
            part.started, part.corner = move.started, move.corner
            zone = None if stops else part.segment.zone
            part.segment = replace(
                part.segment,
                zone=zone,
                ramp=move.segment.ramp,
                stop_ramp=stop_ramp,
            )
            robot.take(part)
            if continues and isinstance(last, TeamMove):
                before = last.parts[number]
                if frames_of(before) != frames_of(part):
                    before.segment = replace(before.segment, joint_corner=True)
            part.command_start_s = move.command_start_s
        return move

    def store(self, number: int) -> None:
        """Store the path for one robot, which is at rest; it stays halted until all restore it."""
        self.planner.version += 1
        self._stored_by.add(number)
        self._left_at.setdefault(number, self.robots[number].standing())

    def restore(self, number: int) -> None:
        """Restore the path for one robot, which is at rest; see `store`."""
        planner, robot = self.planner, self.robots[number]
        planner.version += 1
        planner.ready_s = max(planner.ready_s, robot.planner.ready_s)
        self._stored_by.discard(number)
        if not self._stored_by:
            self._next_level = None
            self._renew_offsets()

    def next_level(self) -> TeamPlanner:
        """Planner of the moves that the robots make as a team while this path is stored."""
        if self._next_level is None:
            level = self._next_level = TeamPlanner(self.tasks, self.robots)
            ends_s = (robot.trajectory.command_end for robot in self.robots)
            level.planner.ready_s = max(level.planner.ready_s, self.planner.ready_s, *ends_s)
        return self._next_level

    def resume(self, now_s: float) -> None:
        """Continue from where the robots were stopped; they return there if they have moved since.

        While the path is stored for one of them, all stay halted.
        """
        if self._stored_by:
            return
        left_at, self._left_at = self._left_at, {}
        if left_at and self.planner.is_open:
            now_s = self._regain(left_at, now_s)
        stopping.resume(self.planner, now_s)

    def too_far_off(self) -> str:
        """Distance of a robot from where it left the path, as text; empty if all can return."""
        block = self.planner.block
        if not block.is_open:
            return ""
        move = block.moves[block.commit.move]
        assert isinstance(move, TeamMove)
        for number, left_at in self._left_at.items():
            too_far = self.robots[number].distance_from(left_at, move.parts[number].segment)
            if too_far:
                return too_far
        return ""

    def _regain(self, left_at: Mapping[int, Waypoint], now_s: float) -> float:
        """Return the robots, synchronised, to where they left the path; see `stopping.regain`."""
        stands = [robot.standing() for robot in self.robots]
        goals = [left_at.get(number, here) for number, here in enumerate(stands)]
        if all(map(stopping.is_same_place, stands, goals)):
            return now_s
        move = self.planner.block.moves[self.planner.block.commit.move]
        assert isinstance(move, TeamMove)
        back = zip(move.parts, stands, goals, strict=True)
        parts = tuple(
            replace(part, segment=stopping.segment_back(part.segment, here, there))
            for part, here, there in back
        )
        return stopping.go_back(self.planner, replace(move, parts=parts), now_s)

    def _renew_offsets(self) -> None:
        """Continue the joint path at the current position of each robot on the path of its run."""
        block = self.planner.block
        for move in block.moves[: block.commit.move + 1]:
            if move.started.time is not None:
                self._start_offsets.setdefault(move.number, self._offsets)
        for move in block.moves[: block.commit.move]:
            self._end_offsets.setdefault(move.number, self._offsets)
        travelled_m = self._trajectory.length
        self._offsets = tuple(robot.trajectory.length - travelled_m for robot in self.robots)

    def clear(self) -> None:
        """Discard the remaining path of robots at rest."""
        stopping.clear(self.planner)
        for robot in self.robots:
            robot.end = robot.standing()

    def preview(self, number: int) -> Trajectory:
        """Trajectory of one robot if no further move is queued."""
        own, planner = self.robots[number].trajectory, self.planner
        if not planner.is_open or planner.is_halted:
            return own
        plan = planner.planned()
        assert isinstance(plan.path, TeamPath)
        path = plan.path.part(number)
        start_s = plan.start_s + self._trajectory.delays_s[number]
        lead = planner.block.moves[plan.first]
        assert isinstance(lead, TeamMove)
        first = lead.parts[number].number
        return own.extended(Piece(start_s, path, plan.timing, plan.from_m, path.length, first))

    def places_of(self, number: int, part: QueuedMove) -> tuple[float, float] | None:
        """Path positions [m] of start and end of a robot's move of the current block; else None."""
        move = self._whole(number, part)
        places = None if move is None else self.planner.places_of(move)
        if move is None or places is None:
            return None
        starts, ends = self._offsets_of(move)
        return starts[number] + places[0], ends[number] + places[1]

    def parameter_rate(self, number: int, part: QueuedMove) -> float:
        """Change [m] of the common parameter per metre that a robot travels on its move."""
        move, places = self._whole(number, part), self.places_of(number, part)
        if move is None or places is None:
            return 1.0
        length_m = part.length_m
        if self.planner.is_open and not self.planner.is_halted:
            plan = self.planner.planned()
            index = move.number - self.planner.block.moves[plan.first].number
            if index >= 0:
                assert isinstance(plan.path, TeamPath)
                length_m = float(plan.path.courses[number].path.lengths[index])
        return (places[1] - places[0]) / length_m if length_m > _NO_WAY_M else 1.0

    def _offsets_of(self, move: TeamMove) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Positions of the joint path on that of each robot, for start and end of a move."""
        starts = self._start_offsets.get(move.number, self._offsets)
        return starts, self._end_offsets.get(move.number, self._offsets)

    def _whole(self, number: int, part: QueuedMove) -> TeamMove | None:
        """The team's move of the current block that has a part; None if there is none."""
        moves = (one for one in self.planner.block.moves if isinstance(one, TeamMove))
        return next((one for one in moves if one.parts[number] is part), None)

    def _build(self, moves: Sequence[QueuedMove], lost_corner: int | None) -> Path:
        rows = []
        for number in range(len(self.robots)):
            own = [move.parts[number] for move in moves if isinstance(move, TeamMove)]
            for move, part in zip(moves, own, strict=True):
                if move.segment.zone is None and part.segment.zone is not None:
                    # The corner was known too late, see `BlockPlanner.planned`.
                    part.segment = replace(part.segment, zone=None)
            segments = [part.segment for part in own]
            if lost_corner is not None:
                segments[lost_corner] = replace(segments[lost_corner], zone=None)
            rows.append(segments)
        arms = [robot.robot for robot in self.robots]
        joint = build_team(arms, rows, self.planner.model, self.planner.check_deadline)
        if isinstance(joint, TeamFault):
            blamed = moves[joint.fault.segment]
            assert isinstance(blamed, TeamMove)
            raise MotionError(blamed.parts[joint.number], joint.fault)
        for k, (move, segment) in enumerate(zip(moves, joint.segments, strict=True)):
            zone = move.segment.zone if k == lost_corner else segment.zone
            move.segment = replace(segment, zone=zone)
        return joint

    def _pass_on(self, moves: Sequence[QueuedMove], path: Path | None) -> None:
        """Copy the timing and corners of the team's moves to their parts."""
        for k, move in enumerate(moves):
            assert isinstance(move, TeamMove)
            starts, ends = self._offsets_of(move)
            for number, part in enumerate(move.parts):
                if isinstance(path, TeamPath):
                    own = path.courses[number].path
                    part.length_m, corner = float(own.lengths[k]), own.corners[k]
                    part.zone_m, part.corner_reason = corner.radius, corner.reason
                part.start_place_m = starts[number] + move.start_place_m
                part.end_place_m = ends[number] + move.end_place_m
                part.ended_s = move.ended_s
                part.command_start_s = move.command_start_s
                part.corner = move.corner
