"""Events as plain values, which reports and exports write as JSON."""

from __future__ import annotations

import math

from rapidsim.controller.journal.events import Event

DECIMALS = 8
"""Decimals of s, mm and degrees in JSON: more than needed, fewer than machines agree on."""


def written(value: float) -> float:
    """Return a number rounded for JSON, so that files of two machines are equal but for ties."""
    return round(value, DECIMALS) + 0.0


def event_record(event: Event) -> dict[str, object]:
    """Return the fields common to all events, then the details: finite numbers, texts, lists."""
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
    """Return a detail as a JSON value; infinities, NaN and other types become text."""
    match value:
        case bool() | int() | str() | None:
            return value
        case float():
            return value if math.isfinite(value) else str(value)
        case list() | tuple():
            return [_plain(item) for item in value]
        case _:
            return str(value)
