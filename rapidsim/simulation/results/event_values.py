"""An event as plain values: what reports and exports write as JSON."""

from __future__ import annotations

import math

from rapidsim.controller.journal.events import Event

DECIMALS = 8
"""Of s, mm and degrees in JSON: more than anybody needs, fewer than machines agree on."""


def written(value: float) -> float:
    """A number as JSON has it, so that files of two machines are equal but for rounding ties."""
    return round(value, DECIMALS) + 0.0


def event_record(event: Event) -> dict[str, object]:
    """What every event has, then its details; finite numbers, texts, lists."""
    span = event.place.span if event.place else None
    common: dict[str, object] = {
        "time_s": written(event.time_s),
        "task": event.task,
        "kind": event.kind.value,
        "file": span.file if span else None,
        "line": span.line if span else None,
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
