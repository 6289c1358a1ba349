"""Findings of a run about AccSet's ramps (family R)."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class RampWaits(Violation, code="R113"):
    wanted: float
    achieved: float
