"""One clock for several tasks: whoever has the earliest time runs, one at a time.

Each task is a greenlet. A task that wants to go to a later time says so (`request_advance`) and
sleeps while
others are earlier; ties go by the order of the station file. What one task does can wake another
before its time (`wake_at`). Nothing depends on anything but virtual time, so runs repeat.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Protocol

from greenlet import greenlet


class ScheduledTask(Protocol):
    """What a scheduler knows of the clock of a task."""

    idle_until_s: float
    """Until then [s] it does nothing that others notice, unless something they share changes."""


@dataclass(slots=True, eq=False)
class _Entry:
    """A task of the scheduler."""

    number: int
    task: ScheduledTask
    greenlet: greenlet
    counts: bool
    """The run lasts as long as any of these."""
    wake_s: float = 0.0
    """When it wants to go on; infinite where it waits for what others do."""
    rests: bool = False
    """It only looks again and again at something that does not change."""

    @property
    def rank(self) -> tuple[float, int]:
        """Whose turn it is: the least."""
        return self.wake_s, self.number


@dataclass(slots=True, eq=False)
class Scheduler:
    """Implements `cell.TimeScheduler` for several tasks."""

    current: object = None
    """The task that runs; None outside of `run`."""
    _entries: list[_Entry] = field(default_factory=list)
    _by_task: dict[object, _Entry] = field(default_factory=dict)
    _hub: greenlet | None = None
    _stopped: bool = False

    def add(self, task: ScheduledTask, body: Callable[[], None], *, counts: bool) -> None:
        """Take a task in; the order of adding is that of tasks at the same time.

        Args:
            task: Its controller, which calls `request_advance`.
            body: Runs it; must not raise.
            counts: Whether the run lasts until this task has ended.
        """
        entry = _Entry(len(self._entries), task, greenlet(body), counts)
        self._entries.append(entry)
        self._by_task[task] = entry

    def run(self) -> None:
        """Run all tasks until those that count have ended, or somebody stops the run."""
        self._hub = greenlet.getcurrent()
        try:
            while not self._stopped and any(one.counts for one in self._alive()):
                entry = min(self._alive(), key=lambda one: one.rank)
                if math.isinf(entry.wake_s):
                    # All wait for each other. The first to be told ends the run.
                    entry = next(one for one in self._alive() if one.counts)
                self.current = entry.task
                entry.greenlet.switch()
        finally:
            self.current = None
            for entry in self._alive():
                entry.greenlet.throw()

    def stop(self) -> None:
        """End the run when the task that runs has ended."""
        self._stopped = True

    def request_advance(self, task: object, time_s: float) -> float:
        """See `cell.TimeScheduler`."""
        entry = self._by_task[task]
        assert self.current is task
        assert self._hub is not None
        entry.wake_s = time_s
        if math.isinf(time_s) or any(
            one.rank < entry.rank for one in self._entries if not one.greenlet.dead
        ):
            self._hub.switch()
        return entry.wake_s

    def next_s(self, task: object) -> float:
        """When the next of the other tasks wants to go on [s]; infinite if none does."""
        others = (one for one in self._alive() if one.task is not task)
        return min((max(one.wake_s, one.task.idle_until_s) for one in others), default=math.inf)

    def wake_at(self, time_s: float) -> None:
        """Wake the other tasks at a time [s] at which something happens."""
        for entry in self._entries:
            entry.rests, entry.task.idle_until_s = False, -math.inf
            if entry.task is not self.current:
                entry.wake_s = min(entry.wake_s, time_s)

    def mark_waiting(self, task: object) -> bool:
        """Note that a task waits for what others do; whether all of them do the same."""
        self._by_task[task].rests = True
        return all(one.rests or math.isinf(one.wake_s) for one in self._alive())

    def resting(self, task: object) -> tuple[object, ...]:
        """The other tasks that wait for what only a task can do."""
        others = (one for one in self._alive() if one.task is not task)
        return tuple(one.task for one in others if one.rests or math.isinf(one.wake_s))

    def _alive(self) -> list[_Entry]:
        return [one for one in self._entries if not one.greenlet.dead]
