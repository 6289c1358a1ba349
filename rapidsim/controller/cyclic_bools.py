"""Cyclic bools: persistents, and outputs beside them, that follow a condition.

A controller looks every 12 ms; here they follow at the instant a signal changes, and where the
condition looks at persistents, when the program next moves, waits, reads or writes.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "SetupCyclicBool".
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import field

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.journal.journal import Instant, Moment
from rapidsim.language.reference import Reference
from rapidsim.values import dataclass


@dataclass(frozen=True, slots=True)
class _CyclicBool:
    name: str
    flag: Reference[bool]
    condition: Callable[[], bool]
    signal: str | None


@dataclass(slots=True, eq=False)
class TaskCyclicBools:
    """Implements `language.cyclic_bools.CyclicBools`; a listener of the cell."""

    clock: TaskClock
    cell: Cell
    _kept: dict[str, _CyclicBool] = field(default_factory=dict)
    _looks: bool = False
    """Set while conditions are evaluated: what they change may be what they look at."""

    def __post_init__(self) -> None:
        """Listen to signals, and to what the program does."""
        self.cell.listeners.append(self)
        self.clock.observers.append(self.look)

    def set_up(
        self, name: str, flag: Reference[bool], condition: Callable[[], bool], signal: str | None
    ) -> None:
        """Keep a persistent equal to a condition from now on."""
        self.clock.observe()
        self._kept[name.lower()] = _CyclicBool(name, flag, condition, signal)
        self.look()

    def remove(self, name: str) -> None:
        """Stop updating a persistent."""
        self.clock.observe()
        self._kept.pop(name.lower(), None)

    def names(self) -> tuple[str, ...]:
        """The persistents that are updated."""
        return tuple(one.name for one in self._kept.values())

    def listens_to(self, signal: str) -> bool:
        """True: any signal may be one that a condition reads."""
        del signal
        return bool(self._kept)

    def signal_changed(self, signal: str, old: float, value: float, now_s: float) -> None:
        """Update at the instant at which a signal changes."""
        del signal, old, value
        self._follow(now_s)

    def look(self) -> None:
        """Update after what the program has changed."""
        if self._kept and self.clock.is_known:
            self._follow(self.clock.observe())

    def _follow(self, now_s: float) -> None:
        if self._looks:
            return
        self._looks = True
        try:
            for one in tuple(self._kept.values()):
                self._keep(one, now_s)
        finally:
            self._looks = False

    def _keep(self, one: _CyclicBool, now_s: float) -> None:
        holds = self.clock.aside(now_s, one.condition)
        if one.flag.value is not holds:
            one.flag.value = holds
            self.cell.tell(Moment(Instant(now_s)))
        if one.signal is not None and self.cell.signals.read(one.signal) != float(holds):
            moment = Moment(Instant(now_s))
            self.cell.set_signal(self.clock.cause(), moment, one.signal, float(holds))
