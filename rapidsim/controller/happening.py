"""What happens by itself while time passes, as a task's clock sees it."""

from __future__ import annotations

from typing import Protocol


class Happening(Protocol):
    """Something that falls due while a task lets time pass."""

    @property
    def on_path(self) -> bool:
        """Whether asking for the next plans the path of the robot."""
        ...

    def next_s(self) -> float | None:
        """When the next falls due [s]; None if none does."""
        ...

    def pass_next(self, passed_s: float, until_s: float) -> float:
        """Let the next happen.

        Args:
            passed_s: Nothing happens before this time [s] any more.
            until_s: It is due by then.

        Returns:
            When it has ended [s]: a trap takes time.
        """
        ...

    def look_from(self, time_s: float) -> None:
        """Take note that time has passed up to here [s]."""
        ...
