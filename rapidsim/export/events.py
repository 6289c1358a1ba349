"""Writer of the events of a run as JSON lines, one object per event, in order of time."""

from __future__ import annotations

import json
from pathlib import Path

from rapidsim.json_records.encoding import json_of
from rapidsim.output_files import whole_file
from rapidsim.simulation.results.event_values import event_record
from rapidsim.simulation.results.simulation import Simulation


def write_events(simulation: Simulation, path: str | Path) -> Path:
    """Write the events.

    Returns:
        The path written.

    Raises:
        InputError: For a path that cannot be written.
    """
    path = Path(path)
    with (
        whole_file(path) as temporary,
        temporary.open("w", encoding="utf-8", newline="") as file,
    ):
        for event in simulation.events:
            record = json_of(event_record(event))
            file.write(json.dumps(record, ensure_ascii=False, allow_nan=False) + "\n")
    return path
