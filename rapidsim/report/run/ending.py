"""How a run ended, in one line: for the terminal and for the page."""

from __future__ import annotations

from rapidsim.diagnostics import Severity
from rapidsim.simulation.results.simulation import End, Simulation

_ENDS = {
    End.ENDED: ("ended as programmed", None),
    End.STOPPED: ("stopped by the program", None),
    End.CYCLE_LIMIT: ("ended after the requested cycles", None),
    End.TIME_LIMIT: ("cut off at the time limit", Severity.WARNING),
    End.ERROR: ("stopped with an error", Severity.ERROR),
}


def ending(simulation: Simulation) -> tuple[str, Severity | None]:
    """The words for the end of a run, and how bad it is; None if nothing is wrong."""
    words, severity = _ENDS[simulation.end]
    told = f"{words} after {simulation.time_s:.3f} s"
    hits = 0 if simulation.collisions is None else len(simulation.collisions.hits)
    if not hits:
        return told, severity
    return f"{told}, with {hits} collision{'s' if hits > 1 else ''}", Severity.ERROR
