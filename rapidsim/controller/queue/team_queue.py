"""What the controller of one task sees of the path of its team: the path of its own robot."""

from __future__ import annotations

from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.controller.queue.solo_queue import RobotPath
from rapidsim.controller.queue.team_planner import Team
from rapidsim.language.error_numbers import ERR_PATH, rapid_error
from rapidsim.motion.geometry.segments import Waypoint
from rapidsim.motion.trajectory.command import Piece
from rapidsim.motion.trajectory.trajectory import Samples, Trajectory


class Seat(RobotPath):
    """A robot's place in a team: motion is planned together, samples are its own."""

    def __init__(self, own: RobotPath, team: Team, number: int) -> None:
        """Take part.

        Args:
            own: The path of the robot while it moves alone.
            team: The joint path.
            number: Of the robot in the team.
        """
        self.own = own
        self.team = team
        self.number = number
        self.robot, self.model = own.robot, own.model
        self.trajectory, self.moves = own.trajectory, own.moves

    @property
    def end(self) -> Waypoint:  # type: ignore[override]
        """Where the last queued move of the robot ends."""
        return self.own.end

    @property
    def version(self) -> int:  # type: ignore[override]
        """Changes whenever what the robot will do may change."""
        return self.team.version

    @property
    def is_open(self) -> bool:
        """Whether a block of moves of the team waits for its end."""
        return self.team.is_open

    @property
    def is_halted(self) -> bool:
        """Whether a stop keeps the robots where they are."""
        return self.team.is_halted

    @property
    def open_moves(self) -> int:
        """How many moves of the open block have not been travelled."""
        return self.team.open_moves

    def close(self, corner: CornerKind = CornerKind.STOP) -> float:
        """End the block of the team; see `PathQueue.close`."""
        return self.team.close(corner)

    def commit_last_start(self) -> float:
        """Fix the path up to the start of the last move; see `PathQueue.commit_last_start`."""
        return self.team.commit_last_start()

    def commit_ahead(self) -> float | None:
        """Fix what later moves cannot change; see `PathQueue.commit_ahead`."""
        return self.team.commit_ahead()

    def nominal_last_start(self) -> float:
        """About when the last move starts [s]; see `PathQueue.nominal_last_start`."""
        return self.team.nominal_last_start()

    def halt(self, now_s: float) -> float:
        """Stop all robots of the team; see `RobotPath.halt`."""
        return self.team.halt(now_s)

    def leave(self) -> None:
        """Leave all robots of the team on their way."""
        self.team.leave()

    def resume(self, now_s: float) -> None:
        """Let all robots of the team go on."""
        self.team.resume(now_s)

    def clear(self) -> None:
        """Forget what is left of the path of the team."""
        self.team.clear()

    def store(self) -> None:
        """Not modelled; see `Team.store`."""
        self.team.store()

    def restore(self) -> None:
        """Not modelled: a path that was kept is that of the robot alone.

        Raises:
            RapidError: ERR_PATH.
        """
        raise rapid_error(
            ERR_PATH, "RestoPath while robots move together is not simulated; SyncMoveOff first"
        )

    def away_deg(self) -> float:
        """A team never takes up a stored path."""
        return 0.0

    def standing(self) -> Waypoint:
        """Where the robot comes to its end."""
        return self.own.standing()

    def samples_at(self, now_s: float) -> Samples:
        """The robot now, which fixes the path of the team up to now."""
        self.team.advance(now_s)
        return self.own.at_past(now_s)

    def at_past(self, time_s: float) -> Samples:
        """The robot at a time [s] that is past."""
        return self.own.at_past(time_s)

    def preview(self) -> Trajectory:
        """What the robot will do if nothing more is said."""
        rest = self.team.rest()
        if rest is None:
            return self.trajectory
        path = rest.path.part(self.number)
        return self.trajectory.extended(
            Piece(rest.start_s, path, rest.timing, rest.from_m, path.length)
        )

    def places_of(self, queued: QueuedMove) -> tuple[float, float] | None:
        """None: triggers on moves of a team are not modelled, and the run says so."""
        del queued
        return None
