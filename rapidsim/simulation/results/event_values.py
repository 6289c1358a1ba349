"""Events as records of JSON, which reports and exports write."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import fields
from typing import Annotated

from rapidsim.controller.journal.events import Event, EventKind
from rapidsim.json_records.declarations import Lenient, Rounded, ValueForm
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class EventRecord:
    """An event; its other keys depend on its kind, such as the signal and its value."""

    time_s: Rounded
    task: Lenient[str]
    """Task whose program caused it; `cell` if none did."""
    kind: EventKind
    file: str | None
    line: int | None
    message: str
    details: Annotated[Mapping[str, object], ValueForm.INLINE]
    """Finite numbers, texts and lists."""


_COMMON = frozenset(field.name for field in fields(EventRecord))


def event_record(event: Event) -> EventRecord:
    """Return the record of an event."""
    span = event.place.span if event.place else None
    return EventRecord(
        time_s=event.time_s,
        task=event.task,
        kind=event.kind,
        file=span.file if span else None,
        line=span.line if span else None,
        message=event.message,
        details={
            name: _plain(value) for name, value in event.details.items() if name not in _COMMON
        },
    )


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
