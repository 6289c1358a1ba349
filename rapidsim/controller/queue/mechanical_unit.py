"""Robot of a task, with the queue through which it currently moves."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from rapidsim.controller.journal.stop_reasons import WallLimitReached
from rapidsim.controller.moves.queued_move import MotionError
from rapidsim.controller.queue.motion_queue import MotionQueue
from rapidsim.controller.queue.solo_queue import SoloQueue
from rapidsim.controller.queue.team_planner import TeamPlanner
from rapidsim.controller.queue.team_queue import TeamQueue
from rapidsim.language.error_numbers import ERR_PATH, rapid_error
from rapidsim.motion.geometry.segments import Waypoint


@dataclass(frozen=True, slots=True)
class _PathLevel:
    """State of a robot's motion before StorePath."""

    seat: TeamQueue | None
    """Its queue in its team; None if it moved alone."""
    end: Waypoint
    """End of its last queued move."""


@dataclass(slots=True, eq=False)
class MechanicalUnit:
    """A robot with its queue: the only module that lets it join or leave a team.

    Code that needs the robot's queue reads it from here each time.
    """

    solo_queue: SoloQueue
    team_queue: TeamQueue | None = None
    """Its queue in the team with which it moves; None while it moves alone."""
    held_by_task: bool = False
    """StopMove of its own task holds it, in addition to that of a task without a robot."""
    held_by_watcher: bool = False
    """StopMove of a task without a robot holds it."""
    suspended: tuple[str, ...] = ()
    """Tasks of the team that it left by SyncMoveSuspend; empty if none."""
    _levels: list[_PathLevel] = field(default_factory=list)
    _changes: int = 0

    @property
    def queue(self) -> MotionQueue:
        """The queue through which it currently moves."""
        return self.solo_queue if self.team_queue is None else self.team_queue

    @property
    def version(self) -> tuple[int, int]:
        """Changes whenever the planned motion of the robot may change."""
        return self._changes, self.queue.version

    @property
    def team(self) -> TeamPlanner | None:
        """The team with which it currently moves; None while it moves alone."""
        return None if self.team_queue is None else self.team_queue.team

    def forget(self, before_s: float, keep_from: int | None) -> None:
        """Discard what was before a time [s]; see `BlockPlanner.forget`."""
        self.solo_queue.planner.forget(before_s, keep_from)
        if self.team_queue is not None:
            self.team_queue.team.planner.forget(before_s)

    @contextmanager
    def ending(self) -> Iterator[None]:
        """Guard the last planning of the robot at the end of a run.

        A `MotionError` is dropped, because the cause of the end is reported; if the limit on the
        wall clock is reached, the robot is left in motion.
        """
        try:
            yield
        except MotionError:
            pass
        except WallLimitReached:
            self.queue.leave()

    def join(self, team: TeamPlanner, number: int) -> None:
        """Join a team as the robot of this number in it."""
        if self.solo_queue.corrected is not None:
            self.solo_queue.corrected.settle()
        self._changes += 1
        self.team_queue = TeamQueue(self.solo_queue, team, number)

    def part(self) -> None:
        """Leave the team and move alone from where it has come to rest."""
        if self.team_queue is not None:
            ended_s = self.solo_queue.trajectory.command_end
            self.solo_queue.continue_from(max(self.team_queue.team.planner.ready_s, ended_s))
            self._changes += 1
            self.team_queue = None

    @property
    def has_left_team(self) -> bool:
        """Whether it moves alone until its team resumes or its path is restored."""
        stored = any(level.seat is not None for level in self._levels)
        return self.team_queue is None and (stored or bool(self.suspended))

    def hold(self) -> None:
        """Note that the robot's own task has stopped it, and with it its team."""
        self.held_by_task = True
        if self.team_queue is not None:
            self.team_queue.team.holders.add(self.team_queue.number)

    def release(self) -> bool:
        """Note that the robot's own task restarts it; return whether no task of its team holds it.

        A task that has not stopped the team restarts it for all.
        """
        self.held_by_task = False
        if self.team_queue is None:
            return True
        holders, number = self.team_queue.team.holders, self.team_queue.number
        if number not in holders:
            holders.clear()
        holders.discard(number)
        return not holders

    def store_path(self, *, keep_sync: bool) -> None:
        """Store the path of a robot at rest, and begin another one.

        Args:
            keep_sync: Whether a robot in a team begins the new path together with the team, or
                alone.
        """
        seat = self.team_queue
        self._levels.append(_PathLevel(seat, self.solo_queue.end))
        if seat is not None:
            seat.team.store(seat.number)
            self.part()
        self.solo_queue.store()
        if seat is not None and keep_sync:
            self._changes += 1
            self.team_queue = TeamQueue(self.solo_queue, seat.team.next_level(), seat.number)

    def restore_path(self) -> None:
        """Restore the path that was stored last, and the team to which it belongs.

        Raises:
            RapidError: ERR_PATH, if the robot joined a team after it had stored a path alone.
        """
        level = self._levels[-1]
        if level.seat is None and self.team_queue is not None:
            raise rapid_error(ERR_PATH, _STORED_ALONE)
        del self._levels[-1]
        self.suspended = ()
        self.part()
        self.solo_queue.restore()
        if level.seat is not None:
            self._changes += 1
            self.team_queue = level.seat
            if level.seat.is_open:
                self.solo_queue.end = level.end
            level.seat.team.restore(level.seat.number)

    def drop_paths(self) -> None:
        """Discard all stored paths, of the robot alone and of its teams."""
        for level in self._levels:
            if level.seat is not None:
                level.seat.team.restore(level.seat.number)
        self._levels.clear()
        self.suspended = ()
        while self.solo_queue.stored:
            self.solo_queue.clear()
            self.solo_queue.restore()


_STORED_ALONE = (
    "RestoPath while robots move together is not simulated for a path that was stored before they "
    "did; SyncMoveOff first"
)
