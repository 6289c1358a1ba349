"""Stopping and restarting the program of one task: by itself, or from outside.

In a run of its own nobody starts a program that has stopped, so the run ends. Where somebody may,
the program stands where it is while virtual time passes, as in a trap that waits; the robot stops
on its path and goes on from there. Interrupts that come meanwhile are lost unless they are safe.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "Stop", "ISignalDI"
(SingleSafe). That waits for a time count what passes while the program stands is our reading.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import ClassVar

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.interrupt_table import InterruptTable
from rapidsim.controller.moves.queued_move import MotionError
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.controller.stop_processes import StopProcess, StopProcesses
from rapidsim.language.errors import Stopped
from rapidsim.language.option_data import RestartData
from rapidsim.language.reference import Reference


@dataclass(slots=True)
class _StopRequest:
    """A stop that was requested and has not happened yet."""

    at_s: float
    on_path: bool
    """Whether the robot stops where it is; otherwise it finishes its moves."""


@dataclass(eq=False)
class TaskExecution:
    """Implements `language.controller.ExecutionControl`; a stop is a `event_source.EventSource`."""

    on_path: ClassVar = False
    clock: TaskClock
    unit: MechanicalUnit
    cell: Cell
    table: InterruptTable
    processes: StopProcesses
    """What a stop does to process signals."""
    stops_all: Callable[[str], None] | None = None
    """Stops all tasks, for a reason; None if nobody would start them again."""
    resumed: Callable[[], None] | None = None
    """Called when the program continues."""
    stopped: Callable[[], None] | None = None
    """Called when the program stops and its robot has been told to."""
    is_halted: bool = False
    """Whether the program waits to be started."""
    _stop_request: _StopRequest | None = None

    def stop(self, reason: str) -> None:
        """Stop all tasks that are executing.

        Raises:
            Stopped: If nobody starts it again.
        """
        if self.stops_all is None:
            raise Stopped(reason)
        now_s = self.clock.synchronise()
        self.stops_all(reason)
        self.clock.pass_time(now_s)

    def supervise(
        self, restart: Reference[RestartData], process: tuple[str | None, ...], shadow: str
    ) -> None:
        """Record and reset process signals at each stop."""
        self.processes.watch(StopProcess(restart, process, shadow))

    def end(self) -> None:
        """The program has stopped for good, and its robot has finished its moves."""
        stood_s = max(self.clock.pointer_s(), self.unit.queue.trajectory.duration)
        self.processes.stop(stood_s, stood_s, on_path=False)
        if self.stopped is not None:
            self.stopped()

    def request_stop(self, at_s: float, *, on_path: bool) -> None:
        """Stop at the present time [s], before the program does anything more."""
        if not self.is_halted and self._stop_request is None:
            self._stop_request = _StopRequest(at_s, on_path)

    def resume(self) -> None:
        """Let the program continue at its next turn; also cancels a requested stop."""
        self.is_halted, self._stop_request = False, None

    def next_s(self) -> float | None:
        """When the program stops [s]; see `event_source.EventSource`."""
        return None if self._stop_request is None else self._stop_request.at_s

    def dispatch_next(self, passed_s: float, until_s: float) -> float:
        """Stop and wait; see `event_source.EventSource`."""
        del passed_s, until_s
        assert self._stop_request is not None
        asked, self._stop_request = self._stop_request, None
        return self.clock.run_handler(asked.at_s, lambda: self._rest(on_path=asked.on_path))

    def advance_to(self, time_s: float) -> None:
        """Nothing to do: a stop is requested for the present time."""

    def await_restart(self) -> None:
        """Wait until somebody starts the program; its robot finishes its moves."""
        self._rest(on_path=False)

    def _rest(self, *, on_path: bool) -> None:
        queue, since_s = self.unit.queue, self.clock.pointer_s()
        stopped = on_path and not queue.is_halted
        stood_s = since_s
        if stopped:
            # What cannot be planned is reported when the program comes to it again.
            with suppress(MotionError):
                stood_s = queue.halt(since_s)
        self.processes.stop(since_s, stood_s, on_path=stood_s > since_s)
        if self.stopped is not None:
            self.stopped()
        waited = self.table.waiting()
        self.is_halted, now_s = True, since_s
        while self.is_halted:
            now_s = self.cell.scheduler.request_advance(self.clock, math.inf)
        self.clock.set(max(since_s, now_s))
        self.table.discard_while_stopped(waited, since_s, now_s)
        if self.resumed is not None:
            self.resumed()
        if stopped and queue.is_halted:
            queue.resume(now_s)
