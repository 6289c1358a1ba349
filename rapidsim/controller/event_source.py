"""Sources of timed events that a task's clock dispatches."""

from __future__ import annotations

from typing import Protocol


class EventSource(Protocol):
    """A source of events that fall due while a task passes time."""

    @property
    def on_path(self) -> bool:
        """Whether reading the time of the next event plans the path of the robot."""
        ...

    def next_s(self) -> float | None:
        """Time [s] of the next event; None if there is none."""
        ...

    def dispatch_next(self, passed_s: float, until_s: float) -> float:
        """Dispatch the next event.

        Args:
            passed_s: Time [s] before which all is over.
            until_s: Time [s] by which the event is due.

        Returns:
            Time [s] at which the event has ended: a trap takes time.
        """
        ...

    def advance_to(self, time_s: float) -> None:
        """Note that time has passed up to `time_s` [s]."""
        ...
