r"""Findings about circles with CirPathMode \Wrist45, \Wrist46 or \Wrist56."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class WristCircleFails(Violation, code="K616"):
    target: str
    percent: float
    distance_mm: float
    reason: str
    suggestion: str | None = None

    @property
    def help(self) -> str:
        """Suggestion for the cause, or for an axis at its limit or before a jump."""
        return self.suggestion or (
            "start the circle in another posture, with that axis nearer to the middle of its "
            "range, take another pair of wrist axes, or use all axes, with "
            r"CirPathMode \PathFrame"
        )


class WristCircleTilted(Violation, code="K617"):
    target: str
    angle_deg: float
    pair: str


class WristCircleDeviates(Violation, code="K618"):
    target: str
    pair: str
    off_plane_mm: float
    angle_deg: float
    off_end_mm: float
