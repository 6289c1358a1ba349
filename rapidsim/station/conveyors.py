"""The tables [[conveyor]]: times at which objects arrive.

[[conveyor]]
unit = "CNV1"
speed = 200
at = 2.0
every = 5.0
length = 1500
"""

from __future__ import annotations

import math

from rapidsim.controller.cell.conveyors import ConveyorScript
from rapidsim.station.toml_reader import Reader, Table

_KEYS = ("unit", "speed", "at", "every", "length")


def read_conveyors(reader: Reader, tables: Table) -> tuple[ConveyorScript, ...]:
    """Read the list; errors are collected in the reader."""
    scripts = []
    for path, table in reader.tables(tables, "conveyor"):
        reader.note_unknown_keys(path, table, _KEYS)
        unit, speed = reader.text(table, path, "unit"), reader.positive(table, path, "speed")
        for key, value in (("unit", unit), ("speed", speed)):
            if value is None and key not in table:
                reader.wrong(f"{path}.{key}", "is missing")
        scripts.append(
            ConveyorScript(
                unit or "",
                speed or 1.0,
                reader.not_negative(table, path, "at") or 0.0,
                reader.positive(table, path, "every"),
                reader.positive(table, path, "length") or math.inf,
            )
        )
    return tuple(scripts)
