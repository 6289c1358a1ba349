"""Robots that move together: one path queue for all of them, with moves of several robots.

A move of the team is made of one move of each robot. It is put on the path when the last task has
said its own; planning, stopping and starting are those of one robot, on the joint path.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.queued_move import MotionError, QueuedMove, frames_of
from rapidsim.controller.queue.path_planner import Plan
from rapidsim.controller.queue.solo_queue import RobotPath
from rapidsim.language.error_numbers import ERR_ARGVALERR, ERR_PATH, rapid_error
from rapidsim.motion.geometry.segments import Waypoint
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.path.path import Path, build_path
from rapidsim.motion.path.synchronised_path import TeamPath, team_path
from rapidsim.motion.timing.axis_limits import Limits
from rapidsim.motion.timing.time_scaling import Timing
from rapidsim.motion.trajectory.command import Piece
from rapidsim.motion.trajectory.trajectory import Samples, Trajectory


@dataclass(slots=True, eq=False)
class TeamMove(QueuedMove):
    """One move of all robots."""

    parts: tuple[QueuedMove, ...] = ()
    """In the order of the team."""


@dataclass(slots=True, eq=False)
class Offer:
    """A move of the team that waits for the tasks that have not said their own."""

    sync_id: float
    parts: dict[int, QueuedMove] = field(default_factory=dict)
    """By the robot's number in the team."""
    is_complete: bool = False


@dataclass(frozen=True, slots=True)
class TeamPlan:
    """A plan of the open part of a block of the team."""

    path: TeamPath
    timing: Timing
    from_m: float
    """Where on the path the plan starts."""
    start_s: float
    """Command time there."""


class _TeamTrajectory(Trajectory):
    """The motion over the common parameter; it gives each robot its own."""

    def __init__(self, robots: Sequence[RobotPath]) -> None:
        own = robots[0]
        super().__init__(own.end, own.model.filter_time, own.model.smoothing)
        self._robots = robots

    def append(self, piece: Piece) -> float:
        """Add a piece to the motion of each robot too."""
        path = piece.path
        assert isinstance(path, TeamPath)
        for number, robot in enumerate(self._robots):
            robot.trajectory.append(replace(piece, path=path.part(number)))
            robot.version += 1
        return super().append(piece)

    def cut(self, time_s: float) -> None:
        """Take back what is commanded after a time [s], for each robot too."""
        for robot in self._robots:
            robot.trajectory.cut(time_s)
            robot.version += 1
        super().cut(time_s)


