"""A robot of a task, and the queue it currently moves through."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from rapidsim.controller.journal.stop_reasons import WallLimitReached
from rapidsim.controller.moves.queued_move import MotionError
from rapidsim.controller.queue.motion_queue import MotionQueue
from rapidsim.controller.queue.solo_queue import SoloQueue
from rapidsim.controller.queue.team_planner import TeamPlanner
from rapidsim.controller.queue.team_queue import TeamQueue


@dataclass(slots=True, eq=False)
class MechanicalUnit:
    """The only place where a robot changes from moving alone to moving together, and back.

    Whoever needs the robot's queue asks here each time.
    """

    own: SoloQueue
    seat: TeamQueue | None = None
    """Its place in the team it moves with; None while it moves alone."""
    held_by_task: bool = False
    """StopMove of its own task holds it, in addition to a task that watches."""
    held_by_watcher: bool = False
    """StopMove of a task without a robot holds it."""
    _changes: int = 0

    @property
    def queue(self) -> MotionQueue:
        """The queue it currently moves through."""
        return self.own if self.seat is None else self.seat

    @property
    def version(self) -> tuple[int, int]:
        """Changes whenever what the robot will do may change."""
        return self._changes, self.queue.version

    @property
    def team(self) -> TeamPlanner | None:
        """The team it currently moves with."""
        return None if self.seat is None else self.seat.team

    def forget(self, before_s: float, keep_from: int | None) -> None:
        """Forget what was before a time [s]; see `BlockPlanner.forget`."""
        self.own.planner.forget(before_s, keep_from)
        if self.seat is not None:
            self.seat.team.planner.forget(before_s)

    @contextmanager
    def ending(self) -> Iterator[None]:
        """What the robot still does at the end of a run.

        It fails in silence, as what has ended the run is told; and if the computer's clock ends
        it, the robot is left on its way.
        """
        try:
            yield
        except MotionError:
            pass
        except WallLimitReached:
            self.queue.leave()

    def join(self, team: TeamPlanner, number: int) -> None:
        """Move together with others, as a robot of this number in the team."""
        if self.own.corrected is not None:
            self.own.corrected.settle()
        self._changes += 1
        self.seat = TeamQueue(self.own, team, number)

    def part(self) -> None:
        """Move alone from where the team has come to rest."""
        if self.seat is not None:
            ended_s = self.own.trajectory.command_end
            self.own.continue_from(max(self.seat.team.planner.ready_s, ended_s))
            self._changes += 1
            self.seat = None
