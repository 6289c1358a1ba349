"""Findings about the way between two points, bound to the move that wanted it."""

from __future__ import annotations

from rapidsim.diagnostics import Violation
from rapidsim.motion.violations import PathNotReachable
from rapidsim.simulation.path_queue import MotionError


def path_violation(error: MotionError) -> Violation:
    """What is wrong with a move that cannot be made."""
    queued, fault = error.queued, error.fault
    return PathNotReachable(
        target=queued.place.arguments.get("topoint", queued.move.instruction),
        percent=100.0 * fault.fraction,
        distance_mm=1000.0 * fault.distance,
        why=fault.reason,
    )
