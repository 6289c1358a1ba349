"""Shared data are read and written in the order of virtual time."""

from __future__ import annotations

from typing import Protocol

from rapidsim.controller.clock import TaskClock
from rapidsim.values import dataclass


class Current(Protocol):
    """Who knows which task runs."""

    @property
    def current(self) -> object:
        """The clock of the task that runs; None while none does."""
        ...


@dataclass(frozen=True, slots=True)
class TurnsBoard:
    """Implements `shared_persistents.Board` for tasks that take turns."""

    turns: Current

    def look(self) -> None:
        """Let every other task come up to the time of the statement that runs."""
        task = self.turns.current
        if isinstance(task, TaskClock):
            task.come_up()

    def tell(self) -> None:
        """Shared data have changed."""
        task = self.turns.current
        if isinstance(task, TaskClock):
            task.tell()
