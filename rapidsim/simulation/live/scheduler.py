"""One clock for tasks that are started, stopped and replaced while it runs.

As in `scheduler`, whoever has the earliest time runs. Here the one who holds the clock decides how
far virtual time has come (`step`), tasks come and go, and between two steps somebody outside may
change what they wait for. No wait is a deadlock, since a client may always act.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from dataclasses import dataclass, field

from greenlet import greenlet

from rapidsim.controller.cell.cell import Cell
from rapidsim.simulation.scheduler import ScheduledTask

LOOKS_S = 0.01
"""How often [s of virtual time] a program that computes or polls yields to observers."""


@dataclass(slots=True, eq=False)
class _Entry:
    """A task."""

    number: int
    task: ScheduledTask
    greenlet: greenlet
    wake_s: float
    """When it is due to continue; infinite while it waits for others."""

    @property
    def rank(self) -> tuple[float, int]:
        """Priority: the least goes first."""
        return self.wake_s, self.number


@dataclass(slots=True, eq=False)
class LiveScheduler:
    """Implements `cell.TimeScheduler`."""

    cell: Cell
    now_s: float = 0.0
    """The virtual time [s]."""
    current: object = None
    """The task that runs; None between steps."""
    _entries: dict[object, _Entry] = field(default_factory=dict)
    _hub: greenlet | None = None

    def add(self, number: int, task: ScheduledTask, body: Callable[[], None]) -> None:
        """Add a task, which runs from now on.

        Args:
            number: Its place among tasks that are due at the same time.
            task: Its clock, which calls `request_advance`.
            body: Runs it; must not raise.
        """
        self._entries[task] = _Entry(number, task, greenlet(body), self.now_s)

    def remove(self, task: object) -> None:
        """Remove a task; called between steps."""
        entry = self._entries.pop(task, None)
        if entry is not None and not entry.greenlet.dead:
            entry.greenlet.throw()

    def wake(self, task: object) -> None:
        """Wake a task now."""
        entry = self._entries.get(task)
        if entry is not None:
            entry.wake_s = min(entry.wake_s, self.now_s)

    def due_s(self) -> float:
        """When the next task or the cell is due [s]; infinite if none is."""
        cell_s = self.cell.next_s()
        wakes = (one.wake_s for one in self._entries.values())
        return min(math.inf if cell_s is None else cell_s, min(wakes, default=math.inf))

    def step(self, until_s: float) -> bool:
        """Let the next go on that wants to by a time [s]; if none does, the time has come.

        Returns:
            Whether one did.
        """
        cell_s, entry = self.cell.next_s(), self._first()
        if cell_s is not None and cell_s <= until_s and (entry is None or cell_s <= entry.wake_s):
            self.now_s = max(self.now_s, cell_s)
            self.cell.dispatch_next(cell_s, cell_s)
            return True
        if entry is None or math.isinf(entry.wake_s) or entry.wake_s > until_s:
            if until_s < math.inf:
                self.now_s = max(self.now_s, until_s)
            return False
        self.now_s = max(self.now_s, entry.wake_s)
        self._hub = greenlet.getcurrent()
        self.current = entry.task
        try:
            _switch(entry.greenlet)
        finally:
            self.current = None
        if entry.greenlet.dead and self._entries.get(entry.task) is entry:
            del self._entries[entry.task]
        return True

    def request_advance(self, task: object, time_s: float) -> float:
        """See `cell.TimeScheduler`; never infinite, as somebody outside may always come."""
        entry = self._entries[task]
        entry.wake_s = time_s
        if time_s > self.now_s or self._first() is not entry:
            assert self._hub is not None
            _switch(self._hub)
        return entry.wake_s

    def next_s(self, task: object) -> float:
        """When somebody else may want to go on [s]."""
        entries = (one for one in self._entries.values() if one.task is not task)
        others = (max(one.wake_s, one.task.idle_until_s) for one in entries)
        look_s = (math.floor(self.now_s / LOOKS_S + 1e-6) + 1) * LOOKS_S
        return min(look_s, min(others, default=math.inf))

    def wake_at(self, time_s: float) -> None:
        """Wake the other tasks at a time [s] at which something happens."""
        for entry in self._entries.values():
            entry.task.idle_until_s = -math.inf
            if entry.task is not self.current:
                entry.wake_s = min(entry.wake_s, max(time_s, self.now_s))

    def mark_waiting(self, task: object) -> bool:
        """A task waits for what others do; somebody outside may do it."""
        del task
        return False

    def _first(self) -> _Entry | None:
        return min(self._entries.values(), key=lambda one: one.rank, default=None)


def _switch(to: greenlet) -> None:
    """Switch to another task; a program being stepped stays stepped, whatever ran in between."""
    followed = sys.gettrace()
    to.switch()
    if sys.gettrace() is not followed:
        sys.settrace(followed)
