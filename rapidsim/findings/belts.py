"""Findings about arms that follow belts."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class BeltNotFollowed(Violation, code="R132"):
    conveyor: str
    time_s: float
    reason: str
