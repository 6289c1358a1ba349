"""The tables [[search]]: poses of the parts that a torch searches.

[[search]]
wobj = "wPlate"
name = "left edge"
position = [2, -1.5, 0]
quaternion = [1, 0, 0, 0]
"""

from __future__ import annotations

from rapidsim.controller.cell.part_poses import PartPose
from rapidsim.language.data import IDENTITY_POSE, Orient, Pos, Pose
from rapidsim.station.toml_reader import Reader, Table

_KEYS = ("wobj", "name", "position", "quaternion")


def read_searches(reader: Reader, tables: Table) -> tuple[PartPose, ...]:
    """Read the list; errors are collected in the reader."""
    parts = []
    for path, table in reader.tables(tables, "search"):
        reader.note_unknown_keys(path, table, _KEYS)
        if not {"position", "quaternion"} & table.keys():
            reader.wrong(f"{path}.position", "is missing: [0, 0, 0] where the part is as taught")
        position = reader.numbers(table, path, "position", 3)
        rotation = reader.numbers(table, path, "quaternion", 4)
        pose = Pose(
            IDENTITY_POSE.trans if position is None else Pos(*position),
            IDENTITY_POSE.rot if rotation is None else Orient(*rotation),
        )
        wobj, name = (reader.text(table, path, key) for key in ("wobj", "name"))
        parts.append(PartPose(pose, wobj, name))
    return tuple(parts)
