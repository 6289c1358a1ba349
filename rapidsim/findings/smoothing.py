"""What a run finds about the smoothing of the command (family R)."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class CornerTooFast(Violation, code="R116"):
    load: float
    limit: str
    """Such as `torque of axis 2`."""
    other_text: str
    """How many more such corners there are; empty for none."""
