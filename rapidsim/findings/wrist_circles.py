r"""What comes of circles that two wrist axes lead: CirPathMode \Wrist45, \Wrist46, \Wrist56."""

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
        """What could be done about the cause, or about an axis at its limit or about to jump."""
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