class Team(RobotPath):
    """The joint path of several robots."""

    def __init__(self, tasks: Sequence[str], robots: Sequence[RobotPath]) -> None:
        """Let robots that stand move together from now on.

        Args:
            tasks: Names of their tasks.
            robots: Their own paths, in the order of the tasks.
        """
        lead = robots[0]
        super().__init__(lead.robot, lead.model, _TeamTrajectory(robots), lead.end)
        self.tasks = tuple(tasks)
        self.robots = tuple(robots)
        self.offer: Offer | None = None
        self._ready_s = max(robot._ready_s for robot in robots)
        self._offsets = tuple(robot.trajectory.length for robot in robots)
        """Where the joint path begins on that of each robot's whole run [m]."""
        self._faulty = 0

    @cached_property
    def limits(self) -> Limits:
        """Those of all axes, robot after robot."""
        return Limits(
            np.concatenate([robot.limits.max_speed for robot in self.robots]),
            np.concatenate([robot.limits.max_acceleration for robot in self.robots]),
        )

    def say(self, number: int, part: QueuedMove, sync_id: float) -> Offer:
        r"""Let a task say its part of the next move.

        Args:
            number: Of its robot in the team.
            part: Its move.
            sync_id: The argument \ID.

        Raises:
            RapidError: ERR_ARGVALERR, if another task has said another number.
        """
        if self.offer is None:
            self.offer = Offer(sync_id)
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

    def begin(self, offer: Offer, now_s: float) -> TeamMove:
        """Put a move on the path that all tasks have said; see `append`."""
        parts = tuple(offer.parts[number] for number in range(len(self.robots)))
        lead = parts[0]
        stops = any(part.corner is CornerKind.STOP for part in parts)
        # One window of the smoothing for all, or they would not stay together.
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
        self.offer, offer.is_complete = None, True
        last = self._block[-1] if self.is_open else None
        self.append(move, now_s)
        continues = last is not None and self._block[0] is not move
        for number, (part, robot) in enumerate(zip(parts, self.robots, strict=True)):
            part.started, part.corner = move.started, move.corner
            zone = None if stops else part.segment.zone
            part.segment = replace(
                part.segment,
                index=len(robot.moves),
                zone=zone,
                ramp=move.segment.ramp,
                stop_ramp=stop_ramp,
            )
            robot.moves.append(part)
            robot.end = part.segment.end
            if continues and isinstance(last, TeamMove):
                before = last.parts[number]
                if frames_of(before) != frames_of(part):
                    before.segment = replace(before.segment, joint_corner=True)
            part.command_start_s = move.command_start_s
        return move

    def clear(self) -> None:
        """Forget what is left of the path of robots that stand."""
        super().clear()
        self._pass_on(self._block)
        for robot in self.robots:
            robot.end = robot.standing()

    def leave(self) -> None:
        """Leave the robots on their way."""
        super().leave()
        self._pass_on(self._block)

    def standing(self) -> Waypoint:
        """Where the first robot stands."""
        return self.robots[0].standing()

    def at_past(self, time_s: float) -> Samples:
        """The first arm at a time [s] that is past."""
        return self.robots[0].at_past(time_s)

    def advance(self, now_s: float) -> None:
        """Fix the path up to now [s]."""
        self._advance(now_s)

    def rest(self) -> TeamPlan | None:
        """What is planned of the open block; None while nothing moves on."""
        if not self.is_open or self.is_halted:
            return None
        plan = self._planned()
        assert isinstance(plan.path, TeamPath)
        return TeamPlan(plan.path, plan.timing, plan.from_m, plan.start_s)

    def store(self) -> None:
        """Not modelled.

        Raises:
            RapidError: ERR_PATH.
        """
        raise rapid_error(
            ERR_PATH,
            "StorePath while robots move together is not simulated; SyncMoveOff first",
        )

    def _build(self, moves: Sequence[QueuedMove], lost_corner: int | None) -> Path | PathFault:
        paths = []
        for number, robot in enumerate(self.robots):
            own = [move.parts[number] for move in moves if isinstance(move, TeamMove)]
            for move, part in zip(moves, own, strict=True):
                if move.segment.zone is None and part.segment.zone is not None:
                    # The corner was learnt too late, see `_planned`.
                    part.segment = replace(part.segment, zone=None)
            segments = [part.segment for part in own]
            if lost_corner is not None:
                segments[lost_corner] = replace(segments[lost_corner], zone=None)
            path = build_path(robot.robot, segments, self.model, self.look)
            if isinstance(path, PathFault):
                self._faulty = number
                return path
            paths.append(path)
        joint = team_path(paths)
        for k, (move, segment) in enumerate(zip(moves, joint.segments, strict=True)):
            zone = move.segment.zone if k == lost_corner else segment.zone
            move.segment = replace(segment, index=move.segment.index, zone=zone)
        return joint

    def _planned(self) -> Plan:
        try:
            return super()._planned()
        except MotionError as error:
            if isinstance(error.queued, TeamMove):
                raise MotionError(error.queued.parts[self._faulty], error.fault) from None
            raise

    def _travel(self, tentative: Plan, moves_begun: int, to_m: float) -> float:
        time_s = super()._travel(tentative, moves_begun, to_m)
        begun = self._block[tentative.first : moves_begun]
        assert isinstance(tentative.path, TeamPath)
        for k, move in enumerate(begun):
            assert isinstance(move, TeamMove)
            for course, part in zip(tentative.path.courses, move.parts, strict=True):
                part.length_m = float(course.path.lengths[k])
                corner = course.path.corners[k]
                part.zone_m, part.corner_reason = corner.radius, corner.reason
        self._pass_on(begun)
        return time_s

    def _take_back(self, index: int) -> None:
        super()._take_back(index)
        self._pass_on(self._block[index:])

    def _pass_on(self, moves: Sequence[QueuedMove]) -> None:
        """Let the parts of moves know what became of the whole."""
        for move in moves:
            assert isinstance(move, TeamMove)
            for offset_m, part in zip(self._offsets, move.parts, strict=True):
                part.start_place_m = offset_m + move.start_place_m
                part.end_place_m = offset_m + move.end_place_m
                part.ended_s = move.ended_s
                part.command_start_s = move.command_start_s
                part.corner = move.corner
