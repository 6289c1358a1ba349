"""Processor time that the moves of a robot have cost; nothing in a run depends on it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(slots=True)
class PlanningCosts:
    """Sums over all plans that a robot led."""

    solving_s: float = 0.0
    """Time [s] for the geometry of paths and the joints along them."""
    planning_s: float = 0.0
    """Time [s] for the fastest motion along them."""
