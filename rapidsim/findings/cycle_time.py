"""Findings about causes of lost cycle time (family D), if the station file sets a cycle budget."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class CycleOverBudget(Violation, code="D701"):
    assumed: str
    budget_s: float
    model: str
    """Version of the motion model behind `assumed`."""


class AvoidableStop(Violation, code="D702"):
    target: str
