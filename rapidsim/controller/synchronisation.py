r"""Moving together with the robots of other tasks: SyncMoveOn, SyncMoveOff, moves with \ID.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "SyncMoveOn",
"SyncMoveOff", "SyncMoveSuspend"; Application manual MultiMove.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import nullcontext
from dataclasses import dataclass

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.cell.rendezvous import Meeting
from rapidsim.controller.clock import TaskClock, Waiting
from rapidsim.controller.interrupt_table import InterruptTable
from rapidsim.controller.journal.journal import Journal
from rapidsim.controller.journal.stop_reasons import MoveImpossible, WaitsForever
from rapidsim.controller.motion_state import MotionState
from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.move_request import target_name
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.other_tasks import TaskOthers
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.controller.queue.path_marks import PathMarks
from rapidsim.controller.queue.team_planner import TeamPlanner
from rapidsim.controller.queue.team_queue import TeamQueue
from rapidsim.controller.queue.zone_table import WorldZoneTable
from rapidsim.controller.solo_moves import SoloMoves
from rapidsim.findings.reach_and_motion_data import CoordinationImpossible
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.language.moves import Move
from rapidsim.motion.configurations.targets import Lead, lead_of

_IN_A_CIRCLE = "{}, which holds the work object, waits for this robot in turn, which holds its own"
_NO_OTHER_LIMITS = "robots that move together keep the limits of their axes and of their TCPs alone"
_ONE_RAMP = "the lowest ramp since the last stop point counts for all"


@dataclass(slots=True, eq=False)
class TaskTeam:
    """Implements `language.tasks.SyncMoves`, and puts the moves of a task on its robot's path."""

    clock: TaskClock
    unit: MechanicalUnit
    cell: Cell
    resolver: Resolver
    table: InterruptTable
    marks: PathMarks
    zones: WorldZoneTable
    journal: Journal
    state: MotionState
    solo: SoloMoves
    others: TaskOthers

    @property
    def team(self) -> tuple[str, ...]:
        """Names of the tasks that move together, this one among them; empty while it is alone."""
        return self.unit.team.tasks if self.unit.team is not None else ()

    def move_together(
        self, name: str, tasks: Sequence[str], *, max_time: float | None = None
    ) -> bool:
        """Wait for some tasks at a stop point; from there their robots move together.

        Raises:
            RapidError: ERR_ARGVALERR, if the robot moves together with others already; see `meet`.
        """
        if self.team:
            raise rapid_error(
                ERR_ARGVALERR, f"SyncMoveOn {name}: {self.others.task_name} moves together already"
            )
        self.others.require_listed("SyncMoveOn", name, tasks)
        self.clock.note_line()
        self.clock.come_to_rest()
        meeting = self.others.come_together("SyncMoveOn", name, tasks, max_time)
        if meeting is None:
            return False
        self._join(meeting, tasks)
        return True

    def move_apart(self, name: str, *, max_time: float | None = None) -> bool:
        """Wait for the tasks that move together at a stop point; from there each moves alone."""
        self.clock.note_line()
        self.clock.come_to_rest()
        if self.others.come_together("SyncMoveOff", name, self.team, max_time) is None:
            return False
        self.leave_team()
        return True

    def leave_team(self) -> None:
        """Let all that move together move alone, without waiting for anybody."""
        self.unit.suspended = ()
        team = self.unit.team
        if team is not None:
            self.clock.come_to_rest()
            for one in self.others.all_tasks().values():
                if one.unit.team is team:
                    one.unit.part()

    def suspend_team(self) -> None:
        """Move alone until `resume_team`; all tasks of the team do so together."""
        team = self.unit.team
        if team is not None:
            self.clock.note_line()
            self.clock.come_to_rest()
            self.others.come_together("SyncMoveSuspend", "", team.tasks, None)
            self.unit.part()
            self.unit.suspended = team.tasks

    def resume_team(self) -> None:
        """Move together again."""
        if self.unit.suspended:
            tasks, self.unit.suspended = self.unit.suspended, ()
            self.clock.note_line()
            self.clock.come_to_rest()
            meeting = self.others.come_together("SyncMoveResume", "", tasks, None)
            assert meeting is not None
            self._join(meeting, tasks)

    def put(self, move: Move, before: Callable[[QueuedMove], None], *, wait: bool = True) -> None:
        r"""Put a move on the path, in a team together with those of the others.

        Raises:
            RapidError: ERR_ARGVALERR, if the task has no robot or the numbers \ID do not agree.
        """
        if not self.others.has_robot:
            raise rapid_error(
                ERR_ARGVALERR,
                f"{move.instruction}: the task {self.others.task_name} has no robot; in the "
                "station file, give it one with `robot` or `motion = true`",
            )
        seat = self.unit.seat
        if seat is None:
            if move.sync_id is not None and self.cell.is_shared:
                why = "without SyncMoveOn before it"
                if self.unit.has_left_team:
                    why = r"after SyncMoveSuspend, or after StorePath without \KeepSync"
                raise rapid_error(ERR_ARGVALERR, f"{move.instruction} \\ID {why}")
            self.solo.put(move, before, wait=wait)
            return
        if move.sync_id is None:
            raise rapid_error(
                ERR_ARGVALERR,
                f"{move.instruction} without \\ID between SyncMoveOn and SyncMoveOff",
            )
        queued = self._in_step(seat, move, move.sync_id)
        self.journal.moves_given = len(self.unit.own.moves)
        before(queued)
        self._say_what_a_team_ignores(move, queued)
        self.state.use(move, self.clock.place.arguments)
        if queued.corner is CornerKind.STOP and wait and not move.concurrent:
            self.clock.drive_to_stop()
            self.clock.pass_time(max(self.clock.observe(), self.unit.queue.trajectory.duration))
            return
        self.clock.follow(queued.started)
        looks = self.table.armed or self.zones.is_watching or self.marks.may_interrupt
        if looks or self.cell.outsiders_act:
            self.solo.keep_up()

    def _say_what_a_team_ignores(self, move: Move, queued: QueuedMove) -> None:
        segment = queued.segment
        limits = (segment.tcp_acceleration, segment.tcp_deceleration, segment.world_acceleration)
        if math.isfinite(min(limits)):
            name = f"PathAccLim or WorldAccLim with {move.instruction} \\ID"
            self.journal.unsimulated(name, _NO_OTHER_LIMITS, self.clock.place)
        own_speeds = segment.external_speeds[: len(segment.start.external)]
        if any(math.isfinite(speed) for speed in own_speeds):
            name = f"the programmed speed of external axes with {move.instruction} \\ID"
            self.journal.unsimulated(name, _NO_OTHER_LIMITS, self.clock.place)

        if segment.ramp < self.state.settings.ramp_percent / 100.0:
            name = "different ramps of robots that move together"
            self.journal.unsimulated(name, _ONE_RAMP, self.clock.place)

    def _in_step(self, seat: TeamQueue, move: Move, sync_id: float) -> QueuedMove:
        """Say a part of the next move of the team and wait until all have said theirs."""
        self.clock.note_line()
        lead = self._lead(seat, move, sync_id)
        queued = self.resolver.resolve(
            move, self.clock.place, seat.end, self.state.settings, lead=lead
        )
        passes = self.table.armed or self.marks.is_pending
        if self.clock.thinks_long() or not seat.is_open or passes:
            self.clock.come_up()
        offer = seat.team.say(seat.number, queued, sync_id)
        if len(offer.parts) < len(seat.team.robots):
            if seat.number in seat.team.waiting.values():
                self.cell.happenings += 1
                self.cell.turns.look_again(0.0)
            self._await(seat.team, lambda: offer.is_complete, sync_id)
            return queued
        moment = self.clock.moment()
        now_s = moment.time_s if moment.instant.time is not None else -math.inf
        seat.team.begin(offer, now_s)
        self.cell.happenings += 1
        self.cell.turns.look_again(max(now_s, 0.0))
        return queued

    def _lead(self, seat: TeamQueue, move: Move, sync_id: float) -> Lead | None:
        """The robot of the team that carries the work object of a move along, if one does.

        Where it goes must be known first, so this waits for its task.

        Raises:
            MoveImpossible: If it waits for this one in turn.
            WaitsForever: If its task never says.
        """
        wobj, team = move.wobj, seat.team
        other = None if wobj.ufprog or wobj.robhold else self.others.robot_of(wobj.ufmec)
        if other is None or other is self.others or other.task_name not in team.tasks:
            return None
        number = team.tasks.index(other.task_name)
        after = number
        while after in team.waiting:
            after = team.waiting[after]
            if after == seat.number:
                name = target_name(self.clock.place, move)
                raise MoveImpossible(CoordinationImpossible(name, _IN_A_CIRCLE.format(wobj.ufmec)))
        team.waiting[seat.number] = number
        try:
            self._await(team, lambda: team.said(number) is not None, sync_id)
        finally:
            del team.waiting[seat.number]
        part = team.said(number)
        assert part is not None
        return lead_of(
            number,
            other.resolver.robot,
            self.resolver.base_from_world,
            other.resolver.base_from_world.inverse(),
            (part.segment.start, part.segment.end),
            len(self.resolver.robot.external),
        )

    def _await(self, team: TeamPlanner, ready: Callable[[], bool], sync_id: float) -> None:
        """Sleep until other tasks have said their parts of the next move.

        Raises:
            WaitsForever: If one of them never will.
        """
        others = ", ".join(self._silent(team))
        # Nobody needs the time where the robots are still on the way that all know.
        waits = self.clock.waiting(others) if self.clock.is_known else nullcontext(Waiting())
        with waits as wait:
            while not ready():
                if self.clock.is_known:
                    woken = self.clock.await_event(math.inf)
                else:
                    woken = not math.isinf(self.cell.turns.until(self.clock, math.inf))
                if not woken:
                    missing = ", ".join(self._silent(team))
                    raise WaitsForever(
                        f"{missing} has no move with \\ID:={sync_id:g} to make together"
                    )
            wait.ended_by = others

    def _silent(self, team: TeamPlanner) -> Iterator[str]:
        """The other tasks that have not said their part of the next move."""
        own = self.others.task_name
        return (t for n, t in enumerate(team.tasks) if t != own and team.said(n) is None)

    def _join(self, meeting: Meeting, tasks: Sequence[str]) -> None:
        """Take the place in the team that some tasks form; the first to come here makes it."""
        if meeting.outcome is None:
            wanted = {name.lower() for name in tasks}
            known = self.others.all_tasks().items()
            members = [one for key, one in known if key in wanted and one.has_robot]
            robots = [one.unit.own for one in members]
            meeting.outcome = TeamPlanner([one.task_name for one in members], robots)
        if self.others.has_robot:
            assert isinstance(meeting.outcome, TeamPlanner)
            number = meeting.outcome.tasks.index(self.others.task_name)
            self.unit.join(meeting.outcome, number)
