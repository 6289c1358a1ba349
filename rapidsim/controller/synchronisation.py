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
from rapidsim.controller.journal.stop_reasons import MoveImpossible, WaitsForever
from rapidsim.controller.motion_state import MotionState
from rapidsim.controller.moves.move_request import target_name
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.other_tasks import TaskCoordination
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.controller.queue.motion_queue import MotionQueue
from rapidsim.controller.queue.path_marks import PathMarks
from rapidsim.controller.queue.synchronised_tasks import SynchronisedTasks
from rapidsim.findings.reach_and_motion_data import CoordinationImpossible
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.language.errors import NotAllowed
from rapidsim.language.moves import Move
from rapidsim.motion.configurations.targets import CarrierMotion, carrier_motion

_IN_A_CIRCLE = "{}, which holds the work object, waits for this robot in turn, which holds its own"


@dataclass(slots=True, eq=False)
class TaskSynchronisation:
    """Implements `language.tasks.SyncMoves`, and submits a task's parts of synchronised moves."""

    clock: TaskClock
    unit: MechanicalUnit
    cell: Cell
    resolver: Resolver
    table: InterruptTable
    marks: PathMarks
    state: MotionState
    coordination: TaskCoordination

    @property
    def team(self) -> tuple[str, ...]:
        """Names of the tasks of the team, this one included; empty while it moves alone."""
        return self.unit.team.names if self.unit.team is not None else ()

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
        if self.unit.member.rides:
            raise NotAllowed("SyncMoveOn while the robot follows a conveyor; leave it before")
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
            self.coordination.rendezvous("SyncMoveSuspend", "", team.names, None)
            self.unit.part()
            self.unit.suspended = team.names

    def resume_team(self) -> None:
        """Join the suspended team again."""
        if self.unit.suspended:
            tasks, self.unit.suspended = self.unit.suspended, ()
            self.clock.note_line()
            self.clock.bring_to_rest()
            meeting = self.coordination.rendezvous("SyncMoveResume", "", tasks, None)
            assert meeting is not None
            self._join(meeting, tasks)

    def require_id(self, move: Move) -> None:
        r"""Refuse a move that is no part of a synchronised one although it should be, or is one.

        Raises:
            RapidError: ERR_ARGVALERR, if the task has no robot, or about the argument \ID.
        """
        if not self.coordination.has_robot:
            raise rapid_error(
                ERR_ARGVALERR,
                f"{move.instruction}: the task {self.coordination.task_name} has no robot; in the "
                "station file, give it one with `robot` or `motion = true`",
            )
        is_alone = len(self.coordination.all_tasks()) == 1
        if self.unit.team is None and move.sync_id is not None and not is_alone:
            why = "without SyncMoveOn before it"
            if self.unit.has_left_team:
                why = r"after SyncMoveSuspend, or after StorePath without \KeepSync"
            raise rapid_error(ERR_ARGVALERR, f"{move.instruction} \\ID {why}")
        if self.unit.team is not None and move.sync_id is None:
            raise rapid_error(
                ERR_ARGVALERR,
                f"{move.instruction} without \\ID between SyncMoveOn and SyncMoveOff",
            )

    def submit(self, move: Move) -> QueuedMove:
        """Submit a part of the next move of the team and wait until all parts are submitted."""
        queue, number, team = self.unit.queue, self.unit.number, self.unit.team
        assert team is not None
        assert move.sync_id is not None
        lead = self._lead(team, move, move.sync_id)
        queued = self.resolver.resolve(
            move, self.clock.place, self.unit.end, self.state.settings, lead=lead
        )
        passes = self.table.armed or self.marks.is_pending
        if self.clock.is_compute_bound() or not queue.is_open or passes:
            self.clock.synchronise()
        pending = team.submit(number, queued, move.sync_id)
        if len(pending.parts) < len(team.names):
            if number in team.waiting.values():
                self.cell.event_count += 1
                self.cell.scheduler.wake_at(0.0)
            self._await(team, lambda: pending.is_complete, move.sync_id)
            return queued
        now_s = self.clock.moment().earliest_s
        queue.append(team.complete(pending), now_s)
        self.cell.event_count += 1
        self.cell.scheduler.wake_at(max(now_s, 0.0))
        return queued

    def _lead(self, team: SynchronisedTasks, move: Move, sync_id: float) -> CarrierMotion | None:
        """Motion of the robot of the team that carries a move's work object; None if none does.

        Its end must be known first, so this waits for its task.

        Raises:
            MoveImpossible: If it waits for this one in turn.
            WaitsForever: If its task never submits its part.
        """
        wobj, own = move.wobj, self.unit.number
        other = None if wobj.ufprog or wobj.robhold else self.coordination.robot_of(wobj.ufmec)
        if other is None or other is self.coordination or other.task_name not in team.names:
            return None
        number = team.names.index(other.task_name)
        after = number
        while after in team.waiting:
            after = team.waiting[after]
            if after == own:
                name = target_name(self.clock.place, move)
                raise MoveImpossible(CoordinationImpossible(name, _IN_A_CIRCLE.format(wobj.ufmec)))
        team.waiting[own] = number
        try:
            self._await(team, lambda: team.submitted(number) is not None, sync_id)
        finally:
            del team.waiting[own]
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

    def _await(self, team: SynchronisedTasks, ready: Callable[[], bool], sync_id: float) -> None:
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

    def _silent(self, team: SynchronisedTasks) -> Iterator[str]:
        """Tasks that have not submitted their part of the next move."""
        own = self.coordination.task_name
        return (t for n, t in enumerate(team.names) if t != own and team.submitted(n) is None)

    def _join(self, rendezvous: Rendezvous, tasks: Sequence[str]) -> None:
        """Join the team that some tasks form; the first of them to arrive creates it."""
        if rendezvous.outcome is None:
            wanted = {name.lower() for name in tasks}
            known = self.coordination.all_tasks().items()
            members = [one for key, one in known if key in wanted and one.has_robot]
            team = SynchronisedTasks(tuple(one.task_name for one in members))
            robots = [one.unit.member for one in members]
            rendezvous.outcome = MotionQueue(robots, self.cell.watchdog.check, team)
        if self.coordination.has_robot:
            assert isinstance(rendezvous.outcome, MotionQueue)
            self.unit.join(rendezvous.outcome)
