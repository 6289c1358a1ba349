"""The table [gripper], or several [[gripper]]: signals of a gripper, and its load.

[gripper]
close = "doGrip = 1"
closed = "diGripped = 1"
at = "stand"
load = 2.5

And [[smart_gripper]]: the object between the fingers of the servo gripper of an IRB 14000.

[[smart_gripper]]
task = "T_ROB_R"
object = 12
"""

from __future__ import annotations

from rapidsim.controller.cell.description import DescribedFingers, Gripper
from rapidsim.station.declared_tables import read_when
from rapidsim.station.toml_reader import Reader, Table

_KEYS = ("name", "close", "closed", "at", "load", "task")
_STAND, _ANYWHERE = "stand", "anywhere"


def read_grippers(reader: Reader, tables: Table) -> tuple[Gripper, ...]:
    """Read the table or the list; errors are collected in the reader."""
    if isinstance(tables.get("gripper"), dict):
        listed = [("gripper", reader.table(tables, "gripper"))]
    else:
        listed = list(reader.tables(tables, "gripper"))
    grippers = []
    for path, table in listed:
        reader.note_unknown_keys(path, table, _KEYS)
        close = read_when(reader, table, path, "close")
        closed = read_when(reader, table, path, "closed")
        at = reader.text(table, path, "at")
        load_kg = reader.not_negative(table, path, "load")
        name = reader.text(table, path, "name") or "the gripper"
        task = reader.text(table, path, "task")
        if at not in (None, _STAND, _ANYWHERE):
            reader.wrong(f"{path}.at", f'"{_STAND}" or "{_ANYWHERE}" is needed')
        if close is None:
            reader.wrong(path, 'say what closes it, as in close = "doGrip = 1"')
            continue
        grippers.append(Gripper(name, close, closed, at != _ANYWHERE, load_kg or 0.0, task))
    return tuple(grippers)


def read_smart_grippers(reader: Reader, tables: Table) -> tuple[DescribedFingers, ...]:
    """Read the list; errors are collected in the reader."""
    described = []
    for path, table in reader.tables(tables, "smart_gripper"):
        reader.note_unknown_keys(path, table, ("task", "object"))
        object_mm = reader.not_negative(table, path, "object")
        task = reader.text(table, path, "task")
        if object_mm is None:
            reader.wrong(path, "say where closing fingers meet the object, as in object = 12 [mm]")
            continue
        described.append(DescribedFingers(object_mm, task))
    return tuple(described)
