"""Write the events of a run as JSON lines, one object an event, in order of time."""

from __future__ import annotations

import json
import math
from pathlib import Path

from rapidsim.output_files import whole_file
from rapidsim.simulation.result import Event, Simulation


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
            file.write(json.dumps(event_json(event), ensure_ascii=False, allow_nan=False) + "\n")
    return path


def event_json(event: Event) -> dict[str, object]:
    """An event as a JSON object: what every event has, then its details."""
    place = event.place
    common: dict[str, object] = {
        "time_s": event.time_s,
        "task": event.task,
        "kind": event.kind.value,
        "file": place.span.file if place else None,
        "line": place.span.line if place else None,
        "message": event.message,
    }
    details = {name: _plain(value) for name, value in event.details.items()}
    return {**common, **{name: value for name, value in details.items() if name not in common}}


def _plain(value: object) -> object:
    """A detail as JSON can say it; numbers that are none become text."""
    match value:
        case bool() | int() | str() | None:
            return value
        case float():
            return value if math.isfinite(value) else str(value)
        case list() | tuple():
            return [_plain(item) for item in value]
        case _:
            return str(value)
