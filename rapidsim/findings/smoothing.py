"""Findings of a run about the smoothing of the command (family R)."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class CornerTooFast(Violation, code="R116"):
    load: float
    limit: str
    """The exceeded limit, such as `torque of axis 2`."""
    other_text: str
    """Number of other such corners, for the message; empty for none."""


class CornerSpeedUncertain(Violation, code="R118"):
    limit: str
    """The limit that is reached in the corner, such as `torque of axis 2`."""
    difference: str
    """Difference of a controller's speed and time."""
    other_text: str
    """Number of other such corners, for the message; empty for none."""
