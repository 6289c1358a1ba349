"""What happens by itself while time passes, as a task's clock sees it."""

from __future__ import annotations

from typing import Protocol


class EventSource(Protocol):
    """Something that falls due while a task passes time."""

    @property
    def on_path(self) -> bool:
        """Whether asking for the next one plans the path of the robot."""
        ...

    def next_s(self) -> float | None:
        """When the next falls due [s]; None if none does."""
        ...

    def dispatch_next(self, passed_s: float, until_s: float) -> float:
        """Carry out the next one.

        Args:
            passed_s: Everything before this time [s] is over.
            until_s: It is due by then.

        Returns:
            When it has ended [s]: a trap takes time.
        """
        ...

    def advance_to(self, time_s: float) -> None:
        """Take note that time has passed up to here [s]."""
        ...
