"""The table [gripper], or several [[gripper]]: signals of a gripper, and its load.

[gripper]
close = "doGrip = 1"
closed = "diGripped = 1"
at = "stand"
load = 2.5
"""

from __future__ import annotations

from rapidsim.controller.cell.description import Gripper
from rapidsim.station.declared_tables import read_record, read_records
from rapidsim.station.toml_reader import Reader, Table


def read_grippers(reader: Reader, tables: Table) -> tuple[Gripper, ...]:
    """Read the table or the list; errors are collected in the reader."""
    if not isinstance(tables.get("gripper"), dict):
        return read_records(reader, tables, "gripper", Gripper)
    gripper = read_record(reader, Gripper, reader.table(tables, "gripper"), "gripper")
    return () if gripper is None else (gripper,)
