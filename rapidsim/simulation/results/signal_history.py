"""Values of each signal of a run over time, for lanes of pictures."""

from __future__ import annotations

import math

from rapidsim.controller.journal.events import EventKind
from rapidsim.simulation.results.simulation import Simulation

Changes = list[tuple[float, float]]
"""Start times [s] of values of a signal, and the values; the first at 0 s."""

_MOST_STILL = 24
"""With more declared signals than this, as in a backup, unchanged ones are omitted."""


def signal_changes(simulation: Simulation, *, still: bool = False) -> dict[str, Changes]:
    """Return the values of every declared or changed signal, by name in alphabetical order.

    Args:
        simulation: The run.
        still: Whether to include the unchanged signals of a long I/O configuration, too; 500 lanes
            of zeros are of no use to a reader.
    """
    found: dict[str, Changes] = {}
    names: dict[str, str] = {}
    is_set: set[str] = set()
    for name, start in simulation.signal_starts.items():
        names[name.lower()] = name
        found[name] = [(0.0, start)]
    for event in simulation.events:
        signal, value = event.details.get("signal"), event.details.get("value")
        if event.kind is not EventKind.SIGNAL or not isinstance(signal, str):
            continue
        if isinstance(value, (int, float)) and math.isfinite(value):
            name = names.setdefault(signal.lower(), signal)
            is_set.add(name)
            changes = found.setdefault(name, [(0.0, 0.0)])
            if event.time_s <= 0.0:
                changes[0] = (0.0, float(value))
            else:
                changes.append((event.time_s, float(value)))
    if len(simulation.signal_starts) > _MOST_STILL and not still:
        found = {name: changes for name, changes in found.items() if name in is_set}
    return dict(sorted(found.items(), key=lambda item: item[0].lower()))
