"""Choice of a robot, with its reason."""

from __future__ import annotations

from rapidsim.values import value_class

DEFAULT_ROBOT = "irb1600-6-1.2"


@value_class(frozen=True, slots=True)
class RobotChoice:
    """A robot, and the reason of its choice."""

    name: str
    reason: str | None
    """Reason for the summary; None if the user named the robot."""
    scale: float | None = None
    """Factor on the lengths of a URDF file; None for no scaling."""

    @property
    def text(self) -> str:
        """Name of the arm in a summary."""
        return self.name if self.reason is None else f"{self.name} ({self.reason})"
