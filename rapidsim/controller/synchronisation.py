r"""Moving together with the robots of other tasks: SyncMoveOn, SyncMoveOff, moves with \ID.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "SyncMoveOn",
"SyncMoveOff", "SyncMoveSuspend"; Application manual MultiMove.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from rapidsim.controller.cell.rendezvous import Meeting
from rapidsim.controller.journal.stop_reasons import WaitsForever
from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.controller.other_tasks import TaskOthers
from rapidsim.controller.path_control import TaskPathControl
from rapidsim.controller.queue.path_planner import LOOK_AHEAD_SLACK_S
from rapidsim.controller.queue.team_planner import Offer, TeamPlanner
from rapidsim.controller.queue.team_queue import TeamQueue
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.language.moves import Move

_NO_OTHER_LIMITS = "robots that move together keep the limits of their axes and of their TCPs alone"
_ONE_RAMP = "the lowest ramp since the last stop point counts for all"
_NO_TRIGGERS = "moved without them: robots that move together have no triggers yet"


class TaskTeam(TaskOthers, TaskPathControl):
    """Implements the moving together of `language.controller.Tasks`."""

    _suspended: tuple[str, ...] = ()
    """The team that the task is to move with again."""

    @property
    def team(self) -> tuple[str, ...]:
        """Names of the tasks that move together, this one among them; empty while it is alone."""
        return self._unit.team.tasks if self._unit.team is not None else ()

    def move_together(
        self, name: str, tasks: Sequence[str], *, max_time: float | None = None
    ) -> bool:
        """Wait for some tasks at a stop point; from there their robots move together.

        Raises:
            RapidError: ERR_ARGVALERR, if the robot moves together with others already; see `meet`.
        """
        if self.team:
            raise rapid_error(
                ERR_ARGVALERR, f"SyncMoveOn {name}: {self.task_name} moves together already"
            )
        self._require_listed("SyncMoveOn", name, tasks)
        self._note_line()
        self._come_to_rest()
        meeting = self._meet("SyncMoveOn", name, tasks, max_time)
        if meeting is None:
            return False
        self._join(meeting, tasks)
        return True

    def move_apart(self, name: str, *, max_time: float | None = None) -> bool:
        """Wait for the tasks that move together at a stop point; from there each moves alone."""
        self._note_line()
        self._come_to_rest()
        if self._meet("SyncMoveOff", name, self.team, max_time) is None:
            return False
        self.leave_team()
        return True

    def leave_team(self) -> None:
        """Let all that move together move alone, without waiting for anybody."""
        self._suspended = ()
        team = self._unit.team
        if team is not None:
            self._come_to_rest()
            for one in self._tasks().values():
                if one._unit.team is team:
                    one._unit.part()

    def suspend_team(self) -> None:
        """Move alone until `resume_team`; all tasks of the team do so together."""
        team = self._unit.team
        if team is not None:
            self._note_line()
            self._come_to_rest()
            self._meet("SyncMoveSuspend", "", team.tasks, None)
            self._unit.part()
            self._suspended = team.tasks

    def resume_team(self) -> None:
        """Move together again."""
        if self._suspended:
            tasks, self._suspended = self._suspended, ()
            self._note_line()
            self._come_to_rest()
            meeting = self._meet("SyncMoveResume", "", tasks, None)
            assert meeting is not None
            self._join(meeting, tasks)

    def start_move(self) -> None:
        """Let the robot go on, and with it those that move together with it."""
        super().start_move()
        self.tell()

    def _put(self, move: Move, before: Callable[[QueuedMove], None], *, wait: bool = True) -> None:
        r"""Put a move on the path, in a team together with those of the others.

        Raises:
            RapidError: ERR_ARGVALERR, if the task has no robot or the numbers \ID do not agree.
        """
        if not self.has_robot:
            raise rapid_error(
                ERR_ARGVALERR,
                f"{move.instruction}: the task {self.task_name} has no robot; in the station file, "
                "give it one with `robot` or `motion = true`",
            )
        seat = self._unit.seat
        if seat is None:
            if move.sync_id is not None and self._cell.is_shared:
                raise rapid_error(
                    ERR_ARGVALERR, f"{move.instruction} \\ID without SyncMoveOn before it"
                )
            super()._put(move, before, wait=wait)
            return
        if move.sync_id is None:
            raise rapid_error(
                ERR_ARGVALERR,
                f"{move.instruction} without \\ID between SyncMoveOn and SyncMoveOff",
            )
        queued = self._in_step(seat, move, move.sync_id)
        before(queued)
        if self._marks.is_pending:
            self._marks.clear()
            self._journal.unsimulated(
                f"{move.instruction} \\ID with triggers", _NO_TRIGGERS, self.place
            )
        self._say_what_a_team_ignores(move, queued)
        self._active = (move.tool, move.wobj)
        if queued.corner is CornerKind.STOP and wait and not move.concurrent:
            self._drive_to_stop()
            self._pass_time(max(self._observe(), self._unit.queue.trajectory.duration))
            return
        self._time.follow(queued.started)
        if self._interrupts.armed or self._zones.is_watching:
            self._keep_up()

    def _say_what_a_team_ignores(self, move: Move, queued: QueuedMove) -> None:
        segment = queued.segment
        limits = (segment.tcp_acceleration, segment.tcp_deceleration, segment.world_acceleration)
        if math.isfinite(min(limits)):
            name = f"PathAccLim or WorldAccLim with {move.instruction} \\ID"
            self._journal.unsimulated(name, _NO_OTHER_LIMITS, self.place)
        if any(math.isfinite(speed) for speed in segment.external_speeds):
            name = f"the programmed speed of external axes with {move.instruction} \\ID"
            self._journal.unsimulated(name, _NO_OTHER_LIMITS, self.place)

        if segment.ramp < self.settings.ramp_percent / 100.0:
            name = "different ramps of robots that move together"
            self._journal.unsimulated(name, _ONE_RAMP, self.place)

    def _in_step(self, seat: TeamQueue, move: Move, sync_id: float) -> QueuedMove:
        """Say a part of the next move of the team and wait until all have said theirs."""
        self._note_line()
        queued = self._resolver.resolve(move, self.place, seat.end, self.settings)
        self._time.settle(self.left)
        if not seat.is_open or self._time.offset_s > LOOK_AHEAD_SLACK_S or self._interrupts.armed:
            self.come_up()
        offer = seat.team.say(seat.number, queued, sync_id)
        if len(offer.parts) < len(seat.team.robots):
            self._await_parts(seat.team, offer, sync_id)
            return queued
        moment = self._moment()
        now_s = moment.time_s if moment.instant.time is not None else -math.inf
        seat.team.begin(offer, now_s)
        self._cell.happenings += 1
        self._cell.turns.look_again(max(now_s, 0.0))
        return queued

    def _await_parts(self, team: TeamPlanner, offer: Offer, sync_id: float) -> None:
        """Sleep until the other tasks have said their parts.

        Raises:
            WaitsForever: If one of them never will.
        """
        while not offer.is_complete:
            if self._time.is_known:
                woken = self._await_event(math.inf)
            else:
                # Nobody needs the time: the robots are still on the way that all know.
                woken = not math.isinf(self._cell.turns.until(self, math.inf))
            if not woken:
                missing = (t for n, t in enumerate(team.tasks) if n not in offer.parts)
                raise WaitsForever(
                    f"{', '.join(missing)} has no move with \\ID:={sync_id:g} to make together"
                )

    def _join(self, meeting: Meeting, tasks: Sequence[str]) -> None:
        """Take the place in the team that some tasks form; the first to come here makes it."""
        if meeting.outcome is None:
            wanted = {name.lower() for name in tasks}
            known = self._tasks().items()
            members = [one for key, one in known if key in wanted and one.has_robot]
            robots = [one._unit.own for one in members]
            meeting.outcome = TeamPlanner([one.task_name for one in members], robots)
        if self.has_robot:
            assert isinstance(meeting.outcome, TeamPlanner)
            number = meeting.outcome.tasks.index(self.task_name)
            self._unit.join(meeting.outcome, number)
