"""Robot of a task, with the queue through which it currently moves."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress

import numpy as np

from rapidsim.controller.journal.stop_reasons import WallLimitReached
from rapidsim.controller.moves.queued_move import MotionError, QueuedMove
from rapidsim.controller.queue import stopping
from rapidsim.controller.queue.member import Member
from rapidsim.controller.queue.motion_queue import MotionQueue
from rapidsim.controller.queue.move_log import MoveLog
from rapidsim.controller.queue.synchronised_tasks import SynchronisedTasks
from rapidsim.frames.transform import Array
from rapidsim.language.error_numbers import ERR_PATH, rapid_error
from rapidsim.motion.geometry.segments import Waypoint
from rapidsim.motion.interruption import Look, undisturbed
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.motion.trajectory.trajectory import Trajectory
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class _PathLevel:
    """State of a robot's motion before StorePath."""

    alone: MotionQueue
    """Its own queue."""
    queue: MotionQueue
    """The queue through which it moved."""
    number: int
    end: Waypoint
    """End of its last queued move."""


class MechanicalUnit:
    """A robot, as its task uses it: the only class that lets it join or leave a team.

    Code that needs the queue reads it from here each time. Methods that plan raise `MotionError` if
    the path turns out not to be passable.
    """

    def __init__(self, member: Member, check_deadline: Look = undisturbed) -> None:
        """Let a robot at rest move alone.

        Args:
            member: The robot.
            check_deadline: Called while planning; raises to interrupt it.
        """
        self.member = member
        self._check_deadline = check_deadline
        self._alone = MotionQueue((member,), check_deadline)
        self.queue = self._alone
        """The queue through which it currently moves."""
        self.number = 0
        """Its number in that queue."""
        self.held_by_task = False
        """StopMove of its own task holds it, in addition to that of a task without a robot."""
        self.held_by_watcher = False
        """StopMove of a task without a robot holds it."""
        self.suspended: tuple[str, ...] = ()
        """Tasks of the team that it left by SyncMoveSuspend; empty if none."""
        self._levels: list[_PathLevel] = []
        self._changes = 0

    @property
    def version(self) -> tuple[int, int]:
        """Changes whenever the planned motion of the robot may change."""
        return self._changes, self.queue.version

    @property
    def team(self) -> SynchronisedTasks | None:
        """The team with which it currently moves; None while it moves alone."""
        return self.queue.team

    @property
    def trajectory(self) -> Trajectory:
        """The robot's motion as far as it is fixed."""
        return self.member.trajectory

    @property
    def moves(self) -> MoveLog:
        """All moves the robot ever got."""
        return self.member.moves

    @property
    def end(self) -> Waypoint:
        """End of the last queued move."""
        return self.member.end

    def begin_at(self, start: Waypoint) -> None:
        """Let an arm that has not moved begin elsewhere."""
        self.trajectory.begin_at(start)
        self.member.end = start
        self._changes += 1

    def seen_s(self, command_s: float) -> float:
        """Time [s] at which the arm completes the command up to a time [s] of the queue."""
        return self.trajectory.seen_s(command_s + self.queue.delays_s[self.number])

    def preview(self) -> Trajectory:
        """Trajectory if no further move is queued."""
        return self.queue.preview(self.number)

    def foreseen(self) -> Trajectory:
        """Trajectory if no further move is queued, for observers; never raises.

        Falls back to the committed part; the next read of the moves raises the cause.
        """
        with suppress(MotionError):
            return self.preview()
        return self.trajectory

    def places_of(self, queued: QueuedMove) -> tuple[float, float] | None:
        """Path positions [m] of start and end of a move of the current block; None for others."""
        return self.queue.places_of(self.number, queued)

    def path_ratio(self, queued: QueuedMove) -> float:
        """Change [m] of the path position per metre that the TCP travels on such a move."""
        return self.queue.path_ratio(self.number, queued)

    def seen(self, now_s: float, times: Array) -> Samples:
        """The arm at increasing times (k,) [s]; future ones as if no further move is queued.

        A block that is too late to be continued now [s] ends with a stop.
        """
        self.queue.end_if_late(now_s)
        is_decided = float(times[-1]) <= self.trajectory.command_end
        return (self.trajectory if is_decided else self.preview()).at(times)

    def at_past(self, time_s: float) -> Samples:
        """The arm at a time [s] that is past, one sample."""
        return self.trajectory.at(np.array([time_s]))

    def halt(self, now_s: float, in_s: float = 0.0) -> float:
        """Stop on the path, see `stopping.halt`; return the command time [s] of the standstill."""
        return stopping.halt(self.queue, now_s, in_s)

    def resume(self, now_s: float) -> None:
        """Continue from where the robot was stopped."""
        stopping.resume(self.queue, now_s)

    def off_path_reason(self) -> str:
        """Distance from where the path to be resumed was left; see `stopping.off_path_reason`."""
        return stopping.off_path_reason(self.queue)

    def clear(self) -> None:
        """Discard the remaining path of a robot at rest."""
        stopping.clear(self.queue)

    def leave(self) -> None:
        """Leave the robot in motion; planning ends."""
        stopping.leave(self.queue)

    def end_guidance(self) -> None:
        """Bring a robot that a sensor guides to rest; the next move begins there."""
        stopping.end_guidance(self.queue)

    def forget(self, before_s: float, keep_from: int | None) -> None:
        """Discard what no read at a time [s] or later needs.

        Args:
            before_s: That time.
            keep_from: Number of a move that is kept with all that follow; None for none.
        """
        self.trajectory.forget(before_s)
        self.queue.forget(before_s)
        self.queue.planner.forget()
        row = self.queue.block.rows[self.number]
        needed = row[0].number if row else len(self.moves)
        self.moves.forget(before_s, needed if keep_from is None else min(needed, keep_from))

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
            self.leave()

    def join(self, queue: MotionQueue) -> None:
        """Join a team, of which the robot is a member."""
        self.member.settle_correction()
        self._enter(queue, queue.members.index(self.member))

    def part(self) -> None:
        """Leave the team and move alone from where it has come to rest."""
        if self.team is not None:
            self._enter(self._alone, 0)
            self._alone.begin_again(self.member.ready_s)

    def _enter(self, queue: MotionQueue, number: int) -> None:
        """Move through another queue."""
        if queue.team is not None or self.team is not None:
            # The robots of a team set off when all of them are at rest.
            self.member.ready_s = max(self.member.ready_s, self.trajectory.command_end)
            self.member.settled_s = -np.inf
        self._changes += 1
        self.queue, self.number = queue, number

    @property
    def has_left_team(self) -> bool:
        """Whether it moves alone until its team resumes or its path is restored."""
        stored = any(level.queue.team is not None for level in self._levels)
        return self.team is None and (stored or bool(self.suspended))

    def hold(self) -> None:
        """Note that the robot's own task has stopped it, and with it its team."""
        self.held_by_task = True
        if self.team is not None:
            self.team.hold(self.number)

    def release(self) -> bool:
        """Note that the robot's own task restarts it; return whether no task of its team holds it.

        A task that has not stopped the team restarts it for all.
        """
        self.held_by_task = False
        return self.team is None or self.team.release(self.number)

    def store_path(self, *, keep_sync: bool) -> None:
        """Store the path of a robot at rest, and begin another one.

        Args:
            keep_sync: Whether a robot in a team begins the new path together with the team, or
                alone.
        """
        self.member.settle_correction()
        queue, number = self.queue, self.number
        self._levels.append(_PathLevel(self._alone, queue, number, self.end))
        stopping.store(queue, number)
        self.member.level += 1
        self.member.end = self.member.standing()
        self._alone = MotionQueue((self.member,), self._check_deadline)
        if queue.team is None or not keep_sync:
            self._enter(self._alone, 0)
            return
        if queue.next_level is None:
            team = SynchronisedTasks(queue.team.names)
            queue.next_level = MotionQueue(queue.members, self._check_deadline, team)
        self._enter(queue.next_level, number)

    def restore_path(self) -> None:
        """Restore the path that was stored last, and the team to which it belongs.

        Raises:
            RapidError: ERR_PATH, if the robot joined a team after it had stored a path alone.
        """
        level = self._levels[-1]
        if level.queue.team is None and self.team is not None:
            raise rapid_error(ERR_PATH, _STORED_ALONE)
        self._drop_level()
        self._enter(level.queue, level.number)
        # If no move remains, the next one begins at the position of the arm.
        self.member.end = level.end if level.queue.is_open else self.member.standing()

    def drop_paths(self) -> None:
        """Discard all stored paths of a robot that moves alone."""
        while self._levels:
            stopping.clear(self._alone)
            self._drop_level()
        self._enter(self._alone, 0)

    def _drop_level(self) -> None:
        level = self._levels.pop()
        self._alone, self.suspended = level.alone, ()
        self.member.level -= 1
        stopping.restore(level.queue, level.number)


_STORED_ALONE = (
    "RestoPath while robots move together is not simulated for a path that was stored before they "
    "did; SyncMoveOff first"
)
