"""The tables [[fault]]: what goes wrong, on purpose, and when. An emergency stop for three seconds:

[[fault]]
kind = "emergency_stop"
at = 2.0
for = 3.0
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from rapidsim.controller.cell.faults import KEYS, FailureKind, Fault
from rapidsim.controller.cell.occasions import Occasion
from rapidsim.json_records.declarations import record_fields
from rapidsim.station.declared_tables import as_record, values_of
from rapidsim.station.stimuli import note_wrong_times
from rapidsim.station.toml_reader import Reader, Table, as_toml

_OF_ALL = ("kind", *(field.key for field in record_fields(Occasion)))


def read_faults(reader: Reader, tables: Table) -> tuple[Fault, ...]:
    """Read the list; errors are collected in the reader."""
    found = []
    for path, table in reader.tables(tables, "fault"):
        found.append(_fault(reader, table, path))
        note_wrong_times(reader, table, path, may_be_now=False)
    return tuple(fault for fault in found if fault is not None)


def read_fault(values: Mapping[str, object]) -> Fault:
    """Read a fault of a test; without a time or a condition it begins at once.

    Raises:
        InputError: If a key is missing, unknown, or has a wrong value.
    """
    table, reader = as_toml(values), Reader(Path("fault"))
    assert isinstance(table, dict)
    fault = _fault(reader, table, "fault")
    note_wrong_times(reader, table, "fault", may_be_now=True)
    reader.finish()
    assert fault is not None
    return fault


def _fault(reader: Reader, table: Table, path: str) -> Fault | None:
    values = values_of(reader, Fault, table, path)
    kind = values.get("kind")
    if not isinstance(kind, FailureKind):
        return None
    for key in table:
        if key not in (*_OF_ALL, *KEYS[kind]) and key in _KNOWN:
            known = ", ".join(KEYS[kind]) or "none"
            reader.wrong(f"{path}.{key}", f"{kind} has no such key; its own keys: {known}")
    if kind is FailureKind.DEVICE_LOST and not values.get("device"):
        reader.wrong(f"{path}.device", "name the device")
    return as_record(Fault, values)


_KNOWN = frozenset(field.key for field in record_fields(Fault))
