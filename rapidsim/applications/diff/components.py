"""Components of a value that differ, each with both values and its unit."""

from __future__ import annotations

from collections.abc import Iterator
from typing import get_type_hints

from rapidsim.applications.diff.changes import ComponentChange, Literal
from rapidsim.language import data

_RECORDS: dict[str, type] = {
    "robtarget": data.RobTarget,
    "jointtarget": data.JointTarget,
    "tooldata": data.ToolData,
    "wobjdata": data.WobjData,
    "loaddata": data.LoadData,
    "speeddata": data.SpeedData,
    "zonedata": data.ZoneData,
    "pose": data.Pose,
    "pos": data.Pos,
    "orient": data.Orient,
    "extjoint": data.ExtJoint,
    "robjoint": data.RobJoint,
    "confdata": data.ConfData,
}
_UNITS = {
    "x": "mm",
    "y": "mm",
    "z": "mm",
    "mass": "kg",
    "ix": "kgm2",
    "iy": "kgm2",
    "iz": "kgm2",
    "v_tcp": "mm/s",
    "v_ori": "deg/s",
    "v_leax": "mm/s",
    "v_reax": "deg/s",
    "pzone_tcp": "mm",
    "pzone_ori": "mm",
    "pzone_eax": "mm",
    "zone_ori": "deg",
    "zone_leax": "mm",
    "zone_reax": "deg",
    **{f"rax_{number}": "deg" for number in range(1, 7)},
    **{f"eax_{letter}": "deg or mm" for letter in "abcdef"},
}


def changed_components(type_name: str, old: object, new: object) -> tuple[ComponentChange, ...]:
    """Return the components that differ; the value as a whole if its components are unknown."""
    return tuple(_changed("", _RECORDS.get(type_name), old, new))


def _changed(path: str, record: type | None, old: object, new: object) -> Iterator[ComponentChange]:
    hints = {} if record is None else get_type_hints(record)
    rows = (old, new)
    if hints and all(isinstance(row, tuple | list) and len(row) == len(hints) for row in rows):
        for (name, kind), a, b in zip(hints.items(), old, new, strict=True):  # type: ignore[call-overload]
            nested = kind if hasattr(kind, "_fields") else None
            yield from _changed(f"{path}.{name}" if path else name, nested, a, b)
    elif old != new:
        unit = _UNITS.get(path.rpartition(".")[2], "")
        yield ComponentChange(path, _literal(old), _literal(new), unit)


def _literal(value: object) -> Literal:
    """Return a value that JSON can represent."""
    return value if isinstance(value, bool | int | float | str) else repr(value)
