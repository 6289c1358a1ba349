"""Virtual time of one task: time of the program pointer, dispatch of events, limits.

The program pointer's time is an instant plus an offset. After a fly-by move the instant is "the
robot starts that move", which is unknown until the path is planned; the program runs ahead and its
effects are dated later. Callers that need the time or the position call `resolve_time`.

RAPID statements take no virtual time except waits, motion, and a small fixed cost per loop turn.
All time passes in `pass_time`: the cell's `scheduler`, or the wall clock in its place, grants it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from typing import TypeVar

from rapidsim.controller.busy_wait import BusyWaitDetector
from rapidsim.controller.cell.cell import Cause, Cell
from rapidsim.controller.event_source import EventSource
from rapidsim.controller.interrupt_table import InterruptTable
from rapidsim.controller.journal.events import CUT_OFF, THE_TIME, EventKind, Wait
from rapidsim.controller.journal.journal import Instant, Journal, Moment
from rapidsim.controller.journal.stop_reasons import PollsForever, TimeLimitReached, WaitsForever
from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.pointer_time import BACKGROUND_TICK_S, PointerTime
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.controller.queue.motion_queue import LOOK_AHEAD_SLACK_S
from rapidsim.language.errors import RapidError
from rapidsim.language.moves import Place

T = TypeVar("T")
_ROUNDING_S = 1e-9


@dataclass(slots=True)
class ActiveWait:
    """A wait in progress."""

    ended_by: str = CUT_OFF


class TaskClock:
    """Implements `language.controller.ClockService`: the only place where a task's time passes."""

    def __init__(
        self,
        cell: Cell,
        unit: MechanicalUnit,
        journal: Journal,
        table: InterruptTable,
        place: Place,
    ) -> None:
        """Start at time zero with the arm where the unit has it and the pointer at `place`."""
        self.place = place
        self.ticks_left = 0
        self.event_sources: tuple[EventSource, ...] = ()
        """In the order of dispatch at equal times; set once, when all exist."""
        self.observers: list[Callable[[], None]] = []
        """Called at each statement that reports, to check the program's data for changes."""
        self.time_reads = 0
        """Number of times the program has read the time."""
        self._cell = cell
        self._unit = unit
        self._journal = journal
        self._table = table
        self.program_state: Callable[[], Iterable[object]] = lambda: (None,)
        self._polling = BusyWaitDetector(lambda: self.program_state())
        self._time = PointerTime()
        self.effect_count = 0
        """Number of statements with side effects so far."""
        self._reported = place
        """Place of the last statement with side effects: the start of a poll iteration."""
        self._passed_s = 0.0
        """Time [s] up to which all events were dispatched; none is dispatched before it again."""
        self._serves = False
        """Whether due events are dispatched between two statements."""
        self._handler_depth = 0
        """Number of nested handlers that run (traps and the like)."""
        self._failure: RapidError | None = None
        """The error with which a trap ends the statement it interrupts."""
        self.idle_until_s = -math.inf
        """Until then [s] the program only polls; reset when shared data change."""
        self._viewed_s: float | None = None
        """The time [s] of `at_time`; None outside it."""
        cell.listeners.append(table)
        cell.watchdog.watch(self)

    @property
    def watches(self) -> bool:
        """Whether an interrupt waits for a change of a persistent."""
        return self._table.watches

    @property
    def needs_service(self) -> bool:
        """Whether a statement has to wait for something even if its time is unknown."""
        return self.watches or self._failure is not None

    @property
    def is_known(self) -> bool:
        """Whether the path that decides the pointer's time has been planned."""
        return self._time.is_known

    def synchronise(self) -> float:
        """Return the time [s] of the current statement after all other tasks have caught up.

        Called before reading or changing anything that tasks share.
        """
        if self._viewed_s is not None:
            # The others have caught up already, and the program's own time may still be unknown.
            return self._viewed_s
        now_s = self.resolve_time()
        if self._cell.is_shared:
            while self._cell.scheduler.request_advance(self, now_s) < now_s:
                pass
        return now_s

    def now(self) -> float:
        """Virtual time [s] of the current statement."""
        self.note_line()
        self.time_reads += 1
        return self.resolve_time()

    def note_unknown(self) -> None:
        """Let a loop around the current statement, which is unknown, go on to the time limit."""
        self._polling.note_stable_until(self._cell.max_time_s)

    def hold_until(self, time_s: float) -> None:
        """Note that all that the current statement reads stays unchanged until a time [s]."""
        self.discount_effect()
        self._polling.note_stable_until(time_s)

    def date_and_time(self) -> datetime:
        """Date and time of the controller's clock."""
        seconds = math.floor(self.now())
        self.hold_until(seconds + 1.0)
        return self._cell.starts_at + timedelta(seconds=seconds)

    def wait(self, seconds: float, *, in_position: bool = False) -> None:
        """Let virtual time pass; with `in_position`, first bring the robot to rest."""
        self.note_line()
        if in_position:
            self.bring_to_rest()
        now_s = self.resolve_time()
        with self.waiting(f"{seconds:g} s") as wait:
            self.pass_time(now_s + max(0.0, seconds))
            wait.ended_by = THE_TIME

    @contextmanager
    def waiting(self, awaited: str) -> Iterator[ActiveWait]:
        """Record that the current statement waits, if it takes time, and what ends the wait.

        Args:
            awaited: The awaited condition, for the journal.
        """
        place, start_s, wait = self.place, self.resolve_time(), ActiveWait()
        try:
            yield wait
        finally:
            end_s = self._time.known_s if self._time.is_known else start_s
            if end_s > start_s:
                task, ended_by = self._journal.task, wait.ended_by
                self._journal.wait(Wait(task, place, awaited, start_s, end_s, ended_by))

    def long_work(self) -> AbstractContextManager[None]:
        """Guard work that `--max-wall` may interrupt; raises as `ClockService.long_work` does."""
        return self._cell.watchdog.interrupting()

    def service(self) -> None:
        """Dispatch due events and grant the next slice of ticks.

        Raises:
            TimeLimitReached: When a time limit is reached.
        """
        self._cell.watchdog.check()
        if self._table.watches:
            self.serve_persistent_changes()
        time = self._time
        time.settle(self.ticks_left)
        if not time.is_known and time.offset_s > LOOK_AHEAD_SLACK_S:
            self.resolve_time()
        if time.is_known:
            due_s = self.next_due_s()
            # Ticks sum to a rounding error less: an event due in this very tick is due now.
            is_now = due_s is not None and 0.0 < due_s - time.known_s < _ROUNDING_S
            self._serves = True
            try:
                self._go(due_s if is_now and due_s is not None else time.known_s)
                self._skip_rounds()
            finally:
                self._serves = False
        self.grant()

    def _skip_rounds(self) -> None:
        """Skip to the next event if the program only polls for it.

        Raises:
            PollsForever: If no event can end the polling.
        """
        if self.place is not self._reported:
            # A new object, so that a call from this very statement is noticed, too.
            self.place = self._reported = replace(self.place)
            self.effect_count += 1
        used, now_s = self._time.used, self._time.known_s
        ticks = self._polling.observe(used, (self.effect_count, self._cell.event_count))
        if ticks is None:
            return
        due_s = self.next_due_s()
        own_s = min(math.inf if due_s is None else due_s, self._polling.stable_until_s)
        # Other polling tasks need not wait for this one.
        self.idle_until_s = own_s
        until_s = min(own_s, self._cell.scheduler.next_s(self))
        if math.isinf(until_s) and self._cell.scheduler.mark_waiting(self):
            raise PollsForever("the program loops forever here: nothing that it reads ever changes")
        round_s = ticks * self._time.tick_s
        # Stop one iteration early: the tick in which the program reads the change may matter.
        rounds = math.ceil((min(until_s, self._cell.max_time_s) - now_s) / round_s - 1e-6) - 1
        if rounds > 0:
            self._polling.again(used, ticks)
            self._go(now_s + rounds * round_s)
        else:
            self._polling.note_failed_check(used)

    def end_time_s(self) -> float:
        """Time [s] at which both the program pointer and the arm are done."""
        pointer_s = self._time.known_s if self._time.is_known else 0.0
        return min(self._cell.max_time_s, max(pointer_s, self._unit.trajectory.duration))

    def pointer_s(self) -> float:
        """Time [s] of the program pointer, or when its robot's path ends if unknown."""
        return self._time.known_s if self._time.is_known else self._unit.trajectory.command_end

    def is_compute_bound(self) -> bool:
        """Whether the program has computed for so long that it affects the path."""
        self._time.settle(self.ticks_left)
        return self._time.offset_s > LOOK_AHEAD_SLACK_S

    def follow(self, instant: Instant) -> None:
        """Set the pointer to an instant, known or not."""
        self._time.follow(instant)

    def set(self, time_s: float) -> None:
        """Set the pointer to a known time [s] without dispatching the events due before it."""
        self._time.set(time_s)

    def go_to(self, time_s: float) -> None:
        """Pass time up to `time_s` [s], whatever instant the program is at; see `pass_time`."""
        self._time.follow(Instant())
        self.pass_time(time_s)

    def notify_tasks(self) -> None:
        """Notify the other tasks of a change of shared data."""
        self._cell.notify(self.moment())

    def run_in_background(self) -> None:
        """Run loops more slowly than normal tasks."""
        self._time.tick_s = BACKGROUND_TICK_S

    def tick(self) -> None:
        """Let the time of one loop turn pass, so that endless loops take virtual time, too."""
        self.ticks_left -= 1
        if self.ticks_left < 0:
            self.service()

    def moment(self) -> Moment:
        """Moment of the current statement."""
        self._time.settle(self.ticks_left)
        return self._time.moment()

    def grant(self) -> None:
        """Grant the program ticks until the next event is due."""
        self._cell.watchdog.check()
        due_s = self.next_due_s()
        until_s = min(self._cell.max_time_s, math.inf if due_s is None else due_s)
        if self._cell.is_shared:
            until_s = min(until_s, self._cell.scheduler.next_s(self))
        most = self._polling.ticks_left(self._time.used)
        self.ticks_left = self._time.grant(until_s, LOOK_AHEAD_SLACK_S, most)

    def resolve_time(self) -> float:
        """The time [s] of the current statement; plans the path if that is needed to know it."""
        time = self._time
        time.settle(self.ticks_left)
        if not time.is_known:
            offset_s = time.offset_s
            self.await_restart()
            # During that wait another task of the team may have ended the block.
            if self._unit.queue.is_open:
                self.pass_time(self._unit.queue.commit_last_start())
            while self._unit.queue.is_open and (
                self._unit.queue.is_halted or self._unit.queue.commit_last_start() > time.known_s
            ):
                # An event before that start has stopped the robot, so the move starts later.
                self.await_restart()
                self.pass_time(self._unit.queue.commit_last_start())
            self.pass_time(time.known_s + offset_s)
        return time.known_s

    def pass_time(self, until_s: float) -> None:
        """Advance to a later time, serving the interrupts that fall due until then.

        Raises:
            TimeLimitReached: When the time limit comes first.
        """
        self._go(until_s)
        self.grant()

    def _go(self, until_s: float) -> None:
        """Pass time without granting ticks."""
        limit_s = self._cell.max_time_s
        reached_s = min(until_s, limit_s)
        served_s = self.serve_due(reached_s)
        now_s = self._time.known_s if self._time.is_known else 0.0
        self._time.set(max(reached_s, served_s, now_s))
        self._passed_s = max(self._passed_s, self._time.known_s)
        for one in self.event_sources:
            one.advance_to(self._passed_s)
        if until_s > limit_s:
            raise TimeLimitReached(f"the time limit of {limit_s:g} s was reached")

    def await_event(self, deadline_s: float) -> bool:
        """Let time pass until an event that a program may notice, or until a deadline [s].

        Returns:
            False if there is no deadline and no further event.
        """
        next_s = self.next_due_s()
        until_s = deadline_s if next_s is None else min(next_s, deadline_s)
        happenings = self._cell.event_count
        comes_s = self._cell.scheduler.request_advance(self, until_s)
        if math.isinf(comes_s):
            return False
        if comes_s < until_s or self._cell.event_count != happenings:
            self._note_foreign_changes(comes_s)
        self.pass_time(comes_s)
        return True

    def next_due_s(self) -> float | None:
        """Time [s] of the next event (signal change, interrupt, on the path); None if none.

        While the program runs ahead, events on the path are excluded: reading them would plan it.
        """
        known = self._time.is_known
        times = [one.next_s() for one in self.event_sources if known or not one.on_path]
        return min((time_s for time_s in times if time_s is not None), default=None)

    def serve_due(self, until_s: float) -> float:
        """Dispatch all events due by a time; returns when the last of them ended [s]."""
        ended_s = 0.0
        while True:
            self._cell.watchdog.check()
            times = [one.next_s() for one in self.event_sources]
            next_s = min((time_s for time_s in times if time_s is not None), default=math.inf)
            turn_s = min(next_s, until_s)
            happenings = self._cell.event_count
            reached_s = self._cell.scheduler.request_advance(self, turn_s)
            if reached_s < turn_s or self._cell.event_count != happenings:
                self._note_foreign_changes(reached_s)
                continue
            if next_s > until_s or math.isinf(next_s):
                return ended_s
            due = self.event_sources[times.index(next_s)]
            ended_s = max(ended_s, due.dispatch_next(self._passed_s, until_s))

    def run_handler(self, due_s: float, run: Callable[[], None]) -> float:
        """Run a handler, then continue where the program was.

        Args:
            due_s: Time [s] at which it begins, or as soon after that as it can.
            run: The handler; its statements pass time.

        Returns:
            Time [s] at which the handler has ended.
        """
        start_s = max(due_s, self._passed_s)
        instant, offset_s, place = self._time.instant, self._time.offset_s, self.place
        if instant.time is not None:
            start_s = max(start_s, instant.time + offset_s)
        self._time.set(start_s)
        around, self._handler_depth = self._handler_depth, self._handler_depth + 1
        try:
            run()
        except Exception:
            # An ERROR clause of the interrupted code may handle the error and continue.
            self._passed_s = max(self._passed_s, self.resolve_time())
            raise
        finally:
            self._handler_depth = around
        ended_s = self.resolve_time()
        self._passed_s = max(self._passed_s, ended_s)
        self.place = place
        if instant.time is None:
            self._time.instant, self._time.offset_s = instant, offset_s
        else:
            self._time.set(max(ended_s, instant.time + offset_s))
        if not self._serves:
            self._fail()
        return ended_s

    def leave_ticks(self, left: int) -> None:
        """Restore the ticks of a caller: a loop that counts its own ticks must not use them."""
        self.ticks_left = self._time.hold(self.ticks_left, left)

    def fail_later(self, error: RapidError) -> None:
        """Raise an error at the statement that a trap interrupts, once the trap has ended.

        If that statement cannot fail, as in a loop that computes, the next one that can fail raises
        it.
        """
        self._failure = error

    def _fail(self) -> None:
        if self._handler_depth:
            return
        failure, self._failure = self._failure, None
        if failure is not None:
            raise failure

    def await_restart(self) -> None:
        """Wait while StopMove holds the robot that the program needs to move.

        Raises:
            WaitsForever: If nothing will start it again.
        """
        while self._unit.queue.is_halted:
            if not self.await_event(math.inf):
                raise WaitsForever(
                    "the robot was stopped by StopMove, and nothing restarts it",
                    "StartMove resumes the motion, in the program or in a trap",
                )

    def drive_to_stop(self, corner: CornerKind = CornerKind.STOP) -> None:
        """End the block of moves and wait until the arm is at rest at its end.

        Events until then may stop the robot and start it again, so the end may move.
        Source: RAPID Overview, "Motion and I/O principles". A real controller continues some 40 ms
        earlier (measured); then CRobT after a stop point would miss the point, against expectation.
        """
        while self._unit.queue.is_open:
            if self._unit.queue.is_halted:
                self.await_restart()
                continue
            reached_s = self._unit.seen_s(self._unit.queue.close(corner))
            self.go_to(0.0)
            # A trap may stop the robot, or clear its path: then the end is earlier.
            while not self._unit.queue.is_open and self._time.known_s < reached_s:
                due_s = self.next_due_s()
                self.pass_time(reached_s if due_s is None else min(due_s, reached_s))
                reached_s = min(reached_s, self._unit.trajectory.duration)

    def bring_to_rest(self) -> None:
        """End an open block and wait until the arm is at rest."""
        if self._unit.queue.is_open and not self._unit.queue.is_halted:
            self.resolve_time()
            self.drive_to_stop(CornerKind.STOP_CORNER_PATH_FAILURE)
        self.pass_time(max(self.resolve_time(), self._unit.trajectory.duration))

    def serve_persistent_changes(self) -> None:
        """Serve the interrupts of persistents that the program has changed since the last check."""
        now_s = self.resolve_time()
        self._table.raise_changed(now_s)
        self.pass_time(now_s)

    def at_time(self, now_s: float, read: Callable[[], T]) -> T:
        """Read the cell's state at a time [s], without letting time pass."""
        before, self._viewed_s = self._viewed_s, now_s
        try:
            return read()
        finally:
            self._viewed_s = before

    def _note_foreign_changes(self, now_s: float) -> None:
        """Detect persistents that another task has changed, without serving the interrupts."""
        self.at_time(now_s, lambda: self._table.raise_changed(now_s))

    def cause(self) -> Cause:
        """The current statement, as the cause of what it changes."""
        return Cause(self._journal, self.place)

    def note_line(self) -> None:
        """Record that the program is at the current statement."""
        self._cell.watchdog.check()
        for look in self.observers:
            look()
        if self._table.watches:
            self.serve_persistent_changes()
        self._fail()
        self.effect_count += 1
        self._journal.line(self.moment(), self.place)

    def discount_effect(self) -> None:
        """Undo the count of the current statement, which had no side effect."""
        self.effect_count -= 1

    def event(self, kind: EventKind, message: str, **details: object) -> None:
        """Record an event of the current statement."""
        self.note_line()
        self._journal.event(self.moment(), kind, self.place, message, **details)
