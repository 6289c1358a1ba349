"""One task's way to the signals of the cell: reading, writing, waiting."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType

from rapidsim.controller.clock import TaskTime
from rapidsim.controller.journal.journal import Moment
from rapidsim.controller.journal.stop_reasons import WaitsForever

_IDLE_LOOKS = 1000
"""So often a condition is looked at that nothing can change before the run gives up: it may count
its looks itself."""


class TaskSignals(TaskTime):
    """Implements `language.controller.Signals`, and waiting for conditions."""

    _looked_at: dict[str, None] | None = None
    """The signals that a condition has read, while one is evaluated."""
    _seen: Mapping[str, None] = MappingProxyType({})
    """The signals that the last condition has read."""
    _saw_time: bool = False
    """Whether the last condition has read the time."""

    def now(self) -> float:
        """Virtual time [s] of the statement that runs."""
        self._saw_time = True
        return super().now()

    def read_signal(self, name: str) -> float:
        """The value of a signal now."""
        self.come_up()
        if self._looked_at is not None:
            self._looked_at[name] = None
        return self._cell.signals.read(name)

    def write_signal(self, name: str, value: float, *, delay_s: float = 0.0) -> None:
        """Set an output at the time of the program pointer, or later by a delay.

        Raises:
            RapidError: If the station declares it as an input, or with narrower limits.
        """
        self._note_line()
        self._cell.signals.require_output(name, value)
        if self._cell.is_shared:
            self.come_up()
        if delay_s > 0.0:
            moment = self._moment()
            later = Moment(moment.instant, moment.offset_s + delay_s)
            self._cell.schedule(self._cause(), later, {name: value})
            if self._time.is_known:
                # A loop that polls the signal must not run past the change.
                self._grant()
            return
        heard = self._marks.is_pending or self._zones.is_watching or self._cell.hears(name)
        now_s = self._observe() if heard else 0.0
        self._cell.set_signal(self._cause(), self._moment(), name, value)
        if heard:
            self._pass_time(now_s)

    def wait_for_signal(
        self, name: str, condition: Callable[[float], bool], *, max_time: float | None = None
    ) -> bool:
        """Let virtual time pass until the value of a signal satisfies a condition.

        Raises:
            Stopped: When nothing that is known to happen can ever satisfy it.
        """
        self._note_line()
        now_s = self.come_up()
        deadline_s = math.inf if max_time is None else now_s + max_time
        while not condition(self._cell.signals.read(name)):
            if self._observe() >= deadline_s:
                return False
            alone = not self._cell.is_shared
            if alone and math.isinf(deadline_s) and self._is_vain((name,)):
                raise WaitsForever(f"`{name}` is waited for and nothing ever changes it")
            if not self._await_event(deadline_s):
                raise WaitsForever(f"`{name}` is waited for and nothing ever changes it")
        return True

    def wait_until(
        self, condition: Callable[[], bool], *, max_time: float | None = None, poll_s: float = 0.1
    ) -> bool:
        """Let virtual time pass until a condition holds; False if `max_time` [s] ran out first.

        Raises:
            Stopped: When it looks only at what nothing ever changes.
        """
        self._note_line()
        now_s = self._observe()
        deadline_s = math.inf if max_time is None else now_s + max_time
        idle = 0
        happenings = self._cell.happenings
        while not self._holds(condition):
            if now_s >= deadline_s:
                return False
            looked_at = tuple(self._seen)
            vain = not self._saw_time and self._is_vain(looked_at)
            idle = idle + 1 if vain and happenings == self._cell.happenings else 0
            happenings = self._cell.happenings
            if idle > _IDLE_LOOKS and math.isinf(deadline_s) and self._cell.turns.rest(self):
                raise WaitsForever(_vain(looked_at))
            self._pass_time(min(now_s + poll_s, deadline_s))
            now_s = self._observe()
        return True

    def _holds(self, condition: Callable[[], bool]) -> bool:
        """Evaluate a condition and note what it looks at."""
        self._looked_at, self._saw_time = {}, False
        try:
            return condition()
        finally:
            self._seen, self._looked_at = self._looked_at, None

    def _is_vain(self, signals: tuple[str, ...]) -> bool:
        """Whether nothing but other tasks, if there are any, could change signals."""
        if self._interrupts.armed or self._unit.queue.trajectory.duration > self._observe():
            return False
        return not any(map(self._cell.may_change, signals))


def _vain(signals: tuple[str, ...]) -> str:
    if not signals:
        return "the condition looks at no signal and no clock, and nothing ever changes it"
    names = ", ".join(f"`{name}`" for name in signals)
    return f"the condition looks at {names}, and nothing ever changes that"
