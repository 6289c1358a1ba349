"""How time passes for one task: the program pointer's time, what falls due on the way, limits.

The program pointer's time is an instant plus an offset. After a fly-by move the instant is "the
robot starts that move", which nobody knows until the path is planned; the program runs on and what
it does is dated later. Whoever must know the time or the position calls `_observe`.

RAPID statements take no virtual time except waits, motion, and a small fixed cost a loop turn. All
time passes in `_pass_time`, which asks the cell's `turns` how far it may go.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from rapidsim.controller.cell.cell import Cause, Cell
from rapidsim.controller.interrupt_table import Due, InterruptTable
from rapidsim.controller.journal.events import EventKind
from rapidsim.controller.journal.journal import Instant, Journal, Moment
from rapidsim.controller.journal.stop_reasons import TimeLimitReached, WaitsForever
from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.pointer_time import PointerTime
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.controller.queue.path_marks import PathMarks
from rapidsim.controller.queue.path_planner import LOOK_AHEAD_SLACK_S
from rapidsim.controller.queue.zone_table import WorldZoneTable
from rapidsim.language.data import TOOL0, WOBJ0, ToolData, WobjData
from rapidsim.language.error_log import LoggedError
from rapidsim.language.modules import Modules
from rapidsim.language.moves import MotionSettings, Place
from rapidsim.language.symbols import Symbols


class TaskTime:
    """The state of one task's controller, and its time."""

    def __init__(
        self,
        cell: Cell,
        unit: MechanicalUnit,
        resolver: Resolver,
        journal: Journal,
        place: Place,
    ) -> None:
        """Start at time zero with the arm where the unit says and the pointer at `place`."""
        self.settings = MotionSettings()
        self.errno = 0.0
        self.intno = 0.0
        self.call_procedure: Callable[[str], None] = _no_procedure
        self.symbols: Symbols
        self.modules: Modules
        self.place = place
        self.left = 0
        self._cell = cell
        self._unit = unit
        self._resolver = resolver
        self._journal = journal
        self._time = PointerTime()
        self._passed_s = 0.0
        """Up to here everything has happened; nothing happens before it any more."""
        self._in_trap = False
        self._trap_cause: LoggedError | None = None
        self._interrupts = InterruptTable()
        self._marks = PathMarks(unit)
        self._zones = WorldZoneTable(unit, resolver.base_from_world.inverse())
        self._active: tuple[ToolData, WobjData] = (TOOL0, WOBJ0)
        self._looks_at_s: float | None = None
        """The time [s] at which it looks aside; None while it does not."""
        cell.listeners.append(self._interrupts)
        cell.watchdog.watch(self)

    @property
    def in_trap(self) -> bool:
        """Whether a trap runs."""
        return self._in_trap

    def come_up(self) -> float:
        """The time [s] of the statement that runs, with every other task come up to it.

        Whoever reads or changes what tasks share does this first.
        """
        if self._looks_at_s is not None:
            # The others have come up already, and the program's own time may not be known yet.
            return self._looks_at_s
        now_s = self._observe()
        if self._cell.is_shared:
            while self._cell.turns.until(self, now_s) < now_s:
                pass
        return now_s

    def now(self) -> float:
        """Virtual time [s] of the statement that runs."""
        self._note_line()
        return self._observe()

    def wait(self, seconds: float, *, in_position: bool = False) -> None:
        """Let virtual time pass; with `in_position`, first let the robot come to rest."""
        self._note_line()
        if in_position:
            self._come_to_rest()
        now_s = self._observe()
        self._pass_time(now_s + max(0.0, seconds))

    def service(self) -> None:
        """Do what is due and grant the next slice.

        Raises:
            TimeLimitReached: When a time limit is reached.
        """
        self._cell.watchdog.look()
        if self._interrupts.watches:
            self._look_at_persistents()
        time = self._time
        time.settle(self.left)
        if not time.is_known and time.offset_s > LOOK_AHEAD_SLACK_S:
            self._observe()
        if time.is_known:
            self._pass_time(time.known_s)
        self._grant()

    def end_time_s(self) -> float:
        """When everything is over [s]: the program pointer and the arm."""
        pointer_s = self._time.known_s if self._time.is_known else 0.0
        return min(self._cell.max_time_s, max(pointer_s, self._unit.queue.trajectory.duration))

    def _moment(self) -> Moment:
        """When the statement that runs happens."""
        self._time.settle(self.left)
        return self._time.moment()

    def _grant(self) -> None:
        """Give the program ticks until something is due."""
        self._cell.watchdog.look()
        due_s = self._next_due_s()
        until_s = min(self._cell.max_time_s, math.inf if due_s is None else due_s)
        if self._cell.is_shared:
            until_s = min(until_s, self._cell.turns.next_s(self))
        self.left = self._time.grant(until_s, LOOK_AHEAD_SLACK_S)

    def _observe(self) -> float:
        """The time [s] of the statement that runs, planned if nobody has had to know it yet."""
        time = self._time
        time.settle(self.left)
        if not time.is_known:
            offset_s = time.offset_s
            self._await_restart()
            # Meanwhile another task of the team may have ended the block.
            if self._unit.queue.is_open:
                self._pass_time(self._unit.queue.commit_last_start())
            while self._unit.queue.is_open and (
                self._unit.queue.is_halted or self._unit.queue.commit_last_start() > time.known_s
            ):
                # Something on the way has stopped the robot, so it starts the move later.
                self._await_restart()
                self._pass_time(self._unit.queue.commit_last_start())
            self._pass_time(time.known_s + offset_s)
        return time.known_s

    def _pass_time(self, until_s: float) -> None:
        """Go to a later time, serving the interrupts that fall due on the way.

        Raises:
            TimeLimitReached: When the time limit comes first.
        """
        limit_s = self._cell.max_time_s
        reached_s = min(until_s, limit_s)
        served_s = self._serve_due(reached_s)
        now_s = self._time.known_s if self._time.is_known else 0.0
        self._time.set(max(reached_s, served_s, now_s))
        self._passed_s = max(self._passed_s, self._time.known_s)
        self._zones.look_from(self._passed_s)
        if until_s > limit_s:
            raise TimeLimitReached(f"the time limit of {limit_s:g} s was reached")
        self._grant()

    def _await_event(self, deadline_s: float) -> bool:
        """Let time pass until something happens that a program may notice, or a deadline [s].

        Returns:
            False if there is no deadline and nothing will ever happen.
        """
        next_s = self._next_due_s()
        until_s = deadline_s if next_s is None else min(next_s, deadline_s)
        until_s = self._cell.turns.until(self, until_s)
        if math.isinf(until_s):
            return False
        self._pass_time(until_s)
        return True

    def _next_due_s(self) -> float | None:
        """When the next thing happens by itself [s]: a signal change, an interrupt, on the path.

        While the program runs ahead of the robot, nobody asks for what happens on the path: that
        would plan it.
        """
        times = (
            self._cell.next_change_s(),
            None if self._in_trap else self._interrupts.next_due_s(),
            self._marks.next_s() if self._time.is_known else None,
            self._zones.next_s() if self._time.is_known else None,
        )
        return min((time_s for time_s in times if time_s is not None), default=None)

    def _serve_due(self, until_s: float) -> float:
        """Let everything due by a time happen; returns when the last trap ended [s].

        No trap interrupts a trap: what falls due meanwhile is served afterwards.
        """
        ended_s = 0.0
        while True:
            change_s = self._cell.next_change_s()
            trap_s = None if self._in_trap else self._interrupts.next_due_s()
            mark_s, zone_s = self._marks.next_s(), self._zones.next_s()
            times = [one for one in (change_s, trap_s, mark_s, zone_s) if one is not None]
            next_s = min(times, default=math.inf)
            turn_s = min(next_s, until_s)
            happenings = self._cell.happenings
            reached_s = self._cell.turns.until(self, turn_s)
            if reached_s < turn_s or self._cell.happenings != happenings:
                self._look_aside(reached_s)
                continue
            if next_s > until_s:
                return ended_s
            if change_s is not None and change_s <= next_s:
                self._cell.make_next_change()
            elif mark_s is not None and mark_s <= next_s:
                self._marks.pass_next(self._passed_s)
            elif zone_s is not None and zone_s <= next_s:
                self._zones.pass_next(self._passed_s)
            elif (due := self._interrupts.take_due(until_s)) is not None:
                ended_s = self._serve(due)

    def _serve(self, due: Due) -> float:
        """Run a trap, then go on where the program was; returns when the trap ended [s]."""
        start_s = max(due.time_s, self._passed_s)
        instant, offset_s, place = self._time.instant, self._time.offset_s, self.place
        if instant.time is not None:
            start_s = max(start_s, instant.time + offset_s)
        self._time.set(start_s)
        what = "trap" if due.is_trap else "procedure"
        self._event(EventKind.INTERRUPT, f"{what} {due.trap_name}", **{what: due.trap_name})
        self._in_trap, self.intno, self._trap_cause = True, due.number, due.cause
        self._grant()
        try:
            due.trap()
        finally:
            self._in_trap, self._trap_cause = False, None
        ended_s = self._observe()
        self._passed_s = max(self._passed_s, ended_s)
        self.place = place
        if instant.time is None:
            self._time.instant, self._time.offset_s = instant, offset_s
        else:
            self._time.set(max(ended_s, instant.time + offset_s))
        return ended_s

    def _await_restart(self) -> None:
        """While StopMove keeps the robot where it is, a program that needs it to move waits.

        Raises:
            WaitsForever: If nothing will start it again.
        """
        while self._unit.queue.is_halted:
            if not self._await_event(math.inf):
                raise WaitsForever("the robot was stopped by StopMove, and nothing starts it again")

    def _drive_to_stop(self, corner: CornerKind = CornerKind.STOP) -> None:
        """End the block of moves and wait until the arm stands still at its end.

        What happens on the way may stop the robot and start it again, so the end may move.

        Source: RAPID Overview, "Motion and I/O principles". A controller was measured to go on some
        40 ms earlier; then CRobT after a stop point would miss the point, which nobody expects.
        """
        while self._unit.queue.is_open:
            if self._unit.queue.is_halted:
                self._await_restart()
                continue
            reached_s = self._unit.queue.trajectory.seen_s(self._unit.queue.close(corner))
            self._time.follow(Instant())
            self._pass_time(reached_s)

    def _come_to_rest(self) -> None:
        """End an open block and wait until the arm stands still."""
        if self._unit.queue.is_open and not self._unit.queue.is_halted:
            self._observe()
            self._drive_to_stop(CornerKind.STOP_CORNER_PATH_FAILURE)
        self._pass_time(max(self._observe(), self._unit.queue.trajectory.duration))

    def _look_at_persistents(self) -> None:
        """Serve the interrupts of persistents that the program has changed since."""
        now_s = self._observe()
        self._interrupts.look(now_s)
        self._pass_time(now_s)

    def _look_aside(self, now_s: float) -> None:
        """Notice which persistents another task has changed, without serving the interrupts."""
        self._looks_at_s = now_s
        try:
            self._interrupts.look(now_s)
        finally:
            self._looks_at_s = None

    def _cause(self) -> Cause:
        """The statement that runs, for what it changes."""
        return Cause(self._journal, self.place)

    def _note_line(self) -> None:
        self._cell.watchdog.look()
        if self._interrupts.watches:
            self._look_at_persistents()
        self._journal.line(self._moment(), self.place)

    def _event(self, kind: EventKind, message: str, **details: object) -> None:
        self._note_line()
        self._journal.event(self._moment(), kind, self.place, message, **details)


def _no_procedure(name: str) -> None:
    raise AssertionError(f"{name} is called before the program is loaded")
