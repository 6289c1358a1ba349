"""Cyclic bools: persistents, optionally with outputs, that follow a condition.

A controller evaluates it every 12 ms; here they follow at the instant a signal changes, and, for
conditions on persistents, when the program next moves, waits, reads or writes.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "SetupCyclicBool".
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import field

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.journal.journal import Instant, Moment
from rapidsim.language.reference import Reference
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class _CyclicBool:
    name: str
    flag: Reference[bool]
    condition: Callable[[], bool]
    signal: str | None


@value_class(slots=True, eq=False)
class TaskCyclicBools:
    """Implements `language.cyclic_bools.CyclicBools`; a listener of the cell."""

    clock: TaskClock
    cell: Cell
    _bools: dict[str, _CyclicBool] = field(default_factory=dict)
    _updates: bool = False
    """Whether conditions are being evaluated: their results may be among their inputs."""

    def __post_init__(self) -> None:
        """Listen to signals and to the statements of the program."""
        self.cell.listeners.append(self)
        self.clock.observers.append(self.update)

    def set_up(
        self, name: str, flag: Reference[bool], condition: Callable[[], bool], signal: str | None
    ) -> None:
        """Keep a persistent equal to a condition from now on."""
        self.clock.resolve_time()
        self._bools[name.lower()] = _CyclicBool(name, flag, condition, signal)
        self.update()

    def remove(self, name: str) -> None:
        """Stop updating a persistent."""
        self.clock.resolve_time()
        self._bools.pop(name.lower(), None)

    def names(self) -> tuple[str, ...]:
        """The persistents that are updated."""
        return tuple(one.name for one in self._bools.values())

    def listens_to(self, signal: str) -> bool:
        """Whether any cyclic bool is set up: any signal may be one that a condition reads."""
        del signal
        return bool(self._bools)

    def signal_changed(self, signal: str, old: float, value: float, now_s: float) -> None:
        """Update at the instant at which a signal changes."""
        del signal, old, value
        self._follow(now_s)

    def update(self) -> None:
        """Update after a statement of the program."""
        if self._bools and self.clock.is_known:
            self._follow(self.clock.resolve_time())

    def _follow(self, now_s: float) -> None:
        if self._updates:
            return
        self._updates = True
        try:
            for one in tuple(self._bools.values()):
                self._keep(one, now_s)
        finally:
            self._updates = False

    def _keep(self, cyclic: _CyclicBool, now_s: float) -> None:
        holds = self.clock.at_time(now_s, cyclic.condition)
        if cyclic.flag.value is not holds:
            cyclic.flag.value = holds
            self.cell.notify(Moment(Instant(now_s)))
        if cyclic.signal is not None and self.cell.signals.read(cyclic.signal) != float(holds):
            moment = Moment(Instant(now_s))
            self.cell.set_signal(self.clock.cause(), moment, cyclic.signal, float(holds))
