"""One clock for tasks that are started, stopped and replaced while it runs.

As in `scheduler`, the task with the earliest time runs next. Here the owner of the clock decides
how far virtual time advances (`step`), tasks are added and removed, and between two steps a client
may change what they wait for. No wait is a deadlock, since a client may always act.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from types import FrameType
from typing import Any

from greenlet import greenlet

from rapidsim.controller.cell.cell import Cell
from rapidsim.simulation.scheduler import ScheduledTask
from rapidsim.simulation.task_greenlets import task_greenlet

LOOKS_S = 0.01
"""Period [s of virtual time] at which a program that computes or polls yields to observers."""


@dataclass(slots=True, eq=False)
class _Entry:
    """A task of the scheduler."""

    number: int
    task: ScheduledTask
    greenlet: greenlet
    wake_s: float
    """Time at which it continues; infinite while it waits for others."""

    @property
    def rank(self) -> tuple[float, int]:
        """Scheduling order: the lowest runs first."""
        return self.wake_s, self.number


@dataclass(slots=True, eq=False)
class LiveScheduler:
    """Implementation of `cell.TimeScheduler` for a live controller."""

    cell: Cell
    now_s: float = 0.0
    """Current virtual time [s]."""
    current: object = None
    """The running task; None between steps."""
    trace: Callable[[FrameType, str, Any], Any] | None = None
    """Python's trace function for the tasks' programs, of a debugger; None without one."""
    _entries: dict[object, _Entry] = field(default_factory=dict)
    _hub: greenlet | None = None
    _suspended: _Entry | None = None
    """The task that is suspended before a statement, and all time with it."""

    def add(self, number: int, task: ScheduledTask, body: Callable[[], None]) -> None:
        """Add a task that runs from now on.

        Args:
            number: Its rank among tasks that are due at the same time.
            task: Its clock, which calls `request_advance`.
            body: Runs the task; must not raise.
        """

        def traced() -> None:
            # A greenlet has a trace function of its own.
            if self.trace is not None:
                sys.settrace(self.trace)
            body()

        self._entries[task] = _Entry(number, task, task_greenlet(traced), self.now_s)

    def remove(self, task: object) -> None:
        """Remove a task; called between steps."""
        entry = self._entries.pop(task, None)
        if entry is not None and not entry.greenlet.dead:
            entry.greenlet.throw()

    def finish(self, task: object, until_s: float) -> bool:
        """Wake a task and let time pass until it has ended, or to a time [s].

        Returns:
            Whether it has ended.
        """
        self.wake(task)
        while task in self._entries and self.due_s() <= until_s:
            self.step(until_s)
        return task not in self._entries

    def wake(self, task: object) -> None:
        """Wake a task now."""
        entry = self._entries.get(task)
        if entry is not None:
            entry.wake_s = min(entry.wake_s, self.now_s)

    def due_s(self) -> float:
        """Time [s] at which the next task or the cell is due; infinite if none is."""
        cell_s = self.cell.next_s()
        if self._suspended is not None:
            return math.inf
        wakes = (one.wake_s for one in self._entries.values())
        return min(math.inf if cell_s is None else cell_s, min(wakes, default=math.inf))

    def step(self, until_s: float) -> bool:
        """Run the next task or cell event due by a time [s]; if none is due, advance to that time.

        Returns:
            Whether a task or an event was due.
        """
        if self._suspended is not None:
            return False
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
        self._run(entry)
        return True

    def _run(self, entry: _Entry) -> None:
        self._hub = greenlet.getcurrent()
        self.current = entry.task
        try:
            _switch(entry.greenlet)
        finally:
            self.current = None
        if entry.greenlet.dead and self._entries.get(entry.task) is entry:
            del self._entries[entry.task]

    def end_wait(self, task: object) -> None:
        """Continue a task that waits for what nothing can end any more: its wait raises."""
        entry = self._entries[task]
        entry.wake_s = math.inf
        self._run(entry)

    def hold(self) -> None:
        """Suspend the running task where it is, all others, and time, until `release`."""
        assert self._hub is not None
        self._suspended = self._entries[self.current]
        self._hub.switch()
        sys.settrace(self.trace)

    def release(self) -> None:
        """Continue the task that is held, in the same slice of time."""
        suspended, self._suspended = self._suspended, None
        if suspended is not None and not suspended.greenlet.dead:
            self._run(suspended)

    def request_advance(self, task: object, time_s: float) -> float:
        """See `cell.TimeScheduler`; as a client may act, it returns infinity by `end_wait` only."""
        entry = self._entries[task]
        entry.wake_s = time_s
        if time_s > self.now_s or self._first() is not entry:
            assert self._hub is not None
            _switch(self._hub)
            if self.trace is not None:
                sys.settrace(self.trace)
        return entry.wake_s

    def next_s(self, task: object) -> float:
        """Earliest time [s] at which another task may continue or an observer may read."""
        entries = (one for one in self._entries.values() if one.task is not task)
        others = (max(one.wake_s, one.task.idle_until_s) for one in entries)
        look_s = (math.floor(self.now_s / LOOKS_S + 1e-6) + 1) * LOOKS_S
        return min(look_s, min(others, default=math.inf))

    def wake_at(self, time_s: float) -> None:
        """Wake the other tasks at the time [s] of an event."""
        for entry in self._entries.values():
            entry.task.idle_until_s = -math.inf
            if entry.task is not self.current:
                entry.wake_s = min(entry.wake_s, max(time_s, self.now_s))

    def mark_waiting(self, task: object) -> bool:
        """Return False: no wait is a deadlock, since a client may end it."""
        del task
        return False

    def frame_of(self, task: object) -> FrameType | None:
        """Python frame at which a task is suspended; None if it runs, or has ended."""
        entry = self._entries.get(task)
        return None if entry is None else entry.greenlet.gr_frame

    def _first(self) -> _Entry | None:
        return min(self._entries.values(), key=lambda one: one.rank, default=None)


def _switch(to: greenlet) -> None:
    """Switch to another task and restore the trace function of a program that is being stepped."""
    followed = sys.gettrace()
    to.switch()
    if sys.gettrace() is not followed:
        sys.settrace(followed)
