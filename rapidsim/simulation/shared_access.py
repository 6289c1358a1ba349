"""Access to shared data in the order of virtual time."""

from __future__ import annotations

from typing import Protocol

from rapidsim.controller.clock import TaskClock
from rapidsim.values import value_class


class CurrentTask(Protocol):
    """A scheduler that knows the running task."""

    @property
    def current(self) -> object:
        """Clock of the running task; None if no task runs."""
        ...


@value_class(frozen=True, slots=True)
class ScheduledAccess:
    """Implementation of `shared_persistents.SharedAccessObserver` for scheduled tasks."""

    turns: CurrentTask

    def synchronise(self) -> None:
        """Synchronise all other tasks to the time of the running statement."""
        task = self.turns.current
        if isinstance(task, TaskClock):
            task.synchronise()

    def notify(self) -> None:
        """Notify other tasks of a change of shared data."""
        task = self.turns.current
        if isinstance(task, TaskClock):
            task.notify_tasks()
