"""The interrupts of one task: ordering them, switching them, error numbers."""

from __future__ import annotations

from collections.abc import Callable

from rapidsim.controller.clock import TaskTime
from rapidsim.language.error_log import LoggedError
from rapidsim.language.error_numbers import FIRST_BOOKED
from rapidsim.language.reference import Reference


class TaskInterrupts(TaskTime):
    """Implements `language.controller.Interrupts` and `ErrorNumbers`."""

    _booked_errors = 0

    def connect(self, trap: Callable[[], None], trap_name: str) -> float:
        """Book an interrupt number for a trap routine."""
        return self._interrupts.connect(trap, trap_name)

    def is_connected(self, interrupt: float) -> bool:
        """Whether an interrupt number belongs to a trap routine, ordered or not."""
        return self._interrupts.is_connected(interrupt)

    def order_timer(self, interrupt: float, seconds: float, *, single: bool) -> None:
        """Raise an interrupt once, or every so many seconds."""
        self._interrupts.order_timer(interrupt, self._observe(), seconds, single=single)
        self._grant()

    def order_signal(
        self,
        interrupt: float,
        signal: str,
        matches: Callable[[float], bool],
        *,
        single: bool,
    ) -> None:
        """Raise an interrupt once, or each time a signal changes to a value that matches."""
        self._observe()
        self._interrupts.order_signal(interrupt, signal, matches, single=single)

    def order_persistent(self, interrupt: float, data: Reference[object], *, single: bool) -> None:
        """Raise an interrupt once, or each time a persistent has changed."""
        self._observe()
        self._interrupts.order_persistent(interrupt, data, single=single)

    def order_logged(self, interrupt: float, wanted: Callable[[LoggedError], bool]) -> None:
        """Raise an interrupt each time an entry that is wanted comes into the event log."""
        self._observe()
        self._interrupts.order_logged(interrupt, wanted)

    def log_error(self, entry: LoggedError) -> None:
        """Put an entry into the event log."""
        if self._interrupts.hears_errors:
            now_s = self._observe()
            self._interrupts.error_logged(entry, now_s)
            self._pass_time(now_s)

    def trap_cause(self) -> LoggedError | None:
        """What made the trap run that runs; None if that is not an entry of the event log."""
        return self._trap_cause

    def delete_interrupt(self, interrupt: float) -> None:
        """Forget an interrupt and its order."""
        self._observe()
        self._interrupts.delete(interrupt)

    def sleep_interrupt(self, interrupt: float, *, asleep: bool) -> None:
        """Switch one interrupt off or on."""
        self._observe()
        self._interrupts.sleep(interrupt, asleep=asleep)

    def hold_interrupts(self, *, hold: bool) -> None:
        """Queue all interrupts, or serve them again."""
        now_s = self._observe()
        self._interrupts.held = hold
        self._pass_time(now_s)

    def book_error_number(self) -> float:
        """The next error number that is free."""
        self._booked_errors += 1
        return FIRST_BOOKED + self._booked_errors - 1.0
