"""Motion queue of one robot of a team, as its task's controller uses it."""

from __future__ import annotations

from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.controller.queue import stopping
from rapidsim.controller.queue.move_log import MoveLog
from rapidsim.controller.queue.solo_queue import SoloQueue
from rapidsim.controller.queue.team_planner import TeamPlanner
from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.segments import Waypoint
from rapidsim.motion.trajectory.trajectory import Samples, Trajectory
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class TeamQueue:
    """Implements `MotionQueue` in a team: the team plans, each queue shows its own robot."""

    own: SoloQueue
    team: TeamPlanner
    number: int
    """Number of the robot in the team."""

    @property
    def trajectory(self) -> Trajectory:
        """The robot's motion as far as it is fixed."""
        return self.own.trajectory

    @property
    def moves(self) -> MoveLog:
        """All moves the robot ever got, alone or with others."""
        return self.own.moves

    @property
    def end(self) -> Waypoint:
        """End of the last queued move of the robot."""
        return self.own.end

    @property
    def version(self) -> int:
        """Changes whenever the planned motion of the robot may change."""
        return self.team.planner.version

    @property
    def is_open(self) -> bool:
        """Whether a block of moves of the team is open: its end is not decided."""
        return self.team.planner.is_open

    @property
    def is_halted(self) -> bool:
        """Whether a stop keeps the robots where they are."""
        return self.team.planner.is_halted

    @property
    def open_moves(self) -> int:
        """Number of moves of the open block that are not yet travelled."""
        return self.team.planner.open_moves

    @property
    def braking_s(self) -> float:
        """More time [s] than any arm of the team needs to stop."""
        return self.team.planner.braking_s

    def close(self, corner: CornerKind = CornerKind.STOP) -> float:
        """End the block of the team; see `BlockPlanner.close`."""
        return self.team.planner.close(corner)

    def commit_last_start(self) -> float:
        """Fix the path up to the start of the last move."""
        return self.team.planner.commit_last_start()

    def commit_ahead(self) -> float | None:
        """Fix what later moves cannot change."""
        return self.team.planner.commit_ahead()

    def nominal_last_start(self) -> float:
        """Nominal time [s] at which the last move starts."""
        return self.team.planner.nominal_last_start()

    def preview(self) -> Trajectory:
        """Trajectory of the robot if no further move is queued."""
        return self.team.preview(self.number)

    def places_of(self, queued: QueuedMove) -> tuple[float, float] | None:
        """Path positions [m] of start and end of a move of the robot; None for other moves."""
        return self.team.places_of(self.number, queued)

    def path_ratio(self, queued: QueuedMove) -> float:
        """Rate of the common parameter, which the robot with the longest path sets."""
        return self.team.parameter_rate(self.number, queued)

    def seen(self, now_s: float, times: Array) -> Samples:
        """The robot at times (k,) [s] around now; see `MotionQueue.seen`."""
        self.team.planner.end_if_late(now_s)
        return self.preview().at(times)

    def at_past(self, time_s: float) -> Samples:
        """The robot at a time [s] that is past."""
        return self.own.at_past(time_s)

    def halt(self, now_s: float, in_s: float = 0.0) -> float:
        """Stop all robots of the team; see `stopping.halt`."""
        return stopping.halt(self.team.planner, now_s, in_s)

    def resume(self, now_s: float) -> None:
        """Continue the motion of all robots of the team."""
        self.team.resume(now_s)

    def leave(self) -> None:
        """Leave all robots of the team in motion; planning ends."""
        stopping.leave(self.team.planner)

    def clear(self) -> None:
        """Discard the remaining path of the team."""
        self.team.clear()

    def off_path_reason(self) -> str:
        """Distance of a robot of the team from where it left the path; see `MotionQueue`."""
        return self.team.too_far_off()
