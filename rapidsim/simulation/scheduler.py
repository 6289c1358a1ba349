"""Cooperative scheduler of several tasks on one clock: the task with the earliest time runs next.

Each task is a greenlet. A task requests an advance to a later time (`request_advance`) and sleeps
while others are earlier; ties are broken by the order of the station file. An action of one task
can wake another before its time (`wake_at`). All decisions depend on virtual time only, so runs are
repeatable.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from types import FrameType
from typing import Protocol

from greenlet import greenlet

from rapidsim.simulation.task_greenlets import task_greenlet


class ScheduledTask(Protocol):
    """Clock of a task, as a scheduler sees it."""

    idle_until_s: float
    """Time [s] until which it affects no other task, unless shared data change."""


@dataclass(slots=True, eq=False)
class _Entry:
    """A task of the scheduler."""

    number: int
    task: ScheduledTask
    greenlet: greenlet
    counts: bool
    """Whether the run lasts until this task has ended."""
    wake_s: float = 0.0
    """Time at which it continues; infinite while it waits for others."""
    rests: bool = False
    """Whether it only polls something that does not change."""

    @property
    def rank(self) -> tuple[float, int]:
        """Scheduling order: the lowest runs first."""
        return self.wake_s, self.number


@dataclass(slots=True, eq=False)
class Scheduler:
    """Implementation of `cell.TimeScheduler` for several tasks."""

    current: object = None
    """The running task; None outside of `run`."""
    _entries: list[_Entry] = field(default_factory=list)
    _by_task: dict[object, _Entry] = field(default_factory=dict)
    _hub: greenlet | None = None
    _stopped: bool = False

    def add(self, task: ScheduledTask, body: Callable[[], None], *, counts: bool) -> None:
        """Add a task; tasks at the same time run in the order of adding.

        Args:
            task: Its clock, which calls `request_advance`.
            body: Runs the task; must not raise.
            counts: Whether the run lasts until this task has ended.
        """
        entry = _Entry(len(self._entries), task, task_greenlet(body), counts)
        self._entries.append(entry)
        self._by_task[task] = entry

    def run(self) -> None:
        """Run all tasks until those that count have ended, or the run is stopped."""
        self._hub = greenlet.getcurrent()
        try:
            while not self._stopped and any(one.counts for one in self._alive()):
                entry = min(self._alive(), key=lambda one: one.rank)
                if math.isinf(entry.wake_s):
                    # All wait for each other. The first task that counts ends the run.
                    entry = next(one for one in self._alive() if one.counts)
                self.current = entry.task
                entry.greenlet.switch()
        finally:
            self.current = None
            for entry in self._alive():
                entry.greenlet.throw()

    def frame_of(self, task: object) -> FrameType | None:
        """Python frame at which a task has been suspended; None if it runs, or has ended."""
        entry = self._by_task.get(task)
        return None if entry is None else entry.greenlet.gr_frame

    def stop(self) -> None:
        """End the run when the running task has ended."""
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
        """Earliest time [s] at which another task may continue; infinite if none does."""
        others = (one for one in self._alive() if one.task is not task)
        return min((max(one.wake_s, one.task.idle_until_s) for one in others), default=math.inf)

    def wake_at(self, time_s: float) -> None:
        """Wake the other tasks at the time [s] of an event."""
        for entry in self._entries:
            entry.rests, entry.task.idle_until_s = False, -math.inf
            if entry.task is not self.current:
                entry.wake_s = min(entry.wake_s, time_s)

    def mark_waiting(self, task: object) -> bool:
        """Note that a task waits for others; return whether all of them do so, too."""
        self._by_task[task].rests = True
        return all(one.rests or math.isinf(one.wake_s) for one in self._alive())

    def resting(self, task: object) -> tuple[object, ...]:
        """Return the other tasks that wait for something that only a task can do."""
        others = (one for one in self._alive() if one.task is not task)
        return tuple(one.task for one in others if one.rests or math.isinf(one.wake_s))

    def _alive(self) -> list[_Entry]:
        return [one for one in self._entries if not one.greenlet.dead]
