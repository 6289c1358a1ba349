"""Changes between two station files, key by key.

Tables of a list are matched by their names, those without a name by their keys.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence

from rapidsim.applications.diff.changes import ConfigurationChange
from rapidsim.station.toml_reader import Table

_NAMES = ("name", "set", "to", "object", "unit", "when", "at")
"""Keys that identify the tables of a list; the first that all tables have is used."""
_UNITS = {
    "position": "mm",
    "size": "mm",
    "radius": "mm",
    "length": "mm",
    "start": "deg or mm",
    "limits": "deg or mm",
    "at": "s",
    "after": "s",
    "every": "s",
    "pulse": "s",
    "acceleration_time": "s",
    "filter_time": "s",
    "fine_dwell": "s",
    "cycle-budget": "s",
    "axis_speed": "deg/s or mm/s",
}


def station_changes(old: Table, new: Table) -> Iterator[ConfigurationChange]:
    """Yield the changes of all tables."""
    before, after = dict(_flat("", old)), dict(_flat("", new))
    for path in dict.fromkeys((*before, *after)):
        a, b = before.get(path), after.get(path)
        if a != b:
            table, _, key = path.rpartition(".")
            yield ConfigurationChange(
                "station", "table", table or "top level", key, a, b, _UNITS.get(key, "")
            )


def _flat(path: str, value: object) -> Iterator[tuple[str, str]]:
    """Yield the values by their paths, as text."""
    if isinstance(value, Mapping):
        for key, one in value.items():
            yield from _flat(f"{path}.{key}" if path else str(key), one)
    elif isinstance(value, list) and value and all(isinstance(one, Mapping) for one in value):
        for name, table in _named(value):
            yield from _flat(f"{path}[{name}]", table)
    else:
        yield path, _text(value)


def _named(tables: Sequence[Table]) -> Iterator[tuple[str, Table]]:
    """Yield the tables of a list, each with a distinct name."""
    counts: dict[str, int] = {}
    key = next((one for one in _NAMES if all(one in table for table in tables)), None)
    for table in sorted(tables, key=_text):
        name = "" if key is None else _text(table[key])
        counts[name] = counts.get(name, 0) + 1
        yield name if counts[name] == 1 and name else f"{name}#{counts[name]}", table


def _text(value: object) -> str:
    """Return a value as text; equal numbers have one text."""
    match value:
        case bool():
            return "true" if value else "false"
        case int() | float():
            return f"{float(value):.9g}" if abs(value) < 1e300 else "too large"
        case str():
            return json.dumps(value, ensure_ascii=False)
        case list():
            return f"[{', '.join(map(_text, value))}]"
        case Mapping():
            return f"{{ {', '.join(f'{key} = {_text(value[key])}' for key in sorted(value))} }}"
        case _:
            return str(value)
