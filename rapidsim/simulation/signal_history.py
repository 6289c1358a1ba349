"""What each signal of a run was, and from when on: for lanes over time."""

from __future__ import annotations

import math

from rapidsim.simulation.result import EventKind, Simulation

Changes = list[tuple[float, float]]
"""Instant [s] from which on a signal has a value, and the value; the first at 0 s."""


def signal_changes(simulation: Simulation) -> dict[str, Changes]:
    """The values of every signal that is declared or changes, by name in alphabetic order."""
    found: dict[str, Changes] = {}
    names: dict[str, str] = {}
    for name, start in simulation.signal_starts.items():
        names[name.lower()] = name
        found[name] = [(0.0, start)]
    for event in simulation.events:
        signal, value = event.details.get("signal"), event.details.get("value")
        if event.kind is not EventKind.SIGNAL or not isinstance(signal, str):
            continue
        if isinstance(value, (int, float)) and math.isfinite(value):
            name = names.setdefault(signal.lower(), signal)
            changes = found.setdefault(name, [(0.0, 0.0)])
            if event.time_s <= 0.0:
                changes[0] = (0.0, float(value))
            else:
                changes.append((event.time_s, float(value)))
    return dict(sorted(found.items(), key=lambda item: item[0].lower()))
