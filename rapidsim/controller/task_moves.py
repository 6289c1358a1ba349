"""Appending the moves of a task to the path of its robot, alone or in a team."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Protocol

from rapidsim.controller.belt_tracking import BeltTracking
from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.interrupt_table import InterruptTable
from rapidsim.controller.interrupts import TaskInterrupts
from rapidsim.controller.journal.events import THE_TIME
from rapidsim.controller.journal.journal import Journal
from rapidsim.controller.motion_state import MotionState
from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.controller.queue.motion_queue import MAX_OPEN_MOVES
from rapidsim.controller.queue.path_marks import PathMarks
from rapidsim.controller.queue.zone_table import WorldZoneTable
from rapidsim.controller.synchronisation import TaskSynchronisation
from rapidsim.findings.runs import MoveWithoutStorePath, RampWaits
from rapidsim.language.error_log import CORNER_PATH_FAILURE
from rapidsim.language.error_numbers import ERR_CONC_MAX, rapid_error
from rapidsim.language.errors import NotAllowed
from rapidsim.language.moves import AnnouncedTargets, Move, SensorInfluence
from rapidsim.values import value_class

_NO_OTHER_LIMITS = "robots that move together keep the limits of their axes and of their TCPs alone"
_ONE_RAMP = "the lowest ramp since the last stop point counts for all"
MAX_CONCURRENT_MOVES = 5
r"""Maximum number of moves with \Conc in succession."""


class EnqueueMove(Protocol):
    """Appends a move to the path; returns when the program may continue."""

    def __call__(
        self, move: Move, before: Callable[[QueuedMove], None], *, wait: bool = True
    ) -> None:
        """Append a move to the path.

        Args:
            move: The move.
            before: Called with the move before the program waits for it.
            wait: Whether to wait for the stop, if the move has one.

        Raises:
            MoveImpossible: When the end of the move cannot be reached.
            MotionError: When a move on the path cannot be made.
        """
        ...


@value_class(frozen=True, slots=True)
class TaskMoves:
    """Appends the moves of a task to the path of its robot."""

    clock: TaskClock
    unit: MechanicalUnit
    cell: Cell
    resolver: Resolver
    table: InterruptTable
    marks: PathMarks
    zones: WorldZoneTable
    journal: Journal
    state: MotionState
    interrupts: TaskInterrupts
    synchronisation: TaskSynchronisation
    belts: BeltTracking

    def put(self, move: Move, before: Callable[[QueuedMove], None], *, wait: bool = True) -> None:
        r"""Append a move to the path, in a team together with the moves of the other tasks.

        Raises:
            RapidError: ERR_ARGVALERR, if the task has no robot or the numbers \ID do not agree.
        """
        self.synchronisation.require_id(move)
        self.clock.note_line()
        self._count_concurrent(move)
        self._note_level(move)
        member = self.unit.member
        if member.guided is not None:
            raise NotAllowed(
                f"{move.instruction}: a sensor guides the robot; EGMStop, or EGMWaitCond, ends that"
            )
        if member.corrected is not None and move.sensed is SensorInfluence.NEVER:
            member.corrected.end()
        queued = self._append(move)
        self.journal.moves_given = len(self.unit.moves)
        before(queued)
        self._note_ramp(queued)
        self.state.use(move, self.clock.place.arguments)
        if queued.corner is CornerKind.STOP and wait and not move.concurrent:
            self._wait_for_stop(move)
            return
        self.clock.follow(queued.started)
        if self._may_interrupt or self.unit.queue.open_moves > MAX_OPEN_MOVES:
            self.keep_up()

    @property
    def _may_interrupt(self) -> bool:
        """Whether something may happen between two moves for which the path has to be known."""
        return (
            self.table.armed
            or self.cell.has_clients
            or self.zones.is_watching
            or self.marks.may_interrupt
        )

    def repeat(self, targets: AnnouncedTargets, number: int, most: int) -> int:
        """Make announced moves like the last one at once; see `Motion.repeat`.

        It had no remark, neither have they: only their targets differ, and these are plain.
        """
        queue, expected, journal = self.unit.queue, self.resolver.expected, self.journal
        is_remarkable = expected.remarks != journal.remarks
        expected.remarks = journal.remarks
        is_alone = self.unit.team is None and queue.is_open and not queue.is_halted
        if is_remarkable or self._may_interrupt or self.interrupts.in_trap or not is_alone:
            return 0
        last = self.unit.moves[-1]
        is_at_once = not self.clock.needs_service and not self.clock.moment().offset_s
        if not is_at_once or last.corner is not CornerKind.FLY_BY or last.started.time is not None:
            return 0
        moves = expected.more(last, min(most, MAX_OPEN_MOVES - queue.open_moves))
        if moves:
            self.cell.watchdog.check()
            journal.rows([last.started, *(one.started for one in moves[:-1])], targets, number)
            queue.extend(moves)
            journal.moves_given = len(self.unit.moves)
            self.clock.effect_count += len(moves)
            self.clock.place = moves[-1].place
            self.clock.follow(moves[-1].started)
        return len(moves)

    def _append(self, move: Move) -> QueuedMove:
        """Resolve a move and append it, in a team when the other tasks have submitted theirs."""
        if self.unit.team is not None:
            self.belts.followed_by(move, self.state.settings.inactive_units)
            queued = self.synchronisation.submit(move)
            self._report_ignored_options(move, queued)
            return queued
        queued = self._resolved(move)
        if self.clock.is_compute_bound() or not self.unit.queue.is_open:
            self.clock.resolve_time()
        last = self.unit.moves[-1] if self.unit.queue.is_open else None
        now_s = self.clock.moment().earliest_s
        self.unit.queue.append((queued,), now_s)
        if last is not None and last.corner is CornerKind.STOP_CORNER_PATH_FAILURE:
            self.table.error_logged(CORNER_PATH_FAILURE, now_s)
        return queued

    def _report_ignored_options(self, move: Move, queued: QueuedMove) -> None:
        """Report the options of a move that do not count for robots that move together."""
        segment, place = queued.segment, self.clock.place
        limits = (segment.tcp_acceleration, segment.tcp_deceleration, segment.world_acceleration)
        if math.isfinite(min(limits)):
            name = f"PathAccLim or WorldAccLim with {move.instruction} \\ID"
            self.journal.unsimulated(name, _NO_OTHER_LIMITS, place)
        own_speeds = segment.external_speeds[: len(segment.start.external)]
        if any(math.isfinite(speed) for speed in own_speeds):
            name = f"the programmed speed of external axes with {move.instruction} \\ID"
            self.journal.unsimulated(name, _NO_OTHER_LIMITS, place)

    def _resolved(self, move: Move) -> QueuedMove:
        """The move from the end of the queue; the first may choose where the arm starts."""
        place, settings, member = self.clock.place, self.state.settings, self.unit.member
        is_first = not len(member.moves)
        is_free = is_first and member.start_is_free and move.sensed is SensorInfluence.NEVER
        if is_free:
            start = self.resolver.first_start(move, place, member.end, settings)
            if start is not None:
                self.unit.begin_at(start)
        belt = self.belts.followed_by(move, settings.inactive_units)
        return self.resolver.resolve(
            *(move, place, member.end, settings),
            is_first=is_first,
            starts_free=is_free,
            belt=belt,
        )

    def _wait_for_stop(self, move: Move) -> None:
        self.clock.drive_to_stop()
        if self.unit.team is not None:
            # Another task may have stopped the robots before, and this one has waited for that.
            self.clock.pass_time(max(self.clock.resolve_time(), self.unit.trajectory.duration))
        if move.stop and move.stop.program_waits:
            with self.clock.waiting(f"{move.stop.seconds:g} s") as waiting:
                self.clock.pass_time(self.clock.resolve_time() + move.stop.seconds)
                waiting.ended_by = THE_TIME

    def keep_up(self) -> None:
        """Dispatch interrupts on time although the program runs ahead of the robot.

        Planning after each move would be slow. Planning waits until the queued moves last, at their
        programmed speeds, until the next interrupt is due and the arm could stop after it.
        """
        due_s = self.clock.next_due_s()
        queue = self.unit.queue
        early = not self.marks.may_interrupt and not self.zones.is_watching
        early &= not self.cell.is_shared
        early &= due_s is None or queue.nominal_last_start() - queue.braking_s < due_s
        if early and queue.open_moves <= MAX_OPEN_MOVES:
            return
        fixed_s = queue.commit_ahead()
        if fixed_s is None:
            return
        self.journal.settle()
        self.clock.serve_due(min(fixed_s, self.cell.max_time_s))
        if fixed_s > self.cell.max_time_s:
            self.clock.go_to(fixed_s)

    def _note_ramp(self, queued: QueuedMove) -> None:
        """Report a ramp above that of the moves before, or of the team, which does not count."""
        requested, used = self.state.settings.ramp_percent, queued.segment.ramp
        if used >= requested / 100.0:
            return
        if self.unit.team is None:
            found = RampWaits(requested, 100.0 * used)
            self.journal.finding(found, self.clock.place, once=RampWaits)
        else:
            name = "different ramps of robots that move together"
            self.journal.unsimulated(name, _ONE_RAMP, self.clock.place)

    def _note_level(self, move: Move) -> None:
        """Report a move that a controller requires to be on a path of its own."""
        if not self.interrupts.in_trap or self.unit.member.level:
            return
        place = self.clock.place
        found = MoveWithoutStorePath(move.instruction)
        self.journal.finding(found, place, once=(MoveWithoutStorePath, place.span))

    def _count_concurrent(self, move: Move) -> None:
        r"""Refuse more moves with \Conc in succession than a controller accepts.

        Raises:
            RapidError: ERR_CONC_MAX.
        """
        state = self.state
        if move.concurrent and self.unit.member.level:
            raise NotAllowed(
                rf"{move.instruction} \Conc between StorePath and RestoPath is not allowed"
            )
        state.concurrent = state.concurrent + 1 if move.concurrent else 0
        if state.concurrent > MAX_CONCURRENT_MOVES:
            state.concurrent = 0
            raise rapid_error(
                ERR_CONC_MAX,
                rf"more than {MAX_CONCURRENT_MOVES} moves with \Conc in succession",
            )
