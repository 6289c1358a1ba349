"""Stopping and restarting the program of one task, by itself or by a client.

In a run without clients nothing can restart a stopped program, so the run ends. With clients the
program waits while virtual time passes, as in a trap that waits; the robot stops on its path and
continues from there. Interrupts during the stop are lost unless they are safe.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "Stop", "ISignalDI"
(SingleSafe). That waits for a time include the duration of the stop is our reading.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from typing import ClassVar

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.interrupt_table import InterruptTable
from rapidsim.controller.moves.queued_move import MotionError
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.controller.stop_processes import StopProcess, StopProcesses
from rapidsim.language.errors import AllStopped, ProgramReset, Stopped
from rapidsim.language.moves import Place
from rapidsim.language.option_data import RestartData
from rapidsim.language.reference import Reference


@dataclass(slots=True)
class _StopRequest:
    """A stop that was requested and has not happened yet."""

    at_s: float
    on_path: bool
    """Whether the robot stops where it is; otherwise it finishes its moves."""
    is_quick: bool


@dataclass(eq=False)
class TaskExecution:
    """Implements `language.controller.ExecutionControl`; a stop is a `event_source.EventSource`."""

    on_path: ClassVar = False
    clock: TaskClock
    unit: MechanicalUnit
    cell: Cell
    table: InterruptTable
    processes: StopProcesses
    """Effect of a stop on process signals."""
    stops: Callable[[str, Place, bool], None] | None = None
    """Stops this task or all, for a reason at a place; None if nothing would restart them."""
    resumed: Callable[[], None] | None = None
    """Called when the program continues."""
    halted: Callable[[bool], None] = lambda is_quick: None
    """Called in the program's task when it has come to a stop, which may be a quick one."""
    restarted: Callable[[], None] = lambda: None
    """Called in the program's task before it continues."""
    stopped: Callable[[], None] | None = None
    """Called after the program and its robot were stopped."""
    is_halted: bool = False
    """Whether the program waits to be started."""
    is_leaving: bool = False
    """Whether the program leaves its routines, as its pointer is set elsewhere."""
    _stop_request: _StopRequest | None = None
    _is_stopping: bool = False
    """Whether the program comes to a stop, or begins to continue."""

    def stop(self, reason: str, *, every: bool = False) -> None:
        """Stop this task, or all that are executing.

        Raises:
            Stopped: If nothing can restart it.
        """
        if self.stops is None:
            raise (AllStopped if every else Stopped)(reason)
        now_s = self.clock.synchronise()
        self.stops(reason, self.clock.place, every)
        self.clock.pass_time(now_s)

    def supervise(
        self, restart: Reference[RestartData], process: tuple[str | None, ...], shadow: str
    ) -> None:
        """Record and reset process signals at each stop."""
        self.processes.watch(StopProcess(restart, process, shadow))

    def end(self) -> None:
        """Handle the final stop of the program, after its robot has finished its moves."""
        stood_s = max(self.clock.pointer_s(), self.unit.trajectory.duration)
        self.processes.stop(stood_s, stood_s, on_path=False)
        if self.stopped is not None:
            self.stopped()

    def request_stop(self, at_s: float, *, on_path: bool, is_quick: bool = False) -> None:
        """Stop at the present time [s], before the next statement."""
        if not self.is_halted and self._stop_request is None and not self._is_stopping:
            self._stop_request = _StopRequest(at_s, on_path, is_quick)

    def resume(self) -> None:
        """Let the program continue at its next turn; also cancels a requested stop."""
        self.is_halted, self._stop_request = False, None

    def leave(self) -> None:
        """Let a program that is halted or has ended leave its routines: their UNDO clauses run."""
        self.is_halted, self.is_leaving = False, True

    def next_s(self) -> float | None:
        """Time [s] at which the program stops; see `event_source.EventSource`."""
        return None if self._stop_request is None else self._stop_request.at_s

    def dispatch_next(self, passed_s: float, until_s: float) -> float:
        """Stop and wait; see `event_source.EventSource`."""
        del passed_s, until_s
        assert self._stop_request is not None
        asked, self._stop_request = self._stop_request, None
        return self.clock.run_handler(
            asked.at_s, lambda: self._rest(on_path=asked.on_path, is_quick=asked.is_quick)
        )

    def advance_to(self, time_s: float) -> None:
        """Do nothing: a stop is requested for the present time."""

    def await_restart(self) -> None:
        """Wait until a client starts the program; its robot finishes its moves."""
        self._rest(on_path=False)

    def _rest(self, *, on_path: bool, is_quick: bool = False) -> None:
        if self.is_leaving:
            # Nothing stops an UNDO clause then.
            return
        since_s = self.clock.pointer_s()
        stopped = on_path and not self.unit.queue.is_halted
        stood_s = since_s
        if stopped:
            # A planning error is reported when the program reaches it again.
            with suppress(MotionError):
                stood_s = self.unit.halt(since_s)
        self.processes.stop(since_s, stood_s, on_path=stood_s > since_s)
        if self.stopped is not None:
            self.stopped()
        with self._handling():
            self.halted(is_quick)
        since_s = self.clock.pointer_s()
        waited = self.table.waiting()
        self.is_halted, now_s = True, since_s
        while self.is_halted:
            now_s = self.cell.scheduler.request_advance(self.clock, math.inf)
        self.clock.set(max(since_s, now_s))
        if self.is_leaving:
            raise ProgramReset("the program pointer is set elsewhere")
        self.table.discard_while_stopped(waited, since_s, now_s)
        with self._handling():
            self.restarted()
        if self.resumed is not None:
            self.resumed()
        if stopped and self.unit.queue.is_halted:
            self.unit.resume(self.clock.pointer_s())

    @contextmanager
    def _handling(self) -> Iterator[None]:
        """Let no further stop begin meanwhile."""
        self._is_stopping = True
        try:
            yield
        finally:
            self._is_stopping = False
