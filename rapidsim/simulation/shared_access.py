"""Shared data are read and written in the order of virtual time."""

from __future__ import annotations

from typing import Protocol

from rapidsim.controller.clock import TaskClock
from rapidsim.values import value_class


class CurrentTask(Protocol):
    """Who knows which task runs."""

    @property
    def current(self) -> object:
        """The clock of the task that runs; None while none does."""
        ...


@value_class(frozen=True, slots=True)
class ScheduledAccess:
    """Implements `shared_persistents.SharedAccessObserver` for tasks that take turns."""

    turns: CurrentTask

    def synchronise(self) -> None:
        """Let every other task come up to the time of the statement that runs."""
        task = self.turns.current
        if isinstance(task, TaskClock):
            task.synchronise()

    def notify(self) -> None:
        """Shared data have changed."""
        task = self.turns.current
        if isinstance(task, TaskClock):
            task.notify_tasks()
