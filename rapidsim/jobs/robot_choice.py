"""A robot, and what determined it."""

from __future__ import annotations

from rapidsim.values import value_class

DEFAULT_ROBOT = "irb1600-6-1.2"


@value_class(frozen=True, slots=True)
class RobotChoice:
    """A robot, and what determined it."""

    name: str
    reason: str | None
    """For the summary; None where the user named the robot."""
    scale: float | None = None
    """What the lengths of a URDF file are multiplied by; None leaves them."""

    @property
    def text(self) -> str:
        """The arm as named in a summary."""
        return self.name if self.reason is None else f"{self.name} ({self.reason})"
