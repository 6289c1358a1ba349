"""The interrupts of one task: ordering them, switching them, running their traps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.interrupt_table import Due, InterruptTable
from rapidsim.controller.journal.events import EventKind
from rapidsim.language.error_log import LoggedError
from rapidsim.language.error_numbers import FIRST_BOOKED
from rapidsim.language.reference import Reference


def _no_procedure(name: str) -> None:
    raise AssertionError(f"{name} is called before the program is loaded")


@dataclass(eq=False)
class TaskInterrupts:
    """Implements `language.controller.Interrupts`; those due are a `event_source.EventSource`."""

    on_path: ClassVar = False
    clock: TaskClock
    cell: Cell
    table: InterruptTable
    intno: float = 0.0
    in_trap: bool = False
    """Whether a trap runs."""
    _cause: LoggedError | None = None

    def __post_init__(self) -> None:
        """Install a placeholder for calls; the interpreter replaces it."""
        self.call_procedure: Callable[[str], None] = _no_procedure

    def next_s(self) -> float | None:
        """Time [s] at which the next is due; no trap interrupts a trap."""
        return None if self.in_trap else self.table.next_due_s()

    def dispatch_next(self, passed_s: float, until_s: float) -> float:
        """Run the trap of the next interrupt; see `event_source.EventSource`."""
        due = self.table.take_due(until_s)
        return (
            passed_s if due is None else self.clock.run_handler(due.time_s, lambda: self._run(due))
        )

    def advance_to(self, time_s: float) -> None:
        """Do nothing: interrupts wait until they are served."""

    def connect(self, trap: Callable[[], None], trap_name: str) -> float:
        """Book an interrupt number for a trap routine."""
        return self.table.connect(trap, trap_name)

    def is_connected(self, interrupt: float) -> bool:
        """Whether an interrupt number belongs to a trap routine, ordered or not."""
        return self.table.is_connected(interrupt)

    def order_timer(self, interrupt: float, seconds: float, *, single: bool) -> None:
        """Raise an interrupt once, or every so many seconds."""
        self.table.order_timer(interrupt, self.clock.resolve_time(), seconds, single=single)
        self.clock.grant()

    def order_signal(
        self,
        interrupt: float,
        signal: str,
        matches: Callable[[float], bool],
        *,
        single: bool,
    ) -> None:
        """Raise an interrupt once, or each time a signal changes to a value that matches."""
        self.clock.resolve_time()
        self.table.order_signal(interrupt, signal, matches, single=single)

    def order_persistent(self, interrupt: float, data: Reference[object], *, single: bool) -> None:
        """Raise an interrupt once, or each time a persistent has changed."""
        self.clock.resolve_time()
        self.table.order_persistent(interrupt, data, single=single)

    def order_logged(self, interrupt: float, wanted: Callable[[LoggedError], bool]) -> None:
        """Raise an interrupt each time a wanted entry is added to the event log."""
        self.clock.resolve_time()
        self.table.order_logged(interrupt, wanted)

    def log_error(self, entry: LoggedError) -> None:
        """Add an entry to the event log, which raises the interrupts of tasks that want it."""
        if self.cell.has_log_listeners:
            now_s = self.clock.synchronise()
            self.cell.log(self.clock.cause().journal.task, entry, now_s)
            self.clock.pass_time(now_s)

    def trap_cause(self) -> LoggedError | None:
        """The entry of the event log that raised the current trap; None if none did."""
        return self._cause

    def delete_interrupt(self, interrupt: float) -> None:
        """Delete an interrupt and its order."""
        self.clock.resolve_time()
        self.table.delete(interrupt)

    def sleep_interrupt(self, interrupt: float, *, asleep: bool) -> None:
        """Switch one interrupt off or on."""
        self.clock.resolve_time()
        self.table.sleep(interrupt, asleep=asleep)

    def make_safe(self, interrupt: float) -> None:
        """Make an interrupt safe, so that it cannot be put to sleep."""
        self.table.make_safe(interrupt)

    def hold_interrupts(self, *, hold: bool) -> None:
        """Queue all interrupts, or serve them again."""
        now_s = self.clock.resolve_time()
        self.table.is_on_hold = hold
        self.clock.pass_time(now_s)

    def _run(self, due: Due) -> None:
        what = "trap" if due.is_trap else "procedure"
        name = due.trap_name
        self.clock.event(EventKind.INTERRUPT, f"{what} {name}", **{what: name})
        self.in_trap, self.intno, self._cause = True, due.number, due.cause
        self.clock.grant()
        try:
            due.trap()
        finally:
            self.in_trap, self._cause = False, None


@dataclass(slots=True, eq=False)
class TaskErrorNumbers:
    """Implements `language.controller.ErrorNumbers`."""

    errno: float = 0.0
    retries: int = 0
    handler: float = 0.0
    _booked: int = 0

    def book_error_number(self) -> float:
        """The next free error number."""
        self._booked += 1
        return FIRST_BOOKED + self._booked - 1.0
