r"""Synchronized motion with robots of other tasks: SyncMoveOn, SyncMoveOff, moves with \ID.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "SyncMoveOn",
"SyncMoveOff", "SyncMoveSuspend"; Application manual MultiMove.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import nullcontext
from dataclasses import dataclass

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.cell.rendezvous import Rendezvous
from rapidsim.controller.clock import ActiveWait, TaskClock
from rapidsim.controller.interrupt_table import InterruptTable
from rapidsim.controller.journal.journal import Journal
from rapidsim.controller.journal.stop_reasons import MoveImpossible, WaitsForever
from rapidsim.controller.motion_state import MotionState
from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.move_request import target_name
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.other_tasks import TaskCoordination
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.controller.queue.path_marks import PathMarks
from rapidsim.controller.queue.team_planner import TeamPlanner
from rapidsim.controller.queue.team_queue import TeamQueue
from rapidsim.controller.queue.zone_table import WorldZoneTable
from rapidsim.controller.solo_moves import SoloMoves
from rapidsim.findings.reach_and_motion_data import CoordinationImpossible
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.language.moves import Move
from rapidsim.motion.configurations.targets import CarrierMotion, carrier_motion

_IN_A_CIRCLE = "{}, which holds the work object, waits for this robot in turn, which holds its own"
_NO_OTHER_LIMITS = "robots that move together keep the limits of their axes and of their TCPs alone"
_ONE_RAMP = "the lowest ramp since the last stop point counts for all"


@dataclass(slots=True, eq=False)
class TaskTeam:
    """Implements `language.tasks.SyncMoves`, and appends a task's moves to its robot's path."""

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
    coordination: TaskCoordination

    @property
    def team(self) -> tuple[str, ...]:
        """Names of the tasks of the team, this one included; empty while it moves alone."""
        return self.unit.team.tasks if self.unit.team is not None else ()

    def sync_move_on(
        self, name: str, tasks: Sequence[str], *, max_time: float | None = None
    ) -> bool:
        """Wait for some tasks at a stop point; from there their robots form a team.

        Raises:
            RapidError: ERR_ARGVALERR, if the robot is in a team already; see `meet`.
        """
        if self.team:
            raise rapid_error(
                ERR_ARGVALERR,
                f"SyncMoveOn {name}: {self.coordination.task_name} moves together already",
            )
        self.coordination.require_listed("SyncMoveOn", name, tasks)
        self.clock.note_line()
        self.clock.bring_to_rest()
        meeting = self.coordination.rendezvous("SyncMoveOn", name, tasks, max_time)
        if meeting is None:
            return False
        self._join(meeting, tasks)
        return True

    def sync_move_off(self, name: str, *, max_time: float | None = None) -> bool:
        """Wait for the tasks of the team at a stop point; from there each moves alone."""
        self.clock.note_line()
        self.clock.bring_to_rest()
        if self.coordination.rendezvous("SyncMoveOff", name, self.team, max_time) is None:
            return False
        self.leave_team()
        return True

    def leave_team(self) -> None:
        """End the team at once: all its robots move alone, without waiting for other tasks."""
        self.unit.suspended = ()
        team = self.unit.team
        if team is not None:
            self.clock.bring_to_rest()
            for one in self.coordination.all_tasks().values():
                if one.unit.team is team:
                    one.unit.part()

    def suspend_team(self) -> None:
        """Move alone until `resume_team`; all tasks of the team do so together."""
        team = self.unit.team
        if team is not None:
            self.clock.note_line()
            self.clock.bring_to_rest()
            self.coordination.rendezvous("SyncMoveSuspend", "", team.tasks, None)
            self.unit.part()
            self.unit.suspended = team.tasks

    def resume_team(self) -> None:
        """Join the suspended team again."""
        if self.unit.suspended:
            tasks, self.unit.suspended = self.unit.suspended, ()
            self.clock.note_line()
            self.clock.bring_to_rest()
            meeting = self.coordination.rendezvous("SyncMoveResume", "", tasks, None)
            assert meeting is not None
            self._join(meeting, tasks)

    def put(self, move: Move, before: Callable[[QueuedMove], None], *, wait: bool = True) -> None:
        r"""Append a move to the path, in a team together with the moves of the other tasks.

        Raises:
            RapidError: ERR_ARGVALERR, if the task has no robot or the numbers \ID do not agree.
        """
        if not self.coordination.has_robot:
            raise rapid_error(
                ERR_ARGVALERR,
                f"{move.instruction}: the task {self.coordination.task_name} has no robot; in the "
                "station file, give it one with `robot` or `motion = true`",
            )
        seat = self.unit.team_queue
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
        self.journal.moves_given = len(self.unit.solo_queue.moves)
        before(queued)
        self._report_ignored_options(move, queued)
        self.state.use(move, self.clock.place.arguments)
        if queued.corner is CornerKind.STOP and wait and not move.concurrent:
            self.clock.drive_to_stop()
            self.clock.pass_time(
                max(self.clock.resolve_time(), self.unit.queue.trajectory.duration)
            )
            return
        self.clock.follow(queued.started)
        looks = self.table.armed or self.zones.is_watching or self.marks.may_interrupt
        if looks or self.cell.has_clients:
            self.solo.keep_up()

    def _report_ignored_options(self, move: Move, queued: QueuedMove) -> None:
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

    def _in_step(self, team_queue: TeamQueue, move: Move, sync_id: float) -> QueuedMove:
        """Submit a part of the next move of the team and wait until all parts are submitted."""
        self.clock.note_line()
        lead = self._lead(team_queue, move, sync_id)
        queued = self.resolver.resolve(
            move, self.clock.place, team_queue.end, self.state.settings, lead=lead
        )
        passes = self.table.armed or self.marks.is_pending
        if self.clock.is_compute_bound() or not team_queue.is_open or passes:
            self.clock.synchronise()
        offer = team_queue.team.submit(team_queue.number, queued, sync_id)
        if len(offer.parts) < len(team_queue.team.robots):
            if team_queue.number in team_queue.team.waiting.values():
                self.cell.event_count += 1
                self.cell.scheduler.wake_at(0.0)
            self._await(team_queue.team, lambda: offer.is_complete, sync_id)
            return queued
        moment = self.clock.moment()
        now_s = moment.time_s if moment.instant.time is not None else -math.inf
        team_queue.team.begin(offer, now_s)
        self.cell.event_count += 1
        self.cell.scheduler.wake_at(max(now_s, 0.0))
        return queued

    def _lead(self, team_queue: TeamQueue, move: Move, sync_id: float) -> CarrierMotion | None:
        """Motion of the robot of the team that carries a move's work object; None if none does.

        Its end must be known first, so this waits for its task.

        Raises:
            MoveImpossible: If it waits for this one in turn.
            WaitsForever: If its task never submits its part.
        """
        wobj, team = move.wobj, team_queue.team
        other = None if wobj.ufprog or wobj.robhold else self.coordination.robot_of(wobj.ufmec)
        if other is None or other is self.coordination or other.task_name not in team.tasks:
            return None
        number = team.tasks.index(other.task_name)
        after = number
        while after in team.waiting:
            after = team.waiting[after]
            if after == team_queue.number:
                name = target_name(self.clock.place, move)
                raise MoveImpossible(CoordinationImpossible(name, _IN_A_CIRCLE.format(wobj.ufmec)))
        team.waiting[team_queue.number] = number
        try:
            self._await(team, lambda: team.submitted(number) is not None, sync_id)
        finally:
            del team.waiting[team_queue.number]
        part = team.submitted(number)
        assert part is not None
        return carrier_motion(
            number,
            other.resolver.robot,
            self.resolver.base_from_world,
            other.resolver.base_from_world.inverse(),
            (part.segment.start, part.segment.end),
            len(self.resolver.robot.external),
        )

    def _await(self, team: TeamPlanner, ready: Callable[[], bool], sync_id: float) -> None:
        """Wait until other tasks have submitted their parts of the next move.

        Raises:
            WaitsForever: If one of them never will.
        """
        others = ", ".join(self._silent(team))
        # While the robots are still on a known path, the time need not be resolved.
        waits = self.clock.waiting(others) if self.clock.is_known else nullcontext(ActiveWait())
        with waits as wait:
            while not ready():
                if self.clock.is_known:
                    woken = self.clock.await_event(math.inf)
                else:
                    woken = not math.isinf(
                        self.cell.scheduler.request_advance(self.clock, math.inf)
                    )
                if not woken:
                    missing = ", ".join(self._silent(team))
                    raise WaitsForever(
                        f"{missing} has no move with \\ID:={sync_id:g} to make together"
                    )
            wait.ended_by = others

    def _silent(self, team: TeamPlanner) -> Iterator[str]:
        """Tasks that have not submitted their part of the next move."""
        own = self.coordination.task_name
        return (t for n, t in enumerate(team.tasks) if t != own and team.submitted(n) is None)

    def _join(self, rendezvous: Rendezvous, tasks: Sequence[str]) -> None:
        """Join the team that some tasks form; the first of them to arrive creates it."""
        if rendezvous.outcome is None:
            wanted = {name.lower() for name in tasks}
            known = self.coordination.all_tasks().items()
            members = [one for key, one in known if key in wanted and one.has_robot]
            robots = [one.unit.solo_queue for one in members]
            rendezvous.outcome = TeamPlanner([one.task_name for one in members], robots)
        if self.coordination.has_robot:
            assert isinstance(rendezvous.outcome, TeamPlanner)
            number = rendezvous.outcome.tasks.index(self.coordination.task_name)
            self.unit.join(rendezvous.outcome, number)
