"""Access of one task to the signals of the cell: reading, writing, waiting."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.interrupt_table import InterruptTable
from rapidsim.controller.journal.events import MAX_TIME, SATISFIED
from rapidsim.controller.journal.journal import Moment
from rapidsim.controller.journal.stop_reasons import WaitsForever
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.controller.queue.path_marks import PathMarks
from rapidsim.controller.queue.zone_table import WorldZoneTable

_IDLE_LOOKS = 1000
"""Number of evaluations without any possible change after which a wait gives up: a condition may
count its evaluations itself."""


@dataclass(slots=True, eq=False)
class TaskSignals:
    """Implements `language.controller.Signals`."""

    clock: TaskClock
    unit: MechanicalUnit
    cell: Cell
    table: InterruptTable
    marks: PathMarks
    zones: WorldZoneTable

    _looked_at: dict[str, None] | None = None
    """The signals that a condition has read, while one is evaluated."""
    _seen: Mapping[str, None] = field(default_factory=dict)
    """The signals that the last condition has read."""
    _saw_time: bool = False
    """Whether the last condition has read the time."""

    def read_signal(self, name: str) -> float:
        """The value of a signal now.

        Raises:
            RapidError: ERR_NORUNUNIT if its device has no contact.
        """
        self.clock.synchronise()
        if self._looked_at is not None:
            self._looked_at[name] = None
        self.cell.signals.require_contact(name)
        return self.cell.signals.read(name)

    def write_signal(self, name: str, value: float, *, delay_s: float = 0.0) -> None:
        """Set an output at the time of the program pointer, or later by a delay.

        Raises:
            RapidError: If the station declares it as an input, or with narrower limits.
        """
        self.clock.note_line()
        self.cell.signals.require_output(name, value)
        if self.cell.is_shared:
            self.clock.synchronise()
        if delay_s > 0.0:
            moment = self.clock.moment()
            later = Moment(moment.instant, moment.offset_s + delay_s)
            self.cell.schedule(self.clock.cause(), later, {name: value})
            if self.clock.is_known:
                # A loop that polls the signal must not run past the change.
                self.clock.grant()
            return
        heard = self.marks.is_pending or self.zones.is_watching or self.cell.has_listener(name)
        now_s = self.clock.resolve_time() if heard else 0.0
        moment = self.clock.moment()
        if not self.cell.set_signal(self.clock.cause(), moment, name, value):
            self.clock.discount_effect()
        if heard:
            self.clock.pass_time(now_s)

    def is_missing(self, name: str) -> bool:
        """Whether a cell that declares its signals has none of this name."""
        return self.cell.signals.is_missing(name)

    def require_within(self, name: str, value: float) -> None:
        """Refuse a value outside the limits of an analog signal or a group."""
        self.cell.signals.require_within(name, value)

    def wait_for_signal(
        self, name: str, condition: Callable[[float], bool], *, max_time: float | None = None
    ) -> bool:
        """Let virtual time pass until the value of a signal satisfies a condition.

        Raises:
            Stopped: When no known event can ever satisfy it.
            RapidError: ERR_NORUNUNIT if its device has no contact.
        """
        self.clock.note_line()
        now_s = self.clock.synchronise()
        self.cell.signals.require_contact(name)
        deadline_s = math.inf if max_time is None else now_s + max_time
        with self.clock.waiting(self._awaited(name)) as wait:
            while not condition(self.cell.signals.read(name)):
                if self.clock.resolve_time() >= deadline_s:
                    wait.ended_by = MAX_TIME
                    return False
                alone = not self.cell.is_shared
                if alone and math.isinf(deadline_s) and self._is_vain((name,)):
                    raise WaitsForever(f"`{name}` is waited for, but nothing will change it")
                if not self.clock.await_event(deadline_s):
                    raise WaitsForever(f"`{name}` is waited for, but nothing will change it")
            wait.ended_by = self.cell.last_change((name,), now_s) or SATISFIED
        return True

    def _awaited(self, signal: str) -> str:
        """The signal for which the current statement waits, with the value as written."""
        value = self.clock.place.arguments.get("value")
        return signal if value is None else f"{signal} = {value}"

    def wait_until(
        self, condition: Callable[[], bool], *, max_time: float | None = None, poll_s: float = 0.1
    ) -> bool:
        """Let virtual time pass until a condition holds; False if `max_time` [s] ran out first.

        Raises:
            Stopped: When it reads only data that nothing ever changes.
        """
        self.clock.note_line()
        now_s = self.clock.resolve_time()
        deadline_s = math.inf if max_time is None else now_s + max_time
        start_s, idle = now_s, 0
        happenings = self.cell.event_count
        arguments = self.clock.place.arguments
        awaited = arguments.get("cond") or arguments.get("wobj") or "its condition"
        with self.clock.waiting(awaited) as wait:
            while not self._holds(condition):
                if now_s >= deadline_s:
                    wait.ended_by = MAX_TIME
                    return False
                looked_at = tuple(self._seen)
                vain = not self._saw_time and self._is_vain(looked_at)
                idle = idle + 1 if vain and happenings == self.cell.event_count else 0
                happenings = self.cell.event_count
                endless = idle > _IDLE_LOOKS and math.isinf(deadline_s)
                if endless and self.cell.scheduler.mark_waiting(self.clock):
                    raise WaitsForever(_vain(looked_at))
                if idle:
                    # Tasks that poll need not wait for this one: only they end its wait.
                    self.clock.idle_until_s = deadline_s
                polls = self._polls_ahead(now_s, deadline_s, poll_s) if idle > _IDLE_LOOKS else 1
                self.clock.pass_time(min(now_s + polls * poll_s, deadline_s))
                now_s = self.clock.resolve_time()
            wait.ended_by = self.cell.last_change(tuple(self._seen), start_s) or SATISFIED
        return True

    def _polls_ahead(self, now_s: float, deadline_s: float, poll_s: float) -> int:
        """Number of polls before anything can have changed; at least one."""
        due_s, others_s = self.clock.next_due_s(), self.cell.scheduler.next_s(self.clock)
        own_s = deadline_s if due_s is None else min(due_s, deadline_s)
        still_s = min(own_s, others_s, self.cell.max_time_s) - now_s
        return max(1, math.floor(still_s / poll_s)) if math.isfinite(still_s) else 1

    def _holds(self, condition: Callable[[], bool]) -> bool:
        """Evaluate a condition and record its reads; it may call a routine that waits itself."""
        around, told = self._looked_at, self.clock.time_reads
        seen: dict[str, None] = {}
        self._looked_at = seen
        try:
            return condition()
        finally:
            self._seen, self._looked_at = seen, around
            self._saw_time = self.clock.time_reads > told

    def _is_vain(self, signals: tuple[str, ...]) -> bool:
        """Whether only other tasks, if there are any, could change signals."""
        if self.table.armed or self.unit.trajectory.duration > self.clock.resolve_time():
            return False
        return not any(map(self.cell.may_change, signals))


def _vain(signals: tuple[str, ...]) -> str:
    if not signals:
        return "the condition reads no signal and no clock, and nothing ever changes it"
    names = ", ".join(f"`{name}`" for name in signals)
    return f"the condition reads {names}, and nothing ever changes that"
