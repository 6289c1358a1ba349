"""The tables [[search]]: poses of the parts that a torch searches."""

from __future__ import annotations

from rapidsim.controller.cell.part_poses import PartPose
from rapidsim.language.data import IDENTITY_POSE, Orient, Pos, Pose
from rapidsim.station.declared_tables import values_of
from rapidsim.station.toml_reader import Reader, Table
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class SearchTable:
    """A table [[search]]: the pose of a part in the work object in which it was taught."""

    wobj: str | None = None
    """The work object of the searches; None for all."""
    name: str | None = None
    """The `\\SearchName` of the search; None for all."""
    position: tuple[float, float, float] = IDENTITY_POSE.trans
    """Displacement of the part [mm]."""
    quaternion: tuple[float, float, float, float] = IDENTITY_POSE.rot
    """Its rotation, the scalar first."""


def read_searches(reader: Reader, tables: Table) -> tuple[PartPose, ...]:
    """Read the list; errors are collected in the reader."""
    parts = []
    for path, table in reader.tables(tables, "search"):
        if not {"position", "quaternion"} & table.keys():
            reader.wrong(f"{path}.position", "is missing: [0, 0, 0] where the part is as taught")
        one = SearchTable(**values_of(reader, SearchTable, table, path))
        parts.append(
            PartPose(Pose(Pos(*one.position), Orient(*one.quaternion)), one.wobj, one.name)
        )
    return tuple(parts)
