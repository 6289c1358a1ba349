"""The tables of bodies: [[object]], [[attach]], [[source]], [[sink]] and [collisions].

[[object]]
name = "table"
box = [800, 600, 40]                       # mm
pose = { position = [900, 0, -20] }        # of its centre, in its parent
parent = "world"                           # or "wobj:wobjVice", "link:3", "tool"

[[attach]]
when = "doGrip = 1"
object = "part"                            # or "part *": the nearest of them
to = "tool"                                # or "tool:NAME", "unit:STN1"
nearest = 20                               # mm; what is farther away is not taken
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fnmatch import fnmatchcase
from pathlib import Path

import numpy as np

from rapidsim.collisions import shape
from rapidsim.collisions.geometry import (
    Attachment,
    CellGeometry,
    CellObject,
    ParentKind,
    PartSource,
    Sink,
)
from rapidsim.collisions.meshes.read import IN_METRES, read_mesh
from rapidsim.collisions.shape import Filling, Shape
from rapidsim.files import InputError, did_you_mean
from rapidsim.frames.transform import Transform
from rapidsim.motion.configurations.targets import MM
from rapidsim.station.declared_tables import as_record, read_record, values_of
from rapidsim.station.object_tables import (
    LEAST_M,
    MOST_M,
    SHAPES,
    AttachTable,
    CollisionsTable,
    ObjectTable,
    SinkTable,
    SourceTable,
)
from rapidsim.station.toml_reader import Reader, Table
from rapidsim.station.units import LengthUnit

_MOST_OBJECTS = 1000
_Meshes = dict[tuple[Path, float, Filling], Shape]
"""Shapes of mesh files, with their scales and fillings, which objects share."""


def read_geometry(reader: Reader, station: Table) -> CellGeometry:
    """Read the tables; errors are collected in the reader."""
    objects: dict[str, CellObject] = {}
    meshes: _Meshes = {}
    for number, (path, table) in enumerate(reader.tables(station, "object")):
        if number >= _MOST_OBJECTS:
            reader.wrong("object", f"more than {_MOST_OBJECTS} are not supported")
            break
        found = _object(reader, path, table, meshes)
        if found is None:
            continue
        if found.name.lower() in objects:
            reader.wrong(f"{path}.name", f"another object is called `{found.name}`")
        objects[found.name.lower()] = found
    names = [one.name for one in objects.values()]
    attachments = [
        one
        for path, table in reader.tables(station, "attach")
        if (one := _attachment(reader, path, table, names)) is not None
    ]
    sources = _sources(reader, station, names)
    sinks = _sinks(reader, station, names)
    table = reader.table(station, "collisions")
    settings = values_of(reader, CollisionsTable, table, "collisions")
    clearance_m = settings.pop("clearance_mm", 0.0) * MM
    bodies = CellGeometry(
        tuple(objects.values()), tuple(attachments), sources, sinks, clearance_m=clearance_m
    )
    return replace(bodies, **settings)


def _sources(reader: Reader, station: Table, objects: Sequence[str]) -> tuple[PartSource, ...]:
    sources = []
    for path, table in reader.tables(station, "source"):
        one = read_record(reader, SourceTable, table, path)
        if one is None or not _exists(reader, f"{path}.object", one.object, objects):
            continue
        when = one.when.text if one.when else ""
        if not (when or one.times or {"at", "every"} & set(table)):
            reader.wrong(path, "give `at`, `every`, `times` or `when`")
        sources.append(PartSource(one.object, one.times, _first_s(table, one), one.every, when))
    return tuple(sources)


def _first_s(table: Table, source: SourceTable) -> float | None:
    """Time [s] of the first copy by the clock; None if there is none."""
    return source.at if {"at", "every"} & set(table) else None


def _sinks(reader: Reader, station: Table, objects: Sequence[str]) -> tuple[Sink, ...]:
    sinks = []
    for path, table in reader.tables(station, "sink"):
        one = read_record(reader, SinkTable, table, path)
        if one is not None and _exists(reader, f"{path}.on", one.on, objects):
            sinks.append(Sink(one.on, one.after, one.when.text if one.when else "", one.holds))
    return tuple(sinks)


def _exists(reader: Reader, path: str, name: str, objects: Sequence[str]) -> bool:
    if name.lower() in [one.lower() for one in objects]:
        return True
    cure = did_you_mean(name, objects) or f"there are {', '.join(objects) or 'none'}"
    reader.wrong(path, f"there is no object `{name}`", cure)
    return False


def _attachment(
    reader: Reader, path: str, table: Table, objects: Sequence[str]
) -> Attachment | None:
    attach = as_record(AttachTable, values_of(reader, AttachTable, table, path))
    if attach is None:
        return None
    pattern, tool = attach.object.lower(), attach.to.name.lower()
    matches = tuple(
        name for name in objects if name.lower() == pattern or fnmatchcase(name.lower(), pattern)
    )
    if not matches and not _exists(reader, f"{path}.object", attach.object, objects):
        return None
    of_tool = attach.to.kind is ParentKind.TOOL and tool
    if of_tool and not _exists(reader, f"{path}.to", attach.to.name, objects):
        return None
    to = replace(attach.to, robot=attach.robot)
    return Attachment(attach.when.text, matches, to, attach.nearest * MM)


def _object(reader: Reader, path: str, table: Table, meshes: _Meshes) -> CellObject | None:
    found = values_of(reader, ObjectTable, table, path)
    kinds = [key for key in SHAPES if key in table]
    if len(kinds) != 1:
        reader.wrong(path, f"one of {', '.join(SHAPES)} is needed")
    elif "mesh" not in kinds:
        for key in ("unit", "scale", "filling"):
            if key in table:
                reader.wrong(f"{path}.{key}", f"a {kinds[0]} has no such key")
    entry = as_record(ObjectTable, found)
    if entry is None or len(kinds) != 1:
        return None
    if entry.capsule is not None and entry.capsule.length <= entry.capsule.diameter:
        reader.wrong(f"{path}.capsule.length", "with both ends it is longer than the diameter")
        return None
    body = (
        _solid(entry)
        if entry.mesh is None
        else _mesh(reader, path, table, entry, entry.mesh, meshes)
    )
    if body is None:
        return None
    return CellObject(
        entry.name,
        body,
        replace(entry.parent, robot=entry.robot),
        entry.pose or Transform.identity(),
        entry.colour,
    )


def _solid(entry: ObjectTable) -> Shape | None:
    """Return the shape of an object that is no mesh; None if it is invalid."""
    if entry.box is not None:
        return shape.box(np.array(entry.box) * MM)
    if entry.plane:
        return shape.half_space()
    if entry.sphere is not None:
        return shape.sphere(entry.sphere.radius_m)
    if entry.cylinder is not None:
        return shape.cylinder(entry.cylinder.radius_m, entry.cylinder.length * MM)
    if entry.capsule is not None:
        radius_m = entry.capsule.radius_m
        return shape.capsule(radius_m, entry.capsule.length * MM - 2.0 * radius_m)
    return None


def _mesh(
    reader: Reader, path: str, table: Table, entry: ObjectTable, file: Path, meshes: _Meshes
) -> Shape | None:
    unit = entry.unit
    if "unit" not in table:
        if file.suffix.lower() not in IN_METRES:
            reader.wrong(
                f"{path}.unit", "the file does not give one", f"known: {', '.join(LengthUnit)}"
            )
        else:
            unit = LengthUnit.METRE
    if unit is None:
        return None
    scale = unit.in_m * entry.scale
    if (known := meshes.get((file, scale, entry.filling))) is not None:
        return known
    try:
        mesh = read_mesh(file, file.parent)
    except InputError as mistake:
        reader.wrong(f"{path}.mesh", mistake.message, mistake.help)
        return None
    if entry.filling is Filling.SOLID and not mesh.closed:
        reader.wrong(
            f"{path}.mesh",
            f"{file} is not closed, so it has no inside",
            'filling = "surface" checks only its triangles, filling = "hull" their convex hull',
        )
        return None
    mesh = replace(mesh, vertices=mesh.vertices * scale)
    size = float(np.ptp(mesh.vertices, axis=0).max())
    if not LEAST_M <= size <= MOST_M:
        reader.wrong(
            f"{path}.unit",
            f"{file} would be {size / MM:.6g} mm long in {unit}",
            "give the unit that it was drawn in",
        )
        return None
    meshes[file, scale, entry.filling] = found = shape.of_mesh(mesh, entry.filling)
    return found
