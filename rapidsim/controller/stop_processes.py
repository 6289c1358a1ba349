"""Process signals that a stop of the program sets to zero, and their record for a restart.

The record has the values when the stop began and when the robot came to rest; then they are set to
0. A real controller records the latter values some tenths of a second later.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "TriggStopProc",
"restartdata".
"""

from __future__ import annotations

from dataclasses import field
from functools import partial

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.journal.journal import Instant, Moment
from rapidsim.language.option_data import RestartData
from rapidsim.language.reference import Reference
from rapidsim.values import value_class

_NO_SIGNAL = -1.0


@value_class(frozen=True, slots=True)
class StopProcess:
    """Effect of a stop on the signals of one process."""

    restart: Reference[RestartData]
    process: tuple[str | None, ...]
    """A digital output and four groups; None for each that was omitted."""
    shadow: str


@value_class(slots=True, eq=False)
class _Stopping:
    """A stop in progress; a listener of the cell."""

    of: StopProcess
    cell: Cell
    on_path: bool
    before: tuple[float, ...] = ()
    flanks: int = 0

    def __post_init__(self) -> None:
        """Record the signals, and listen to the shadow signal."""
        self.before = self._values()
        self.cell.listeners.append(self)

    def listens_to(self, signal: str) -> bool:
        """Whether it is the shadow signal."""
        return signal.lower() == self.of.shadow.lower()

    def signal_changed(self, signal: str, old: float, value: float, now_s: float) -> None:
        """Count a flank of the shadow signal."""
        del signal, old, value, now_s
        self.flanks += 1

    def reset_outputs(self, clock: TaskClock, now_s: float) -> None:
        """Record the signals again at a time [s], and set those of the process to 0."""
        self.cell.listeners.remove(self)
        pairs = zip(self.before, self._values(), strict=True)
        *process, shadow = [(float(old), float(new)) for old, new in pairs]
        of_process = [value for pair in process for value in pair]
        flanks = float(self.flanks)
        told = (True, self.on_path, *of_process, shadow[0], flanks, shadow[1])
        self.of.restart.value = RestartData._make(told)
        for name in self.of.process:
            if name is not None:
                self.cell.set_signal(clock.cause(), Moment(Instant(now_s)), name, 0.0)

    def _values(self) -> tuple[float, ...]:
        names = (*self.of.process, self.of.shadow)
        return tuple(_NO_SIGNAL if one is None else self.cell.signals.read(one) for one in names)


@value_class(slots=True, eq=False)
class StopProcesses:
    """The stop processes of one task."""

    clock: TaskClock
    cell: Cell
    _processes: list[StopProcess] = field(default_factory=list)

    def watch(self, process: StopProcess) -> None:
        """Act at each stop from now on; a process with the same restart data is replaced."""
        self.clock.resolve_time()
        self._processes = [one for one in self._processes if one.restart is not process.restart]
        self._processes.append(process)

    def stop(self, begun_s: float, stood_s: float, *, on_path: bool) -> None:
        """Act at a stop that has begun and whose robot comes to rest at a time [s]."""
        for one in self._processes:
            stopping = _Stopping(one, self.cell, on_path)
            if stood_s > begun_s:
                self.cell.happen(stood_s, partial(stopping.reset_outputs, self.clock))
            else:
                stopping.reset_outputs(self.clock, begun_s)
